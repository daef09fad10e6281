"""A continuous set of poses about the neutral one, and the lines of its positions to draw."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np

from ninedof import _core
from ninedof.redundancy.rules import STUDY_RULES
from ninedof.robot.configuration import Configuration
from ninedof.support.arguments import Vector, choice, finite, instance, items, text, vector, vectors
from ninedof.support.arrays import Floats
from ninedof.support.structs import StudyTable, entry
from ninedof.support.text import short_repr
from ninedof.support.units import amount, exact_degrees, half_turn, scale

SHAPES = ("box", "ball", "cylinder", "path")


def _cylinder(name: str, value: Any) -> tuple[float, float]:
    radius, height = items(name, value, "(radius, half height)", 2)
    return finite(name, radius, least=0.0), finite(name, height, least=0.0)


def _corners(name: str, value: Any) -> tuple[Vector, ...]:
    corners = vectors(name, value)
    if len(set(corners)) < 2:
        raise ValueError(f"{name}: got {len(corners)} corners, expected at least two different ones")
    return corners


@short_repr
@dataclass(frozen=True)
class Region(StudyTable):
    """Every tilt and yaw at every position of a box, ball, cylinder or path: the poses a machine is built for.

    Limits hold and the index is the worst in all of it, not at listed poses. Q = exp(tilt) Rz(yaw) Q_neutral; the tilt
    is a horizontal rotation vector, base axes.

    Parameters
    ----------
    box : (3,) floats, optional
        Half edges along x, y and z of the base frame, about the neutral position.
    ball : float, optional
        Radius about the neutral position.
    cylinder : (2,) floats, optional
        Radius and half height of a cylinder about z.
    path : sequence of (3,) floats, optional
        Shifts of p at the corners of a path, straight between them.
    tilt, yaw : float
        Greatest angle of a tilt about any horizontal axis, and of a yaw in both directions; radians, 0 by default.
    internal_point : {"shifted", "held", "best"}
        "shifted", the default: s - p stays as at the neutral pose, in base axes; without turns q1, q2, q3 do not move.
        "held": s stays, and r1, r2, r3 never move. "best": O is placed anew at every pose, where the worst of the
        index and of all limits is least: between the plates, at most zp from its neutral position along each axis.
        Limits on strokes give each leg a range of lengths, the same at every pose. The index is at most that of
        "shifted"; the solution takes ten times as long.
    unit : {"length", "zp"}
        Scale of positions: the length unit of the study (default), or the height zp of the design. The name of the
        length unit is the `unit` of the study.

    Raises
    ------
    ValueError
        Naming the entry that does not fit.

    Examples
    --------
    >>> import math
    >>> import ninedof as nd
    >>> nd.Region(box=(50.0, 50.0, 50.0), tilt=math.radians(10)).words
    'a box of half edges 50, 50, 50, tilts of at most 10 degrees'

    """

    box: Vector | None = entry(partial(vector, least=0.0), None)
    ball: float | None = entry(partial(finite, least=0.0), None)
    cylinder: tuple[float, float] | None = entry(_cylinder, None)
    path: tuple[Vector, ...] | None = entry(_corners, None)
    tilt: float = entry(partial(finite, least=0.0), 0.0, angle=True)
    yaw: float = entry(partial(finite, least=0.0), 0.0, angle=True)
    internal_point: str = entry(partial(choice, known=STUDY_RULES), "shifted")
    unit: str = entry(scale, "length")
    tool_height: float = field(default=0.0, init=False, compare=False, repr=False)
    """Of the tool's point above the plate at home in the study that has the region: zp is the height of p less this."""

    def __post_init__(self) -> None:
        """Check every entry, and that they go together."""
        super().__post_init__()
        shapes = [name for name in SHAPES if getattr(self, name) is not None]
        if len(shapes) > 1:
            raise ValueError(f"{shapes[-1]}: got {' and '.join(shapes)}, expected one of {', '.join(SHAPES)}")
        for name in ("tilt", "yaw"):
            half_turn(name, getattr(self, name))

    @property
    def words(self) -> str:
        """The region in words."""
        return self.worded()

    def worded(self, unit: str = "") -> str:
        """Return the region in words, with the name of the length unit."""
        unit = "zp" if self.unit == "zp" else text("unit", unit)
        where = "the neutral position"
        if self.box is not None:
            where = f"a box of half edges {amount(', '.join(map(_plain, self.box)), unit)}"
        elif self.ball is not None:
            where = f"a ball of radius {amount(_plain(self.ball), unit)}"
        elif self.cylinder is not None:
            radius, half = (amount(_plain(x), unit) for x in self.cylinder)
            where = f"a cylinder of radius {radius} and half height {half}"
        elif self.path is not None:
            where = f"a path of {len(self.path)} corners"
        if self.internal_point == "best":
            where += " with O placed at every pose"
        turns = [("tilts", self.tilt), ("yaws", self.yaw)]
        return ", ".join([where, *(f"{name} of at most {_degrees(angle)} degrees" for name, angle in turns if angle)])

    @property
    def reach(self) -> tuple[float, ...]:
        """Greatest moduli of the six coordinates of a pose: shift of p, tilt about x and y, yaw."""
        return tuple(self.for_core().reach)

    def size_at(self, home: Configuration) -> float:
        """Return the scale of positions for a design: zp, or 1."""
        c = instance("home", home, Configuration)
        return float(c.position[2]) - self.tool_height if self.unit == "zp" else 1.0

    def for_core(self) -> _core.Region:
        """Return the region as the core takes it; one of turns alone is an empty box."""
        shape, size = "box" if self.path is None else "path", self.box or (0.0, 0.0, 0.0)
        if self.ball is not None:
            shape, size = "ball", (self.ball, 0.0, 0.0)
        if self.cylinder is not None:
            shape, size = "cylinder", (self.cylinder[0], 0.0, self.cylinder[1])
        return _core.Region(
            shape=shape,
            size=size,
            corners=self.path or (),
            tilt=self.tilt,
            yaw=self.yaw,
            shifted=self.internal_point == "shifted",
            placed=self.internal_point == "best",
            in_zp=self.unit == "zp",
            tool_height=self.tool_height,
        )


