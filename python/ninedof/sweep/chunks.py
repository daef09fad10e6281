"""Long work in chunks: each is computed alone, anywhere, and none twice where a folder keeps what is finished.

The folder notes which chunks are finished, and has a .npy file for each large array.
"""

from __future__ import annotations

import math
import os
import secrets
import shutil
from collections.abc import Generator, Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from contextlib import closing, nullcontext, suppress
from dataclasses import replace
from itertools import islice
from pathlib import Path
from time import monotonic
from typing import Any, NamedTuple, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from ninedof.support.arguments import executor_argument, path_argument, whole
from ninedof.support.arrays import Floats
from ninedof.support.files import Arrays, naming
from ninedof.support.progress import Progress, progress_argument
from ninedof.support.store import Store

FINISHED = "finished"  # an entry of what is noted
EVERY = 0.5  # seconds: what is finished is noted as often, and at the end
IN_FLIGHT = 128  # chunks at an executor: enough to keep it busy, few to be lost or pickled early
MOST_CHUNK, MOST_CHUNKS = 2**24, 2**22  # points of a chunk, chunks of a run


class State(Protocol):
    """The values computed so far."""

    @property
    def finished(self) -> NDArray[Any]:
        """Return an entry for each chunk: 0 where it is missing."""

    def add(self, first: int, arrays: Arrays) -> None:
        """Take the values of the chunk that begins with point `first`."""

    def noted(self) -> Arrays:
        """Return what a folder notes; `finished` is part of it."""


S = TypeVar("S", bound=State, covariant=True)


class Work(Protocol[S]):
    """A dataclass: points 0 ... points - 1 in chunks of `chunk` points, the last one smaller."""

    @property
    def points(self) -> int:
        """Return the number of points."""

    @property
    def chunk(self) -> int:
        """Return the number of points of a chunk."""

    def question(self) -> dict[str, Any]:
        """Return all that the values depend on, but for the version of this package."""

    def part(self, first: int, last: int) -> Work[S]:
        """Return what is needed for points first ... last - 1: small, and it can be pickled."""

    def values(self, first: int, last: int) -> Arrays:
        """Return the values of points first ... last - 1: the same whenever and wherever this is called."""

    def begin(self, folder: Folder | None) -> S:
        """Return the state of this work in a folder, or in memory."""


def chunk_argument(chunk: object, default: int) -> int:
    """Return the number of points of a chunk."""
    return default if chunk is None else whole("chunk", chunk, 1, MOST_CHUNK)


