"""URDF: the mechanism as a tree, for programs that know no closed loops, and the table of its loops beside it.

A spanning tree with 30 joints: each leg turns about two axes at its start and slides; leg l1 carries the platform on
three more axes, leg q1 carries O. The other seven legs hang free, and their ends are the loops: 21 scalar equations,
which leave the nine degrees of freedom. All joints at zero is the neutral configuration.
"""

from __future__ import annotations

from collections.abc import Iterable
from xml.sax.saxutils import quoteattr

import numpy as np

from ninedof.export.bodies import COLOURS, LEVEL, MOMENTS, Bodies, Inertial, Leg, angles, ball, bars, numbers, pointing
from ninedof.export.model import Format, Model
from ninedof.support.arrays import Floats
from ninedof.support.text import encode

TABLE, MARK = ".loops.json", "ninedof-loops-1"
EFFORT, VELOCITY = 1000.0, 1.0  # N and m/s: the format demands limits of a slide; a design has none
CARRIERS = ("l1", "q1")
"""The legs that carry a body in the tree: the platform and O."""
CROSS = 0.02  # mass of the part between two axes of a joint, by that of a cylinder: programs refuse a mass of 0


def text(model: Model, leg_mass: float | None = None, platform_mass: float | None = None) -> str:
    """Return the URDF text of a design; masses in kg."""
    b = Bodies(model, leg_mass, platform_mass)
    return f"""<?xml version="1.0"?>
<robot name={quoteattr(model.name)}>
  <!-- The nine-degree-of-freedom manipulator as a tree, written by ninedof. Lengths: {b.unit}; masses: kilograms.
       Its loops are in the file of the same name that ends in {TABLE}: without them the legs hang free.
       All joints at zero is the neutral configuration; a slide reads the length of its leg less the neutral one. -->
  <mujoco><compiler fusestatic="false" discardvisual="false"/></mujoco>
{_link("base", *_bars(b, b.base.values()))}{"".join(_leg(b, leg) for leg in b.legs)}{_platform(b)}
{_point("O", b.point, 2.0 * b.radius)}
{_joint("q1_O", "fixed", "q1_rod", "O")}
</robot>
"""


def table(model: Model) -> str:
    """Return the table of the loops, JSON."""
    b, zero = Bodies(model), [0.0, 0.0, 0.0]
    legs = [
        {"name": leg.name, "joint": f"{leg.name}_slide"}
        | {"length_at_zero": leg.length, "shortest": leg.shortest, "longest": leg.longest}
        for leg in b.legs
    ]
    loops = [
        {"name": leg.name, "link_1": f"{leg.name}_rod", "point_1": zero}
        | {"link_2": leg.tip, "point_2": b.platform.get(leg.tip_joint, zero)}
        for leg in b.legs
        if leg.name not in CARRIERS
    ]
    contents = {
        "format": MARK,
        "robot": model.name,
        "length_unit": "m" if model.unit else "",
        "meaning": "point_1 of link_1 and point_2 of link_2, each in the frame of its link, coincide",
        "loops": loops,
        "legs": legs,
    }
    return encode(contents) + "\n"


def _leg(b: Bodies, leg: Leg) -> str:
    """Return two axes across the leg, the cylinder, and the rod, whose frame is at its tip."""
    at, along = b.root_of(leg)
    n, low, high = leg.name, leg.shortest - leg.length, leg.longest - leg.length
    slide = f"""<origin xyz="0 0 {numbers(leg.length)}"/>
    <axis xyz="0 0 1"/>
    <limit lower="{numbers(low)}" upper="{numbers(high)}" effort="{EFFORT:g}" velocity="{VELOCITY:g}"/>"""
    return f"""
{_axis(f"{n}_turn1", leg.root, f"{n}_cross", "1 0 0", at, pointing(along))}
{_point(f"{n}_cross", ball(CROSS * b.masses.cylinder, b.radius), b.radius)}
{_axis(f"{n}_turn2", f"{n}_cross", f"{n}_cylinder", "0 1 0")}
{_strut(b, leg, "cylinder", 0.5 * leg.part, 1.5 * b.radius, COLOURS[n[0]])}
{_joint(f"{n}_slide", "prismatic", f"{n}_cylinder", f"{n}_rod", slide)}
{_strut(b, leg, "rod", -0.5 * leg.part, b.radius, COLOURS["rod"])}"""


