"""Start and stop of the web server, which serves pages of its own address alone.

A browser lets every page of the web open a web socket to 127.0.0.1, and a name that an attacker points there (DNS
rebinding) makes such a page look like one of the viewer. Both are seen in the headers Origin and Host.
"""

from __future__ import annotations

import contextlib
import errno
import logging
import re
import socket
import threading
from collections.abc import Iterator
from http import HTTPStatus
from ipaddress import ip_address
from typing import Any

from ninedof.support.arguments import whole
from ninedof.support.extras import optional

HOST = re.compile(r"\[?([0-9a-z:._-]+?)\]?(:[0-9]{1,5})?", re.IGNORECASE | re.ASCII)
_patching = threading.Lock()


def start(host: str, port: int) -> Any:
    """Return a server of viser at a port; 0 takes any free one. ValueError names a port or host that cannot be used."""
    viser = optional("viser", "viewer", "the viewer")
    _require_free(host, whole("port", port, 0, 65535))
    logging.getLogger("websockets.server").addFilter(_no_handshake)  # only once, however often it is added
    with _silence(), _guard(host) as guarded:
        server = viser.ViserServer(host=host, port=port, label="ninedof", verbose=False)
    if not guarded:
        stop(server)
        raise ValueError(f"viser: got {viser.__version__}, whose requests are not guarded, expected another release")
    # Any page could ask by a message for a tunnel that hands the viewer to the whole world.
    server.request_share_url = server.disconnect_share_url = lambda verbose=False: None
    return server


def stop(server: Any) -> None:
    """Stop a server."""
    with _silence():
        server.stop()


def loopback(host: str) -> bool:
    """Return whether an address is reached from this machine alone."""
    with contextlib.suppress(ValueError):
        return ip_address(host.strip("[]")).is_loopback
    return host.lower() == "localhost"


def refusal(headers: Any, host: str) -> str:
    """Return why a request with headers of websockets is refused by a viewer that listens at `host`; "" if it is not.

    Its Host is a number, which nobody can point elsewhere, or a name of this machine; its Origin, if any, the same.
    """
    hosts, origins = headers.get_all("Host"), headers.get_all("Origin")
    address = HOST.fullmatch(hosts[0]) if len(hosts) == 1 else None
    if address is None or not _own(address[1].lower(), host.lower()):
        return "Host: expected the address of the viewer"
    if any(origin.lower() not in (f"http://{hosts[0].lower()}", f"https://{hosts[0].lower()}") for origin in origins):
        return "Origin: expected the page of the viewer, not that of another site"
    return ""


def _own(name: str, host: str) -> bool:
    with contextlib.suppress(ValueError):
        return bool(ip_address(name))
    machine = socket.gethostname().lower()
    return name in {"localhost", host} | (set() if loopback(host) else {machine, f"{machine}.local"})


@contextlib.contextmanager
def _guard(host: str) -> Iterator[list[bool]]:
    """Refuse foreign requests to the server of viser that starts within; the list given is empty if that failed.

    viser takes no function that looks at requests, so the one that it hands to websockets is wrapped.
    """
    module = optional("websockets.asyncio.server", "viewer", "the viewer")
    guarded: list[bool] = []

    def serve(*args: Any, process_request: Any = None, **options: Any) -> Any:
        def look(connection: Any, request: Any) -> Any:
            if why := refusal(request.headers, host):
                return connection.respond(HTTPStatus.FORBIDDEN, f"{why}.\n")
            return process_request(connection, request)

        guarded.append(process_request is not None)
        return of_websockets(*args, process_request=process_request and look, **options)

    with _patching:
        of_websockets, module.serve = module.serve, serve
        try:
            yield guarded
        finally:
            module.serve = of_websockets


def _no_handshake(record: logging.LogRecord) -> bool:
    """Leave out what is printed of a request that is no page, such as HEAD; viser does so after the first page."""
    return record.getMessage() != "opening handshake failed"


@contextlib.contextmanager
def _silence() -> Iterator[None]:
    import rich

    console = rich.get_console()
    quiet, console.quiet = console.quiet, True
    try:
        yield
    finally:
        console.quiet = quiet


def _require_free(host: str, port: int) -> None:
    try:
        family = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0][0]
        socket.create_server((host, port), family=family).close()
    except (OSError, UnicodeError) as error:
        if isinstance(error, OSError) and error.errno in (errno.EADDRINUSE, errno.EACCES):
            words = "which is in use or reserved, expected a free one, or 0 for any"
            raise ValueError(f"port: got {port}, {words}") from None
        raise ValueError(f"host: got {host!r}, expected an address of this machine ({error})") from None
