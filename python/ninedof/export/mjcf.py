"""MJCF: the whole mechanism for MuJoCo, nine prismatic actuators, 27 scalar constraints.

Each leg is a cylinder on a ball joint and a rod that slides in it; upper internal legs hang on the platform, the others
on the base. The tip of a rod is held at its joint by a constraint: 45 degrees of freedom less 27 are the nine of the
robot and nine spins of the legs about themselves.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from xml.etree import ElementTree
from xml.sax.saxutils import quoteattr

import numpy as np

from ninedof.conditioning.characteristic_length import length_argument
from ninedof.export.bodies import COLOURS, Bodies, Inertial, Leg, numbers
from ninedof.export.model import Fields, Format, Model, from_metres
from ninedof.motion.rotations import from_quaternions
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import TRIPLES, Geometry
from ninedof.support.arguments import finite, shown
from ninedof.support.arrays import Floats
from ninedof.support.kept.files import finite_or_nan
from ninedof.support.units import unit_argument

MARK = "ninedof-mjcf-1"
TIMESTEP = 5e-4
# With h the time step and m the mass of a rod: a stiffness of 0.1 m / h^2 is stable where the integrator is explicit in
# positions (0.4 is the most), and a damping of 3 m / h brings a leg to rest in some 0.1 s without oscillation.
STIFFNESS, DAMPING = 0.1, 3.0
LAG = round(DAMPING / STIFFNESS * TIMESTEP, 6)  # kv / kp, s: at a steady rate a leg is behind its control by this time
SPIN_DECAY = 20.0  # 1/s: the free spin of a leg dies out in a twentieth of a second
PLATE = "0.62 0.66 0.70 0.55"


def text(model: Model, leg_mass: float | None = None, platform_mass: float | None = None, gravity: float = 0.0) -> str:
    """Return the MJCF text of a design; masses in kg, gravity in m/s² downward."""
    b, down, length = Bodies(model, leg_mass, platform_mass), finite("gravity", gravity), model.characteristic_length
    legs = {root: "".join(_leg(b, leg) for leg in b.legs if leg.root == root) for root in ("base", "platform")}
    slides = "\n      ".join(
        f'<joint name="O_{axis}" type="slide" axis="{numbers(direction)}" ref="{numbers(at)}"/>'
        for axis, direction, at in zip("xyz", np.eye(3), b.internal_point, strict=True)
    )
    ends = "\n    ".join(
        f'<connect name="{leg.name}_end" site1="{leg.name}_tip" site2="{leg.tip_joint}"/>' for leg in b.legs
    )
    return f"""<mujoco model={quoteattr(model.name)}>
  <!-- The nine-degree-of-freedom manipulator, written by ninedof. Lengths: {b.unit}; masses: kilograms.
       Controls are the lengths of the legs l1 l2 l3 q1 q2 q3 r1 r2 r3, their ranges the strokes. Start from the
       keyframe "neutral": without it MuJoCo sets all controls to zero. Under gravity the actuators give way.
       A leg lags behind its control by {LAG!r} s: to follow a path, control its length + {LAG!r} s * its rate. -->
  <compiler angle="radian" inertiafromgeom="false"/>
  <option timestep="{TIMESTEP!r}" integrator="implicitfast" solver="Newton" tolerance="1e-14"
    gravity="0 0 {numbers(-down) if down else 0}"/>
  <visual><global offwidth="1280" offheight="960"/></visual>
  <statistic center="{numbers(0.5 * b.position)}" extent="{numbers(_extent(b))}"/>
  <custom>
    <text name="format" data="{MARK}"/>
    <text name="unit" data="{model.unit or "none"}"/>
    <text name="characteristic_length" data="{length if isinstance(length, str) else repr(float(length))}"/>
  </custom>
  <default>
    <geom contype="0" conaffinity="0" group="1"/>
    <site size="{numbers(1.6 * b.radius)}" rgba="{COLOURS["joint"]}"/>
    <equality solref="{2 * TIMESTEP!r} 1" solimp="0.9999 0.9999"/>
  </default>
  <asset>
    {_plate("base", b.base, b.radius)}
    {_plate("platform", b.platform, b.radius)}
    <texture type="skybox" builtin="gradient" rgb1="1 1 1" rgb2="0.85 0.88 0.92" width="32" height="32"/>
  </asset>
  <worldbody>
    <light pos="{numbers([*b.position[:2], 3 * _extent(b)])}" dir="0 0 -1" castshadow="false"/>
    <geom name="base" type="mesh" mesh="base" rgba="{PLATE}"/>
    {_sites(b.base)}{legs["base"]}
    <body name="O" pos="{numbers(b.internal_point)}">
      {slides}
      {_inertial(b.point)}
      <geom name="O" type="sphere" size="{numbers(2.2 * b.radius)}" rgba="{COLOURS["joint"]}"/>
      <site name="O"/>
    </body>
    <body name="platform" pos="{numbers(b.position)}" xyaxes="{numbers(b.rotation[:, :2].T.ravel())}">
      <freejoint name="platform"/>
      {_inertial(b.plate)}
      <geom name="platform" type="mesh" mesh="platform" rgba="{PLATE}"/>
      <site name="platform" size="{numbers(0.2 * b.radius)}"/>{_tool(b)}
      {_sites(b.platform)}{legs["platform"]}
    </body>
  </worldbody>
  <equality>
    {ends}
  </equality>
  <actuator>
    {_actuators(b)}
  </actuator>
  <sensor>
    <framepos name="position" objtype="xbody" objname="platform"/>
    <framequat name="rotation" objtype="xbody" objname="platform"/>
    <framepos name="internal_point" objtype="xbody" objname="O"/>
  </sensor>
  <keyframe>
    <key name="neutral" ctrl="{numbers(leg.length for leg in b.legs)}"/>
  </keyframe>
