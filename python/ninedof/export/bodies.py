"""The robot as rigid bodies for simulators, in metres and kilograms: two plates, O, and nine legs of two parts.

A leg is a cylinder and a rod that slides in it. External legs go from base to platform, upper internal ones from the
platform to O, lower ones from the base to O (paper, Section 3).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ninedof.export.model import Model
from ninedof.robot.geometry import triples
from ninedof.robot.leg_names import LEGS
from ninedof.support.arguments import finite
from ninedof.support.arrays import Floats

METRES = {"mm": (1, 1000), "cm": (1, 100), "m": (1, 1), "in": (254, 10000), "ft": (3048, 10000), "": (1, 1)}
"""A unit in metres as a fraction, so that 850 mm is 0.85 and not 0.8500000000000001; none is taken as it is."""

LEG_MASS, PLATFORM_MASS = 1.0, 5.0
FREE = (0.7, 1.3)  # of the neutral length: the range of a leg that nothing limits, which one stage can have
LEAST_STROKE = 0.01  # of the neutral length: simulators take no range that is a point
ROOTS = {"l": ("base", "base_external"), "q": ("platform", "platform_internal"), "r": ("base", "base_internal")}
COLOURS = {
    "l": "0 0.447 0.698 1",  # the legs as in the figures
    "q": "0.835 0.369 0 1",
    "r": "0 0.62 0.451 1",
    "rod": "0.8 0.8 0.8 1",
    "plate": "0.55 0.6 0.65 1",
    "joint": "0.15 0.15 0.15 1",
}
Angles = tuple[float, float, float]
"""Roll, pitch and yaw as URDF and SDFormat have them: R = Rz(yaw) Ry(pitch) Rx(roll)."""
LEVEL = (0.0, 0.0, 0.0)
RADIUS = 0.012  # of a rod, by the mean length of the legs; for the eye and for its inertia about its axis


@dataclass(frozen=True, eq=False)
class Leg:
    """One leg at the neutral configuration."""

    name: str
    root: str
    """The body that it starts from: "base" or "platform"."""
    root_joint: str
    """The name of its joint there: "base_external1"."""
    tip: str
    """The body that it ends at: "platform" or "O"."""
    tip_joint: str
    start: Floats
    """Its first end, base frame, shape (3,)."""
    end: Floats
    shortest: float
    longest: float
    part: float
    """Length of the cylinder and of the rod, each: they overlap in the whole range where that can be."""

    @property
    def length(self) -> float:
        """At the neutral configuration."""
        return float(np.linalg.norm(self.end - self.start))

    @property
    def direction(self) -> Floats:
        """From start to end, a unit vector, base frame."""
        return np.asarray((self.end - self.start) / self.length)


@dataclass(frozen=True, eq=False)
class Bodies:
    """The robot in metres and kilograms."""

    base: dict[str, Floats]
    """Joints of the base by name, base frame."""
    platform: dict[str, Floats]
    """Joints of the platform by name, platform frame."""
    position: Floats
    rotation: Floats
    internal_point: Floats
    legs: tuple[Leg, ...]
    part_mass: float
    """Of a cylinder and of a rod, each: half a leg."""
    platform_mass: float
    radius: float
    """Of a rod."""

    @property
    def point_mass(self) -> float:
        """Of the body O: a tenth of a leg."""
        return 0.2 * self.part_mass

    @property
    def platform_inertia(self) -> tuple[float, float]:
        """Moments about an axis in the plate and about its normal: a disc through the outermost joint."""
        square = max(float(np.sum(point[:2] ** 2)) for point in self.platform.values())
        return 0.25 * self.platform_mass * square, 0.5 * self.platform_mass * square

    def part_inertia(self, leg: Leg) -> tuple[float, float]:
        """Moments of a cylinder or a rod about an axis across it, through its centre, and about its own axis."""
        square = (1.5 * self.radius) ** 2
        return self.part_mass * (3.0 * square + leg.part**2) / 12.0, 0.5 * self.part_mass * square


def in_metres(values: Floats, unit: str) -> Floats:
    """Return lengths in metres; as they are without a unit."""
    above, below = METRES[unit]
    return np.asarray(values, dtype=np.float64) * above / below


def from_metres(values: Floats, unit: str) -> Floats:
    """Undo `in_metres`, to rounding."""
    above, below = METRES[unit]
    return np.asarray(values, dtype=np.float64) * below / above


def bodies_of(model: Model, leg_mass: float = LEG_MASS, platform_mass: float = PLATFORM_MASS) -> Bodies:
    """Return the bodies of a design; masses in kg, above 0."""
    for name, mass in (("leg_mass", leg_mass), ("platform_mass", platform_mass)):
        if not finite(name, mass) > 0.0:
            raise ValueError(f"{name}: got {mass:g}, expected a mass above 0")
    c, unit = model.configuration, model.unit
    p, s = in_metres(c.position, unit), in_metres(c.internal_point, unit)
    joints = {
        f"{name}{i}": in_metres(point, unit)
        for name, points in triples(model.geometry).items()
        for i, point in enumerate(points, start=1)
    }
    at = {n: p + c.rotation @ x if n.startswith("platform") else x for n, x in joints.items()} | {"O": s}
    ranges = [None] * 9 if model.leg_ranges is None else list(model.leg_ranges)
    legs = tuple(_leg(name, at, between, unit) for name, between in zip(LEGS, ranges, strict=True))
    return Bodies(
        base={name: x for name, x in joints.items() if name.startswith("base")},
        platform={name: x for name, x in joints.items() if name.startswith("platform")},
        position=p,
        rotation=c.rotation,
        internal_point=s,
        legs=legs,
        part_mass=0.5 * float(leg_mass),
        platform_mass=float(platform_mass),
        radius=RADIUS * float(np.mean([leg.length for leg in legs])),
    )


def _leg(name: str, at: dict[str, Floats], between: tuple[float, float] | None, unit: str) -> Leg:
    kind, i = name[0], name[1]
    root, triple = ROOTS[kind]
    tip, tip_joint = ("platform", f"platform_external{i}") if kind == "l" else ("O", "O")
    start, end = at[f"{triple}{i}"], at[tip_joint]
    length = float(np.linalg.norm(end - start))
    if length == 0.0:
        raise ValueError(f"design: leg {name} has the length 0 at the neutral configuration and no direction")
    low, high = (FREE[0] * length, FREE[1] * length) if between is None else in_metres(np.array(between), unit)
    low, high = min(float(low), length), max(float(high), length)
    if high - low < LEAST_STROKE * length:
        low, high = low - 0.5 * LEAST_STROKE * length, high + 0.5 * LEAST_STROKE * length
    part = min(0.95 * low, 0.55 * high)
    return Leg(name, root, f"{triple}{i}", tip, tip_joint, start, end, low, high, part)


def length_words(model: Model) -> str:
    """Return the unit of lengths of a file of a simulator, for people."""
    return "metres" if model.unit else "the design's own, without a unit"


def numbers(values: Iterable[float] | float) -> str:
    """Return the text of an attribute: it reads back to the same doubles."""
    each = [values] if isinstance(values, float | int) else values
    return " ".join(_short(float(value)) for value in each)


def _short(value: float) -> str:
    return repr(int(value)) if value == int(value) and abs(value) < 1e15 else repr(value)


def angles(rotation: Floats) -> Angles:
    """Return roll, pitch and yaw of a rotation, radians; yaw is 0 where the pitch is a right angle."""
    level = math.hypot(rotation[0, 0], rotation[1, 0])
    pitch = math.atan2(-rotation[2, 0], level)
    if level < 1e-12:
        return math.atan2(-rotation[1, 2], rotation[1, 1]), pitch, 0.0
    return math.atan2(rotation[2, 1], rotation[2, 2]), pitch, math.atan2(rotation[1, 0], rotation[0, 0])


def rotation_of(rpy: Angles) -> Floats:
    """Return the rotation of roll, pitch and yaw."""
    (cr, cp, cy), (sr, sp, sy) = ([f(a) for a in rpy] for f in (math.cos, math.sin))
    about_x = np.array([[1.0, 0.0, 0.0], [0.0, cr, -sr], [0.0, sr, cr]])
    about_y = np.array([[cp, 0.0, sp], [0.0, 1.0, 0.0], [-sp, 0.0, cp]])
    about_z = np.array([[cy, -sy, 0.0], [sy, cy, 0.0], [0.0, 0.0, 1.0]])
    return np.asarray(about_z @ about_y @ about_x)


def pointing(direction: Floats) -> Angles:
    """Return the angles of a frame whose z axis has a direction."""
    x, y, z = (float(v) for v in direction)
    return 0.0, math.atan2(math.hypot(x, y), z), math.atan2(y, x)


def bars(joints: Iterable[Floats]) -> Iterator[tuple[Floats, Angles, float]]:
    """Yield middle, angles and length of bars around a plate, from joint to joint; z is along the bar.

    Joints in the order of their angles about their mean; two at the same place have no bar.
    """
    points = np.array(list(joints))
    x, y, _ = (points - points.mean(axis=0)).T
    ring = points[np.argsort(np.arctan2(y, x), kind="stable")]
    for a, b in pairwise([*ring, ring[0]]):
        length = float(np.linalg.norm(b - a))
        if length > 1e-9 * float(np.abs(points).max()):
            yield 0.5 * (a + b), pointing((b - a) / length), length
