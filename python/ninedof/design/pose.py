"""One pose of an objective, as shifts from the neutral pose of a design."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ninedof.redundancy.rules import study_rule
from ninedof.support.angles import rotation_entry, vector_argument
from ninedof.support.arguments import Vector, finite, known_keys, shown, vector
from ninedof.support.short import short_repr
from ninedof.support.units import scale_argument

ZERO: Vector = (0.0, 0.0, 0.0)
DEFAULT_INTERNAL_POINT = "shifted"
POSE_KEYS = ("position", "rotation", "rotation_deg", "internal_point", "unit", "weight")


@short_repr
@dataclass(frozen=True)
class Pose:
    """A pose of the platform and of O, relative to the neutral pose of a design.

    Parameters
    ----------
    position : (3,) floats
        Shift of p from its neutral position (0, 0, zp), base frame. Zero by default.
    rotation : (3,) floats
        Rotation vector in radians, base axes, applied after the neutral rotation. Zero by default.
    internal_point : (3,) floats, "shifted", "held" or "best"
        Shift of s from its neutral position (0, 0, zs), base frame. "shifted", the default, is the shift of p: r1 r2 r3
        follow the platform, and q1 q2 q3 its rotation. "held" is no shift: r1 r2 r3 never move. With "best" the
        optimizer chooses the position.
    unit : {"length", "zp"}
        Scale of both shifts: the length unit of the study (default), or the height zp of the design, so that a larger
        design moves farther. The name of the length unit is the `unit` of the study.

    weight : float
        Weight in a mean over the poses; 1 by default. With 0 the limits hold at the pose, and it counts as one of which
        the worst is taken, but not in the mean.

    Raises
    ------
    ValueError
        Naming the entry that does not fit.

    Examples
    --------
    >>> import math
    >>> from ninedof.design.pose import Pose
    >>> Pose(position=(0.1, 0, 0), rotation=(0, math.radians(10), 0), unit="zp").internal_point
    'shifted'

    """

    position: Vector = ZERO
    rotation: Vector = ZERO
    internal_point: Vector | str = DEFAULT_INTERNAL_POINT
    unit: str = "length"
    weight: float = 1.0

    def __post_init__(self) -> None:
        """Check and normalize every entry."""
        point = self.internal_point
        if isinstance(point, str):
            chosen: Vector | str = study_rule(point)
        elif point is None:
            raise ValueError(f"internal_point: got {shown(point)}, expected [x, y, z], 'shifted', 'held' or 'best'")
        else:
            chosen = vector("internal_point", point)
        object.__setattr__(self, "position", vector("position", self.position))
        object.__setattr__(self, "rotation", vector("rotation", self.rotation))
        object.__setattr__(self, "internal_point", _named(chosen, self.position))
        object.__setattr__(self, "unit", scale_argument(self.unit))
        object.__setattr__(self, "weight", finite("weight", self.weight, least=0.0))

    @classmethod
    def from_dict(
        cls, data: Mapping[str, Any], internal_point: Any = DEFAULT_INTERNAL_POINT, unit: Any = "length"
    ) -> Pose:
        """Make a pose from a table [[objective.poses]]; the last two arguments are the defaults of its entries."""
        known_keys("pose", data, POSE_KEYS)
        return cls(
            position=data.get("position", ZERO),
            rotation=vector_argument("rotation", data.get("rotation"), data.get("rotation_deg")),
            internal_point=data.get("internal_point", internal_point),
            unit=data.get("unit", unit),
            weight=data.get("weight", 1.0),
        )

    def to_dict(self) -> dict[str, Any]:
        """Return the table of a study file: what differs from the neutral pose."""
        out: dict[str, Any] = {}
        if self.position != ZERO:
            out["position"] = list(self.position)
        if self.rotation != ZERO:
            out |= rotation_entry("rotation", self.rotation)
        if self.internal_point != DEFAULT_INTERNAL_POINT:
            point = self.internal_point
            out["internal_point"] = point if isinstance(point, str) else list(point)
        if self.unit != "length":
            out["unit"] = self.unit
        if self.weight != 1.0:
            out["weight"] = self.weight
        return out

    def for_core(self) -> tuple[Vector, Vector, Vector, bool, bool, float]:
        """Return position, rotation vector, shift of s, whether the optimizer chooses s or shifts are in zp, weight."""
        point = self.internal_point
        shift = point if not isinstance(point, str) else self.position if point == "shifted" else ZERO
        return self.position, self.rotation, shift, self.internal_point == "best", self.unit == "zp", self.weight


def _named(point: Vector | str, position: Vector) -> Vector | str:
    """Return the word for a shift of s that has one, so that the same pose is equal to itself."""
    shift = ZERO if point == "held" else point
    return "shifted" if shift == position else "held" if shift == ZERO else point
