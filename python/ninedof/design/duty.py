"""The duty of a machine as a study file states it: title, tool, loads, masses, speeds and tolerances."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from ninedof import _core
from ninedof.design.tool import Tool
from ninedof.statics.dynamics import GRAVITY, inertia_matrix, masses_for_core
from ninedof.support.arguments import Vector, choice, finite, instance, items, text, vector
from ninedof.support.structs import StudyTable, entry, read
from ninedof.support.text import short_repr
from ninedof.support.units import amount

Six = tuple[float, ...]
positive_or_zero = partial(finite, least=0.0)


def six(name: str, value: Any, expected: str) -> Six:
    """Return six finite numbers."""
    return tuple(finite(f"{name}[{k}]", x) for k, x in enumerate(items(name, value, expected, 6)))


def _wrenches(name: str, value: Any) -> tuple[Six, ...]:
    rows = items(name, value, "a list of [mx, my, mz, fx, fy, fz]")
    return tuple(six(f"{name}[{k}]", one, "[mx, my, mz, fx, fy, fz]") for k, one in enumerate(rows))


def _inertia(name: str, value: Any) -> Six:
    moments = six(name, value, "[ixx, iyy, izz, ixy, ixz, iyz]")
    small, middle, large = np.linalg.eigvalsh(inertia_matrix(moments))
    slack = 1e-9 * max(abs(small), abs(large))
    if small < -slack or large > small + middle + slack:
        got = ", ".join(f"{x:g}" for x in (small, middle, large))
        raise ValueError(f"{name}: got principal moments {got}, expected none below 0 or above the other two's sum")
    return moments


@short_repr
@dataclass(frozen=True)
class About(StudyTable):
    """The title block of a report.

    Parameters
    ----------
    project, author, revision : text
        Shown as they are; empty by default.

    Examples
    --------
    >>> import ninedof as nd
    >>> nd.Study(about={"project": "Polishing head", "revision": "B"}).about
    About(project='Polishing head', revision='B')

    """

    project: str = entry(text, "")
    author: str = entry(text, "")
    revision: str = entry(text, "")


@short_repr
@dataclass(frozen=True)
class Loads(StudyTable):
    """Loads on the platform, and gravity: by its direction, how the machine is mounted.

    Parameters
    ----------
    gravity : (3,) floats
        Force per mass in base axes. (0, 0, -9.81) by default, the base below and level: kilograms give newtons in any
        unit of lengths. A machine that hangs from the ceiling has (0, 0, 9.81).
    wrenches : sequence of (6,) floats
        Each (mx, my, mz, fx, fy, fz): a moment about the tool's point and a force, base axes. None by default.

    Examples
    --------
    >>> import ninedof as nd
    >>> nd.Loads(gravity=(9.81, 0.0, 0.0), wrenches=[[0, 0, 0, 0, 0, -500]])  # on a wall
    Loads(gravity=(9.81, 0, 0), wrenches=((0, 0, 0, 0, 0, -500),))

    """

    gravity: Vector = entry(vector, GRAVITY)
    wrenches: tuple[Six, ...] = entry(_wrenches, ())


@short_repr
@dataclass(frozen=True)
class Masses(StudyTable):
    """Masses and inertias of the platform, of the two bodies of each leg, and of O.

    Parameters
    ----------
    platform : float
        Mass of the platform with its load. Zero by default.
    centre : (3,) floats
        Its centre of mass in the platform's frame. Zero by default.
    inertia : (6,) floats
        (ixx, iyy, izz, ixy, ixz, iyz) about that centre, axes of the platform's frame: entries of the matrix. Zero by
        default.
    cylinder, rod : float
        Masses of the two bodies of each leg. Zero by default.
    cylinder_centre, rod_centre : float
        Distance of the centre of mass from the joint that the body hangs on: of the cylinder from the beginning of the
        leg (base joint r_i, platform joint ũ_i, base joint r̂_i), of the rod from its end. Zero by default.
    cylinder_inertia, rod_inertia : float
        About a transverse axis through that centre. Zero by default.
    internal_point : float
        A point mass at O. Zero by default.

    Examples
    --------
    >>> import ninedof as nd
    >>> nd.Masses(platform=12.0, centre=(0.0, 0.0, 30.0), cylinder=1.4, rod=0.6)
    Masses(platform=12, centre=(0, 0, 30), cylinder=1.4, rod=0.6)

    """

    platform: float = entry(positive_or_zero, 0.0)
    centre: Vector = entry(vector, (0.0, 0.0, 0.0))
    inertia: Six = entry(_inertia, (0.0,) * 6)
    cylinder: float = entry(positive_or_zero, 0.0)
    rod: float = entry(positive_or_zero, 0.0)
    cylinder_centre: float = entry(positive_or_zero, 0.0)
    rod_centre: float = entry(positive_or_zero, 0.0)
    cylinder_inertia: float = entry(positive_or_zero, 0.0)
    rod_inertia: float = entry(positive_or_zero, 0.0)
    internal_point: float = entry(positive_or_zero, 0.0)

    def __bool__(self) -> bool:
        """Whether anything has a mass or an inertia."""
        places = ("centre", "cylinder_centre", "rod_centre")
        return any(np.any(value) for name, value in vars(self).items() if name not in places)

    def seen_from(self, tool: Tool) -> Masses:
        """Return the same masses with centre and inertia in the tool's frame, that of geometries and poses."""
        axes = instance("tool", tool, Tool).axes
        m = (axes.T @ inertia_matrix(self.inertia) @ axes).tolist()
        inertia = (m[0][0], m[1][1], m[2][2], m[0][1], m[0][2], m[1][2])
        return replace(self, centre=tool.seen(self.centre), inertia=inertia)


