"""Compute all chunks of some work: take up what is finished, do the rest, keep it, and say how far it is."""

from __future__ import annotations

import os
from collections.abc import Callable, Generator, Sequence
from contextlib import closing, contextmanager
from dataclasses import replace
from time import perf_counter
from typing import TypeVar

from ninedof.chunks.crew import Crew, Executors
from ninedof.chunks.store import Store
from ninedof.chunks.work import Arrays, Work, as_arrays, bounds, chunks_of
from ninedof.support.arguments import shown, whole

__all__ = ["Progress", "check_progress", "chunk_argument", "kept", "run"]

MOST_CHUNK = 2**24  # points

Progress = Callable[[int, int, float], object]
"""Called with (points done, points in all, seconds to go); the last is NaN before anything is known."""


def check_progress(progress: object) -> None:
    """Refuse what cannot be called."""
    if progress is not None and not callable(progress):
        raise ValueError(f"progress: got {shown(progress)}, expected a callable of three arguments")


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

    """
    clock = _Clock(work.points, progress)
    todo: Sequence[int] = range(chunks_of(work))
    if store is not None:
        todo = _missing(work, store, deliver, clock)
    clock.start()
    with closing(_computed(work, todo, executor)) as computed:  # Ctrl-C while keeping a chunk recalls the others too
        for k, arrays in computed:
            first, last = bounds(work, k)
            if store is not None:
                store.write(k, arrays)
            deliver(first, last, arrays)
            clock.done(last - first)


def _missing(work: Work, store: Store, deliver: Callable[[int, int, Arrays], object], clock: _Clock) -> list[int]:
    """Deliver the chunks that are there; return the numbers of the others."""
    missing = []
    for k in range(chunks_of(work)):
        first, last = bounds(work, k)
        if (found := store.read(k)) is None:
            missing.append(k)
        else:
            deliver(first, last, found)
            clock.found(last - first)
    return missing


def _computed(work: Work, todo: Sequence[int], executor: Executors | None) -> Generator[tuple[int, Arrays]]:
    tasks = ((k, work.task(*bounds(work, k))) for k in todo)
    if executor is None:
        for k, task in tasks:
            yield k, as_arrays(task())
    elif todo:
        with Crew(executor) as crew:
            yield from crew.run(tasks)


class _Clock:
    """Tells how far the work is, and how long the rest will take at the pace of this run."""

    def __init__(self, total: int, progress: Progress | None) -> None:
        self._total, self._progress = total, progress
        self._found = self._done = 0
        self._begin = perf_counter()

    def found(self, points: int) -> None:
        self._found += points

    def start(self) -> None:
        self._begin = perf_counter()
        self._tell(float("nan") if self._found < self._total else 0.0)

    def done(self, points: int) -> None:
        self._done += points
        left = self._total - self._found - self._done
        self._tell(left * (perf_counter() - self._begin) / self._done)

    def _tell(self, to_go: float) -> None:
        if self._progress is not None:
            self._progress(self._found + self._done, self._total, to_go)
