"""URDF: the mechanism as a tree, for programs that know no closed loops, and the table of its loops beside it.

A spanning tree with 30 joints: each leg turns about two axes at its start and slides; leg l1 carries the platform on
three more axes, leg q1 carries O. The other seven legs hang free, and their ends are the loops: 21 scalar equations,
which leave the nine degrees of freedom. All joints at zero is the neutral configuration.
"""

from __future__ import annotations

from xml.sax.saxutils import quoteattr

from ninedof.export.bodies import COLOURS, LEG_MASS, PLATFORM_MASS, Bodies, Leg, bodies_of, numbers
from ninedof.export.model import Model
from ninedof.export.rpy import angles, pointing, rotation_of
from ninedof.export.urdf_parts import axis, plate, point, slide, strut
from ninedof.support.json import encode

TABLE = "loops.json"
MARK = "ninedof-loops-1"
CARRIERS = ("l1", "q1")
"""The legs that carry a body in the tree: the platform and O."""
CROSS = 0.02  # mass of the part between two axes of a joint, by that of a cylinder: programs refuse a mass of 0


def text(model: Model, leg_mass: float = LEG_MASS, platform_mass: float = PLATFORM_MASS) -> str:
    """Return the URDF text of a design; masses in kg."""
    b = bodies_of(model, leg_mass, platform_mass)
    unit = "metres" if model.unit else "the design's own, without a unit"
    legs = "".join(_leg(b, leg) for leg in b.legs)
    return f"""<?xml version="1.0"?>
<robot name={quoteattr(model.name)}>
  <!-- The nine-degree-of-freedom manipulator as a tree, written by ninedof. Lengths: {unit}; masses: kilograms.
       Its loops are in the file of the same name that ends in .{TABLE}: without them the legs hang free.
       All joints at zero is the neutral configuration; a slide reads the length of its leg less the neutral one. -->
  <mujoco><compiler fusestatic="false" discardvisual="false"/></mujoco>
{plate("base", b.base.values(), b.radius)}{legs}{_platform(b)}
{point("O", b.point_mass, 2.0 * b.radius)}
  <joint name="q1_O" type="fixed">
    <parent link="q1_rod"/>
    <child link="O"/>
  </joint>
</robot>
"""


def beside(model: Model) -> dict[str, str]:
    """Return the table of the loops, JSON."""
    b = bodies_of(model)
    legs = [
        {
            "name": leg.name,
            "joint": f"{leg.name}_slide",
            "length_at_zero": leg.length,
            "shortest": leg.shortest,
            "longest": leg.longest,
        }
        for leg in b.legs
    ]
    zero = [0.0, 0.0, 0.0]
    loops = [
        {
            "name": leg.name,
            "link_1": f"{leg.name}_rod",
            "point_1": zero,
            "link_2": leg.tip,
            "point_2": b.platform[leg.tip_joint] if leg.tip == "platform" else zero,
        }
        for leg in b.legs
        if leg.name not in CARRIERS
    ]
    table = {
        "format": MARK,
        "robot": model.name,
        "length_unit": "m" if model.unit else "",
        "meaning": "point_1 of link_1 and point_2 of link_2, each in the frame of its link, coincide",
        "loops": loops,
        "legs": legs,
    }
    return {TABLE: encode(table) + "\n"}


def _leg(b: Bodies, leg: Leg) -> str:
    """Return two axes across the leg, the cylinder, and the rod, whose frame is at its tip."""
    at, along = leg.start, leg.direction
    if leg.root == "platform":
        at, along = b.platform[leg.root_joint], along @ b.rotation
    n, across = leg.name, b.part_inertia(leg)
    return f"""
{axis(f"{n}_turn1", leg.root, f"{n}_cross", "1 0 0", at, pointing(along))}
{point(f"{n}_cross", CROSS * b.part_mass, b.radius)}
{axis(f"{n}_turn2", f"{n}_cross", f"{n}_cylinder", "0 1 0")}
{strut(f"{n}_cylinder", 0.5 * leg.part, leg.part, 1.5 * b.radius, b.part_mass, across, COLOURS[n[0]])}
{slide(f"{n}_slide", f"{n}_cylinder", f"{n}_rod", leg.length, leg.shortest - leg.length, leg.longest - leg.length)}
{strut(f"{n}_rod", -0.5 * leg.part, leg.part, b.radius, b.part_mass, across, COLOURS["rod"])}"""


def _platform(b: Bodies) -> str:
    """Return three axes of the platform at the tip of leg l1, the plate, and the frame of the platform at p."""
    first = b.platform["platform_external1"]
    turn = rotation_of(pointing(b.legs[0].direction)).T @ b.rotation  # the platform's axes, seen from the rod
    small = CROSS * b.part_mass
    return f"""
{axis("platform_turn1", "l1_rod", "platform_cross1", "1 0 0", (0.0, 0.0, 0.0), angles(turn))}
{point("platform_cross1", small, b.radius)}
{axis("platform_turn2", "platform_cross1", "platform_cross2", "0 1 0")}
{point("platform_cross2", small, b.radius)}
{axis("platform_turn3", "platform_cross2", "plate", "0 0 1")}
{plate("plate", [at - first for at in b.platform.values()], b.radius, -first, b.platform_mass, b.platform_inertia)}
  <joint name="platform_frame" type="fixed">
    <parent link="plate"/>
    <child link="platform"/>
    <origin xyz="{numbers(-first)}"/>
  </joint>
  <link name="platform"/>"""
