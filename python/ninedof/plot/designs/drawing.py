"""The dimensioned drawing of a machine: both plates in plan and the machine from the front, each at its own scale."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Polygon

from ninedof.plot import style
from ninedof.plot.space.mechanism import DASHES, POINT_O, Robot, legs_of
from ninedof.robot.configuration import Configuration, require_single
from ninedof.robot.geometry import Geometry
from ninedof.robot.plates import Plate, free_angles, outlines, plates_of, turn_words
from ninedof.support.arrays import Floats
from ninedof.support.placing import WORDS, LabelPlaces, around, rectangle, toward
from ninedof.support.units import amount

if TYPE_CHECKING:
    from ninedof.design.tool import Tool

HEIGHT = 2.75  # inches
REACH = 1.5  # half a panel of a plan, in sizes of its plate
AXIS, ARCS = 0.15, (0.45, 0.75)  # of a plan, in sizes of its plate: of the axes, radii of the angles
LETTER, LINE = 4.3, 8.5  # points, of a letter and a line of the smallest words
LEADERS = (1.0, 2.5, 3.5, 5.0, 7.0)
"""Distances of the name of a leg, the first beside it."""
JOINTS = {
    "E": {"marker": "o", "ms": 5.5, "color": style.EXTERNAL, "mec": "white", "mew": 0.5, "ls": ""},
    "I": {"marker": "s", "ms": 3.4, "color": style.LOWER, "mec": "white", "mew": 0.5, "ls": ""},
}
CHIP = {"facecolor": "white", "edgecolor": "none", "pad": 0.6, "alpha": 0.85}
CENTRE = {"color": style.MUTED, "lw": 0.5, "ls": (0, (8, 2, 2, 2))}


def drawing(
    geometry: Geometry,
    configuration: Configuration,
    unit: str = "",
    tool: Tool | None = None,
    figure: Figure | None = None,
) -> Figure:
    """Return a figure with the dimensions of a machine: base and platform from +z of their frames, and from the front.

    As in the DXF file, circles about the origin have their radii, hexagons of the paper their sides, and the first
    joints their angles from +x; E1 to E3 are external joints, I1 to I3 internal ones. The front is seen along +y of the
    base at the neutral pose, with the heights of the plate and of O, the twist theta_z and the tool.

    Parameters
    ----------
    geometry : Geometry
    configuration : Configuration
        The neutral one, a single one.
    unit : str
        Of the lengths.
    tool : Tool, optional
        Whose point and axes geometry and configuration are about; None without one.
    figure : matplotlib.figure.Figure or SubFigure, optional
        To draw in; a new one by default.

    Raises
    ------
    ValueError
        If the configuration is a stack.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=850.0, b1=293.0, b2=0.0)
    >>> figure = nd.plot.drawing(g, nd.Configuration.neutral(483.0, 319.0), unit="mm")

    """
    require_single("configuration", configuration)
    points, words = Robot("", geometry, configuration).points(), turn_words(configuration)
    if tool:
        points = np.vstack([points, configuration.position])
        geometry, configuration = tool.plates(geometry), tool.plate(configuration)
        words = turn_words(configuration) + tool.words(unit)
    seen = points[:, [0, 2]]
    with style.page(figure, style.TWO_COLUMNS, HEIGHT) as figure:
        for k, plate in enumerate(plates_of(geometry)):
            panel = _Panel(figure, k, f"{plate.title}, from +z", REACH * plate.size, np.zeros(2))
            panel.plate(plate, unit)
            panel.note(plate.heights(unit))
        low, high = seen.min(axis=0), seen.max(axis=0)
        low[1] = min(low[1], 0.0)
        half, middle = 0.72 * (high - low).max(), 0.5 * (low + high)
        panel = _Panel(figure, 2, "Front, along +y, neutral pose", half, middle)
        panel.front(seen, configuration, unit)
        panel.note([*words, "each view at its own scale"])
    return figure


class _Panel:
    """One view at one scale, its words placed where they cover least."""

    def __init__(self, figure: Any, number: int, title: str, half: float, middle: Floats) -> None:
        """Begin with half the side and the middle of the view."""
        self.axes = figure.add_axes((number / 3.0, 0.0, 1.0 / 3.0, 0.9))
        self.axes.set_title(title, loc="center", size=style.TEXT_SIZE)
        width, height = style.inches(figure) * [1.0 / 3.0, 0.9]
        scale = 2.0 * half / min(width, height)
        self.point = scale / 72.0
        """A point of print in the lengths of the view."""
        spans = 0.5 * scale * np.array([width, height])
        low, high = middle - spans, middle + spans
        self.axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
        self.axes.set_axis_off()
        self.places = LabelPlaces()
        corners = rectangle(middle, *(2.0 * spans))
        self.places.words += [np.array(side) for side in pairwise([*corners, corners[0]])]  # stay inside

    def write(self, words: str, centres: Floats, colour: str = style.INK) -> None:
        """Write words at the one of some centres, shape (n, 2), where they cover least."""
        at = self.places.put(LETTER * self.point * len(words), LINE * self.point, centres)
        self.axes.text(*at, words, size=style.SMALL_SIZE, color=colour, ha="center", va="center", zorder=8, bbox=CHIP)

    def note(self, words: list[str]) -> None:
        """Write lines at the foot of the view."""
        place = {"ha": "center", "va": "bottom", "transform": self.axes.transAxes}
        self.axes.text(0.5, 0.04, "\n".join(words), size=style.SMALL_SIZE, **place)

    def line(self, points: Floats, **look: Any) -> None:
        self.axes.plot(*points.T, **look)
        self.places.add_path(points)

    def beside(self, at: Floats, words: str, out: Floats, first: float = 4.0) -> Floats:
        """Return centres for words about a point, the first in a direction."""
        way = around(out, np.pi / 9.0, 9)
        reach = first + np.abs(way) @ [0.5 * LETTER * len(words), 0.5 * LINE]
        return np.concatenate([at + self.point * (reach + more)[:, None] * way for more in (0.0, 6.0, 14.0, 24.0)])

    def plate(self, plate: Plate, unit: str) -> None:
        """Draw a plate in plan with its dimensions."""
        if len(plate.outline):
            self.axes.add_patch(Polygon(plate.outline, fc=style.GRID, ec=style.INK, lw=1.0, zorder=1))
            self.places.add_path(np.vstack([plate.outline, plate.outline[:1]]))
        for radius in plate.radii:
            self.axes.plot(*(radius * toward(np.linspace(0.0, 2.0 * np.pi, 121))).T, **CENTRE)
        for axis in np.eye(2):
            self.line(np.array([-0.06 * plate.size * axis, AXIS * plate.size * axis]), color=style.MUTED, lw=0.8)
        for at, names in plate.centres().items():
            self.places.words.append(rectangle(np.array(at[:2]), 6.0 * self.point, 6.0 * self.point))
            for kind in sorted({name[0] for name in names}):
                self.axes.plot(*at[:2], zorder=6 + (kind == "I"), **JOINTS[kind])
        for name, ends in plate.sides.items():
            self._side(name, *ends, unit)
        for radius, angle in zip(plate.radii, free_angles(plate), strict=False):
            self._radius(radius, angle, unit)
        for k, angles in enumerate(plate.angles):
            self._angle(ARCS[k] * plate.size, *angles)
        for axis, name in zip(np.eye(2), "xy", strict=True):
            self.write(name, self.beside(AXIS * plate.size * axis, name, axis, 1.0), style.MUTED)
        for at, names in plate.centres().items():
            words = " ".join(names)
            self.write(words, self.beside(np.array(at[:2]), words, np.array(at[:2])))

    def _arrow(self, start: Floats, end: Floats, ends: str = "<|-|>") -> None:
        self.axes.annotate("", tuple(end), tuple(start), arrowprops=style.arrow(style.INK, 0.6, ends), zorder=5)
        self.places.add_path(np.array([start, end]))

    def _side(self, name: str, start: Floats, end: Floats, unit: str) -> None:
        start, end = start[:2], end[:2]
        (x, y), middle, length = end - start, 0.5 * (start + end), np.linalg.norm(end - start)
        out = np.array([y, -x]) / length
        out *= math.copysign(1.0, out @ middle) * 13.0 * self.point
        for point in (start, end):
            self.line(np.array([point + 0.35 * out, point + 1.25 * out]), color=style.INK, lw=0.5)
        self._arrow(start + out, end + out)
        words = f"{name} = {amount(f'{length:.5g}', unit)}"
        self.write(words, self.beside(middle + out, words, out, 1.0))

    def _radius(self, radius: float, angle: float, unit: str) -> None:
        way = toward(angle)
        self._arrow(np.zeros(2), radius * way, "-|>")
        words = f"R {amount(f'{radius:.5g}', unit)}"
        self.write(words, self.beside(radius * way, words, way, 1.0))

    def _angle(self, radius: float, start: float, end: float) -> None:
        first, last = math.degrees(start), math.degrees(end)
        self.axes.add_patch(Arc((0.0, 0.0), 2.0 * radius, 2.0 * radius, theta1=first, theta2=last, lw=0.7))
        self.places.add_path(radius * toward(np.linspace(start, end, 25)))
        for one in (start, end):
            self.line(np.outer([0.25, 1.08], radius * toward(one)), color=style.INK, lw=0.5)
        way = toward(0.5 * (start + end))
        words = f"{last - first:.4g}°"
        self.write(words, np.concatenate([self.beside(radius * way, words, s * way, 1.5) for s in (1.0, -1.0)]))

    def front(self, points: Floats, c: Configuration, unit: str) -> None:
        """Draw the machine from the front with the heights of p and O; a point after O is the tool's."""
        base, platform, o, p = points[:6], points[6:12], points[12], c.position[[0, 2]]
        for body, colour in ((base, style.BASE), (platform, style.PLATFORM)):
            faces = outlines(np.column_stack([body, np.zeros(6)]))
            for face in faces:
                self.axes.add_patch(Polygon(face[:, :2], fc=colour, ec=style.INK, lw=0.9, alpha=0.8))
            ends = [body[:, 0].argmin(), body[:, 0].argmax()]
            self.line(body[ends], color=colour, lw=0.5 if faces else 3.0, solid_capstyle="butt", zorder=1)
        legs = legs_of(points)
        for name, *leg in legs:
            self.line(np.array(leg), color=style.LEG_COLOURS[name[0]], lw=1.3, ls=DASHES[name[0]])
        self.axes.plot(*points[:12].T, "o", color=style.INK, ms=3.0, mec="white", mew=0.5, zorder=6)
        self.axes.plot(*o, **POINT_O, zorder=7)
        self.places.words.append(rectangle(o, 7.0 * self.point, 7.0 * self.point))
        left, right = points[:, 0].min(), points[:, 0].max()
        for side, edge, name, at in ((-1.0, left, "zs", o), (1.0, right, "zp", p)):
            x = edge + side * 12.0 * self.point
            for start in (np.array([edge, 0.0]), at):
                tip = np.array([x + side * 3.0 * self.point, start[1]])
                self.line(np.array([start, tip]), color=style.INK, lw=0.4, zorder=0)
            self._arrow(np.array([x, 0.0]), np.array([x, at[1]]))
            words = f"{name} = {amount(f'{at[1]:.5g}', unit)}"  # along the arrow, as on any drawing
            middle = np.array([x + side * LINE * self.point, 0.5 * at[1]])
            self.axes.text(*middle, words, size=style.SMALL_SIZE, rotation=90.0, ha="center", va="center", zorder=8)
            self.places.words.append(rectangle(middle, LINE * self.point, LETTER * self.point * len(words)))
        self.write("O", self.beside(o, "O", np.array([-1.0, 0.3])))
        for tool in points[13:]:
            self.line(np.array([p, tool]), color=style.REGION, lw=1.6)
            self.axes.plot(*tool, "v", color=style.REGION, ms=5.0, mec="white", mew=0.5, zorder=7)
            self.places.words.append(rectangle(tool, 7.0 * self.point, 7.0 * self.point))
            self.write("tool", self.beside(tool, "tool", tool - p)[:36], style.REGION)  # near it, whatever it covers
        for name, start, end in legs:
            self._name(name, start, end)

    def _name(self, name: str, start: Floats, end: Floats) -> None:
        """Write the name of a leg beside it, or, where others stand there, at the end of a thin line from it."""
        share = 0.5 + 0.05 * np.array([0, -1, 1, -2, 2, -3, 3, -4, 4, -5, 5, -6, 6])[:, None]
        x, z = (end - start) / max(float(np.linalg.norm(end - start)), 1e-300)
        on_leg, out = np.tile(start + share * (end - start), (2, 1)), 6.5 * self.point * np.array([z, -x])
        colour, size = style.LEG_COLOURS[name[0]], np.array([LETTER * len(name) + 2.0, LINE + 1.0]) * self.point
        aside = np.repeat([out, -out], len(share), axis=0)
        for reach in LEADERS:
            spots = on_leg + reach * aside
            costs = self.places.costs(spots, *size)
            best = int(np.argmin(costs))
            if costs[best] < WORDS or reach == LEADERS[-1]:
                break
        if reach > 1.0:
            ends = np.array([on_leg[best], spots[best] - 0.6 * aside[best]])
            self.axes.plot(*ends.T, color=colour, lw=0.5, zorder=7)
        self.write(name, spots[best : best + 1], colour)
