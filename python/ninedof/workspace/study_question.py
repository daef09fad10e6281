"""The workspace that a result asks for: limits at a pose, lengths of its legs, O, and a box about its region."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from ninedof import _core
from ninedof.conditioning.characteristic_length import length_at
from ninedof.design.domains.region import Region, extent
from ninedof.design.domains.region_poses import o_is_placed
from ninedof.design.limit_numbers import CLEARANCE, CONES, PARTS, SPREADS, exempt_pairs
from ninedof.design.limits import OF_LENGTHS
from ninedof.design.study import Study
from ninedof.design.tool import Tool
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.robot.configuration import Configuration
from ninedof.robot.designs import HasRobot, robot_of
from ninedof.robot.geometry import Geometry
from ninedof.sheet.sheet import sheet
from ninedof.support.arrays import Floats
from ninedof.support.structs import Fixed
from ninedof.workspace.question import DEFAULTS, LEG_LIMITS, criteria_of

EASE = 1e-9
"""Share by which limits are eased: an optimum lies on some of them, and rounding would put its home pose outside."""
COUNT = 10_000  # even poses, and as many toward the boundary
ROOM = 2.0  # about the region in the box of a map, in its largest half edge


def region_share(
    region: Region, g: Geometry, home: Configuration, criteria: Mapping[str, Any], characteristic_length: float
) -> _core.RegionShare:
    """Return how much of a region keeps the criteria of a workspace, with its tilts, O as the region has it.

    The share is of even poses; as many are drawn toward the boundary. `passed` are the criteria that any pose passes.
    """
    question = _core.WorkspaceQuestion(g, home=home, criteria=criteria_of(criteria, characteristic_length))
    return _core.region_share(question, region.for_core(), COUNT)


def leg_ranges_over(region: Region, g: Geometry, home: Configuration) -> tuple[Floats, Floats]:
    """Return the shortest and longest length of each leg over a region, shapes (9,): of the legs that are built for it.

    Eased by `EASE` of themselves.
    """
    return _eased(*_core.leg_lengths_over(g, home, region.for_core(), 2 * COUNT))


def box_about(region: Region, home: Configuration) -> tuple[Floats, Floats]:
    """Return the low and high corner of a box about the positions of a region, with room on every side."""
    low, high = extent(region, home)
    room = ROOM * 0.5 * float((high - low).max())
    return low - room, high + room


ACTUATOR_WORDS = {
    "permitted": "workspace of the actuators that the study permits: ranges about the lengths its poses need",
    "needed": "workspace of the lengths that the poses of the study need",
}
ACTUATORS = tuple(ACTUATOR_WORDS)


def design_question(design: HasRobot, archetype: str = "constant_orientation") -> tuple[dict[str, Any], list[str]]:
    """Return the arguments of `workspace` that a design brings: the limits of its study too, and its rule for O.

    As `ninedof workspace RUN` has them; positions have a box about its region, or one that holds all that a home height
    reaches, "orientation" has the home position. Beside them the limits of the study that no single pose can meet.
    """
    g, home, length = robot_of(design), design.configuration, design.characteristic_length
    study: Study | None = getattr(design, "study", None)
    region, of = None if study is None else study.objective.region, study or design
    arguments = {
        **place_of(home, region, getattr(of, "tool", Tool()), archetype),
        "internal_point": rule_of_region(g, home, region),
        "home": home,
        "characteristic_length": length_at(g, home, length),
        "unit": getattr(of, "unit", "") or None,
    }
    if study is None:
        return arguments, []
    of_study = study_criteria(design)
    return arguments | {"criteria": of_study.criteria}, of_study.left


def robot_and_arguments(design: Geometry | HasRobot, arguments: Mapping[str, Any]) -> tuple[Geometry, dict[str, Any]]:
    """Return the geometry, and the arguments; in place of those that are None what a design has, or a robot alone."""
    own: dict[str, Any] = dict(DEFAULTS)
    if not isinstance(design, Geometry):
        own |= design_question(design, arguments["archetype"])[0]
        design = robot_of(design)
    return design, {**arguments, **{name: value for name, value in own.items() if arguments.get(name) is None}}


def place_of(home: Configuration, region: Region | None, tool: Tool, archetype: str) -> dict[str, Any]:
    """Return the box, about a region or home, or the fixed position and rotation, of an archetype."""
    if archetype == "orientation":
        return {"position": home.position, "rotation": home.rotation}
    turns_alone = region is None or not max(region.reach[:3]) > 0.0
    box = {"box": box_around(home, tool) if region is None or turns_alone else box_about(region, home)}
    return box | ({"rotation": home.rotation} if archetype == "constant_orientation" else {})


class StudyCriteria(NamedTuple):
    """Criteria of a workspace."""

    criteria: dict[str, Any]
    own: set[str]
    """Names of those that come from the study."""
    left: list[str]
    """Limits of the study that are no criteria of a pose."""
    actuators: str
    """The lengths of the legs that a study compares, in words; "" without such."""
    replaced: list[str]
    """Limits of the study in whose place others count."""


def study_criteria(
    design: Any = None, values: Mapping[str, Any] = Fixed(), actuators: str = ACTUATORS[0]
) -> StudyCriteria:
    """Return the criteria of the study of a design, and of values that count instead.

    `values` are of constraints of leg lengths, angles and axes of cones, and of other criteria; one of all legs or of
    all joints of a body counts instead of those of each kind too. Where they say nothing of lengths and the study
    compares those of several poses, the legs are built for them: see `built_ranges`.
    """
    from_study: dict[str, Any] = {}
    left: list[str] = []
    if design is not None and design.geometry is not None:
        from_study, left = study_limits(design.study, design.geometry, design.configuration)
    replaced = [name for name in from_study if any(_covers(other, name) for other in values)]
    unchanged = from_study.keys() - replaced
    criteria = {name: x for name, x in from_study.items() if name in unchanged}
    criteria |= {name: value for name, value in values.items() if not name.endswith("_axis")}
    for cone in CONES:
        axis = values.get(f"{cone}_axis", _option(from_study.get(cone), "axis"))
        if axis is None:
            continue
        if cone not in criteria:
            raise ValueError(f"{cone}_axis: got an axis alone, expected the angle too")
        criteria[cone] = {"max": _option(criteria[cone], "max", criteria[cone]), "axis": axis}
    criteria = {name: value for name, value in criteria.items() if value is not False}
    ranges = OF_LENGTHS.keys() & criteria
    own = {name for name in unchanged - ranges if name in criteria}
    own |= {LEG_LIMITS} if ranges and ranges <= unchanged else set()
    legs = leg_ranges({name: criteria[name] for name in OF_LENGTHS if name in criteria})
    others = {name: value for name, value in criteria.items() if name not in OF_LENGTHS}
    criteria = others if legs is None else {LEG_LIMITS: legs} | others
    compares = any(name in SPREADS for name in left) and OF_LENGTHS.keys().isdisjoint(values)
    if not compares or (built := built_ranges(design, actuators)) is None:
        return StudyCriteria(criteria, own, left, "", replaced)
    least, most = criteria.get(LEG_LIMITS, (0.0, math.inf))
    criteria[LEG_LIMITS] = (np.maximum(least, built[0]), np.minimum(most, built[1]))
    left = [name for name in left if name not in SPREADS]
    return StudyCriteria(criteria, own - {LEG_LIMITS}, left, ACTUATOR_WORDS[actuators], replaced)


def _covers(one: str, other: str) -> bool:
    """Whether a limit is about all that another one is about: `base_cone` covers `base_cone_external`."""
    if other in OF_LENGTHS:
        return set(OF_LENGTHS.get(one, ())) >= set(OF_LENGTHS[other])
    return one == other or (other in CONES and other.startswith(f"{one}_"))


def _option(criterion: Any, name: str, otherwise: Any = None) -> Any:
    return criterion.get(name) if isinstance(criterion, Mapping) else otherwise


def study_limits(study: Study, g: Geometry, home: Configuration) -> tuple[dict[str, Any], list[str]]:
    """Return the limits of a study that a pose alone can meet as criteria, and the names of the others.

    Ranges of leg lengths keep the names of their constraints; `leg_ranges` makes leg limits of them. Limits in zp
    are taken at the height of the home pose. All are eased by `EASE` of themselves. Of a limit on the distance of legs
    only the pairs are exempt whose joints coincide in every design of the study.
    """
    criteria: dict[str, Any] = {}
    left: list[str] = []
    for limit in study.limits:
        name, row = limit.name, limit.row
        if limit.at != "poses" or name not in PARTS:
            left.append(limit.label)
            continue
        unit = study.zp(home) if limit.of == "zp" else 1.0
        low, high = unit * limit.low * (1.0 - EASE), unit * limit.high * (1.0 + EASE)
        ends = {"min": low, "max": min(high, math.pi) if row.is_angle else high}
        entries: dict[str, Any] = {side: ends[side] for side in row.sides if 0.0 < ends[side] < math.inf}
        if name in OF_LENGTHS or row.kind == "sign":
            criteria[name] = (low, high) if name in OF_LENGTHS else True
        elif entries:  # not a min of 0
            if axis := limit.axis_in(study.tool):
                entries["axis"] = axis
            if row.needs:
                entries["duty"] = study.leg_duty.to_dict()
            if name == CLEARANCE:
                pairs = zip(PARTS[name], exempt_pairs(g), exempt_pairs(g, study), strict=True)
                exempt = [pair for pair, meet, always in pairs if always or not meet]
                if len(exempt) < len(PARTS[name]):  # joints coincide that do not in every design of the study
                    entries["exempt"] = exempt
            criteria[name] = entries if len(entries) > 1 else next(iter(entries.values()))
    if study.objective.condition_limit is not None:
        criteria["condition_number"] = study.objective.condition_limit * (1.0 + EASE)
    return criteria, left


def leg_ranges(ranges: Mapping[str, tuple[float, float]]) -> tuple[Any, Any] | None:
    """Return the leg limits that all given ranges leave: two numbers where they are those of all nine legs."""
    low, high = np.zeros(9), np.full(9, np.inf)
    for name, (least, most) in ranges.items():
        if not 0.0 <= least < most:
            raise ValueError(f"{name}: got {least:g} to {most:g}, expected 0 <= low < high")
        legs = OF_LENGTHS[name]
        low[legs], high[legs] = np.maximum(low[legs], least), np.minimum(high[legs], most)
    if not low.any() and np.isinf(high).all():
        return None
    alike = (low == low[0]).all() and (high == high[0]).all()
    return (float(low[0]), float(high[0])) if alike else (low, high)


def built_ranges(design: Any, actuators: str) -> tuple[Floats, Floats] | None:
    """Return the lengths for which the legs are built, where a study compares those of several poses; None if unknown.

    "needed": the lengths that the poses of the study need, over its region all of it. "permitted": the ranges about
    them that its limits on strokes and ratios leave, so as long as the study lets an actuator be.
    """
    study: Study = design.study
    region, listed = study.objective.region, len(study.objective.poses)
    if o_is_placed(study):
        over = getattr(design, "region", None)
        ranges = () if over is None else over.leg_ranges
        if over is not None and actuators == "needed":
            ranges = tuple((leg.shortest, leg.longest) for leg in sheet(design).legs)
        return _eased(*np.transpose(ranges)) if ranges else None
    lengths = leg_lengths(design.geometry, design.configurations[slice(1, 1 + listed) if listed else slice(1)])
    if region is not None:
        over = leg_ranges_over(region, design.geometry, design.configuration)
        lengths = np.concatenate([over, lengths[:listed]])
    if actuators == "needed":
        return _eased(lengths.min(axis=0), lengths.max(axis=0))
    return _eased(*permitted_ranges(study, design.configuration, lengths))


def permitted_ranges(study: Study, home: Configuration, lengths: Floats) -> tuple[Floats, Floats]:
    """Return the ranges about lengths at poses, shape (n, 9), that the limits of a study which compare them leave."""
    permitted = _core.permitted_range(study.problem(), study.zp(home), lengths)
    return permitted.low, permitted.high


def _eased(low: Floats, high: Floats) -> tuple[Floats, Floats]:
    return low * (1.0 - EASE), high * (1.0 + EASE)


def rule_of_region(
    geometry: Geometry, home: Configuration, region: Region | None, rule: str | None = None, position: Any = None
) -> Any:
    """Return a rule for O as `workspace` takes it, by default that of a region, else where the design has O.

    `position` is the one position of a set of orientations: there "shifted" is a point of the base. Without turns it
    is a point of the platform, and the same as "carried".
    """
    if rule is None and region is not None:
        rule = region.internal_point
    if rule == "shifted" and position is not None:
        return tuple((np.asarray(position) + home.internal_point - home.position).tolist())
    if rule == "best":
        return rule
    if rule in ("carried", "shifted"):
        return {"platform": tuple((home.rotation.T @ (home.internal_point - home.position)).tolist())}
    upper = home.position + home.rotation @ geometry.platform_internal.mean(axis=0)
    own = own_fraction(upper, geometry.base_internal.mean(axis=0), home.internal_point)
    return tuple(home.internal_point.tolist()) if rule == "held" or own is None else own


def own_fraction(upper: Floats, lower: Floats, point: Floats) -> float | None:
    """Return how far between the centroids of the lower and the upper internal joints a point lies, None if beside.

    zs / zp for plates whose internal joints are in the planes z = 0 and z = zp.
    """
    line, arm = upper - lower, point - lower
    square = float(line @ line)
    if not square > 0.0:
        return None
    fraction = float(arm @ line) / square
    return fraction if float(np.linalg.norm(arm - fraction * line)) <= 1e-9 * math.sqrt(square) else None


def box_around(home: Configuration, tool: Tool) -> tuple[Floats, Floats]:
    """Return a box about the home position, as far to each side as the plate is from the base."""
    reach = max(float(np.linalg.norm(tool.plate(home).position)), 1e-300)
    return home.position - reach, home.position + reach
