"""Places for the words of a drawing: of several, the one that covers least."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ninedof.support.arrays import Floats

WORDS, LINES, MISTAKEN = 100.0, 1.0, 10.0  # cost of words covered, of a line, of the wrong line nearer
ALONG = 0.5 + 0.05 * np.array([0, -1, 1, -2, 2, -3, 3, -4, 4, -5, 5, -6, 6])[:, None]
"""Where words may stand beside a line, the best place first."""
LEADERS = (1.0, 2.5, 3.5, 5.0, 7.0)
"""Their distances from it, the first beside it."""


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


def _distance(points: Floats, start: Floats, end: Floats) -> Floats:
    """Return the distances of points (n, 2) from a line."""
    share = np.clip((points - start) @ (end - start) / max(float(np.sum((end - start) ** 2)), 1e-300), 0.0, 1.0)
    return np.asarray(np.linalg.norm(points - start - share[:, None] * (end - start), axis=1))


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

    def beside(
        self, start: Floats, end: Floats, size: Floats, away: float, alike: Sequence[Floats] = ()
    ) -> tuple[Floats, Floats | None]:
        """Return the centre of words of a size beside a line, at a distance, and keep their place.

        Where others stand there, it is farther off, and the ends of a thin line to the words follow. Rather not nearer
        to lines that look alike.
        """
        x, z = (end - start) / max(float(np.linalg.norm(end - start)), 1e-300)
        on_line, out = np.tile(start + ALONG * (end - start), (2, 1)), away * np.array([z, -x])
        aside = np.repeat([out, -out], len(ALONG), axis=0)
        for reach in LEADERS:
            spots = on_line + reach * aside
            costs = self.costs(spots, *size)
            costs += sum(MISTAKEN * (_distance(spots, *line) < reach * away) for line in alike)
            best = int(np.argmin(costs))
            if costs[best] < WORDS or reach == LEADERS[-1]:
                break
        centre = self.put(size[0], size[1], spots[best : best + 1])
        return centre, np.array([on_line[best], centre - 0.6 * aside[best]]) if reach > 1.0 else None

    def add_path(self, points: Floats) -> None:
        """Add the lines between points, shape (n, 2)."""
        self.lines += [np.array(pair) for pair in pairwise(points)]
