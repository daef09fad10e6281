"""All designs of a box that keep every limit at every pose, proved."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from contextlib import closing, suppress
from functools import partial
from time import perf_counter
from typing import TYPE_CHECKING, Any, NamedTuple, TypedDict, Unpack

import numpy as np
from numpy.typing import NDArray

from ninedof import _core
from ninedof.design.study import Study
from ninedof.proof.admissible.result import STATES, AdmissibleSet
from ninedof.proof.design_range import LONGEST, DesignRange, HasDesign, design_range
from ninedof.support.arguments import executor_argument, finite, instance, whole
from ninedof.support.arrays import MOST_THREADS, Floats
from ninedof.support.kept.chunks import results_at
from ninedof.support.running import Progress, progress_argument
from ninedof.support.structs import Fixed, from_core, options_of

if TYPE_CHECKING:
    from concurrent.futures import Executor


class AdmissibleArguments(TypedDict, total=False):
    """Options of `admissible`, which says what they mean."""

    at: Mapping[str, float | str] | None
    condition_number: float | None
    time_limit: float | None
    resolution: float
    threads: int
    executor: Executor | None
    resume: AdmissibleSet | None
    progress: Progress | None


def admissible(
    of: Study | HasDesign,
    vary: Collection[str] | Mapping[str, tuple[float, float] | None],
    **options: Unpack[AdmissibleArguments],
) -> AdmissibleSet:
    """Divide a box of designs into what keeps every limit at every pose, what breaks one, and the rest; proved.

    Merlet's parameter space for this machine: all designs that fulfil a requirement, in place of one optimum.

    Parameters
    ----------
    of : Study or Result
        The limits, the region or the poses, and the values of the variables that do not vary. The region has to say
        where O is; poses without a choice of O. A limit of the condition number needs a characteristic length that is
        a number.
    vary : names, or mapping of names to (low, high)
        One to four variables of the family; the ends of the study's bounds where none are given. Angles in radians, or
        in degrees with _deg behind the name.
    at : mapping, optional
        Values of variables, in place of those of the study or the result, or changes of these: {"zs": "+10%"}.
    condition_number : float, optional
        A bound of the condition number besides the limits.
    time_limit : float, optional
        Seconds; none by default. What is proved by then is returned, as after Ctrl-C. With an executor the seconds of
        each root on its worker: all in all at most 64 times as long, divided by the number of workers.
    resolution : float
        Boxes are not divided below this part of each range. What is proved of the parts of the last ones is finer.
    threads : int
        0: one per processor; with an executor one for each root. The result does not depend on it, but for a time
        limit.
    executor : concurrent.futures.Executor, optional
        Where to search: threads, processes, or a cluster by Dask's `Client.get_executor()`. The box is cut into 64
        roots whatever the number of workers, and the set does not depend on that. It may differ from the set that is
        found without an executor, never in what is proved of a design. An exception of the executor or a root is
        raised. After Ctrl-C the roots that have not ended are undecided; those under way end by the time limit.
    resume : AdmissibleSet, optional
        An earlier one of the same question, whose undecided boxes are gone on with.
    progress : callable, optional
        Called as progress(boxes of designs, 0, undecided share); with an executor progress(roots done, roots, None).

    Raises
    ------
    ValueError
        For a variable that is unknown, fixed or without finite ends, one that is free and has no value, and for what
        has no bounds over boxes of designs; the message names it.

    Notes
    -----
    Limits are compared exactly, without the tolerance of an optimizer: an optimum on a limit lies on the boundary.
    Source: docs/theory/admissible.md; Merlet's parameter-space approach is the paper's reference 1.

    Examples
    --------
    >>> import ninedof as nd
    >>> study = nd.Study(variables={"a1": 0.0, "a2": (2.0, 10.0), "b1": (1.0, 5.0), "b2": 0.0})
    >>> found = nd.admissible(study, ("a2", "b1"), at={"zp": 4.9752, "zs": 3.1681}, condition_number=3.911)
    >>> f"{found.shares['inside']:.1%}"
    '18.2%'

    """
    chosen = options_of(admissible, AdmissibleArguments, options, resolution=0.01, threads=0)
    question = design_range(of, vary, chosen["at"], chosen["condition_number"])
    seconds = LONGEST if chosen["time_limit"] is None else finite("time_limit", chosen["time_limit"], 0.0)
    resolution = finite("resolution", chosen["resolution"], 0.0, 1.0)
    threads = whole("threads", chosen["threads"], 0, MOST_THREADS)
    resume, executor, begin = chosen["resume"], chosen["executor"], perf_counter()
    executor_argument(executor)
    if resume is not None and instance("resume", resume, AdmissibleSet).of.digest != question.digest:
        raise ValueError("resume: got the designs of another question, expected those of this one")
    progress = progress_argument(chosen["progress"])
    how: dict[str, Any] = {"seconds": min(seconds, LONGEST), "resolution": resolution, "progress": progress}
    if executor is None:
        answer = _core.admissible_designs(question.for_core(), threads=threads, undecided=ENOUGH, earlier=resume, **how)
    else:
        answer = by_roots(question, executor, resume, threads=threads or 1, **how)
    return from_core(
        AdmissibleSet,
        answer,
        of=question,
        shares=Fixed({name: getattr(answer, name) for name in STATES}),
        designs=answer.looked_at + (0 if resume is None else resume.designs),
        boxes=answer.boxes + (0 if resume is None else resume.boxes),
        seconds=perf_counter() - begin + (0.0 if resume is None else resume.seconds),
    )


ENOUGH = 1e-5  # of the volume: what is undecided below it is not looked at
ROOTS = 64  # whatever the workers are: the answer does not depend on them


class Pieces(NamedTuple):
    """Pieces of a box as `AdmissibleSet` has them."""

    low: Floats
    high: Floats
    state: NDArray[np.int8]
    demand: NDArray[np.int32]
    poses: Floats

    def chosen(self, rows: Any) -> Pieces:
        """Return some of the pieces."""
        return Pieces(*(column[rows] for column in self))


def joined(parts: Iterable[Pieces]) -> Pieces:
    """Return all pieces of some parts."""
    return Pieces(*map(np.concatenate, zip(*parts, strict=True)))


def decided(root: Pieces, of: DesignRange, **how: Any) -> tuple[Pieces, tuple[int, int, bool]]:
    """Return the pieces of a root, decided as far as its time goes; boxes of designs and of poses, interrupted."""
    answer = _core.admissible_designs(of.for_core(), earlier=root, **how)
    return from_core(Pieces, answer), (answer.looked_at, answer.boxes, answer.interrupted)


def by_roots(
    of: DesignRange,
    executor: Executor,
    earlier: AdmissibleSet | None,
    *,
    seconds: float,
    resolution: float,
    threads: int,
    progress: Progress | None,
) -> _core.DesignSet:
    """Return what `_core.admissible_designs` does, by an executor. Ctrl-C leaves the roots that run undecided.

    All roots are about the whole of the box: of the rest of it a root knows nothing.
    """
    # Without time the core takes pieces apart and adds up their shares; a bad question raises here, not at a worker.
    without_time = partial(
        _core.admissible_designs, of.for_core(), threads=1, seconds=0.0, resolution=resolution, undecided=ENOUGH
    )
    begin = from_core(Pieces, without_time(earlier=earlier))
    undecided = begin.state == 2
    roots = roots_of(of, begin.chosen(undecided), resolution)
    pieces, counts, interrupted = dict(roots), np.zeros(3, dtype=int), True
    how: dict[str, Any] = {
        "seconds": seconds,
        "resolution": resolution,
        "threads": threads,
        "undecided": ENOUGH / max(len(roots), 1),
    }
    jobs = ((k, partial(decided, root, of, **how)) for k, root in roots.items())
    progress = progress or (lambda *_: None)
    with closing(results_at(executor, jobs)) as answers, suppress(KeyboardInterrupt):
        progress(0, len(roots), None)
        for done, (k, (root, more)) in enumerate(answers, start=1):
            pieces[k] = root
            counts += more
            progress(done, len(roots), None)
        interrupted = False
    out = without_time(earlier=joined([begin.chosen(~undecided), *pieces.values()]))
    out.looked_at, out.boxes, stopped = counts.tolist()
    out.interrupted = interrupted or stopped > 0
    return out


def roots_of(of: DesignRange, pieces: Pieces, resolution: float) -> dict[int, Pieces]:
    """Deal undecided pieces out, the largest first; few ones are halved, where their halves are above the resolution.

    The core leaves pieces alone that are below it.
    """
    size = np.ptp(np.array(of.ranges), axis=1)
    while 0 < len(pieces.low) < ROOTS:
        parts: Floats = (pieces.high - pieces.low) / size
        wide = parts.max(axis=1) > 2.0 * max(resolution, 1e-9)
        if not wide.any():
            break
        row, column = np.flatnonzero(wide), parts.argmax(axis=1)[wide]
        middle = 0.5 * (pieces.low + pieces.high)[row, column]
        upper, lower = pieces.chosen(wide), pieces._replace(high=pieces.high.copy())
        upper.low[np.arange(len(row)), column] = middle
        lower.high[row, column] = middle
        pieces = joined([lower, upper])
    order = np.argsort(-np.prod(pieces.high - pieces.low, axis=1), kind="stable")
    return {k: pieces.chosen(order[k::ROOTS]) for k in range(min(len(order), ROOTS))}
