"""The option --scheduler: a Dask cluster by its address, and what is said when it is lost."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import ExitStack, contextmanager, suppress

from ninedof.support.arguments import LONGEST, cleaned, shown
from ninedof.support.extras import optional

TIMEOUT = 10.0  # seconds for a scheduler to answer
CLOSING = 2.0  # seconds to take leave
OF_CLUSTER = ("distributed", "dask", "tornado", "asyncio", "concurrent")  # modules of its errors


@contextmanager
def executor_at(scheduler: str | None) -> Iterator[Executor | None]:
    """Connect to a Dask scheduler; inside the `with` block its workers compute the tasks of the executor.

    None without an address. ImportError says how to install dask where it is missing, ValueError that no scheduler
    answers at the address, RuntimeError that it was lost.
    """
    if scheduler is None:
        yield None
        return
    distributed = optional("distributed", "cluster", "a Dask cluster")

    async def handshake() -> None:
        (await asyncio.wait_for(distributed.comm.connect(scheduler, timeout=TIMEOUT), TIMEOUT)).abort()

    with ExitStack() as after:
        after.callback(logging.disable, logging.root.manager.disable)
        logging.disable(logging.CRITICAL)  # of a lost connection dask writes ninety lines, each of an error we raise
        try:
            asyncio.run(handshake())  # a client that finds no scheduler goes on looking for it
            client = distributed.Client(scheduler, timeout=TIMEOUT, set_as_default=False)
        except (Exception, asyncio.CancelledError) as error:  # of any kind: what listens there may send anything
            reason = str(error) or "timed out"
            raise ValueError(
                f"scheduler: got {shown(scheduler)}, where no scheduler answers ({cleaned(reason)}), "
                "expected that of one, as tcp://host:8786"
            ) from None
        try:
            yield client.get_executor()
        except (Exception, asyncio.CancelledError) as error:
            of_cluster = type(error).__module__.partition(".")[0] in OF_CLUSTER
            if not (of_cluster or isinstance(error, TimeoutError | ConnectionError)):
                raise
            reason = f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
            notes = "".join(f". {note}" for note in getattr(error, "__notes__", ()))
            raise RuntimeError(f"--scheduler: lost {scheduler} ({reason[:LONGEST]}){notes}") from None
        finally:
            with suppress(Exception):  # a scheduler that is lost cannot take leave
                client.close(timeout=CLOSING)
