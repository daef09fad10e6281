"""The poses of a region at which numbers of a design are least: a dense sample, then descents from the worst of it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ninedof.design.region import Region
from ninedof.design.region_stack import configurations_at
from ninedof.robot.configuration import Configuration
from ninedof.support.arrays import Floats

Numbers = Callable[[Configuration], Floats]
"""From a stack of n poses to shape (n, k), the worse the lower; NaN, where a pose has no number, is never least."""

STARTS = 5  # descents for each number: from the worst of as many parts of the region, those with the worst first
HALVED = (0, 1, 2, 5, 3, 4)  # coordinates that part the region, the first four that are free
FIRST_STEP, LAST_STEP = 0.2, 1e-6  # of a descent, in parts of the region
# A step must lower a number by this part of it times the square of the step: long steps that only graze a round
# boundary are not worth while.
WORTHWHILE = 1e-4
AGAIN = np.array([1.0, 4.0, 16.0])
MOST_STEPS = 300
SAME = 1e-7  # of the region: nearer poses are one


@dataclass(frozen=True)
class Poses:
    """A region as the search sees it."""

    region: Region
    place: Callable[[Floats], tuple[Floats, Configuration]]
    """From coordinates (n, 6) to the nearest ones of the region, and the poses there with O placed."""
    starts: int = STARTS
    last_step: float = LAST_STEP

    @classmethod
    def of(cls, region: Region, neutral: Configuration) -> Poses:
        """Return those of a region that says where O is."""
        return cls(region, lambda at: configurations_at(region, neutral, at))


def extreme_poses(poses: Poses, near: Floats, c: Configuration, groups: Sequence[Numbers]) -> tuple[Floats, int]:
    """Return where each number of each group is least, without repetition, and how many poses descents looked at.

    Parameters
    ----------
    poses : Poses
    near : numpy.ndarray, shape (n, 6)
        Coordinates of the sample.
    c : Configuration
        The poses there.
    groups : sequence of callables
        Numbers that are computed together.

    """
    region = poses.region
    found, looked_at, parts = [], 0, _parts(region, near)
    for group in groups:
        values = finite_or_high(group(c))
        numbers = np.arange(values.shape[1])
        worst = np.stack([part[np.argmin(values[part], axis=0)] for part in parts])  # (parts, numbers)
        order = np.argsort(values[worst, numbers], axis=0, kind="stable")[: poses.starts]
        rows = np.take_along_axis(worst, order, axis=0).reshape(-1)
        which = np.tile(numbers, len(order))
        ends, least, count = _descend(poses, group, near[rows], which, values[rows, which])
        best = np.argmin(least.reshape(len(order), -1), axis=0)
        found.append(ends.reshape(len(order), -1, 6)[best, numbers])
        looked_at += count
    every = np.concatenate(found)
    cells = np.round(every / (SAME * np.maximum(region.reach, 1e-300)))
    _, first = np.unique(cells, axis=0, return_index=True)
    return every[np.sort(first)], looked_at


def _parts(region: Region, at: Floats) -> list[NDArray[np.intp]]:
    """Return the rows of a sample in each part of the region that has some: by the signs of up to four coordinates."""
    reach = region.reach
    free = [k for k in HALVED if reach[k] > 0.0][:4]
    code = (at[:, free] > 0.0) @ (1 << np.arange(len(free)))
    if region.path is not None:
        code = 4 * code + np.clip((2.0 * (1.0 + at[:, 0])).astype(int), 0, 3)
    return [np.flatnonzero(code == k) for k in np.unique(code)]


def _descend(
    poses: Poses, group: Numbers, at: Floats, which: NDArray[np.intp], value: Floats
) -> tuple[Floats, Floats, int]:
    """Lower one number from each start: to the best neighbour, farther where that helps, nearer where none does."""
    at, value, step, count = at.copy(), value.copy(), np.full(len(at), FIRST_STEP), 0
    way = np.zeros_like(at)  # of the last step: along a ridge the same way is tried again, and farther
    for _ in range(MOST_STEPS):
        active = np.flatnonzero(step >= poses.last_step)
        if not active.size:
            break
        again = at[active][:, None] + AGAIN[:, None] * way[active][:, None]
        trial = np.concatenate([_neighbours(poses.region, at[active], step[active]), again], axis=1)
        near, c = poses.place(trial.reshape(-1, 6))
        count += len(near)
        moves = trial.shape[1]
        values = finite_or_high(group(c))[np.arange(len(near)), np.repeat(which[active], moves)].reshape(-1, moves)
        best = np.argmin(values, axis=1)
        least = values[np.arange(len(active)), best]
        with np.errstate(invalid="ignore"):  # infinite: there is nothing to lower
            better = least < value[active] - WORTHWHILE * step[active] ** 2 * np.abs(value[active])
        moved, to = active[better], near.reshape(-1, moves, 6)[better, best[better]]
        way[moved] = to - at[moved]
        at[moved], value[moved] = to, least[better]
        step[active[~better]] *= 0.5
    return at, value, count


def _neighbours(region: Region, at: Floats, step: Floats) -> Floats:
    """Return (m, moves, 6): steps both ways along each coordinate and, where a boundary is round, around it."""
    reach = np.asarray(region.reach)
    free = np.flatnonzero(reach > 0.0)
    ways = np.concatenate([np.eye(6)[free], -np.eye(6)[free]]) * reach
    moves = [at[:, None] + step[:, None, None] * ways]
    planes = [(3, 4)] if region.tilt > 0.0 else []
    planes += [(0, 1)] if region.cylinder is not None else [(0, 1), (1, 2), (0, 2)] if region.ball is not None else []
    for i, j in planes:
        for angle in (np.pi * step, -np.pi * step):
            turned = at.copy()
            turned[:, i] = np.cos(angle) * at[:, i] - np.sin(angle) * at[:, j]
            turned[:, j] = np.sin(angle) * at[:, i] + np.cos(angle) * at[:, j]
            moves.append(turned[:, None])
    return np.concatenate(moves, axis=1)


def finite_or_high(values: Floats) -> Floats:
    """Return the values with infinity in place of NaN."""
    return np.where(np.isnan(values), np.inf, values)
