"""A box of designs cut into roots, each a search of its own that may run on another machine."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from ninedof import _core
from ninedof.proof.design_range import DesignRange
from ninedof.support.arrays import Floats
from ninedof.support.chunks import computed
from ninedof.support.files import Arrays
from ninedof.support.progress import Progress

if TYPE_CHECKING:
    from concurrent.futures import Executor

ENOUGH = 1e-5  # of the volume: what is undecided below it is not looked at
ROOTS = 64  # whatever the workers are: the answer does not depend on them
PIECES = ("low", "high", "state", "demand", "poses")
COUNTS = ("looked_at", "boxes", "interrupted")


@dataclass(frozen=True)
class RootWork:
    """The roots of a question. All are about the whole of its box: of the rest of it a root knows nothing."""

    of: DesignRange
    roots: Mapping[int, Arrays]
    """The undecided pieces of each, by its number."""
    seconds: float
    """Of each root."""
    resolution: float
    threads: int
    enough: float
    """Share of the volume that may be left undecided, of each root."""
    chunk: int = 1

    @property
    def points(self) -> int:
        """Return the number of roots."""
        return len(self.roots)

    def question(self) -> dict[str, Any]:
        """Return what the answer depends on; nothing of it is kept in a folder."""
        return {"designs": self.of.digest}

    def part(self, first: int, last: int) -> RootWork:
        """Return the work with some of the roots."""
        return replace(self, roots={k: self.roots[k] for k in range(first, last)})

    def values(self, first: int, _: int) -> Arrays:
        """Return the pieces of a root, decided as far as its time goes, and counts."""
        found = _core.admissible_designs(
            self.of.for_core(),
            threads=self.threads,
            seconds=self.seconds,
            resolution=self.resolution,
            undecided=self.enough,
            earlier=for_core(self.roots[first]),
        )
        return {name: np.asarray(found[name]) for name in PIECES + COUNTS}


def by_roots(
    of: DesignRange,
    executor: Executor,
    earlier: Mapping[str, Any] | None,
    *,
    seconds: float,
    resolution: float,
    threads: int,
    progress: Progress | None,
) -> dict[str, Any]:
    """Return what `_core.admissible_designs` does, by an executor. Ctrl-C leaves the roots that run undecided."""
    # Without time the core takes pieces apart and adds up their shares; a bad question raises here, not at a worker.
    without_time = partial(
        _core.admissible_designs, of.for_core(), threads=1, seconds=0.0, resolution=resolution, undecided=ENOUGH
    )
    begin = without_time(earlier=earlier)
    undecided = begin["state"] == 2
    roots = roots_of(of, {name: begin[name][undecided] for name in PIECES}, resolution)
    found, interrupted = dict(roots), False
    work = RootWork(of, roots, seconds, resolution, threads, ENOUGH / max(len(roots), 1))
    try:
        with computed(work, None, executor, progress) as (_, chunks):
            for chunk, values in chunks:
                found[chunk.first] = values
    except KeyboardInterrupt:
        interrupted = True
    parts = [{name: begin[name][~undecided] for name in PIECES}, *found.values()]
    out = without_time(earlier=for_core({name: np.concatenate([one[name] for one in parts]) for name in PIECES}))
    counts = {name: sum(int(one[name]) for one in found.values() if name in one) for name in COUNTS}
    return out | counts | {"interrupted": interrupted or counts["interrupted"] > 0}


def roots_of(of: DesignRange, pieces: Arrays, resolution: float) -> dict[int, Arrays]:
    """Deal undecided pieces out, the largest first; few ones are halved, where their halves are above the resolution.

    The core leaves pieces alone that are below it.
    """
    size = np.ptp(np.array(of.ranges), axis=1)
    while 0 < len(pieces["low"]) < ROOTS:
        parts: Floats = (pieces["high"] - pieces["low"]) / size
        wide = parts.max(axis=1) > 2.0 * max(resolution, 1e-9)
        if not wide.any():
            break
        row, column = np.flatnonzero(wide), parts.argmax(axis=1)[wide]
        middle = 0.5 * (pieces["low"] + pieces["high"])[row, column]
        upper = {name: values[wide] for name, values in pieces.items()}
        upper["low"][np.arange(len(row)), column] = middle
        lower = pieces | {"high": pieces["high"].copy()}
        lower["high"][row, column] = middle
        pieces = {name: np.concatenate([lower[name], upper[name]]) for name in pieces}
    order = np.argsort(-np.prod(pieces["high"] - pieces["low"], axis=1), kind="stable")
    count = min(len(order), ROOTS)
    return {k: {name: values[order[k::ROOTS]] for name, values in pieces.items()} for k in range(count)}


def for_core(pieces: Mapping[str, Any]) -> dict[str, Any]:
    """Return pieces as the core takes them, for a run that goes on."""
    return {name: pieces[name].tolist() if name in ("state", "demand") else pieces[name] for name in PIECES}
