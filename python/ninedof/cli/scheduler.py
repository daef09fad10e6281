"""The option --scheduler: a Dask cluster, and what is said when it is lost."""

from __future__ import annotations

from asyncio import CancelledError
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from typing import TYPE_CHECKING

from ninedof.support.arguments import LONGEST
from ninedof.support.cluster import dask_executor, is_of_cluster

if TYPE_CHECKING:
    from concurrent.futures import Executor


@contextmanager
def executor_at(scheduler: str | None) -> Iterator[Executor | None]:
    """Connect to the scheduler of an address and yield its executor; None without an address."""
    try:
        with nullcontext() if scheduler is None else dask_executor(scheduler) as executor:
            yield executor
    except (Exception, CancelledError) as error:
        if scheduler is None or not is_of_cluster(error):
            raise
        reason = f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
        notes = "".join(f". {note}" for note in getattr(error, "__notes__", ()))
        raise RuntimeError(f"--scheduler: lost {scheduler} ({reason[:LONGEST]}){notes}") from None
