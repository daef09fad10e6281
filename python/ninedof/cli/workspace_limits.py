"""The limits and the rule for O of `ninedof workspace`: those of the run and its study, replaced by the options."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ninedof.design.leg_limits import SPREADS
from ninedof.design.limit_numbers import CONES
from ninedof.design.region import Region
from ninedof.design.study import Study
from ninedof.redundancy.rules import RULES
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.workspace.study_criteria import LEGS
from ninedof.workspace.study_question import rule_of_region, study_limits, with_leg_limits


def criteria_asked(
    study: Study | None, zp: float, options: Mapping[str, Any]
) -> tuple[dict[str, Any], set[str], list[str]]:
    """Return criteria, the names of those that come from the study, and the limits of the study that are none.

    `options` holds a value for each constraint of leg lengths, each angle and each axis of a cone, and each other
    criterion; None leaves what the study has.
    """
    from_study, left = ({}, []) if study is None else study_limits(study, zp)
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
    ranges = {name for name in LEGS if name in found}
    kept = {name for name in from_study if name not in given}
    own = {name for name in found if name in kept and name not in ranges} | (
        {"leg_limits"} if ranges and ranges <= kept else set()
    )
    return with_leg_limits(found), own, left


def compare_poses(left: Sequence[str], options: Mapping[str, Any]) -> bool:
    """Return whether limits on the spread of lengths are left over and no lengths are given by options."""
    return any(name in SPREADS for name in left) and all(options[name] is None for name in LEGS)


def rule_asked(
    text: str | None,
    geometry: Geometry,
    home: Configuration,
    region: Region | None,
    position: Any = None,
    turns: bool = False,
) -> Any:
    """Return the rule for O: that of the option, of the region of a study, or where the design has O.

    `position` is the one position of a set of orientations; `turns` says that there are sets of rotations at many,
    where O cannot be shifted: the rule of a region is then "carried".
    """
    if text is not None and text not in RULES:
        try:
            return float(text)
        except ValueError:
            raise ValueError(f"--internal-point: got {text!r}, expected {', '.join(RULES)} or a fraction") from None
    if text == "shifted" and turns:
        raise ValueError("--internal-point: got 'shifted' where the platform turns as it moves, expected another rule")
    return rule_of_region(geometry, home, region, text, position)


def _axis(cone: Any) -> Any:
    return cone.get("axis") if isinstance(cone, Mapping) else None