def _plain(x: float) -> str:
    """Return a number to its last digit: what is said of a region may be what is proved of it."""
    return repr(float(x)).removesuffix(".0")


def _degrees(angle: float) -> str:
    """Return an angle in degrees, as it was typed or in six digits, never more than it is."""
    if exact := exact_degrees(angle):
        return _plain(exact[0])
    from decimal import ROUND_FLOOR, Context  # when it is needed, as it takes time to load

    return _plain(float(Context(prec=6, rounding=ROUND_FLOOR).create_decimal_from_float(math.degrees(angle))))


ROUND = 97  # points of a round outline, the last one on the first
SQUARE = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]])


def region_lines(region: Region, home: Configuration) -> list[Floats]:
    """Return the outline of a region's positions in space as lines (n, 3) in base axes: edges, circles or the path.

    Nothing for a region of turns alone.
    """
    if region.path is not None:
        return [_path_corners(region, home)]
    half = _half_edges(region, home)
    if not half.any():
        return []
    if region.ball is not None:
        return [home.position + half * np.roll(circle(), k, axis=1) for k in range(3)]
    if region.cylinder is None:
        return box_lines(*extent(region, home))
    return _between_rims([home.position + half * (circle() + np.array([0.0, 0.0, z])) for z in (-1.0, 1.0)])


def box_lines(low: Floats, high: Floats) -> list[Floats]:
    """Return the twelve edges of a box: its lower and its upper rim and four edges up."""
    sides = np.where(SQUARE > 0.0, high[:2], low[:2])
    return _between_rims([np.column_stack([sides, np.full(len(sides), z)]) for z in (low[2], high[2])])


def section_outline(region: Region, home: Configuration, fixed: int, at: float) -> Floats | None:
    """Return the outline of a region's positions in a plane, or a path seen across it; None where it misses the plane.

    Points (n, 2) in the two other coordinates, in their order.
    """
    axes = [k for k in range(3) if k != fixed]
    if region.path is not None:
        return _path_corners(region, home)[:, axes]
    every = _half_edges(region, home)
    half, away = every[axes], abs(at - float(home.position[fixed]))
    if away > every[fixed]:
        return None
    is_round = region.ball is not None or (region.cylinder is not None and fixed == 2)
    if region.ball is not None:
        half = np.sqrt(half**2 - away**2)
    elif region.cylinder is not None and not is_round:
        half[0] = np.sqrt(half[0] ** 2 - away**2)
    return np.asarray(home.position[axes] + half * (circle()[:, :2] if is_round else SQUARE))


def extent(region: Region, home: Configuration) -> tuple[Floats, Floats]:
    """Return the least and the greatest coordinates of a region's positions, in base axes."""
    if region.path is not None:
        corners = _path_corners(region, home)
        return corners.min(axis=0), corners.max(axis=0)
    half = _half_edges(region, home)
    return home.position - half, home.position + half


def circle() -> Floats:
    """Return the points (n, 3) of a circle of radius 1 about z."""
    turn = np.linspace(0.0, 2.0 * np.pi, ROUND)
    return np.column_stack([np.cos(turn), np.sin(turn), np.zeros(ROUND)])


def _path_corners(region: Region, home: Configuration) -> Floats:
    return np.asarray(home.position + region.size_at(home) * np.array(region.path))


def _half_edges(region: Region, home: Configuration) -> Floats:
    return np.asarray(region.size_at(home) * np.array(region.reach[:3]))


def _between_rims(rims: list[Floats]) -> list[Floats]:
    """Return two closed lines, and four lines from one to the other."""
    last = len(rims[0]) - 1
    return [*rims, *(np.stack([rims[0][k], rims[1][k]]) for k in range(0, last, last // 4))]
