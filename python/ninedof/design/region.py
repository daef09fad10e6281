"""A continuous set of poses about the neutral one."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from decimal import ROUND_FLOOR, Context
from typing import Any

from ninedof.redundancy.rules import study_rule
from ninedof.support.angles import exact_degrees
from ninedof.support.arguments import Vector, finite, items, known_keys, pair, text, vector
from ninedof.support.short import short_repr
from ninedof.support.units import amount, scale_argument

SHAPES = ("box", "ball", "cylinder", "path")
ANGLES = ("tilt", "yaw")
REGION_KEYS = (*SHAPES, *ANGLES, *(f"{name}_deg" for name in ANGLES), "internal_point", "unit")


@short_repr
@dataclass(frozen=True)
class Region:
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

    box: Vector | None = None
    ball: float | None = None
    cylinder: tuple[float, float] | None = None
    path: tuple[Vector, ...] | None = None
    tilt: float = 0.0
    yaw: float = 0.0
    internal_point: str = "shifted"
    unit: str = "length"

    def __post_init__(self) -> None:
        """Check and normalize every entry."""
        given = [name for name in SHAPES if getattr(self, name) is not None]
        if len(given) > 1:
            raise ValueError(f"region: got {' and '.join(given)}, expected one of {', '.join(SHAPES)}")
        for name, value in {
            "box": None if self.box is None else vector("box", self.box, least=0.0),
            "ball": None if self.ball is None else finite("ball", self.ball, least=0.0),
            "cylinder": None if self.cylinder is None else _cylinder(self.cylinder),
            "path": None if self.path is None else _corners(self.path),
            "tilt": finite("tilt", self.tilt, 0.0, math.pi),
            "yaw": finite("yaw", self.yaw, 0.0, math.pi),
            "internal_point": study_rule(self.internal_point),
            "unit": scale_argument(self.unit),
        }.items():
            object.__setattr__(self, name, value)

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Region:
        """Make a region from the table [objective.region] of a study file; angles may be in degrees."""
        known_keys("region", data, REGION_KEYS)
        entries = dict(data)
        for name in ANGLES:
            if f"{name}_deg" in entries:
                if name in entries:
                    raise ValueError(f"{name}: got both {name} and {name}_deg, expected one of the two")
                entries[name] = math.radians(finite(f"{name}_deg", entries.pop(f"{name}_deg"), 0.0, 180.0))
        return cls(**entries)

    def to_dict(self) -> dict[str, Any]:
        """Return the table of a study file: what differs from the defaults."""
        out: dict[str, Any] = {}
        for name in SHAPES:
            value = getattr(self, name)
            if value is not None:
                out[name] = [list(p) for p in value] if name == "path" else value if name == "ball" else list(value)
        for name in ANGLES:
            if angle := getattr(self, name):
                degrees = exact_degrees(angle)
                out |= {name: angle} if degrees is None else {f"{name}_deg": degrees[0]}
        for name in ("internal_point", "unit"):
            if getattr(self, name) != getattr(Region, name):
                out[name] = getattr(self, name)
        return out

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
        turns = [("tilts", self.tilt), ("yaws", self.yaw)]
        if self.internal_point == "best":
            where += " with O placed at every pose"
        said = [f"{name} of at most {_degrees(angle)} degrees" for name, angle in turns if angle > 0.0]
        return ", ".join([where, *said])

    @property
    def reach(self) -> tuple[float, ...]:
        """Greatest moduli of the six coordinates of a pose: shift of p, tilt about x and y, yaw."""
        size = self.for_core()["size"]
        place = (1.0, 0.0, 0.0) if self.path is not None else size
        if self.ball is not None:
            place = (self.ball,) * 3
        if self.cylinder is not None:
            place = (self.cylinder[0], self.cylinder[0], self.cylinder[1])
        return (*place, self.tilt, self.tilt, self.yaw)

    def for_core(self) -> dict[str, Any]:
        """Return the region as the core takes it."""
        shape = next((name for name in SHAPES if getattr(self, name) is not None), "box")
        size = self.box or (0.0, 0.0, 0.0)
        if self.ball is not None:
            size = (self.ball, 0.0, 0.0)
        if self.cylinder is not None:
            size = (self.cylinder[0], 0.0, self.cylinder[1])
        return {
            "shape": shape,
            "size": size,
            "corners": self.path or (),
            "tilt": self.tilt,
            "yaw": self.yaw,
            "shifted": self.internal_point == "shifted",
            "placed": self.internal_point == "best",
            "in_zp": self.unit == "zp",
        }


def _plain(x: float) -> str:
    """Return a number to its last digit: what is said of a region may be what is proved of it."""
    return repr(float(x)).removesuffix(".0")


def _degrees(angle: float) -> str:
    """Return an angle in degrees, as it was typed or in six digits, never more than it is."""
    if exact := exact_degrees(angle):
        return _plain(exact[0])
    return _plain(float(Context(prec=6, rounding=ROUND_FLOOR).create_decimal_from_float(math.degrees(angle))))


def _cylinder(value: Any) -> tuple[float, float]:
    radius, height = pair("cylinder", value, "(radius, half height)")
    return finite("cylinder", radius, least=0.0), finite("cylinder", height, least=0.0)


def _corners(value: Any) -> tuple[Vector, ...]:
    corners = tuple(vector(f"path[{k}]", p) for k, p in enumerate(items("path", value, "a list of [x, y, z]")))
    if len(corners) < 2 or len(set(corners)) < 2:
        raise ValueError(f"path: got {len(corners)} corners, expected at least two different ones")
    return corners
