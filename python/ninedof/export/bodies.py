"""The robot as rigid bodies for simulators, in metres and kilograms: two plates, O, and nine legs of two parts.

A leg is a cylinder and a rod that slides in it. External legs go from base to platform, upper internal ones from the
platform to O, lower ones from the base to O (paper, Section 3).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from ninedof.design.duty import Masses, Six
from ninedof.design.study import Study
from ninedof.export.model import LEGS, Model, O, P, in_metres
from ninedof.statics.dynamics import inertia_matrix
from ninedof.support.arguments import Vector, finite
from ninedof.support.arrays import Floats

ASSUMED = Masses(platform=5.0, cylinder=0.5, rod=0.5)
"""In kg, where neither a study nor an option states them: simulators take no body without a mass."""
FREE = (0.7, 1.3)  # of the neutral length: the range of a leg that nothing limits, which one stage can have
LEAST_STROKE = 0.01  # of the neutral length: simulators take no range that is a point
COLOURS = {
    "l": "0 0.447 0.698 1",  # the legs as in the figures
    "q": "0.835 0.369 0 1",
    "r": "0 0.62 0.451 1",
    "rod": "0.8 0.8 0.8 1",
    "plate": "0.55 0.6 0.65 1",
    "joint": "0.15 0.15 0.15 1",
}
LEVEL = (0.0, 0.0, 0.0)
CENTRES = ("centre", "cylinder_centre", "rod_centre")
INERTIAS = ("inertia", "cylinder_inertia", "rod_inertia")
MOMENTS = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
THIN = 1e-9  # of the largest principal moment
RADIUS = 0.012  # of a rod, by the mean length of the legs; for the eye and for its inertia about its axis


class Inertial(NamedTuple):
    """The mass of a body as a simulator takes it, in the frame of the body."""

    mass: float
    centre: Vector
    inertia: Six
    """(ixx, iyy, izz, ixy, ixz, iyz) about that centre."""


class Leg:
    """One leg at the neutral configuration: a cylinder and a rod that overlap in the whole range, where they can."""

    def __init__(self, name: str, root: str, tip: str, at: dict[str, Floats], stroke: Any) -> None:
        self.name, self.root_joint, self.tip_joint = name, root, tip
        self.root = root.partition("_")[0]
        """The body that it starts from: "base" or "platform"."""
        self.tip = tip.partition("_")[0]
        """The body that it ends at: "platform" or "O"."""
        self.start, self.end = at[root], at[tip]
        length = self.length = float(np.linalg.norm(self.end - self.start))
        if length == 0.0:
            raise ValueError(f"design: leg {name} has the length 0 at the neutral configuration and no direction")
        self.direction: Floats = (self.end - self.start) / length
        low, high = (FREE[0] * length, FREE[1] * length) if stroke is None else stroke
        low, high = min(float(low), length), max(float(high), length)
        if high - low < LEAST_STROKE * length:
            low, high = low - 0.5 * LEAST_STROKE * length, high + 0.5 * LEAST_STROKE * length
        self.shortest, self.longest = low, high
        self.part = min(0.95 * low, 0.55 * high)
        """Length of the cylinder and of the rod, each."""

    @property
    def frame(self) -> Floats:
        """The rotation of the frame of `pointing` along the leg."""
        _, pitch, yaw = pointing(self.direction)
        (cp, cy), (sp, sy) = ([f(angle) for angle in (pitch, yaw)] for f in (math.cos, math.sin))
        return np.array([[cy * cp, -sy, cy * sp], [sy * cp, cy, sy * sp], [-sp, 0.0, cp]])


class Bodies:
    """The robot in metres and kilograms; masses as in `body_masses`."""

    def __init__(self, model: Model, leg_mass: float | None = None, platform_mass: float | None = None) -> None:
        masses = self.masses = _metric(body_masses(model.study, leg_mass, platform_mass)[0], model.unit)
        self.unit = "metres" if model.unit else "the design's own, without a unit"
        """Of lengths, for people."""
        metric = model.in_metres()
        at, own = ({_site(name): x for name, x in points.items()} for points in (metric.base_frame, metric.own_frame))
        self.base = {name: x for name, x in own.items() if name.startswith("base")}
        """Joints of the base by name, base frame."""
        self.platform = {name: x for name, x in own.items() if name.startswith("platform")}
        """Joints of the platform by name, platform frame."""
        self.position, self.rotation, self.internal_point = at[P], metric.configuration.rotation, at[O]
        self.tool = metric.tool
        """In metres, in the frame of the platform."""
        strokes = [None] * 9 if model.leg_ranges is None else in_metres(model.leg_ranges, model.unit)
        self.legs = [
            Leg(name, _site(root), _site(tip), at, stroke)
            for (name, root, tip), stroke in zip(LEGS, strokes, strict=True)
        ]
        self.radius = RADIUS * float(np.mean([leg.length for leg in self.legs]))
        """Of a rod."""
        self.point = ball(masses.internal_point, 2.0 * self.radius)
        """O."""
        square = max(float(np.sum(point[:2] ** 2)) for point in self.platform.values())
        across, axial = 0.25 * masses.platform * square, 0.5 * masses.platform * square
        disc = (across, across, axial, 0.0, 0.0, 0.0)
        inertia = _solid(masses.inertia) if any(masses.inertia) else disc
        self.plate = Inertial(masses.platform, masses.centre, inertia)
        """The platform; a disc with the radius of its outermost joint where the study states no inertia."""

    def part(self, leg: Leg, name: str) -> Inertial:
        """Return the "cylinder" of a leg, seen from where the leg starts, or its "rod", from its end; z is along it.

        Centre and transverse inertia are the study's, where it has them, else those of the solid that is drawn.
        """
        mass, centre, across = (getattr(self.masses, f"{name}{of}") for of in ("", "_centre", "_inertia"))
        square = (1.5 * self.radius) ** 2
        centre = centre or 0.5 * leg.part
        across = across or mass * (3.0 * square + leg.part**2) / 12.0
        axial = min(0.5 * mass * square, 2.0 * across)  # no body has more
        at = (0.0, 0.0, centre if name == "cylinder" else -centre)
        return Inertial(mass, at, (across, across, axial, 0.0, 0.0, 0.0))

    def root_of(self, leg: Leg) -> tuple[Floats, Floats]:
        """Return the start of a leg and its direction in the frame of the body that it starts from."""
        if leg.root == "base":
            return leg.start, leg.direction
        return self.platform[leg.root_joint], leg.direction @ self.rotation


def body_masses(
    study: Study | None, leg_mass: float | None = None, platform_mass: float | None = None
) -> tuple[Masses, list[str]]:
    """Return the study's masses with every mass in kg, and the names of those that are assumed.

    The arguments come first, then the study's, then `ASSUMED`; O is a tenth of a leg where the study says nothing.
    """
    for name, mass in (("leg_mass", leg_mass), ("platform_mass", platform_mass)):
        if mass is not None and not finite(name, mass) > 0.0:
            raise ValueError(f"{name}: got {mass:g}, expected a mass above 0")
    of_study = Masses() if study is None else study.masses
    half = None if leg_mass is None else 0.5 * leg_mass
    stated = {"platform": platform_mass, "cylinder": half, "rod": half, "internal_point": None}
    stated = {name: mass or getattr(of_study, name) for name, mass in stated.items()}
    masses: dict[str, Any] = {name: float(mass or getattr(ASSUMED, name)) for name, mass in stated.items()}
    masses["internal_point"] = masses["internal_point"] or 0.1 * (masses["cylinder"] + masses["rod"])
    return replace(of_study, **masses), [name for name, mass in stated.items() if not mass]


def _metric(masses: Masses, unit: str) -> Masses:
    """Return masses with lengths in metres and inertias in kg m²."""
    lengths = {name: in_metres(getattr(masses, name), unit).tolist() for name in CENTRES}
    squares = {name: in_metres(in_metres(getattr(masses, name), unit), unit).tolist() for name in INERTIAS}
    return replace(masses, **lengths, **squares)


def _solid(inertia: Six) -> Six:
    """Return an inertia as programs take it: no principal moment of 0 or, by rounding, above the sum of the others."""
    small, middle, large = np.linalg.eigvalsh(inertia_matrix(inertia)).tolist()
    more = 2.0 * THIN * large if min(small, small + middle - large) < THIN * large else 0.0
    return tuple(x + more * (k < 3) for k, x in enumerate(inertia))


def _site(name: str) -> str:
    """Return the name of a joint in simulators, base_external1 for base_external_1."""
    return "".join(name.rsplit("_", 1))


def ball(mass: float, radius: float) -> Inertial:
    """Return a solid ball about the origin."""
    moment = 0.4 * mass * radius**2
    return Inertial(mass, LEVEL, (moment, moment, moment, 0.0, 0.0, 0.0))


def numbers(values: Iterable[float] | float) -> str:
    """Return the text of an attribute: it reads back to the same doubles."""
    each = map(float, [values] if isinstance(values, float | int) else values)
    return " ".join(repr(int(x)) if x == int(x) and abs(x) < 1e15 else repr(x) for x in each)


def angles(rotation: Floats) -> tuple[float, float, float]:
    """Return roll, pitch and yaw of a rotation R = Rz(yaw) Ry(pitch) Rx(roll), as URDF and SDFormat have them, radians.

    The yaw is 0 where the pitch is a right angle.
    """
    level = math.hypot(rotation[0, 0], rotation[1, 0])
    pitch = math.atan2(-rotation[2, 0], level)
    if level < 1e-12:
        return math.atan2(-rotation[1, 2], rotation[1, 1]), pitch, 0.0
    return math.atan2(rotation[2, 1], rotation[2, 2]), pitch, math.atan2(rotation[1, 0], rotation[0, 0])


def pointing(direction: Floats) -> tuple[float, float, float]:
    """Return the angles of a frame whose z axis has a direction; the roll is 0."""
    x, y, z = (float(v) for v in direction)
    return 0.0, math.atan2(math.hypot(x, y), z), math.atan2(y, x)


def bars(joints: Iterable[Floats]) -> Iterator[tuple[Floats, tuple[float, float, float], float]]:
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
