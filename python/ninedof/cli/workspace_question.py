"""The options of `ninedof workspace`, and the question they ask of a design and the study of its run."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any

import ninedof as nd
from ninedof.cli.options import (
    DESIGN_OR_PUBLISHED,
    LC,
    THREADS,
    JobOptions,
    Three,
    Two,
    argument,
    ends,
    option,
    rule_for_o,
    rule_option,
    struct,
    triple,
    typed,
)
from ninedof.cli.posed import Chosen, length_at_home
from ninedof.conditioning.characteristic_length import KINDS
from ninedof.design.indices import computed
from ninedof.design.limits import OF_LENGTHS
from ninedof.support.arguments import choice, finite
from ninedof.support.units import DEG, plain_name, unit_entry
from ninedof.workspace.certified import GAPS, require_certifiable
from ninedof.workspace.question import ARCHETYPES, CRITERIA
from ninedof.workspace.search import METHODS
from ninedof.workspace.study_question import ACTUATORS, StudyCriteria, place_of, rule_of_region, study_criteria


@struct
class WorkspaceOptions(JobOptions):
    """The options of `ninedof workspace`."""

    design: str | None = argument(DESIGN_OR_PUBLISHED, None)
    archetype: str = option(
        "constant_orientation, orientation, reachable, inclusive or dexterous.",
        "constant_orientation",
        values=ARCHETYPES,
    )
    x: Two | None = ends()
    y: Two | None = ends()
    z: Two | None = ends()
    leg_length: Two | None = ends("Limits of all nine legs; HIGH may be inf.", "--legs")
    external_length: Two | None = ends("Of the external legs, besides.", "--external")
    upper_length: Two | None = ends("Of the upper internal legs, besides.", "--upper")
    lower_length: Two | None = ends("Of the lower internal legs, besides.", "--lower")
    condition_number: float | None = option("Greatest condition number.", None, "--condition")
    base_cone_deg: float | None = option("Greatest angle at a base joint from home.")
    platform_cone_deg: float | None = option("The same at a platform joint.")
    base_cone_axis: Three | None = triple("Axis of the cones of the base, in place of the legs at home.")
    platform_cone_axis: Three | None = triple("The same at the platform, in the frame of the plate.")
    leg_clearance: float | None = option("Least distance of legs that share no joint.", None, "--clearance")
    singularity_free: bool | None = option(
        "Connected with home, on its side of every singularity.", None, "--singularity-free/--any-singularity"
    )
    study_limits: bool = option("Take the limits of the run's study.", True, "--study-limits/--no-study-limits")
    actuators: str = option(
        "Legs of a study that compares lengths: permitted (as long as its limits leave them), or needed (as "
        "its poses need them).",
        ACTUATORS[0],
        values=ACTUATORS,
    )
    angle_deg: float | None = option("Region: rotations of at most this angle.")
    tilt_deg: float | None = option("Region: tilts of at most this angle.")
    torsion_deg: float | None = option("Region: torsions of at most this angle.")
    orientations: int | None = option("Number of rotations of a set.")
    position: Three | None = triple("Position of the platform, for orientation; the home position by default.")
    internal_point: str | None = rule_for_o("the design's")
    lc: str | None = option(LC, values=KINDS)
    method: str = option("octree, grid or sample.", "octree", values=METHODS)
    tolerance: float = option("Wanted error, as a share of the volume.", 1e-3)
    resolution: int | None = option("Cells along each side before any is divided.")
    points: int | None = option("Poses of the audit, or of each shift of a sample.")
    seed: int | None = option("Of the audit and of a sample; 0 by default.")
    index: list[str] | None = option(
        f"An index over the workspace, may be repeated: {', '.join(computed())}.", values=computed()
    )
    certify: bool = option("Prove bounds of the volume, and boxes where every pose is allowed.", False, "--certify")
    gap: float | None = option("Of the bounds, relative to the upper one; 0.05 by default.")
    time: float | None = option("Seconds for the proof; 60 by default.")
    threads: int | None = option(THREADS)


@dataclass(frozen=True)
class Question:
    """A question for `nd.workspace`."""

    keywords: dict[str, Any]
    """Keywords of `nd.workspace`."""
    criteria: StudyCriteria
    """The criteria, and where they are from."""
    region: nd.Region | None
    """The region of the study."""
    proof: dict[str, Any] | None
    """Gap and time of the proof; None without one."""


def question_of(options: WorkspaceOptions, chosen: Chosen) -> Question:
    """Return the question that options ask of a design."""
    study, home = chosen.study, chosen.configuration
    region = None if study is None else study.objective.region
    names = (one.name for one in fields(options))
    limits_of = [n for n in names if plain_name(n) in (*OF_LENGTHS, *CRITERIA) or n.endswith("_axis")]
    numbers = options.values_of(*limits_of).items()
    values = {plain_name(name): _radians(name, x) if name.endswith(DEG) else x for name, x in numbers}
    if (axis := options.platform_cone_axis) is not None:
        values["platform_cone_axis"] = chosen.tool.turned(axis)
    choice("--actuators", options.actuators, ACTUATORS)
    limits = study_criteria(chosen.result if options.study_limits else None, values, options.actuators)
    if not limits.criteria:
        raise ValueError("workspace: got no criterion, expected at least one of --legs, --condition, --clearance, ...")
    if options.method == "grid":
        options.refuse("with --method grid", "points", "seed")
    of_angles = options.archetype == "orientation"
    at = None if not of_angles else home.position if options.position is None else options.position
    turns = options.archetype not in ("constant_orientation", "orientation")
    bounds = options.values_of("angle_deg", "tilt_deg", "torsion_deg")
    keywords: dict[str, Any] = {
        "archetype": options.archetype,
        "criteria": limits.criteria,
        "characteristic_length": length_at_home(chosen),
        "internal_point": _rule(options.internal_point, chosen, region, at, turns),
        "method": options.method,
        "tolerance": options.tolerance,
        **options.values_of("orientations", "resolution", "points", "seed", "index"),
        **unit_entry(chosen.unit),
    }
    if bounds:
        keywords["region"] = {plain_name(name): _radians(name, value) for name, value in bounds.items()}
    proof = _proof(options, keywords["internal_point"])
    place = place_of(home, region, chosen.duty.tool, options.archetype)
    return Question(keywords | place | _changed_place(options, place), limits, region, proof)


def _rule(text: str | None, chosen: Chosen, region: nd.Region | None, position: Any, turns: bool) -> Any:
    """Return the rule for O: that of the option, of the region of a study, or where the design has O.

    `position` is the one position of a set of orientations; `turns` says that there are sets of rotations at many,
    where O cannot be shifted: the rule of a region is then "carried".
    """
    rule = None if text is None else rule_option(text)
    if rule == "shifted" and turns:
        raise ValueError("--internal-point: got 'shifted' where the platform turns as it moves, expected another rule")
    if isinstance(rule, float):
        return rule
    return rule_of_region(chosen.geometry, chosen.configuration, region, rule, position)


def _changed_place(options: WorkspaceOptions, place: Mapping[str, Any]) -> dict[str, Any]:
    """Return the box or the position with what options say of it."""
    ends = [options.x, options.y, options.z]
    if "position" in place:
        if any(end is not None for end in ends):
            raise ValueError("workspace: got a box, expected none for orientations at one position")
        return options.values_of("position")
    options.refuse("but for --archetype orientation", "position")
    around = [own if end is None else end for own, end in zip(zip(*place["box"], strict=True), ends, strict=True)]
    return {"box": tuple(zip(*around, strict=True))}


def _proof(options: WorkspaceOptions, rule: Any) -> dict[str, Any] | None:
    """Return gap and time of the proof; None where none is wanted."""
    settings = options.values_of("gap", "time")
    if not options.certify:
        options.refuse("without --certify", *settings)
        return None
    require_certifiable(options.archetype, rule)
    finite("--gap", settings.get("gap", 0.5), *GAPS)
    finite("--time", settings.get("time", 0.0), 0.0)
    return {"time_limit" if name == "time" else name: value for name, value in settings.items()}


def _radians(name: str, degrees: float) -> float:
    return math.radians(finite(typed(name), degrees, 0.0, 180.0))
