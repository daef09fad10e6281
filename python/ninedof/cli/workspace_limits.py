"""The limits and the rule for O of `ninedof workspace`: those of the run and its study, replaced by the options."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from ninedof.design.indices import LEGS as LEG_NAMES
from ninedof.design.region import Region
from ninedof.design.study import Study
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.sheet.pose_limits import SPREADS
from ninedof.support.arrays import Floats
from ninedof.support.units import amount
from ninedof.workspace.study_criteria import EASE, LEGS, leg_ranges, own_fraction, study_criteria

CONES = ("base_cone", "platform_cone")
KINDS = {"external": slice(0, 3), "upper internal": slice(3, 6), "lower internal": slice(6, 9)}


def criteria_asked(
    study: Study | None, zp: float, options: Mapping[str, Any]
) -> tuple[dict[str, Any], set[str], list[str]]:
    """Return criteria, the names of those that come from the study, and the limits of the study that are none.

    `options` holds a value for each constraint of leg lengths, each angle and each axis of a cone, and each other
    criterion; None leaves what the study has.
    """
    from_study, left = ({}, []) if study is None else study_criteria(study.constraints, zp)
    if study is not None and study.objective.condition_limit is not None:
        from_study["condition_number"] = study.objective.condition_limit * (1.0 + EASE)
    given = {name: value for name, value in options.items() if value is not None}
    found: dict[str, Any] = from_study | {name: value for name, value in given.items() if not name.endswith("_axis")}
    for cone in CONES:
        axis = given.get(f"{cone}_axis", _axis(from_study.get(cone)))
        if cone not in found:
            if axis is not None:
                raise ValueError(f"--{cone.replace('_', '-')}-axis: got an axis alone, expected the angle too")
        elif axis is not None:
            angle = found[cone]["max"] if isinstance(found[cone], Mapping) else found[cone]
            found[cone] = {"max": angle, "axis": axis}
    if found.get("singularity_free") is False:
        del found["singularity_free"]
    ranges = {name: found.pop(name) for name in LEGS if name in found}
    legs = leg_ranges(ranges)
    kept = {name for name in from_study if name not in given}
    own = {name for name in found if name in kept} | ({"leg_limits"} if ranges and set(ranges) <= kept else set())
    return ({} if legs is None else {"leg_limits": legs}) | found, own, left


def compare_poses(left: Sequence[str], options: Mapping[str, Any]) -> bool:
    """Return whether limits on the spread of lengths are left over and no lengths are given by options."""
    return any(name in SPREADS for name in left) and all(options[name] is None for name in LEGS)


def narrowed(criteria: Mapping[str, Any], low: Floats, high: Floats) -> dict[str, Any]:
    """Return criteria with leg limits that are within a range too, before the others."""
    least, most = criteria.get("leg_limits", (0.0, math.inf))
    return {**criteria, "leg_limits": (np.maximum(least, low), np.minimum(most, high))}


def rule_asked(
    text: str | None, geometry: Geometry, home: Configuration, region: Region | None, position: Any = None
) -> Any:
    """Return the rule for O: that of the option, of the region of a study, or where the design has O.

    `position` is the one position of a set of orientations, where a region that carries O leaves it at rest.
    """
    if text is not None and text not in ("best", "held", "carried"):
        try:
            return float(text)
        except ValueError:
            raise ValueError(f"--internal-point: got {text!r}, expected best, held, carried or a fraction") from None
    if text is None and region is not None:
        text = region.internal_point
        if text == "carried" and position is not None:
            return tuple((np.asarray(position) + home.internal_point - home.position).tolist())
    if text == "best":
        return text
    if text == "carried":
        return {"platform": tuple((home.rotation.T @ (home.internal_point - home.position)).tolist())}
    upper = home.position + home.rotation @ geometry.platform_internal.mean(axis=0)
    own = own_fraction(upper, geometry.base_internal.mean(axis=0), home.internal_point)
    return tuple(home.internal_point.tolist()) if text == "held" or own is None else own


def asked_lines(
    asked: Mapping[str, Any], home: Configuration, own: set[str], left: Sequence[str], unit: str = ""
) -> Iterator[str]:
    """Yield what is asked, a line for each part."""
    p, o = (amount(_point(point), unit) for point in (home.position, home.internal_point))
    yield f"home: p = {p}, O = {o}"
    yield f"O: {_rule_words(asked['internal_point'], unit)}"
    for name, value in asked["criteria"].items():
        whose = ", of the study" if name in own else ""
        for words in _criterion_words(name, value, unit):
            yield f"limit: {words}{whose}"
    if left:
        yield f"of the study, no limit of a single pose: {', '.join(left)}"
    if "box" in asked:
        low, high = asked["box"]
        yield f"box: p from {_point(low)} to {amount(_point(high), unit)}"
    if "position" in asked:
        yield f"position: p = {amount(_point(asked['position']), unit)}"
    if "region" in asked:
        yield "region: " + ", ".join(f"{name} to {math.degrees(a):.6g} degrees" for name, a in asked["region"].items())


def _rule_words(rule: Any, unit: str) -> str:
    if isinstance(rule, str):
        return "where the condition number is least, at each pose"
    if isinstance(rule, Mapping):
        return f"carried with the platform, at {_point(rule['platform'])} of its frame"
    if isinstance(rule, float):
        return f"at {rule:.4g} of the way from the lower to the upper internal joints"
    return f"stays at {amount(_point(rule), unit)}"


def _criterion_words(name: str, value: Any, unit: str) -> Iterator[str]:
    if name == "leg_limits":
        low, high = (np.broadcast_to(end, 9) for end in value)
        kinds = {"all": slice(0, 9)} if np.ptp(low) == 0.0 and len(set(high.tolist())) == 1 else KINDS
        if any(len(set(end[legs].tolist())) > 1 for end in (low, high) for legs in KINDS.values()):
            ranges = (f"{leg} {a:.6g} to {b:.6g}" for leg, a, b in zip(LEG_NAMES, low, high, strict=True))
            yield amount(f"legs as the region needs them: {', '.join(ranges)}", unit)
            return
        for kind, legs in kinds.items():
            least, most = float(low[legs][0]), float(high[legs][0])
            if least > 0.0 or math.isfinite(most):
                yield amount(f"{kind} legs {least:.6g} to {most:.6g}", unit)
    elif name in CONES:
        angle, axis = (value["max"], value["axis"]) if isinstance(value, Mapping) else (value, None)
        about = "each leg's direction at home" if axis is None else f"the axis {_point(axis)}"
        yield f"{name.replace('_', ' ')} {math.degrees(angle):.6g} degrees about {about}"
    elif name == "singularity_free":
        yield "connected with home, on its side of every singularity"
    else:
        side, of = ("at least", unit) if name == "leg_clearance" else ("at most", "")
        yield amount(f"{name.replace('_', ' ')} {side} {value:.6g}", of)


def _axis(cone: Any) -> Any:
    return cone.get("axis") if isinstance(cone, Mapping) else None


def _point(values: Sequence[float] | Floats) -> str:
    return "(" + ", ".join(f"{value:.6g}" for value in np.asarray(values, dtype=np.float64) + 0.0) + ")"
