"""Start and stop of the web server."""

from __future__ import annotations

import contextlib
import errno
import logging
import socket
from collections.abc import Iterator
from typing import Any

from ninedof.support.arguments import shown
from ninedof.support.extras import optional
from ninedof.viewer.guard import guard


def started(host: str, port: int) -> Any:
    """Return a server of viser at a port; 0 takes any free one.

    Raises
    ------
    MissingExtra
        Without viser.
    ValueError
        If the port is in use, the host is no address of this machine, or viser lets nobody look at its requests.

    """
    viser = optional("viser", "viewer", "the viewer")
    if isinstance(port, bool) or not isinstance(port, int) or not 0 <= port <= 65535:
        raise ValueError(f"port: got {shown(port)}, expected a number from 0 to 65535")
    _require_free(host, port)
    logging.getLogger("websockets.server").addFilter(_no_handshake)  # only once, however often it is added
    with _silence(), guard(host) as guarded:
        server = viser.ViserServer(host=host, port=port, label="ninedof", verbose=False)
    if not guarded:
        stopped(server)
        raise ValueError(
            f"viser: got {viser.__version__}, whose requests cannot be looked at, expected another release"
        )
    server.request_share_url = server.disconnect_share_url = _not_shared  # any page could ask for it by a message
    if port not in (0, server.get_port()):  # taken a moment ago: viser goes on to the next ones
        stopped(server)
        raise ValueError(_in_use(port))
    return server


def stopped(server: Any) -> None:
    """Stop a server."""
    with _silence():
        server.stop()


def _not_shared(verbose: bool = False) -> None:
    """Stand for what would hand the viewer to the whole world through a server of strangers."""


def _no_handshake(record: logging.LogRecord) -> bool:
    """Leave out what is printed of a request that is no page, such as HEAD; viser does so after the first page."""
    return record.getMessage() != "opening handshake failed"


@contextlib.contextmanager
def _silence() -> Iterator[None]:
    """Leave out what viser prints."""
    import rich

    console = rich.get_console()
    quiet, console.quiet = console.quiet, True
    try:
        yield
    finally:
        console.quiet = quiet


def _in_use(port: int) -> str:
    return f"port: got {port}, which is in use, expected a free one, or 0 for any"


def _require_free(host: str, port: int) -> None:
    try:
        family, kind, _, _, address = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0]
    except (OSError, UnicodeError) as error:
        raise ValueError(f"host: got {host!r}, expected an address of this machine ({error})") from None
    with socket.socket(family, kind) as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)  # as the server does: a port just left is free
        try:
            probe.bind(address)
        except PermissionError:
            raise ValueError(f"port: got {port}, which needs the rights of root, expected one above 1023") from None
        except OSError as error:
            if error.errno == errno.EADDRINUSE:
                raise ValueError(_in_use(port)) from None
            raise ValueError(f"host: got {host!r}, expected an address of this machine ({error.strerror})") from None
