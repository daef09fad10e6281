"""SDFormat: the mechanism with its loops closed, as links and joints, for Gazebo and what else reads the format.

Each leg is a cylinder on a universal joint and a rod that slides in it; a ball joint holds the tip of the rod at the
platform or at O. O is fixed to the rod of leg q1, so that nine degrees of freedom are left and nothing spins.
"""

from __future__ import annotations

from collections.abc import Iterable
from xml.sax.saxutils import quoteattr

from ninedof.export.bodies import COLOURS, LEVEL, MOMENTS, Bodies, Inertial, Leg, angles, bars, numbers, pointing
from ninedof.export.model import Format, Model
from ninedof.support.arrays import Floats

VERSION = "1.9"
CARRIER = "q1"  # the leg whose rod O is fixed to


def text(model: Model, leg_mass: float | None = None, platform_mass: float | None = None) -> str:
    """Return the SDFormat text of a design; masses in kg."""
    b = Bodies(model, leg_mass, platform_mass)
    return f"""<?xml version="1.0"?>
<sdf version="{VERSION}">
  <!-- The nine-degree-of-freedom manipulator, written by ninedof. Lengths: {b.unit}; masses: kilograms.
       The joints l1 to r3 are the actuators; they read the length of the leg less the neutral one. -->
  <model name={quoteattr(model.name)}>
    <link name="base">
      {_bars(b, b.base.values())}
    </link>
    <joint name="base_fixed" type="fixed">
      <parent>world</parent>
      <child>base</child>
    </joint>
    <link name="platform">
      {_pose(b.position, angles(b.rotation))}
      {_inertial(b.plate)}
      {_bars(b, b.platform.values())}
    </link>
    <link name="O">
      {_pose(b.internal_point)}
      {_inertial(b.point)}
      {_visual("O", LEVEL, LEVEL, f"<sphere><radius>{numbers(2.0 * b.radius)}</radius></sphere>", COLOURS["joint"])}
    </link>{_tool(b)}{"".join(_leg(b, leg) for leg in b.legs)}
  </model>
</sdf>
"""


def _tool(b: Bodies) -> str:
    if not b.tool:
        return ""
    pose = _pose(b.tool.position, angles(b.tool.axes))
    return f'\n    <frame name="tool" attached_to="platform">\n      {pose}\n    </frame>'


def _leg(b: Bodies, leg: Leg) -> str:
    """Return cylinder, rod and their three joints; the frame of the rod is at its tip. Joints are in their child."""
    n, rpy, half = leg.name, pointing(leg.direction), 0.5 * leg.part
    cylinder = _cylinder("cylinder", (0.0, 0.0, half), LEVEL, 1.5 * b.radius, leg.part, COLOURS[n[0]])
    rod = _cylinder("rod", (0.0, 0.0, -half), LEVEL, b.radius, leg.part, COLOURS["rod"])
    low, high = numbers(leg.shortest - leg.length), numbers(leg.longest - leg.length)
    return f"""
    <link name="{n}_cylinder">
      {_pose(leg.start, rpy)}
      {_inertial(b.part(leg, "cylinder"))}
      {cylinder}
    </link>
    <link name="{n}_rod">
      {_pose(leg.end, rpy)}
      {_inertial(b.part(leg, "rod"))}
      {rod}
    </link>
    <joint name="{n}_start" type="universal">
      <parent>{leg.root}</parent>
      <child>{n}_cylinder</child>
      <axis><xyz>1 0 0</xyz></axis>
      <axis2><xyz>0 1 0</xyz></axis2>
    </joint>
    <joint name="{n}" type="prismatic">
      <parent>{n}_cylinder</parent>
      <child>{n}_rod</child>
      <axis>
        <xyz>0 0 1</xyz>
        <limit><lower>{low}</lower><upper>{high}</upper></limit>
      </axis>
    </joint>
    <joint name="{n}_end" type="{"fixed" if n == CARRIER else "ball"}">
      <parent>{leg.tip}</parent>
      <child>{n}_rod</child>
    </joint>"""


def _pose(at: Iterable[float], rpy: Iterable[float] = LEVEL) -> str:
    return f"<pose>{numbers(at)} {numbers(rpy)}</pose>"


def _inertial(body: Inertial) -> str:
    moments = "".join(f"<{name}>{numbers(x)}</{name}>" for name, x in zip(MOMENTS, body.inertia, strict=True))
    return f"""<inertial>
        {_pose(body.centre)}
        <mass>{numbers(body.mass)}</mass>
        <inertia>{moments}</inertia>
      </inertial>"""


def _bars(b: Bodies, joints: Iterable[Floats]) -> str:
    return "\n      ".join(
        _cylinder(f"bar{i}", middle, rpy, b.radius, length, COLOURS["plate"])
        for i, (middle, rpy, length) in enumerate(bars(joints), start=1)
    )


def _cylinder(
    name: str, middle: Iterable[float], rpy: Iterable[float], radius: float, length: float, colour: str
) -> str:
    shape = f"<cylinder><radius>{numbers(radius)}</radius><length>{numbers(length)}</length></cylinder>"
    return _visual(name, middle, rpy, shape, colour)


def _visual(name: str, at: Iterable[float], rpy: Iterable[float], shape: str, colour: str) -> str:
    return f"""<visual name="{name}">
        {_pose(at, rpy)}
        <geometry>{shape}</geometry>
        <material><ambient>{colour}</ambient><diffuse>{colour}</diffuse></material>
      </visual>"""


FORMAT = Format("sdf", ".sdf", "SDFormat model with closed loops", text)
