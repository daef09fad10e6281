"""Links and joints of a URDF file as text. Bodies of turning parts are symmetric about the z axis of their frame."""

from __future__ import annotations

from collections.abc import Iterable

from ninedof.export.bodies import COLOURS, numbers
from ninedof.export.rpy import Angles, bars
from ninedof.support.arrays import Floats

EFFORT, VELOCITY = 1000.0, 1.0  # N and m/s: the format demands limits of a slide; a design has none
ORIGIN = (0.0, 0.0, 0.0)


def axis(
    name: str, parent: str, child: str, along: str, at: Iterable[float] = ORIGIN, rpy: Iterable[float] = ORIGIN
) -> str:
    """Return a joint that turns without limits."""
    return f"""  <joint name="{name}" type="continuous">
    <parent link="{parent}"/>
    <child link="{child}"/>
    <origin xyz="{numbers(at)}" rpy="{numbers(rpy)}"/>
    <axis xyz="{along}"/>
  </joint>"""


def slide(name: str, parent: str, child: str, height: float, low: float, high: float) -> str:
    """Return a joint that slides along z, at zero where the child is at this height."""
    return f"""  <joint name="{name}" type="prismatic">
    <parent link="{parent}"/>
    <child link="{child}"/>
    <origin xyz="0 0 {numbers(height)}"/>
    <axis xyz="0 0 1"/>
    <limit lower="{numbers(low)}" upper="{numbers(high)}" effort="{EFFORT:g}" velocity="{VELOCITY:g}"/>
  </joint>"""


def strut(
    name: str, middle: float, length: float, radius: float, mass: float, inertia: tuple[float, float], colour: str
) -> str:
    """Return a link that is a cylinder along z."""
    return f"""  <link name="{name}">
    {_inertial((0.0, 0.0, middle), mass, inertia)}
    {_cylinder((0.0, 0.0, middle), ORIGIN, radius, length, name, colour)}
  </link>"""


def point(name: str, mass: float, radius: float) -> str:
    """Return a link that is a ball."""
    square = 0.4 * mass * radius**2
    return f"""  <link name="{name}">
    {_inertial(ORIGIN, mass, (square, square))}
    <visual>
      <geometry><sphere radius="{numbers(radius)}"/></geometry>
      <material name="joint"><color rgba="{COLOURS["joint"]}"/></material>
    </visual>
  </link>"""


def plate(
    name: str,
    joints: Iterable[Floats],
    radius: float,
    centre: Iterable[float] = ORIGIN,
    mass: float = 0.0,
    inertia: tuple[float, float] = (0.0, 0.0),
) -> str:
    """Return a link drawn as bars from joint to joint; it has inertia if it has a mass."""
    drawn = "\n    ".join(
        _cylinder(middle, rpy, radius, length, "plate", COLOURS["plate"]) for middle, rpy, length in bars(joints)
    )
    massive = f"{_inertial(centre, mass, inertia)}\n    " if mass else ""
    return f"""  <link name="{name}">
    {massive}{drawn}
  </link>"""


def _inertial(centre: Iterable[float], mass: float, inertia: tuple[float, float]) -> str:
    across, axial = (numbers(moment) for moment in inertia)
    return f"""<inertial>
      <origin xyz="{numbers(centre)}"/>
      <mass value="{numbers(mass)}"/>
      <inertia ixx="{across}" ixy="0" ixz="0" iyy="{across}" iyz="0" izz="{axial}"/>
    </inertial>"""


def _cylinder(middle: Iterable[float], rpy: Angles, radius: float, length: float, material: str, colour: str) -> str:
    return f"""<visual>
      <origin xyz="{numbers(middle)}" rpy="{numbers(rpy)}"/>
      <geometry><cylinder radius="{numbers(radius)}" length="{numbers(length)}"/></geometry>
      <material name="{material}"><color rgba="{colour}"/></material>
    </visual>"""
