"""Compute all chunks of some work: take up what is finished, do the rest, keep it, and say how far it is."""

from __future__ import annotations

import os
from collections.abc import Callable, Generator, Sequence
from contextlib import closing, contextmanager
from dataclasses import replace
from typing import TypeVar

from ninedof.chunks.crew import Crew, Executors
from ninedof.chunks.store import Store
from ninedof.chunks.work import Arrays, Work, as_arrays, bounds, chunks_of
from ninedof.support.arguments import shown, whole
from ninedof.support.progress import Progress

__all__ = ["chunk_argument", "kept", "run"]

MOST_CHUNK = 2**24  # points


def chunk_argument(chunk: object, default: int) -> int:
    """Return the points a chunk has."""
    return default if chunk is None else whole("chunk", chunk, 1, MOST_CHUNK)


W = TypeVar("W", bound=Work)


@contextmanager
def kept(work: W, out: str | os.PathLike[str] | None) -> Generator[tuple[Store | None, W]]:
    """Open the folder of a caller, if there is one; return it with the work, cut as the chunks that are there."""
    if out is None:
        yield None, work
        return
    if not isinstance(out, str | os.PathLike):
        raise ValueError(f"out: got {shown(out)}, expected a path")
    with Store(out, work.question(), work.chunk) as store:
        yield store, replace(work, chunk=store.chunk)  # type: ignore[type-var]  # every work is a dataclass


def run(
    work: Work,
    deliver: Callable[[int, int, Arrays], object],
    store: Store | None = None,
    executor: Executors | None = None,
    progress: Progress | None = None,
) -> None:
    """Compute every chunk once, in this process or by an executor.

    Parameters
    ----------
    work : Work
    deliver : callable
        Called in this thread as deliver(first, last, arrays) for each chunk, in no particular order.
    store : Store, optional
        Finished chunks are read from it and new ones kept in it. Without it a run that ends early leaves nothing.
    executor : Executor or callable, optional
        As `Crew` takes it.
    progress : callable, optional
        Called as progress(points done, points in all, None), first with what the store holds.

    """
    count = _Count(work.points, progress)
    todo: Sequence[int] = range(chunks_of(work))
    if store is not None:
        todo = _missing(work, store, deliver, count)
    count.report()
    with closing(_computed(work, todo, executor)) as computed:  # Ctrl-C while keeping a chunk recalls the others too
        for k, arrays in computed:
            first, last = bounds(work, k)
            if store is not None:
                store.write(k, arrays)
            deliver(first, last, arrays)
            count.add(last - first)
            count.report()


def _missing(work: Work, store: Store, deliver: Callable[[int, int, Arrays], object], count: _Count) -> list[int]:
    """Deliver the chunks that are there; return the numbers of the others."""
    missing = []
    for k in range(chunks_of(work)):
        first, last = bounds(work, k)
        if (found := store.read(k)) is None:
            missing.append(k)
        else:
            deliver(first, last, found)
            count.add(last - first)
    return missing


def _computed(work: Work, todo: Sequence[int], executor: Executors | None) -> Generator[tuple[int, Arrays]]:
    tasks = ((k, work.task(*bounds(work, k))) for k in todo)
    if executor is None:
        for k, task in tasks:
            yield k, as_arrays(task())
    elif todo:
        with Crew(executor) as crew:
            yield from crew.run(tasks)


class _Count:
    """Counts finished points and reports them."""

    def __init__(self, total: int, progress: Progress | None) -> None:
        self._total, self._progress, self._done = total, progress, 0

    def add(self, points: int) -> None:
        self._done += points

    def report(self) -> None:
        if self._progress is not None:
            self._progress(self._done, self._total, None)
