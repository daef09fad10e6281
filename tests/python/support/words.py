"""The texts of a figure as they lie on the page: which of them intersect, and which axes lack a name or a unit."""

import functools
import itertools

import numpy as np
from matplotlib.text import Text

SLACK = 0.5  # points: boxes are a little larger than the letters


def overlaps(figure):
    """Pairs of texts that intersect on the page; of those drawn alone, so without ticks beyond the ends of an axis."""
    return [(a, b) for (a, p), (b, q) in itertools.combinations(words(figure), 2) if _meet(p, q)]


def outside(figure):
    """Texts that leave the page, and "ink" where something drawn touches its edge."""
    width, height = figure.get_size_inches() * figure.dpi
    found = [text for text, p in words(figure) if (p < 0.0).any() or (p > [width, height]).any()]
    page = np.asarray(figure.canvas.buffer_rgba())[..., :3]
    edge = np.concatenate([page[0], page[-1], page[:, 0], page[:, -1]])
    return found + ["ink"] * bool((edge < 250).any())


@functools.lru_cache(maxsize=2)
def words(figure):
    """Every text that is drawn, with its four corners in pixels, shape (4, 2)."""
    drawn = {}
    draw = Text.draw

    def noted(self, renderer, *args, **options):
        if self.get_visible() and self.get_text().strip():  # here texts in space have their place on the page
            drawn[id(self)] = (self.get_text(), _corners(self, renderer, SLACK * figure.dpi / 72.0))
        return draw(self, renderer, *args, **options)

    Text.draw = noted
    try:
        figure.canvas.draw()
    finally:
        Text.draw = draw
    return list(drawn.values())


def _corners(text, renderer, slack):
    """The letters alone: no arrow of an annotation, and not the upright box about a slanted text."""
    angle = text.get_rotation()
    box = Text.get_window_extent(text, renderer)
    middle = np.array([0.5 * (box.x0 + box.x1), 0.5 * (box.y0 + box.y1)])
    text.set_rotation(0.0)
    flat = Text.get_window_extent(text, renderer)
    text.set_rotation(angle)
    half = np.maximum([0.5 * flat.width - slack, 0.5 * flat.height - slack], 0.0)
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    return middle + (np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * half) @ np.array([[c, s], [-s, c]])


def _meet(p, q):
    """Whether two rectangles intersect: no side of either separates them."""
    for rectangle in (p, q):
        for side in (rectangle[1] - rectangle[0], rectangle[3] - rectangle[0]):
            first, second = p @ side, q @ side
            if first.max() <= second.min() or second.max() <= first.min():
                return False
    return True


def unnamed(figure):
    """Axes that show numbers without a name beside them; axes that share theirs with the outer ones are named there."""
    lacking = []
    for axes in figure.axes:
        if not axes.axison or axes.get_label() == "magnified":  # a part of the axes above it
            continue
        for letter, axis in (("x", axes.xaxis), ("y", axes.yaxis)):
            numbers = [tick.label1.get_text() for tick in axis.get_major_ticks() if tick.label1.get_visible()]
            beside = axis.label.get_text() or any(text.isalpha() for text in "".join(numbers))
            if any(numbers) and not beside:
                lacking.append((axes.get_title(loc="left"), letter))
    return lacking