</mujoco>
"""


def _leg(b: Bodies, leg: Leg) -> str:
    start, along = b.root_of(leg)
    cylinder, rod = b.part(leg, "cylinder"), b.part(leg, "rod")
    axial = 0.5 * (cylinder.inertia[2] + rod.inertia[2])
    colour, bright = COLOURS[leg.name[0]], COLOURS["rod"]
    return f"""
    <body name="{leg.name}_cylinder" pos="{numbers(start)}" zaxis="{numbers(along)}">
      <joint name="{leg.name}_ball" type="ball" damping="{numbers(SPIN_DECAY * axial)}"/>
      {_inertial(cylinder)}
      <geom type="cylinder" fromto="0 0 0 0 0 {numbers(leg.part)}" size="{numbers(1.5 * b.radius)}" rgba="{colour}"/>
      <body name="{leg.name}_rod" pos="0 0 {numbers(leg.length)}">
        <joint name="{leg.name}" type="slide" axis="0 0 1" ref="{numbers(leg.length)}"
          range="{numbers([leg.shortest, leg.longest])}" limited="true"/>
        {_inertial(rod)}
        <geom type="cylinder" fromto="0 0 0 0 0 {numbers(-leg.part)}" size="{numbers(b.radius)}" rgba="{bright}"/>
        <site name="{leg.name}_tip"/>
      </body>
    </body>"""


def _inertial(body: Inertial) -> str:
    full = any(body.inertia[3:])
    moments = f'{"fullinertia" if full else "diaginertia"}="{numbers(body.inertia[: 6 if full else 3])}"'
    return f'<inertial pos="{numbers(body.centre)}" mass="{numbers(body.mass)}" {moments}/>'


def _actuators(b: Bodies) -> str:
    kp, kv = STIFFNESS * b.masses.rod / TIMESTEP**2, DAMPING * b.masses.rod / TIMESTEP
    return "\n    ".join(
        f'<position name="{leg.name}" joint="{leg.name}" kp="{kp:.6g}" kv="{kv:.6g}" '
        f'ctrlrange="{numbers([leg.shortest, leg.longest])}" ctrllimited="true"/>'
        for leg in b.legs
    )


def _sites(joints: dict[str, Floats]) -> str:
    return "\n    ".join(f'<site name="{name}" pos="{numbers(at)}"/>' for name, at in joints.items())


def _tool(b: Bodies) -> str:
    """Return the frame of the tool as a site of the platform; nothing without one."""
    if not b.tool:
        return ""
    axes = numbers(b.tool.axes[:, :2].T.ravel())
    return f'\n      <site name="tool" pos="{numbers(b.tool.position)}" xyaxes="{axes}"/>'


def _plate(name: str, joints: dict[str, Floats], radius: float) -> str:
    """Return a plate as a mesh: MuJoCo takes the convex hull of the vertices."""
    thick = 0.5 * radius * np.array([0.0, 0.0, 1.0])
    corners = np.concatenate([[at - thick, at + thick] for at in joints.values()])
    return f'<mesh name="{name}" vertex="{numbers(corners.ravel())}"/>'


def _extent(b: Bodies) -> float:
    points = [*b.base.values(), b.position, b.internal_point]
    return float(np.ptp(points, axis=0).max())


def read(text: str) -> Fields:
    """Return the design of a file that `text` wrote, or that MuJoCo saved after reading such a file.

    The joints are the sites of base and platform, the neutral configuration is where the bodies "platform" and "O"
    stand; so a file whose sites were moved gives the design with the joints moved.
    """
    try:
        root = ElementTree.fromstring(text)  # noqa: S314 expat bounds what entities grow to, and reads no other file
    except (ElementTree.ParseError, ValueError) as error:
        raise ValueError(f"not an XML file: {error}") from None
    words = {item.get("name"): item.get("data", "") for item in root.iterfind("custom/text")}
    if root.tag != "mujoco" or words.get("format") != MARK:
        raise ValueError(f"got no {MARK!r} mark, expected an MJCF file written by `ninedof export --to mjcf`")
    unit = unit_argument("" if words.get("unit") == "none" else words.get("unit"))
    sites = {item.get("name"): item for item in root.iter("site")}
    bodies = {item.get("name"): item for item in root.iter("body")}
    joints = {name: np.array([_position(sites, f"{name}{i}") for i in (1, 2, 3)]) for name in TRIPLES}
    geometry = Geometry(**{name: from_metres(points, unit) for name, points in joints.items()})
    p, s = (from_metres(_position(bodies, name), unit) for name in ("platform", "O"))
    length: float | str = words.get("characteristic_length", "1.0")
    if not math.isnan(number := finite_or_nan(str(length))):
        length = number
    return geometry, Configuration(p, _rotation(bodies["platform"]), s), length_argument(length), unit


def _position(items: Mapping[str | None, ElementTree.Element], name: str) -> Floats:
    if name not in items:
        raise ValueError(f"got no body or site {name!r}, expected the file whole")
    return _numbers(items[name], "pos", 3, (0.0, 0.0, 0.0))


def _rotation(body: ElementTree.Element) -> Floats:
    """Return Q from its first two columns, as `text` writes it, or from a quaternion, as MuJoCo saves it."""
    if body.get("xyaxes") is not None:
        x, y = _numbers(body, "xyaxes", 6).reshape(2, 3)
        return np.stack([x, y, np.cross(x, y)], axis=-1)
    quaternion = _numbers(body, "quat", 4, (1.0, 0.0, 0.0, 0.0))
    if not quaternion.any():
        raise ValueError("platform: got a quaternion of length 0, expected a rotation")
    return np.asarray(from_quaternions(quaternion[None])[0])


def _numbers(item: ElementTree.Element, key: str, count: int, default: tuple[float, ...] | None = None) -> Floats:
    text = item.get(key)
    if text is None and default is not None:
        return np.array(default)
    try:
        return np.array([float(part) for part in (text or "").split()]).reshape(count)
    except ValueError:
        raise ValueError(f"{item.get('name')}: got {key}={shown(text)}, expected {count} numbers") from None


FORMAT = Format("mjcf", ".xml", "MuJoCo model with closed loops and nine actuators", text, read)
