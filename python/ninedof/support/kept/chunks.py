"""Long work in chunks: each is computed alone, anywhere, and none twice where a folder keeps what is finished."""

from __future__ import annotations

import os
from collections.abc import Callable, Generator, Iterable, Iterator
from contextlib import closing, contextmanager, nullcontext
from functools import partial
from itertools import islice
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

from ninedof.support.arguments import executor_argument, path_argument, whole
from ninedof.support.kept.files import Arrays
from ninedof.support.kept.store import Store
from ninedof.support.running import Progress, progress_argument

if TYPE_CHECKING:
    from concurrent.futures import Executor, Future

K = TypeVar("K")
T = TypeVar("T")

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
    tell = progress_argument(progress) or (lambda *_: None)
    with nullcontext() if out is None else Store(path_argument("out", out), work.question(), work.chunk) as store:
        if store is not None:
            _countable(work.points, store.chunk)  # before room is made on the disk
        yield store, _computed(work, store, executor, tell)


def _countable(points: int, chunk: int) -> None:
    """Refuse more chunks than a run may have."""
    if points > MOST_CHUNKS * chunk:
        raise ValueError(f"chunk: got {chunk} of {points} points, expected at least {-(-points // MOST_CHUNKS)}")


def _computed(work: Work, store: Store | None, executor: Executor | None, tell: Progress) -> Computed:
    size = work.chunk if store is None else store.chunk
    _countable(work.points, size)
    done, missing, some = 0, [], store is not None and store.has_pieces()
    for k, first in enumerate(range(0, work.points, size)):
        last = min(first + size, work.points)
        if not some or store is None or (values := store.read(k)) is None:
            missing.append((first, last))
            continue
        yield (first, last), values
        done += last - first
    tell(done, work.points, None)
    here = ((chunk, work.values(*chunk)) for chunk in missing)
    there = ((chunk, partial(work.part(*chunk).values, *chunk)) for chunk in missing)
    with closing(here if executor is None else results_at(executor, there)) as new:
        for (first, last), values in new:
            if store is not None:
                store.keep(first // size, values)
            yield (first, last), values
            done += last - first
            tell(done, work.points, None)


def results_at(executor: Executor, jobs: Iterable[tuple[K, Callable[[], T]]]) -> Generator[tuple[K, T]]:
    """Yield what the calls of jobs return as it comes, under their keys.

    A few calls are at the executor, and those are cancelled at the end.
    """
    from concurrent.futures import FIRST_COMPLETED, wait  # when it is needed, as it takes time to load

    left, token = iter(jobs), os.urandom(8).hex()
    waiting: dict[Future[T], K] = {}
    try:
        while True:
            for key, call in islice(left, IN_FLIGHT - len(waiting)):
                waiting[executor.submit(_perform, call, token)] = key
            if not waiting:
                return
            finished = wait(waiting, return_when=FIRST_COMPLETED).done
            order = sorted(finished, key=lambda one: one.cancelled() or one.exception() is not None)
            for future in order:  # what is finished is kept before an error ends the run
                yield waiting.pop(future), future.result()
    finally:
        for future in waiting:
            future.cancel()


def _perform(call: Callable[[], T], token: str) -> T:
    """Call. The token makes it differ from calls of other runs: Dask does not repeat equal ones."""
    return call()
