"""Poses of an objective, as shifts from the neutral pose of a design: one, and sets of them, a box, a ball, a path."""

from __future__ import annotations

import itertools
import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from ninedof import _core
from ninedof.redundancy.rules import STUDY_RULES, where_o
from ninedof.support.arguments import Vector, choice, finite, vector, vectors, whole
from ninedof.support.structs import Check, StudyTable, entry
from ninedof.support.text import short_repr
from ninedof.support.units import DEG, in_radians, scale

ZERO: Vector = (0.0, 0.0, 0.0)
DEFAULT_INTERNAL_POINT = "shifted"


def _internal_point(name: str, value: Any) -> Vector | str:
    return choice(name, value, STUDY_RULES) if isinstance(value, str) else vector(name, value)


@short_repr
@dataclass(frozen=True)
class Pose(StudyTable):
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
    >>> from ninedof.design.domains.poses import Pose
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


__all__ = ["Pose", "ball", "box", "path"]

MOST_POSES = 10_000  # in one study; each takes one decomposition per evaluation


def box(
    half: Any,
    points: int = 3,
    tilt: Any = None,
    tilt_deg: Any = None,
    internal_point: Any = DEFAULT_INTERNAL_POINT,
    unit: str = "length",
) -> tuple[Pose, ...]:
    """Return a grid of poses over a box about the neutral pose, and tilts at its centre.

    Parameters
    ----------
    half : (3,) floats
        Half edges along x, y and z of the base frame; an axis with 0 has one point.
    points : int
        Points on each other axis, both ends included; 3 by default: -half, 0, +half.
    tilt, tilt_deg : (3,) floats, optional
        Angles about x, y and z, radians or degrees: the neutral pose is also turned by plus and minus each, one at a
        time. None by default.
    internal_point, unit
        As in `Pose`, for all of them.

    Examples
    --------
    >>> from ninedof import poses
    >>> len(poses.box((0.1, 0.1, 0.1), tilt_deg=(10, 10, 0), unit="zp"))
    31

    """
    edges = vector("half", half, least=0.0)
    count = whole("points", points, 1, MOST_POSES)
    axes = [_grid(h, count if h > 0.0 else 1) for h in edges]
    if (every := math.prod(map(len, axes))) > MOST_POSES:
        raise ValueError(f"points: got {every} poses in all, expected at most {MOST_POSES}")
    places: list[Vector] = [(x, y, z) for x, y, z in itertools.product(*axes)]
    return _with_tilts(places, tilt, tilt_deg, internal_point, unit)


def ball(
    radius: float,
    points: int = 33,
    tilt: Any = None,
    tilt_deg: Any = None,
    internal_point: Any = DEFAULT_INTERNAL_POINT,
    unit: str = "length",
) -> tuple[Pose, ...]:
    """Return low-discrepancy poses in a ball about the neutral pose, and tilts at its centre.

    Parameters
    ----------
    radius : float
        Of the ball.
    points : int
        Number of poses, 33 by default. The first is the centre, the last lies on the surface; each represents the same
        share of the volume.
    tilt, tilt_deg, internal_point, unit
        As in `box`.

    Examples
    --------
    >>> from ninedof import poses
    >>> poses.ball(0.1, points=5)[0].position
    (0.0, 0.0, 0.0)

    """
    size = finite("radius", radius, least=0.0)
    count = whole("points", points, 1, MOST_POSES)
    places: list[Vector] = [ZERO]
    # Directions by the two-dimensional sequence of the plastic number: another point leaves the others unchanged.
    plastic = 1.324717957244746
    for k in range(1, count):
        distance = size * (k / (count - 1)) ** (1.0 / 3.0)
        height = 2.0 * ((0.5 + k / plastic) % 1.0) - 1.0
        around = 2.0 * math.pi * ((0.5 + k / plastic**2) % 1.0)
        flat = math.sqrt(1.0 - height * height)
        places.append((distance * flat * math.cos(around), distance * flat * math.sin(around), distance * height))
    return _with_tilts(places, tilt, tilt_deg, internal_point, unit)


def path(
    positions: Any,
    rotations: Any = None,
    rotations_deg: Any = None,
    points: int = 17,
    internal_point: Any = DEFAULT_INTERNAL_POINT,
    unit: str = "length",
) -> tuple[Pose, ...]:
    """Return poses along a path, straight between its corners.

    Parameters
    ----------
    positions : sequence of (3,) floats
        Shifts of p at the corners, at least two.
    rotations, rotations_deg : sequence of (3,) floats, optional
        Rotation vector at each corner, radians or degrees, interpolated linearly in between. None by default.
    points : int
        Number of poses, 17 by default, both ends included, evenly spaced over the arc length of the positions (over the
        corners, if p does not move at all).
    internal_point, unit
        As in `Pose`, for all of them.

    Examples
    --------
    >>> from ninedof import poses
    >>> [pose.position[0] for pose in poses.path([[0, 0, 0], [1, 0, 0]], points=3)]
    [0.0, 0.5, 1.0]

    """
    corners = vectors("positions", positions)
    if len(corners) < 2:
        raise ValueError(f"positions: got {len(corners)} corners, expected at least two")
    turns = _radians("rotations", rotations, rotations_deg, vectors) or (ZERO,) * len(corners)
    if len(turns) != len(corners):
        raise ValueError(f"rotations: got {len(turns)} rotations, expected one a corner, {len(corners)}")
    count = whole("points", points, 2, MOST_POSES)
    with np.errstate(over="ignore"):  # of huge numbers, see below
        steps = np.linalg.norm(np.diff(corners, axis=0), axis=1)
    if not steps.any():
        steps = np.ones_like(steps)
    for k, step in enumerate(steps):
        if step == 0.0 and turns[k] != turns[k + 1]:
            raise ValueError(
                f"positions[{k + 1}]: got the place of the corner before it with another rotation, expected a path on "
                "which the platform moves wherever it turns"
            )
    along = np.concatenate([[0.0], np.cumsum(steps)])
    with np.errstate(all="ignore"):  # of huge numbers, which poses refuse
        at = np.linspace(0.0, along[-1], count)
        p, q = (
            np.column_stack([np.interp(at, along, column) for column in np.transpose(rows)])
            for rows in (corners, turns)
        )
    return tuple(Pose(tuple(x), tuple(w), internal_point, unit) for x, w in zip(p.tolist(), q.tolist(), strict=True))


def _grid(half: float, count: int) -> list[float]:
    """Return points from -half to half, exactly symmetric."""
    return [half * ((2 * k - (count - 1)) / (count - 1)) for k in range(count)] if count > 1 else [0.0]


def _with_tilts(places: list[Vector], tilt: Any, tilt_deg: Any, internal_point: Any, unit: str) -> tuple[Pose, ...]:
    """Return poses at the places, and the neutral pose turned by plus and minus each angle that is not zero."""
    angles = _radians("tilt", tilt, tilt_deg, partial(vector, least=0.0)) or ZERO
    turns = [sign * angle * np.eye(3)[k] for k, angle in enumerate(angles) if angle > 0.0 for sign in (1.0, -1.0)]
    every = [(p, ZERO) for p in places] + [(ZERO, tuple((turn + 0.0).tolist())) for turn in turns]
    return tuple(Pose(p, turn, internal_point, unit) for p, turn in every)


def _radians(name: str, radians: Any, degrees: Any, check: Check) -> Any:
    """Return an argument that has a second name for degrees; None without one."""
    values = {key: value for key, value in ((name, radians), (name + DEG, degrees)) if value is not None}
    return check(name, in_radians(values, {name: check})[name]) if values else None
