"""Executors for more than one process: a Dask cluster by its address."""

from __future__ import annotations

import logging
import re
import socket
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, Future
from contextlib import contextmanager, suppress
from threading import Thread
from time import monotonic
from typing import TypeVar

from ninedof.support.arguments import shown
from ninedof.support.extras import optional

TIMEOUT = 10.0  # seconds for a scheduler to answer, all steps together
CLOSING = 2.0  # seconds to take leave
HELLO, LONGEST_HELLO = b"pickle-protocol", 2**16  # in the first message of a scheduler, by its size in binary
T = TypeVar("T")
ADDRESS = re.compile(r"(?:(tcp|tls|ucx|ws|wss)://)?(?:\[([^\[\]\s]+)\]|([^\[\]\s:/]+)):([0-9]{1,5})")


@contextmanager
def dask_executor(address: str) -> Iterator[Executor]:
    """Connect to a Dask scheduler; inside the `with` block its workers compute the tasks of the executor.

    Parameters
    ----------
    address : str
        As `dask scheduler` prints it, "tcp://host:8786". The workers need the same version of this package.

    Raises
    ------
    ImportError
        If dask is not installed; the message says how to install it.
    ValueError
        If the address is not valid, or no scheduler answers.

    """
    distributed = optional("distributed", "cluster", "a Dask cluster")
    found = ADDRESS.fullmatch(address)
    if found is None or not 0 < int(found[4]) < 2**16:
        raise ValueError(f"address: got {shown(address)}, expected one as tcp://host:8786")
    # One that found no scheduler would wait for it again, half a minute, when it is deleted.
    client_type = type("Client", (distributed.Client,), {"__del__": lambda self: None})
    end = monotonic() + TIMEOUT
    with _silent():
        try:
            _require_answer(found[2] or found[3], int(found[4]), found[1] in (None, "tcp"), end)
            left = max(0.1, end - monotonic())
            client = _within(left, lambda: client_type(address, timeout=left, set_as_default=False))
        except Exception as error:  # of any kind: what listens there may send anything
            reason = (isinstance(error, OSError) and error.strerror) or str(error) or type(error).__name__
            if reason.lower().startswith("timed out"):  # the client's own clock was the first of two: it says at length
                reason = "timed out"
            raise ValueError(
                f"address: got {address}, where no scheduler answers ({reason}), expected that of a Dask scheduler"
            ) from None
        try:
            yield client.get_executor()
        finally:
            with suppress(Exception):  # a scheduler that is lost cannot take leave
                client.close(timeout=CLOSING)


def is_of_cluster(error: BaseException) -> bool:
    """Return whether an error in the `with` block is of the cluster: a scheduler or workers were lost."""
    of = type(error).__module__.partition(".")[0]
    return of in ("distributed", "dask", "tornado", "asyncio", "concurrent") or isinstance(
        error, TimeoutError | ConnectionError
    )


@contextmanager
def _silent() -> Iterator[None]:
    """Say nothing: of a lost connection dask writes ninety lines, and each is one of an error that we raise."""
    before = logging.root.manager.disable
    logging.disable(logging.CRITICAL)
    try:
        yield
    finally:
        logging.disable(before)


def _within(seconds: float, work: Callable[[], T]) -> T:
    """Return what some work returns, or raise TimeoutError: names are looked up for as long as the system likes."""
    done: Future[T] = Future()

    def run() -> None:
        try:
            done.set_result(work())
        except BaseException as error:
            done.set_exception(error)

    Thread(target=run, daemon=True).start()
    try:
        return done.result(seconds)
    except TimeoutError as error:
        raise TimeoutError(str(error) or "timed out") from None


def _require_answer(host: str, port: int, sends_first: bool, end: float) -> None:
    """Raise OSError unless a scheduler answers: a Dask client without a scheduler warns when it is deleted.

    By plain TCP the scheduler sends first, a message that names its version of pickle. A client would wait forever for
    a server that accepts and sends nothing, and take what another server sends for the length of a message.
    """
    with _within(TIMEOUT, lambda: socket.create_connection((host, port), timeout=TIMEOUT)) as line:
        heard = b""
        while sends_first and HELLO not in heard:
            line.settimeout(max(0.01, end - monotonic()))
            part = line.recv(4096)
            heard += part
            if not part:
                raise OSError("the connection was closed")
            if len(heard) > LONGEST_HELLO or heard[:1].isalpha() or monotonic() > end:
                raise OSError("another program answers")
