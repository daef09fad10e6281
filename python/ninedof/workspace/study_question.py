"""The workspace that the result of a study asks for: its limits at a pose, the lengths its legs are built for, O."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ninedof import _core
from ninedof.design.duty import Tool
from ninedof.design.limit_numbers import CLEARANCE, LEGS, PARTS, SPREADS
from ninedof.design.region import Region
from ninedof.design.region_poses import places_o
from ninedof.design.study import Study
from ninedof.optimize.result import Candidate, Result
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.arrays import Floats
from ninedof.workspace.question import ROWS
from ninedof.workspace.region_share import EASE, leg_ranges_over

Ranges = tuple[tuple[float, float], ...]


class StudyQuestion(NamedTuple):
    """A workspace for `study_question`."""

    asked: dict[str, Any]
    """Arguments of `workspace`: criteria, box, rotation, rule for O."""
    left: tuple[str, ...]
    """Limits of the study that compare poses, where no lengths of the legs stand for them."""


def study_question(result: Result) -> StudyQuestion:
    """Return the positions that the best design reaches in its neutral orientation within the limits of its study.

    The same limits and the same rule for O as `ninedof workspace RUN` has; the box holds all that a home height
    reaches.
    """
    best: Candidate = result.best  # type: ignore[assignment]
    g, home, region = best.geometry, best.configuration, result.study.objective.region
    limits, others = study_limits(result.study, g, home)
    criteria, left = with_leg_limits(limits), tuple(name for name in others if name in SPREADS)
    if left:
        built = built_ranges(g, home, region, () if result.region is None else result.region.leg_ranges)
        if built is not None:
            criteria, left = narrowed(criteria, *built), ()
    asked = {
        "box": box_around(home, result.study.tool),
        "rotation": home.rotation,
        "criteria": criteria,
        "internal_point": rule_of_region(g, home, region),
        "characteristic_length": best.characteristic_length,
    }
    return StudyQuestion(asked, left)


def study_limits(study: Study, g: Geometry, home: Configuration) -> tuple[dict[str, Any], list[str]]:
    """Return the limits of a study that a pose alone can meet as criteria, and the names of the others.

    Ranges of leg lengths keep the names of their constraints; `with_leg_limits` makes leg limits of them. Limits in zp
    are taken at the height of the home pose. All are eased by `EASE` of themselves. Of a limit on the distance of legs
    only the pairs are exempt whose joints coincide in every design of the study.
    """
    criteria: dict[str, Any] = {}
    left: list[str] = []
    for limit in study.limits:
        name = limit.name
        if limit.at != "poses" or name not in PARTS:
            left.append(limit.label)
            continue
        unit = study.zp(home) if limit.of == "zp" else 1.0
        low, high = unit * limit.low * (1.0 - EASE), unit * limit.high * (1.0 + EASE)
        if name in LEGS:
            criteria[name] = (low, high)
        elif ROWS[name].kind == "sign":
            criteria[name] = True
        else:
            criterion = _criterion(name, low, high, limit.axis_in(study.tool))
            if criterion is None:  # a min of 0
                continue
            criteria[name] = criterion
            if name == CLEARANCE and (collide := _collisions(study, g)):
                exempt = [pair for pair in PARTS[name] if pair not in collide]
                criteria[name] = {"min": low, "exempt": exempt}
    if study.objective.condition_limit is not None:
        criteria["condition_number"] = study.objective.condition_limit * (1.0 + EASE)
    return criteria, left


def _criterion(name: str, low: float, high: float, axis: Sequence[float]) -> Any:
    """Return a limit at poses as a criterion: a number where that says all of it, None without a side that limits."""
    row = ROWS[name]
    ends = {"min": low, "max": min(high, math.pi) if row.is_angle else high}
    entries: dict[str, Any] = {side: ends[side] for side in row.sides if 0.0 < ends[side] < math.inf}
    if entries and axis:
        entries["axis"] = axis
    return entries if len(entries) > 1 else next(iter(entries.values()), None)


def _collisions(study: Study, g: Geometry) -> list[str]:
    """Return the pairs of legs whose joints coincide in this robot, and not in every design of a study."""
    here, always = _core.pairs_sharing_a_joint(g), study.problem().exempt_pairs()
    return [pair for pair, meet, exempt in zip(PARTS[CLEARANCE], here, always, strict=True) if meet and not exempt]


def with_leg_limits(limits: Mapping[str, Any]) -> dict[str, Any]:
    """Return criteria whose ranges of leg lengths are one entry, the first."""
    legs = leg_ranges({name: limits[name] for name in LEGS if name in limits})
    others = {name: value for name, value in limits.items() if name not in LEGS}
    return ({} if legs is None else {"leg_limits": legs}) | others


def leg_ranges(ranges: Mapping[str, tuple[float, float]]) -> tuple[Any, Any] | None:
    """Return the leg limits that all given ranges leave: two numbers where they are those of all nine legs.

    Raises
    ------
    ValueError
        If a range is empty by itself.

    """
    low, high = np.zeros(9), np.full(9, np.inf)
    for name, (least, most) in ranges.items():
        if not 0.0 <= least < most:
            raise ValueError(f"{name}: got {least:g} to {most:g}, expected 0 <= low < high")
        legs = LEGS[name]
        low[legs], high[legs] = np.maximum(low[legs], least), np.minimum(high[legs], most)
    if not low.any() and np.isinf(high).all():
        return None
    return (
        (float(low[0]), float(high[0])) if len({*zip(low.tolist(), high.tolist(), strict=True)}) == 1 else (low, high)
    )


def built_ranges(
    g: Geometry, home: Configuration, region: Region | None, ranges: Ranges
) -> tuple[Floats, Floats] | None:
    """Return the lengths for which the legs are built, where a study compares those of several poses; None if unknown.

    Over the region of the study, or from `ranges` where O is placed in it.
    """
    if region is not None and places_o(region):
        return leg_ranges_over(region, g, home)
    if not ranges:
        return None
    low, high = np.transpose(ranges)
    return low * (1.0 - EASE), high * (1.0 + EASE)


def narrowed(criteria: Mapping[str, Any], low: Floats, high: Floats) -> dict[str, Any]:
    """Return criteria with leg limits that are within a range too, before the others."""
    least, most = criteria.get("leg_limits", (0.0, math.inf))
    return {**criteria, "leg_limits": (np.maximum(least, low), np.minimum(most, high))}


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
