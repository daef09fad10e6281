"""Who may talk to the viewer: pages of its own address alone, and no page may load or run what the viewer did not send.

A browser lets every page of the web open a web socket to 127.0.0.1, and a name that an attacker points there (DNS
rebinding) makes such a page look like one of the viewer. Both are seen in the headers Origin and Host.

viser takes no function that looks at requests, so the one that it hands to websockets is wrapped while it starts.
"""

from __future__ import annotations

import contextlib
import functools
import re
import socket
import threading
from collections.abc import Callable, Iterator
from ipaddress import ip_address
from typing import Any

from ninedof.support.extras import optional

HOST = re.compile(r"(\[[0-9a-f:.]+\]|[a-z0-9._-]+)(:[0-9]{1,5})?", re.IGNORECASE | re.ASCII)
LOOPBACK = ("127.0.0.1", "::1", "localhost")
HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cross-Origin-Opener-Policy": "same-origin",
}
# The page of viser unpacks itself: its scripts are inline, with a little WebAssembly. No text becomes code (no
# 'unsafe-eval'), and nothing comes from or goes to another address.
POLICY = (
    "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval' blob:; worker-src blob:; style-src "
    "'unsafe-inline'; img-src data: blob:; font-src data:; media-src data: blob:; connect-src 'self' ws://{host} data: "
    "blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)

_patching = threading.Lock()


def loopback(host: str) -> bool:
    """Return whether an address is reached from this machine alone."""
    with contextlib.suppress(ValueError):
        return ip_address(host.strip("[]")).is_loopback
    return host.lower() in LOOPBACK


def refusal(headers: Any, host: str) -> str:
    """Return why a request is refused, "" where it is not.

    Parameters
    ----------
    headers : websockets.datastructures.Headers
    host : str
        That the viewer listens at.

    """
    named, origins = headers.get_all("Host"), headers.get_all("Origin")
    if len(named) != 1 or not HOST.fullmatch(named[0]):
        return "Host: expected the address of the viewer"
    if not _own(named[0], host):
        return "Host: expected the address of the viewer, not another name of this machine"
    if any(origin.lower() not in (f"http://{named[0].lower()}", f"https://{named[0].lower()}") for origin in origins):
        return "Origin: expected the page of the viewer, not that of another site"
    return ""


def _own(named: str, host: str) -> bool:
    """Return whether a Host header is a number, which nobody can point elsewhere, or a name of this machine."""
    name = re.sub(r":[0-9]+\Z", "", named).strip("[]").lower()
    with contextlib.suppress(ValueError):
        return bool(ip_address(name))
    own = {"localhost", host.lower()}
    if not loopback(host):
        own |= {socket.gethostname().lower(), f"{socket.gethostname().lower()}.local"}
    return name.rstrip(".") in own


def guarded(process: Callable[[Any, Any], Any], host: str) -> Callable[[Any, Any], Any]:
    """Return a `process_request` of websockets that refuses strangers before `process` sees them."""
    import http

    def looked_at(connection: Any, request: Any) -> Any:
        if why := refusal(request.headers, host):
            return _with_headers(connection.respond(http.HTTPStatus.FORBIDDEN, f"{why}.\n"), "")
        answer = process(connection, request)
        return answer if answer is None else _with_headers(answer, request.headers["Host"])

    return looked_at


def _with_headers(response: Any, host: str) -> Any:
    for name, value in HEADERS.items():
        response.headers[name] = value
    response.headers["Content-Security-Policy"] = POLICY.format(host=host) if host else "default-src 'none'"
    return response


@contextlib.contextmanager
def guard(host: str) -> Iterator[list[bool]]:
    """Guard the server of viser that starts within; the list given is empty if it started unguarded.

    Servers that other threads start meanwhile are left alone.
    """
    server = optional("websockets.asyncio.server", "viewer", "the viewer")
    before = set(threading.enumerate())
    seen: list[bool] = []

    with _patching:
        serve = server.serve

        @functools.wraps(serve, updated=())
        def watched(handler: Any, *args: Any, process_request: Any = None, **options: Any) -> Any:
            of_viser = getattr(handler, "__module__", "").startswith("viser.") and args[:1] == (host,)
            if of_viser and threading.current_thread() not in before and process_request is not None:
                seen.append(True)
                process_request = guarded(process_request, host)
            return serve(handler, *args, process_request=process_request, **options)

        server.serve = watched
        try:
            yield seen
        finally:
            server.serve = serve
