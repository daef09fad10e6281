"""One pose of an objective, as shifts from the neutral pose of a design."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

from ninedof import _core
from ninedof.redundancy.rules import STUDY_RULES, where_o
from ninedof.support.arguments import Vector, choice, finite, vector
from ninedof.support.schema import Table, entry
from ninedof.support.short import short_repr
from ninedof.support.units import scale

ZERO: Vector = (0.0, 0.0, 0.0)
DEFAULT_INTERNAL_POINT = "shifted"


def _internal_point(name: str, value: Any) -> Vector | str:
    return choice(name, value, STUDY_RULES) if isinstance(value, str) else vector(name, value)


@short_repr
@dataclass(frozen=True)
class Pose(Table):
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
        optimizer chooses the position, between the plates and at most zp away along each axis; at the neutral pose zs
        has this role.
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

    position: Vector = entry(vector, ZERO)
    rotation: Vector = entry(vector, ZERO, angle=True)
    internal_point: Vector | str = entry(_internal_point, DEFAULT_INTERNAL_POINT)
    unit: str = entry(scale, "length")
    weight: float = entry(partial(finite, least=0.0), 1.0)

    def __post_init__(self) -> None:
        """Name the shift of s where it has a word, so that the same pose is equal to itself."""
        super().__post_init__()
        shift = ZERO if self.internal_point == "held" else self.internal_point
        word = "shifted" if shift == self.position else "held" if shift == ZERO else shift
        object.__setattr__(self, "internal_point", word)

    def for_core(self) -> _core.Pose:
        """Return the pose as the core takes it."""
        point = self.internal_point
        return _core.Pose(
            position=self.position,
            rotation=self.rotation,
            internal=point if not isinstance(point, str) else self.position if point == "shifted" else ZERO,
            best_internal=point == "best",
            in_zp=self.unit == "zp",
            weight=self.weight,
        )


def rule_words(poses: Sequence[Pose]) -> str:
    """Return where O is: one word for all poses, or how many poses follow each."""
    rules = Counter(p.internal_point if isinstance(p.internal_point, str) else "given" for p in poses)
    if any(p.position != ZERO for p in poses) and len(rules) > 1:
        at_rest = [p for p in poses if p.position == ZERO and p.internal_point == "shifted"]
        if len(at_rest) == rules["shifted"]:  # where the platform has not moved, shifted and held are the same
            del rules["shifted"]
            rules[next(iter(rules))] += len(at_rest)
    if len(rules) == 1:
        return f"O is {where_o(next(iter(rules)))} at every pose"
    counts = (f"{where_o(rule)} at {count} {'pose' if count == 1 else 'poses'}" for rule, count in rules.most_common())
    return f"O is {', '.join(counts)}"
