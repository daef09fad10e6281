"""Compute all chunks of some work: read the finished ones, compute and keep the others, report progress."""

from __future__ import annotations

import os
import secrets
from collections.abc import Callable, Generator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from contextlib import closing
from dataclasses import replace
from itertools import islice
from pathlib import Path
from typing import Any, TypeVar

from ninedof.chunks.store import Store
from ninedof.chunks.work import Task, Work, as_arrays, bounds, chunks_of
from ninedof.support.arguments import executor_argument, path_argument
from ninedof.support.files import Arrays
from ninedof.support.progress import Progress, progress_argument

IN_FLIGHT = 4  # chunks per worker that wait at the executor: enough to keep it busy, few to be lost or pickled early
FEWEST, UNKNOWN = 8, 128
MOST_CHUNKS = 2**22  # of a run: each is a file of its folder

Deliver = Callable[[int, int, Arrays], object]
"""Called as deliver(first, last, arrays) for each chunk."""

W = TypeVar("W", bound=Work)


def run(
    work: W,
    begin: Callable[[Path | None], Deliver],
    *,
    executor: Executor | None = None,
    out: str | os.PathLike[str] | None = None,
    progress: Progress | None = None,
) -> None:
    """Compute every chunk once, in this process or by an executor.

    Parameters
    ----------
    work : Work
        A dataclass with a field `chunk`.
    begin : callable
        Called once with the folder of the chunks, or None, after all arguments were checked. Returns a function that is
        called in this thread as deliver(first, last, arrays) for each chunk, in no particular order.
    executor : concurrent.futures.Executor, optional
        Retries and lost workers are its own matter: its exceptions end the run.
    out : path, optional
        Folder of finished chunks: they are read from it and new ones kept in it. One that cannot be written is
        delivered all the same; a RuntimeWarning tells of the first.
    progress : callable, optional
        Called as progress(points done, points in all, None), first with the points read from the folder.

    """
    executor_argument(executor)
    progress_argument(progress)
    if out is not None:
        out = path_argument("out", out)
    if out is None:
        deliver = begin(None)  # says first what does not fit into memory
        _require_few_chunks(work)
        _run(work, deliver, None, executor, progress)
        return
    _require_few_chunks(work)
    with Store(out, work.question(), work.chunk) as store:
        try:
            cut = replace(work, chunk=store.chunk)  # type: ignore[type-var]  # every work is a dataclass
            _run(cut, begin(store.folder), store, executor, progress)
        except Exception as error:
            if words := store.kept_words():
                error.add_note(words)
            raise


def _require_few_chunks(work: Work) -> None:
    if chunks_of(work) > MOST_CHUNKS:
        least = -(-work.points // MOST_CHUNKS)
        raise ValueError(f"chunk: got {work.chunk} of {work.points} points, expected at least {least}")


def _run(
    work: Work, deliver: Deliver, store: Store | None, executor: Executor | None, progress: Progress | None
) -> None:
    done = 0
    missing = []
    for k in range(chunks_of(work)):
        first, last = bounds(work, k)
        if store is None or (found := store.read(k)) is None or not work.fits(last - first, found):
            missing.append(k)
        else:
            deliver(first, last, found)
            done += last - first
    if progress is not None:
        progress(done, work.points, None)
    tasks = ((k, work.task(*bounds(work, k))) for k in missing)
    with closing(_here(tasks) if executor is None else _by(executor, tasks)) as computed:
        for k, arrays in computed:
            first, last = bounds(work, k)
            if not work.fits(last - first, arrays):
                raise RuntimeError(f"chunk {k}: got arrays that are not of its {last - first} points")
            if store is not None:
                store.keep(k, arrays)
            deliver(first, last, arrays)
            done += last - first
            if progress is not None:
                progress(done, work.points, None)
    if done != work.points:
        raise RuntimeError(f"got the values of {done} points, expected {work.points}")


Tasks = Generator[tuple[int, Task]]
Computed = Generator[tuple[int, Arrays]]


def _here(tasks: Tasks) -> Computed:
    for k, task in tasks:
        yield k, as_arrays(task())


def _by(executor: Executor, tasks: Tasks) -> Computed:
    """Submit a bounded number of tasks at a time, yield results as they come; at the end cancel what still waits."""
    run_id = secrets.token_hex(8)
    waiting: dict[Future[Any], int] = {}
    try:
        while True:
            for k, task in islice(tasks, _most_in_flight(executor) - len(waiting)):
                waiting[executor.submit(_perform, task, f"{run_id}-{k}")] = k
            if not waiting:
                return
            done = wait(waiting, return_when=FIRST_COMPLETED).done
            for future in sorted(done, key=_failed):  # what is finished is kept before an error ends the run
                yield waiting.pop(future), as_arrays(future.result())
    finally:
        for future in waiting:
            future.cancel()


def _failed(future: Future[Any]) -> bool:
    return future.cancelled() or future.exception() is not None


def _perform(task: Task, name: str) -> Arrays:
    """Perform a task. The name makes it differ from those of other runs: Dask does not repeat equal calls."""
    return task()


def _most_in_flight(executor: Executor) -> int:
    """Return how many chunks may wait. The size of a cluster is not known: enough for a large one."""
    workers = getattr(executor, "_max_workers", None)
    return max(FEWEST, IN_FLIGHT * workers) if isinstance(workers, int) else UNKNOWN