@short_repr
@dataclass(frozen=True)
class Speeds(StudyTable):
    """Greatest speeds and accelerations of the tool, in any direction.

    Parameters
    ----------
    linear : float
        Of the tool's point, length/time. Zero by default.
    angular : float
        About any axis, radians/time. Zero by default.
    acceleration : float
        Of the tool's point, length/time². Zero by default.
    angular_acceleration : float
        Radians/time². Zero by default.

    Examples
    --------
    >>> import math
    >>> import ninedof as nd
    >>> nd.Speeds(linear=200.0, angular=math.radians(30)).to_dict()
    {'linear': 200.0, 'angular_deg': 30.0}

    """

    linear: float = entry(positive_or_zero, 0.0)
    angular: float = entry(positive_or_zero, 0.0, angle=True)
    acceleration: float = entry(positive_or_zero, 0.0)
    angular_acceleration: float = entry(positive_or_zero, 0.0, angle=True)


@short_repr
@dataclass(frozen=True)
class Tolerances(StudyTable):
    """Half widths of the errors of manufacture.

    Parameters
    ----------
    joints : float
        Radius about each joint centre in which it lies, a length. Zero by default.
    legs : float
        Of each leg length, to both sides. Zero by default.

    Examples
    --------
    >>> import ninedof as nd
    >>> nd.Tolerances(joints=0.02, legs=0.01)
    Tolerances(joints=0.02, legs=0.01)

    """

    joints: float = entry(positive_or_zero, 0.0)
    legs: float = entry(positive_or_zero, 0.0)

    def __bool__(self) -> bool:
        """Whether anything may be off."""
        return self.joints > 0.0 or self.legs > 0.0

    def remark(self) -> list[str]:
        """Return that an answer is about machines as they are drawn, a sentence; none without tolerances."""
        return ["Of machines as they are drawn: the tolerances of the study are not looked at."] * bool(self)


LARGEST_TOLERANCE = 0.1
"""Of the height zp: no tolerance of a machine is as large."""


def require_small(tolerances: Tolerances, height: float, unit: str) -> None:
    """Raise for tolerances of no machine that is at most as high."""
    for name, size in (("joints", tolerances.joints), ("legs", tolerances.legs)):
        if size > 0.0 and not size < LARGEST_TOLERANCE * height:
            got, most = (amount(f"{x:.6g}", unit) for x in (size, LARGEST_TOLERANCE * height))
            raise ValueError(f"tolerances.{name}: got {got}, expected less than a tenth of the greatest zp, {most}")


def tolerances_like(shape: Tolerances, size: float) -> Tolerances:
    """Return tolerances in the ratio of others, the larger one of a size; alike where the others are none."""
    most = max(shape.joints, shape.legs)
    joints, legs = (shape.joints / most, shape.legs / most) if most > 0.0 else (1.0, 1.0)
    return Tolerances(size * joints, size * legs)


DUTIES: dict[str, type[StudyTable]] = {
    "about": About,
    "tool": Tool,
    "loads": Loads,
    "masses": Masses,
    "speeds": Speeds,
    "tolerances": Tolerances,
}
"""The tables of a study file that say what the machine is for, by name."""


def duty(kind: type[StudyTable]) -> Callable[..., Any]:
    """Return the check of an argument that is such a table or a mapping of its entries, besides their defaults."""
    return lambda name, value, **defaults: value if isinstance(value, kind) else read(kind, value, name, **defaults)


# --- For limits of forces, rates and powers of legs -------------------------------------------------------------------

INTERNAL = ("least", "held", "shifted", "carried")
"""The motion of O with the platform."""


@dataclass(frozen=True)
class LegDuty(StudyTable):
    """The duty of the legs of a machine, masses in the frame of geometries."""

    loads: Loads = entry(duty(Loads), Loads())
    masses: Masses = entry(duty(Masses), Masses())
    speeds: Speeds = entry(duty(Speeds), Speeds())
    internal: str = entry(partial(choice, known=INTERNAL), "least")

    def for_core(self) -> _core.Duty:
        """Return the duty as the core takes it; a machine without wrenches has its weights alone."""
        speeds = {"linear_speed": self.speeds.linear, "angular_speed": self.speeds.angular}
        return _core.Duty(
            loads=self.loads.wrenches or [(0.0,) * 6],
            masses=masses_for_core(self.masses),
            gravity=self.loads.gravity,
            motion=_core.PlatformMotion(internal=self.internal, **speeds),
        )
