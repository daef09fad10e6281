"""Which of many boxes holds each of many points."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ninedof.support.arrays import Floats

FEW = 24  # boxes that are compared with every point

Numbers = NDArray[np.int64]


def located(low: Floats, high: Floats, points: Floats) -> Numbers:
    """Return the number of a box that holds each point, -1 where none does.

    The boxes do not overlap, but for their faces. They are divided at planes, and the points with them.
    """
    out = np.full(len(points), -1, dtype=np.int64)
    ahead = [(np.arange(len(low)), np.arange(len(points)))]
    while ahead:
        boxes, at = ahead.pop()
        if not len(boxes) or not len(at):
            continue
        middle = 0.5 * (low[boxes] + high[boxes])
        axis = int(np.ptp(middle, axis=0).argmax())
        plane = float(np.median(middle[:, axis]))
        below, above = boxes[low[boxes, axis] < plane], boxes[high[boxes, axis] > plane]
        if len(boxes) <= FEW or max(len(below), len(above)) == len(boxes):
            for n in boxes.tolist():
                out[at[((points[at] >= low[n]) & (points[at] <= high[n])).all(axis=1)]] = n
            continue
        left = points[at, axis] <= plane
        ahead += [(below, at[left]), (above, at[~left])]
    return out
