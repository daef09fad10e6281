"""The workspace that the result of a study asks for: its limits at a pose, the lengths its legs are built for, O."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from ninedof.design.leg_limits import SPREADS
from ninedof.design.region import Region
from ninedof.design.region_stack import places_o
from ninedof.design.study import Study
from ninedof.optimize.result import Candidate, Result
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.arrays import Floats
from ninedof.workspace.region_share import leg_ranges_over
from ninedof.workspace.study_criteria import EASE, LEGS, leg_ranges, own_fraction, study_criteria

Ranges = tuple[tuple[float, float], ...]


class StudyQuestion(NamedTuple):
    """What `study_question` returns."""

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
    found, others = study_limits(result.study, float(home.position[2]))
    criteria, left = with_leg_limits(found), tuple(name for name in others if name in SPREADS)
    if left:
        built = built_ranges(g, home, region, () if result.region is None else result.region.leg_ranges)
        if built is not None:
            criteria, left = narrowed(criteria, *built), ()
    asked = {
        "box": box_around(home),
        "rotation": home.rotation,
        "criteria": criteria,
        "internal_point": rule_of_region(g, home, region),
        "characteristic_length": best.characteristic_length,
    }
    return StudyQuestion(asked, left)


def study_limits(study: Study, zp: float) -> tuple[dict[str, Any], list[str]]:
    """Return `study_criteria` of a study, the limit of its condition number among them."""
    found, left = study_criteria(study.limits, zp)
    if study.objective.condition_limit is not None:
        found["condition_number"] = study.objective.condition_limit * (1.0 + EASE)
    return found, left


def with_leg_limits(found: Mapping[str, Any]) -> dict[str, Any]:
    """Return criteria whose ranges of leg lengths are one entry, the first."""
    legs = leg_ranges({name: found[name] for name in LEGS if name in found})
    others = {name: value for name, value in found.items() if name not in LEGS}
    return ({} if legs is None else {"leg_limits": legs}) | others


def built_ranges(
    g: Geometry, home: Configuration, region: Region | None, given: Ranges
) -> tuple[Floats, Floats] | None:
    """Return the lengths for which the legs are built, where a study compares those of several poses; None if unknown.

    Over the region of the study, or as `given` where O is placed in it.
    """
    if region is not None and places_o(region):
        return leg_ranges_over(region, g, home)
    if not given:
        return None
    low, high = np.transpose(given)
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


def box_around(home: Configuration) -> tuple[Floats, Floats]:
    """Return a box about the home position, as far to each side as that is from the base."""
    reach = max(float(np.linalg.norm(home.position)), 1e-300)
    return home.position - reach, home.position + reach
