"""The ranges in which limits that compare poses let the legs be at every pose."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from ninedof.design.leg_limits import SPREADS
from ninedof.design.limits import each, for_core
from ninedof.design.study import Study
from ninedof.support.arrays import Floats

Range = tuple[str, tuple[float, ...], tuple[float, ...], float]
"""A limit, the least and the greatest length of each leg, and what margins are parts of (0: they are logarithms)."""


def leg_ranges(study: Study, lengths: Floats, zp: float) -> tuple[Range, ...]:
    """Return a range for each limit on strokes and leg ratios, from the lengths at some poses, shape (n, 9).

    What the limit leaves beyond those lengths is divided evenly between the two ends: for a ratio in logarithms.
    """
    return tuple(_ranges(study, lengths, zp))


def common_range(ranges: Iterable[Range], least: Floats, most: Floats) -> tuple[tuple[float, float], ...]:
    """Return the least and greatest length of each leg that all ranges and limits allow; nothing without ranges."""
    every = list(ranges)
    if not every:
        return ()
    low = np.maximum(least, np.max([low for _, low, _, _ in every], axis=0))
    high = np.minimum(most, np.min([high for _, _, high, _ in every], axis=0))
    return tuple((float(a), float(b)) for a, b in zip(low, high, strict=True))


def _ranges(study: Study, lengths: Floats, zp: float) -> Iterable[Range]:
    short, long = lengths.min(axis=0), lengths.max(axis=0)
    for name, entry in each(study.constraints):
        limit = for_core(name, entry)
        if name not in SPREADS or limit["at"] == "neutral" or not math.isfinite(limit["high"]):
            continue
        if name == "stroke":
            size = limit["high"] * (zp if limit["of"] == "zp" else 1.0)
            room = 0.5 * (size - (long - short))
            yield name, tuple((short - room).tolist()), tuple((long + room).tolist()), size
            continue
        least, most = (short, long) if name == "stroke_ratio" else (np.full(9, short.min()), np.full(9, long.max()))
        share = np.sqrt(limit["high"] * least / most)
        yield name, tuple((least / share).tolist()), tuple((most * share).tolist()), 0.0
