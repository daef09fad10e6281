"""A Dask cluster by its address."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager, suppress

from ninedof.support.arguments import cleaned, shown
from ninedof.support.extras import optional

TIMEOUT = 10.0  # seconds for a scheduler to answer
CLOSING = 2.0  # seconds to take leave


@contextmanager
def dask_executor(scheduler: str) -> Iterator[Executor]:
    """Connect to a Dask scheduler; inside the `with` block its workers compute the tasks of the executor.

    Parameters
    ----------
    scheduler : str
        Its address as `dask scheduler` prints it, "tcp://host:8786". The workers need the same version of this
        package.

    Raises
    ------
    ImportError
        If dask is not installed; the message says how to install it.
    ValueError
        If no scheduler answers there.

    """
    distributed = optional("distributed", "cluster", "a Dask cluster")

    async def handshake() -> None:
        (await asyncio.wait_for(distributed.comm.connect(scheduler, timeout=TIMEOUT), TIMEOUT)).abort()

    with _silent():
        try:
            asyncio.run(handshake())  # a client that finds no scheduler goes on looking for it
            client = distributed.Client(scheduler, timeout=TIMEOUT, set_as_default=False)
        except Exception as error:  # of any kind: what listens there may send anything
            reason = str(error) or "timed out"
            raise ValueError(
                f"scheduler: got {shown(scheduler)}, where no scheduler answers ({cleaned(reason)}), "
                "expected that of one, as tcp://host:8786"
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
    """Log nothing: of a lost connection dask writes ninety lines, and each is one of an error that we raise."""
    before = logging.root.manager.disable
    logging.disable(logging.CRITICAL)
    try:
        yield
    finally:
        logging.disable(before)
