"""Executors for more than one process: a Dask cluster by its address."""

from __future__ import annotations

import re
import socket
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager

from ninedof.support.arguments import shown
from ninedof.support.extras import optional

TIMEOUT = 15  # seconds for a scheduler to answer
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
    try:
        _require_answer(found[2] or found[3], int(found[4]), found[1] in (None, "tcp"))
        client = distributed.Client(address, timeout=TIMEOUT, set_as_default=False)
    except OSError as error:
        reason = error.strerror or str(error)
        raise ValueError(
            f"address: got {address}, where no scheduler answers ({reason}), expected that of a Dask scheduler"
        ) from None
    with client:
        yield client.get_executor()


def _require_answer(host: str, port: int, sends_first: bool) -> None:
    """Raise OSError unless a scheduler answers: a Dask client without a scheduler warns when it is deleted.

    By plain TCP the scheduler sends first. A client would wait forever for a server that accepts and sends nothing.
    """
    with socket.create_connection((host, port), timeout=TIMEOUT) as line:
        if sends_first and not line.recv(1):
            raise OSError("the connection was closed")