def chunks_of(work: Work[Any]) -> int:
    """Return the number of chunks; raise where there are more than can be counted in time."""
    if (count := -(-work.points // work.chunk)) > MOST_CHUNKS:
        least = -(-work.points // MOST_CHUNKS)
        raise ValueError(f"chunk: got {work.chunk} of {work.points} points, expected at least {least}")
    return count


def run(
    work: Work[S],
    executor: Executor | None = None,
    out: str | os.PathLike[str] | None = None,
    progress: Progress | None = None,
) -> S:
    """Compute every chunk that is missing, in this process or by an executor, and return all values.

    Parameters
    ----------
    work : Work
    executor : concurrent.futures.Executor, optional
        Retries and lost workers are left to it: its exceptions end the run.
    out : path, optional
        Folder that keeps what is finished.
    progress : callable, optional
        Called as progress(points done, points in all, None), first with the points found in the folder.

    """
    executor_argument(executor)
    progress_argument(progress)
    place = nullcontext() if out is None else Folder(path_argument("out", out), work.question(), work.chunk)
    with place as folder:
        if folder is not None:
            work = replace(work, chunk=folder.chunk)  # type: ignore[type-var]  # every work is a dataclass
        state = work.begin(folder)
        for done in _done(work, state, executor):
            if folder is not None:
                folder.note(state)
            if progress is not None:
                progress(done, work.points, None)
        return state


def _done(work: Work[Any], state: State, executor: Executor | None) -> Iterator[int]:
    """Compute what is missing; yield the number of points done, at first and after each chunk."""
    first = np.flatnonzero(state.finished == 0) * work.chunk
    missing = [Chunk(k, min(k + work.chunk, work.points)) for k in first.tolist()]
    done = work.points - sum(chunk.last - chunk.first for chunk in missing)
    yield done
    with closing(_here(work, missing) if executor is None else _by(executor, work, missing)) as computed:
        for chunk, arrays in computed:
            state.add(chunk.first, arrays)
            done += chunk.last - chunk.first
            yield done


class Chunk(NamedTuple):
    """Its first point, and the one after its last."""

    first: int
    last: int


Computed = Generator[tuple[Chunk, Arrays]]


def _here(work: Work[Any], chunks: list[Chunk]) -> Computed:
    for chunk in chunks:
        yield chunk, work.values(*chunk)


def _by(executor: Executor, work: Work[Any], chunks: list[Chunk]) -> Computed:
    """Yield the values of chunks as they come; a few are at the executor, and those are cancelled at the end."""
    left, token = iter(chunks), secrets.token_hex(8)
    waiting: dict[Future[Arrays], Chunk] = {}
    try:
        while True:
            for chunk in islice(left, IN_FLIGHT - len(waiting)):
                waiting[executor.submit(_perform, work.part(*chunk), chunk, token)] = chunk
            if not waiting:
                return
            done = wait(waiting, return_when=FIRST_COMPLETED).done
            for future in sorted(done, key=_failed):  # what is finished is kept before an error ends the run
                yield waiting.pop(future), future.result()
    finally:
        for future in waiting:
            future.cancel()


def _perform(part: Work[Any], chunk: Chunk, token: str) -> Arrays:
    """Compute a chunk. The token makes the call differ from those of other runs: Dask does not repeat equal calls."""
    return part.values(*chunk)


def _failed(future: Future[Any]) -> bool:
    return future.cancelled() or future.exception() is not None


class Folder(Store):
    """What is finished of some work, in the folder of a run: notes as piece 0, large arrays in files beside it."""

    def __init__(self, path: Path, question: dict[str, Any], chunk: int) -> None:
        super().__init__(path, question, chunk)
        self.saved: Arrays = self.read(0) or {}
        """What was noted before."""
        self._files: dict[str, Any] = {}
        self._state: State | None = None
        self._next = 0.0

    def array(self, name: str, shape: tuple[int, ...]) -> Floats:
        """Return an array of numbers in a file of the folder: read through a memory map, written by `put`."""
        path = self.folder / f"{name}.npy"
        try:
            fits = (values := np.load(path, mmap_mode="r")).shape == shape and values.dtype == np.float64
        except (OSError, ValueError, EOFError):
            fits = False
        if not fits:
            path.unlink(missing_ok=True)
            np.lib.format.open_memmap(path, "w+", np.float64, shape)
        array: np.memmap[Any, np.dtype[np.float64]] = np.load(path, mmap_mode="r")
        self._files[name] = path.open("r+b", buffering=0), array.offset
        return array

    def put(self, name: str, first: int, values: Floats) -> None:
        """Write values by position: a writeable memory map would fill the memory, and a full disk end the process."""
        file, offset = self._files[name]
        try:
            file.seek(offset + first * (values.nbytes // len(values)))
            left = values.data.cast("B")
            while left:
                left = left[file.write(left) :]
        except OSError as error:
            raise naming(error, self.folder / f"{name}.npy") from None

    def free(self) -> float:
        """Return the bytes that are free on the disk; infinity where it does not say."""
        with suppress(OSError):
            disk = shutil.disk_usage(self.folder)
            if disk.total:
                return disk.free
        return math.inf

    def note(self, state: State) -> None:
        """Note what is finished, unless that was done just now: then at the end."""
        self._state = state
        if monotonic() >= self._next and state.finished.any():
            self.keep(0, state.noted())
            self._next = monotonic() + EVERY

    def __exit__(self, kind: object, error: BaseException | None, *more: object) -> None:
        """Note what is finished; where that is nothing, no array stays."""
        for file, _offset in self._files.values():
            file.close()
        if self._state is not None and self._state.finished.any():
            self.keep(0, self._state.noted())
        if not self.kept():
            for name in self._files:
                (self.folder / f"{name}.npy").unlink(missing_ok=True)
        super().__exit__(kind, error, *more)