def _platform(b: Bodies) -> str:
    """Return three axes of the platform at the tip of leg l1, the plate, and the frame of the platform at p."""
    first = b.platform["platform_external1"]
    turn = b.legs[0].frame.T @ b.rotation  # the platform's axes, seen from the rod
    small, joints = ball(CROSS * b.masses.cylinder, b.radius), [at - first for at in b.platform.values()]
    x, y, z = np.subtract(b.plate.centre, first).tolist()
    plate = b.plate._replace(centre=(x, y, z))
    return f"""
{_axis("platform_turn1", "l1_rod", "platform_cross1", "1 0 0", rpy=angles(turn))}
{_point("platform_cross1", small, b.radius)}
{_axis("platform_turn2", "platform_cross1", "platform_cross2", "0 1 0")}
{_point("platform_cross2", small, b.radius)}
{_axis("platform_turn3", "platform_cross2", "plate", "0 0 1")}
{_link("plate", _inertial(plate), *_bars(b, joints))}
{_joint("platform_frame", "fixed", "plate", "platform", f'<origin xyz="{numbers(-first)}"/>')}
  <link name="platform"/>{_tool(b)}"""


def _tool(b: Bodies) -> str:
    if not b.tool:
        return ""
    origin = f'<origin xyz="{numbers(b.tool.position)}" rpy="{numbers(angles(b.tool.axes))}"/>'
    return f'\n{_joint("tool_frame", "fixed", "platform", "tool", origin)}\n  <link name="tool"/>'


def _joint(name: str, kind: str, parent: str, child: str, *more: str) -> str:
    lines = "\n    ".join([f'<parent link="{parent}"/>', f'<child link="{child}"/>', *more])
    return f"""  <joint name="{name}" type="{kind}">
    {lines}
  </joint>"""


def _axis(
    name: str, parent: str, child: str, along: str, at: Iterable[float] = LEVEL, rpy: Iterable[float] = LEVEL
) -> str:
    """Return a joint that turns without limits."""
    origin = f'<origin xyz="{numbers(at)}" rpy="{numbers(rpy)}"/>'
    return _joint(name, "continuous", parent, child, origin, f'<axis xyz="{along}"/>')


def _link(name: str, *parts: str) -> str:
    inner = "\n    ".join(parts)
    return f"""  <link name="{name}">
    {inner}
  </link>"""


def _strut(b: Bodies, leg: Leg, part: str, middle: float, radius: float, colour: str) -> str:
    """Return a link that is a part of a leg, a cylinder along z."""
    name = f"{leg.name}_{part}"
    shape = _cylinder((0.0, 0.0, middle), LEVEL, radius, leg.part, name, colour)
    return _link(name, _inertial(b.part(leg, part)), shape)


def _point(name: str, body: Inertial, radius: float) -> str:
    sphere = f"""<visual>
      <geometry><sphere radius="{numbers(radius)}"/></geometry>
      <material name="joint"><color rgba="{COLOURS["joint"]}"/></material>
    </visual>"""
    return _link(name, _inertial(body), sphere)


def _bars(b: Bodies, joints: Iterable[Floats]) -> list[str]:
    return [_cylinder(*bar[:2], b.radius, bar[2], "plate", COLOURS["plate"]) for bar in bars(joints)]


def _inertial(body: Inertial) -> str:
    moments = " ".join(f'{name}="{numbers(x)}"' for name, x in zip(MOMENTS, body.inertia, strict=True))
    return f"""<inertial>
      <origin xyz="{numbers(body.centre)}"/>
      <mass value="{numbers(body.mass)}"/>
      <inertia {moments}/>
    </inertial>"""


def _cylinder(
    middle: Iterable[float], rpy: Iterable[float], radius: float, length: float, material: str, colour: str
) -> str:
    return f"""<visual>
      <origin xyz="{numbers(middle)}" rpy="{numbers(rpy)}"/>
      <geometry><cylinder radius="{numbers(radius)}" length="{numbers(length)}"/></geometry>
      <material name="{material}"><color rgba="{colour}"/></material>
    </visual>"""


FORMAT = Format(
    "urdf", ".urdf", "URDF tree, with the table of its loops beside it", text, beside=(TABLE, "ninedof-loops-", table)
)
