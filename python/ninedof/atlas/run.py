"""The survey of the hexagonal family."""

from __future__ import annotations

import os
from collections.abc import Mapping
from concurrent.futures import Executor
from dataclasses import dataclass
from typing import Any

import numpy as np

from ninedof.atlas import sample
from ninedof.atlas.sample import Sample, bounds_of, squared_radius_ratio
from ninedof.atlas.tally import Tally, condition_edges, is_tally, ratio_edges
from ninedof.chunks import Arrays, chunk_argument, run
from ninedof.conditioning.hexagonal import HEXAGONAL
from ninedof.support.arguments import whole
from ninedof.support.json import plain
from ninedof.support.progress import Progress
from ninedof.support.versions import versions
from ninedof.sweep.result import SweepResult

CHUNK = 2**19  # designs: some 30 ms of work; signals are checked between chunks
BLOCK = 2**14  # designs evaluated together: they fit into the caches
MOST = 2**40  # designs: years of work


def atlas(
    designs: int = 1_000_000,
    seed: int = 0,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    *,
    executor: Executor | None = None,
    out: str | os.PathLike[str] | None = None,
    chunk: int | None = None,
    progress: Progress | None = None,
) -> SweepResult:
    """Return a survey of the hexagonal family: how designs are distributed, and the best for each size of the base.

    Designs a1 a2 b1 b2 zp zs, lengths in units of l_c, come from a low-discrepancy sequence, their condition number at
    the neutral pose from the closed form on the axis. They are counted and not kept: memory does not grow with their
    number.

    Parameters
    ----------
    designs : int
        Number of designs.
    seed : int
        Shifts the sequence.
    bounds : mapping, optional
        Name to (low, high) in place of the usual (0, 10) for a1 a2 b1 b2, (0.05, 10) for zp and (0, 1) for zs_fraction,
        which is zs / zp.
    executor : concurrent.futures.Executor, optional
        Where the chunks are computed, as in `sweep`. By default in this process, by one processor; processes use more,
        threads do not.
    out : path, optional
        Folder that keeps finished chunks, as in `sweep`.
    chunk : int, optional
        Designs per chunk. The result does not depend on it.
    progress : callable, optional
        Called as progress(designs done, designs in all, None).

    Returns
    -------
    SweepResult
        histogram over (radius_ratio, condition_number), counts: a bin goes from its coordinate to the next, the last is
        open. best, the least condition number, design, its variables, and number, its place in the sequence (-1 without
        any), over radius_ratio.

    Raises
    ------
    ValueError
        If an argument does not fit; the message names it.
    KeyboardInterrupt
        Soon after Ctrl-C. Finished chunks stay in `out`.

    Examples
    --------
    >>> import ninedof as nd
    >>> found = nd.atlas(100_000)
    >>> int(found["histogram"].sum()), bool(found.least("best")[0] > 1.0)
    (100000, True)

    """
    drawn = Sample(whole("seed", seed, 0), bounds_of(bounds))
    work = AtlasWork(drawn, whole("designs", designs, 1, MOST), chunk_argument(chunk, CHUNK))
    total = Tally()
    run(work, lambda _: lambda first, last, arrays: total.merge(arrays), executor=executor, out=out, progress=progress)
    if total.designs != work.points:
        raise RuntimeError(f"got {total.designs} designs, expected {work.points}")
    return _labelled(work, total)


@dataclass(frozen=True)
class AtlasTask:
    """The tally of designs first ... last - 1."""

    sample: Sample
    first: int
    last: int

    def __call__(self) -> Arrays:
        """Compute the tally."""
        tally = Tally()
        for first in range(self.first, self.last, BLOCK):
            designs = self.sample.designs(first, min(first + BLOCK, self.last))
            tally.add(first, squared_radius_ratio(designs), sample.closed_form(designs))
        return tally.arrays()


@dataclass(frozen=True)
class AtlasWork:
    """A survey of designs."""

    sample: Sample
    points: int
    chunk: int

    def task(self, first: int, last: int) -> AtlasTask:
        """Return the work on designs first ... last - 1."""
        return AtlasTask(self.sample, first, last)

    def fits(self, count: int, arrays: Arrays) -> bool:
        """Return whether arrays are the tally of so many designs."""
        return is_tally(arrays, count)

    def question(self) -> dict[str, Any]:
        """Return what the tally depends on."""
        return {"kind": "atlas", **self.sample.question(), "designs": self.points}


def _labelled(work: AtlasWork, total: Tally) -> SweepResult:
    rows = total.number >= 0
    design = np.full((len(rows), len(HEXAGONAL)), np.nan)
    design[rows] = work.sample.at(total.number[rows].astype(np.uint64))
    ratio = ("radius_ratio",)
    return SweepResult(
        arrays={**total.arrays(), "best": np.where(rows, total.best, np.nan), "design": design},
        dims={
            "histogram": (*ratio, "condition_number"),
            **{"best": ratio, "number": ratio, "design": (*ratio, "variable")},
        },
        coords={"radius_ratio": ratio_edges(), "condition_number": condition_edges(), "variable": np.array(HEXAGONAL)},
        units=dict.fromkeys(("histogram", "best", "number", "radius_ratio", "condition_number"), "1")
        | {"design": "l_c"},
        attributes=plain({**work.question(), **versions()}),
    )
