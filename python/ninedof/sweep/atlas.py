"""Surveys of hundreds of millions of hexagonal designs, which are counted and compared and not kept."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ninedof.conditioning.hexagonal import HEXAGONAL
from ninedof.support.arguments import finite, items, known_keys, shown, whole
from ninedof.support.extras import versions
from ninedof.support.kept.chunks import MOST_CHUNK, chunk_argument, computed
from ninedof.support.kept.files import Arrays
from ninedof.support.running import Progress
from ninedof.support.text import json_values
from ninedof.sweep.result import SweepResult
from ninedof.sweep.survey import (
    BOUNDS,
    RADIUS_RATIO,
    ZS_FRACTION,
    Sample,
    Tally,
    closed_form,
    condition_edges,
    ratio_edges,
    squared_radius_ratio,
)

if TYPE_CHECKING:
    from concurrent.futures import Executor

CHUNK = 2**19  # designs: some 30 ms of work
PIECES = 256  # chunks of large surveys: a folder has 85 kB for each
BLOCK = 2**14  # designs evaluated together: they fit into the caches; signals are checked between blocks
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
        Folder that keeps what is finished, as in `sweep`.
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
    >>> survey = nd.atlas(100_000)
    >>> int(survey["histogram"].sum()), bool(survey.least("best")[0] > 1.0)
    (100000, True)

    """
    sample = Sample(whole("seed", seed, 0), _bounds(bounds))
    count = whole("designs", designs, 1, MOST)
    work = AtlasWork(sample, count, chunk_argument(chunk, min(max(CHUNK, count // PIECES), MOST_CHUNK)))
    total = Tally()
    with computed(work, out, executor, progress) as (_, chunks):
        for _, arrays in chunks:
            total = total.plus(Tally(**arrays))
    counted = int(total.histogram.sum())
    if counted != work.points:
        raise RuntimeError(f"got {counted} designs, expected {work.points}")
    return _labelled(work, total)


@dataclass(frozen=True)
class AtlasWork:
    """A survey of designs."""

    sample: Sample
    points: int
    chunk: int

    def part(self, first: int, last: int) -> AtlasWork:
        """Return the same: it is small."""
        return self

    def values(self, first: int, last: int) -> Arrays:
        """Return the tally of designs first ... last - 1."""
        tally = Tally()
        for begin in range(first, last, BLOCK):
            designs = self.sample.designs(begin, min(begin + BLOCK, last))
            tally.add(begin, squared_radius_ratio(designs), closed_form(designs))
        return tally.arrays() | {"histogram": tally.histogram.astype(np.uint32)}  # on the disk by half

    def question(self) -> dict[str, Any]:
        """Return what the tally depends on."""
        return {"kind": "atlas", **self.sample.question(), "designs": self.points}


def _labelled(work: AtlasWork, total: Tally) -> SweepResult:
    rows = total.number >= 0
    design = np.full((len(rows), len(HEXAGONAL)), np.nan)
    design[rows] = work.sample.at(total.number[rows].astype(np.uint64))
    ratio = (RADIUS_RATIO,)
    return SweepResult(
        arrays={**total.arrays(), "best": np.where(rows, total.best, np.nan), "design": design},
        dims={
            "histogram": (*ratio, "condition_number"),
            **{"best": ratio, "number": ratio, "design": (*ratio, "variable")},
        },
        coords={RADIUS_RATIO: ratio_edges(), "condition_number": condition_edges(), "variable": np.array(HEXAGONAL)},
        units=dict.fromkeys(("histogram", "best", "number", RADIUS_RATIO, "condition_number"), "1") | {"design": "l_c"},
        attributes=json_values({**work.question(), **versions()}),
    )


def _bounds(bounds: Mapping[str, tuple[float, float]] | None) -> tuple[tuple[float, float], ...]:
    """Return the bounds of all six variables, the usual ones where there are no others."""
    own = {} if bounds is None else bounds
    known_keys("bounds", own, BOUNDS)
    out = []
    for name, usual in BOUNDS.items():
        where, value, most = f"bounds[{name!r}]", own.get(name, usual), 1.0 if name == ZS_FRACTION else math.inf
        low, high = (finite(where, end, 0.0) for end in items(where, value, "(low, high)", 2))
        if not low <= high <= most:
            raise ValueError(f"{where}: got {shown(value)}, expected 0 <= low <= high" + " <= 1" * math.isfinite(most))
        out.append((low, high))
    return tuple(out)
