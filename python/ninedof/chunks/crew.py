"""Chunks to an executor and back: a bounded number at a time, and a lost worker costs its chunk and not the run."""

from __future__ import annotations

import secrets
import warnings
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, CancelledError, Executor, Future, wait
from itertools import chain, count
from typing import Any, NamedTuple

from ninedof.chunks.work import Arrays, Task, as_arrays
from ninedof.support.arguments import shown

__all__ = ["Crew", "Executors", "check_executor"]

Executors = Executor | Callable[[], Executor]
"""An executor, or what makes one: only the second can be replaced when it breaks."""

PATIENCE = 3  # times that one chunk may be lost before the run gives up
REPLACEMENTS = 3  # executors made anew before the run gives up: a chunk may be what kills them
IN_FLIGHT = 4  # chunks per worker that wait at the executor: enough to keep it busy, few to be lost or pickled early
FEWEST, UNKNOWN = 8, 128
LOOK = 0.1  # seconds between two looks at the keyboard


def check_executor(executor: Any) -> None:
    """Refuse what can neither run tasks nor make something that can."""
    if executor is not None and not callable(getattr(executor, "submit", None)) and not callable(executor):
        raise ValueError(
            f"executor: got {shown(executor)}, expected a concurrent.futures.Executor or a function that makes one"
        )


class _Flight(NamedTuple):
    """A chunk on its way."""

    item: tuple[int, Task]
    executor: Any


def _perform(task: Task, ticket: str) -> Arrays:
    """Do a task. By the ticket a submission differs from all others: Dask takes equal calls for one, lost ones too."""
    return task()


class Crew:
    """Runs tasks by an executor.

    A chunk that comes back cancelled, or with the news that its worker is gone, is submitted again, at most three
    times. A ProcessPoolExecutor breaks for good once one of its processes dies. Where a function that makes executors
    was given, it is called for another one, at most three times; where the executor itself was given, the rest is done
    in this process, and a RuntimeWarning says so. What a task raises itself ends the run.
    """

    def __init__(self, executor: Executors) -> None:
        check_executor(executor)
        self._make: Any = None if callable(getattr(executor, "submit", None)) else executor
        self._executor: Any = executor if self._make is None else self._made()
        self._left = REPLACEMENTS
        self._lost: dict[int, int] = {}
        own = secrets.token_hex(8)
        self._tickets = (f"{own}-{n}" for n in count())

    def __enter__(self) -> Crew:
        return self

    def __exit__(self, *_: object) -> None:
        self._dismiss()

    def run(self, tasks: Iterable[tuple[int, Task]]) -> Iterator[tuple[int, Arrays]]:
        """Go through numbered tasks in any order; return each number with what its task left."""
        source = iter(tasks)
        again: list[tuple[int, Task]] = []
        flying: dict[Future[Any], _Flight] = {}
        try:
            while True:
                while self._executor is not None and len(flying) < self._room():
                    item = again.pop() if again else next(source, None)
                    if item is None:
                        break
                    if not self._submit(item, flying):
                        again.append(item)
                if self._executor is None:  # broken and not to be replaced: what flies is lost
                    again.extend(flight.item for flight in flying.values())
                    flying.clear()
                    for k, task in chain(again, source):
                        yield k, as_arrays(task())
                    return
                if not flying:
                    return
                finished = wait(flying, timeout=LOOK, return_when=FIRST_COMPLETED).done
                for future in finished:
                    flight = flying.pop(future)
                    arrays = self._outcome(future, flight)
                    if arrays is None:
                        again.append(flight.item)
                    else:
                        yield flight.item[0], arrays
        finally:
            for future in flying:
                future.cancel()

    def _room(self) -> int:
        """Return how many chunks may fly. Of a cluster, which can grow, nothing is known: enough for a large one."""
        workers = getattr(self._executor, "_max_workers", None)
        return max(FEWEST, IN_FLIGHT * workers) if isinstance(workers, int) else UNKNOWN

    def _submit(self, item: tuple[int, Task], flying: dict[Future[Any], _Flight]) -> bool:
        executor = self._executor
        try:
            flying[executor.submit(_perform, item[1], next(self._tickets))] = _Flight(item, executor)
        except BrokenExecutor as error:
            self._replace(executor, error)
            return False
        return True

    def _outcome(self, future: Future[Any], flight: _Flight) -> Arrays | None:
        """Return what a task left, or None where its worker is gone and it is worth another try."""
        k = flight.item[0]
        try:
            return as_arrays(future.result(timeout=0))
        except BrokenExecutor as error:  # all that waited at it come back so: no fault of theirs, and not counted
            self._replace(flight.executor, error)
        except (CancelledError, ConnectionError, EOFError) as error:
            self._count_loss(k, error)
        except Exception as error:
            if type(error).__module__.partition(".")[0] != "distributed":  # KilledWorker and the like
                raise
            self._count_loss(k, error)
        return None

    def _count_loss(self, k: int, error: BaseException) -> None:
        self._lost[k] = self._lost.get(k, 0) + 1
        if self._lost[k] > PATIENCE:
            raise RuntimeError(f"chunk {k}: its worker was lost {self._lost[k]} times, last with {error!r}") from error

    def _replace(self, broken: Any, error: BrokenExecutor) -> None:
        """Put a new executor in the place of a broken one, or none."""
        if self._executor is not broken:
            return  # another chunk brought the same news before
        self._dismiss()
        self._executor = None
        if self._make is None:
            warnings.warn(
                f"executor: it is broken and cannot be used again ({error}); the rest is computed in this process. "
                "A function that makes executors, given in its place, would be called for a new one",
                RuntimeWarning,
                stacklevel=2,
            )
            return
        self._left -= 1
        if self._left < 0:
            raise RuntimeError(
                f"executor: {REPLACEMENTS + 1} broke one after the other, the last with {error!r}"
            ) from error
        self._executor = self._made()

    def _made(self) -> Any:
        made = self._make()
        if not callable(getattr(made, "submit", None)):
            raise ValueError(
                f"executor: got a function that makes {shown(made)}, expected a concurrent.futures.Executor"
            )
        return made

    def _dismiss(self) -> None:
        """End an executor of our own making; one that was given stays its owner's."""
        if self._make is not None and self._executor is not None:
            self._executor.shutdown(wait=False, cancel_futures=True)
