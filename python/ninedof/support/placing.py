"""Places for the words of a drawing: of several, the one that covers least."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from ninedof.support.arrays import Floats

WORDS, LINES = 100.0, 1.0  # cost of a text that is covered, and of a line


def rectangle(centre: Floats, width: float, height: float, angle: float = 0.0) -> Floats:
    """Return the corners of a rectangle turned by an angle in radians, shape (4, 2)."""
    along = np.array([np.cos(angle), np.sin(angle)])
    half, up = 0.5 * width * along, 0.5 * height * np.array([-along[1], along[0]])
    return np.array([centre - half - up, centre + half - up, centre + half + up, centre - half + up])


def toward(angle: ArrayLike) -> Floats:
    """Return the unit vectors at angles from +x in radians, shape (..., 2)."""
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def around(direction: Floats, step: float, count: int) -> Floats:
    """Return unit vectors at multiples of a step to both sides of a direction, the nearest first, shape (n, 2)."""
    turns = np.array([k * side for k in range(count) for side in (1.0, -1.0)])
    return toward(math.atan2(direction[1], direction[0]) + turns * step)


def meet(one: Floats, other: Floats) -> bool:
    """Whether two convex outlines overlap, shapes (n, 2): rectangles, or a line of two points."""
    for shape in (one, other):
        for edge in np.roll(shape, -1, axis=0) - shape:
            normal = np.array([-edge[1], edge[0]])
            a, b = one @ normal, other @ normal
            if a.max() <= b.min() or b.max() <= a.min():
                return False
    return True


class LabelPlaces:
    """The words and lines that a drawing has so far."""

    def __init__(self) -> None:
        """Begin with an empty drawing."""
        self.words: list[Floats] = []
        """Outlines of texts, shape (4, 2)."""
        self.lines: list[Floats] = []
        """Ends, shape (2, 2)."""

    def cost(self, box: Floats) -> float:
        """Return how much a rectangle covers."""
        covered = WORDS * sum(meet(box, one) for one in self.words)
        return covered + LINES * sum(meet(box, line) for line in self.lines)

    def put(self, width: float, height: float, centres: Floats) -> Floats:
        """Return the centre at which words of a size cover least, the first of equal ones, and keep their place."""
        costs = [self.cost(rectangle(centre, width, height)) for centre in centres]
        best: Floats = centres[int(np.argmin(costs))]
        self.words.append(rectangle(best, width, height))
        return best

    def add_path(self, points: Floats) -> None:
        """Add the lines between points, shape (n, 2)."""
        self.lines += [np.array(pair) for pair in pairwise(points)]
