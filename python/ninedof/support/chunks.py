"""Long work in chunks: each is computed alone, anywhere, and none twice where a folder keeps what is finished."""

from __future__ import annotations

import os
from collections.abc import Generator, Iterator
from contextlib import closing, contextmanager
from dataclasses import replace
from itertools import islice
from typing import TYPE_CHECKING, Any, Protocol

from ninedof.support.arguments import executor_argument, path_argument, whole
from ninedof.support.files import Arrays
from ninedof.support.running import Progress, progress_argument
from ninedof.support.store import Store

if TYPE_CHECKING:
    from concurrent.futures import Executor, Future

IN_FLIGHT = 128  # chunks at an executor: enough to keep it busy, few to be lost or pickled early
MOST_CHUNK, MOST_CHUNKS = 2**24, 2**22  # points of a chunk, chunks of a run


class Work(Protocol):
    """A dataclass: points 0 ... points - 1 in chunks of `chunk` points, the last one smaller."""

    @property
    def points(self) -> int:
        """Return the number of points."""

    @property
    def chunk(self) -> int:
        """Return the number of points of a chunk."""

    def question(self) -> dict[str, Any]:
        """Return all that the values depend on, but for the version of this package."""

    def part(self, first: int, last: int) -> Work:
        """Return what is needed for points first ... last - 1: small, and it can be pickled."""

    def values(self, first: int, last: int) -> Arrays:
        """Return the values of points first ... last - 1: the same whenever and wherever this is called."""


Chunk = tuple[int, int]  # its first point, and the one after its last
Computed = Generator[tuple[Chunk, Arrays]]


def chunk_argument(chunk: object, default: int) -> int:
    """Return the number of points of a chunk."""
    return default if chunk is None else whole("chunk", chunk, 1, MOST_CHUNK)


@contextmanager
def computed(
    work: Work, out: str | os.PathLike[str] | None, executor: Executor | None, progress: Progress | None
) -> Iterator[tuple[Store | None, Computed]]:
    """Check the arguments; yield the folder, and every chunk with its values: those kept there, then the others.

    A run that began in the folder `out` goes on in chunks of its size. Retries and lost workers are left to the
    executor: its exceptions end the run. Progress begins with the points found in the folder.
    """
    executor_argument(executor)
    progress_argument(progress)
    if out is None:
        yield None, _computed(work, None, executor, progress)
        return
    with Store(path_argument("out", out), work.question(), work.chunk) as store:
        own: Any = work  # every work is a dataclass
        work = replace(own, chunk=store.chunk)
        _countable(work)  # before room is made on the disk
        yield store, _computed(work, store, executor, progress)


def _countable(work: Work) -> None:
    """Refuse more chunks than a run may have."""
    if work.points > MOST_CHUNKS * work.chunk:
        least = -(-work.points // MOST_CHUNKS)
        raise ValueError(f"chunk: got {work.chunk} of {work.points} points, expected at least {least}")


def _computed(work: Work, store: Store | None, executor: Executor | None, progress: Progress | None) -> Computed:
    _countable(work)
    done, missing, some = 0, [], store is not None and store.kept()
    for k, first in enumerate(range(0, work.points, work.chunk)):
        last = min(first + work.chunk, work.points)
        if not some or store is None or (values := store.read(k)) is None:
            missing.append((first, last))
            continue
        yield (first, last), values
        done += last - first
    if progress is not None:
        progress(done, work.points, None)
    here = ((chunk, work.values(*chunk)) for chunk in missing)
    with closing(here if executor is None else _by(executor, work, missing)) as new:
        for (first, last), values in new:
            if store is not None:
                store.keep(first // work.chunk, values)
            yield (first, last), values
            done += last - first
            if progress is not None:
                progress(done, work.points, None)


def _by(executor: Executor, work: Work, chunks: list[Chunk]) -> Computed:
    """Yield the values of chunks as they come; a few are at the executor, and those are cancelled at the end."""
    from concurrent.futures import FIRST_COMPLETED, wait  # when it is needed, as it takes time to load

    left, token = iter(chunks), os.urandom(8).hex()
    waiting: dict[Future[Arrays], Chunk] = {}
    try:
        while True:
            for chunk in islice(left, IN_FLIGHT - len(waiting)):
                waiting[executor.submit(_perform, work.part(*chunk), chunk, token)] = chunk
            if not waiting:
                return
            finished = wait(waiting, return_when=FIRST_COMPLETED).done
            order = sorted(finished, key=lambda one: one.cancelled() or one.exception() is not None)
            for future in order:  # what is finished is kept before an error ends the run
                yield waiting.pop(future), future.result()
    finally:
        for future in waiting:
            future.cancel()


def _perform(part: Work, chunk: Chunk, token: str) -> Arrays:
    """Compute a chunk. The token makes the call differ from those of other runs: Dask does not repeat equal calls."""
    return part.values(*chunk)
