"""Executors for more than one process: a Dask cluster by its address."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager

from ninedof.extras import optional

__all__ = ["dask_executor"]

PATIENCE = 15  # seconds for a scheduler to answer


@contextmanager
def dask_executor(address: str) -> Iterator[Executor]:
    """Connect to a Dask scheduler; inside the `with` its workers compute what the executor is given.

    Parameters
    ----------
    address : str
        As `dask scheduler` prints it, "tcp://host:8786". The workers need the same version of this package.

    Raises
    ------
    ImportError
        If dask is not installed; the message says how to install it.
    OSError
        If no scheduler answers there.

    """
    distributed = optional("distributed", "cluster", "a Dask cluster")
    with distributed.Client(address, timeout=PATIENCE, set_as_default=False) as client:
        yield client.get_executor()
