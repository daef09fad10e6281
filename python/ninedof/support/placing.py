"""Places for the words of a drawing: of several, the one that covers least."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ninedof.support.arrays import Floats

WORDS, LINES = 100.0, 1.0  # cost of a text that is covered, and of a line


def rectangle(centre: Floats, width: float, height: float, angle: float = 0.0) -> Floats:
    """Return the corners of rectangles about centres (..., 2), turned by an angle in radians, shape (..., 4, 2)."""
    along = np.array([np.cos(angle), np.sin(angle)])
    half, up = 0.5 * width * along, 0.5 * height * np.array([-along[1], along[0]])
    return np.stack([centre - half - up, centre + half - up, centre + half + up, centre - half + up], axis=-2)


def toward(angle: ArrayLike) -> Floats:
    """Return the unit vectors at angles from +x in radians, shape (..., 2)."""
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def around(direction: Floats, step: float, count: int) -> Floats:
    """Return unit vectors at multiples of a step to both sides of a direction, the nearest first, shape (n, 2)."""
    turns = np.array([k * side for k in range(count) for side in (1.0, -1.0)])
    return toward(math.atan2(direction[1], direction[0]) + turns * step)


def meet(boxes: Floats, shapes: Floats) -> NDArray[np.bool_]:
    """Return whether convex outlines overlap, shapes (m, 4, 2) and (n, k, 2) to (m, n): k is 2 for lines."""
    together = np.ones((len(boxes), len(shapes)), dtype=bool)
    for outlines, along in ((boxes, (-1, 1, 1)), (shapes, (1, -1, 1))):
        for edge in np.moveaxis(np.roll(outlines, -1, axis=1) - outlines, 1, 0):
            x, y = (part.reshape(along) for part in edge.T)
            one, other = (part[..., 1] * x - part[..., 0] * y for part in (boxes[:, None], shapes[None]))
            together &= (one.max(axis=-1) > other.min(axis=-1)) & (other.max(axis=-1) > one.min(axis=-1))
    return together


class LabelPlaces:
    """The words and lines that a drawing has so far."""

    def __init__(self) -> None:
        """Begin with an empty drawing."""
        self.words: list[Floats] = []
        """Outlines of texts, shape (4, 2)."""
        self.lines: list[Floats] = []
        """Ends, shape (2, 2)."""

    def costs(self, centres: Floats, width: float, height: float) -> Floats:
        """Return how much words of a size cover at each of some centres, shape (n, 2)."""
        boxes, costs = rectangle(centres, width, height), np.zeros(len(centres))
        for cost, outlines in ((WORDS, self.words), (LINES, self.lines)):
            for count in {len(one) for one in outlines}:
                costs += cost * meet(boxes, np.array([one for one in outlines if len(one) == count])).sum(axis=1)
        return costs

    def put(self, width: float, height: float, centres: Floats) -> Floats:
        """Return the centre at which words of a size cover least, the first of equal ones, and keep their place."""
        best: Floats = centres[int(np.argmin(self.costs(centres, width, height)))]
        self.words.append(rectangle(best, width, height))
        return best

    def add_path(self, points: Floats) -> None:
        """Add the lines between points, shape (n, 2)."""
        self.lines += [np.array(pair) for pair in pairwise(points)]
