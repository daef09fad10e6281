"""`ninedof path`: the legs of a design along a trajectory, its table and its run folder."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

import ninedof as nd
from ninedof.cli.answer import Answer, finish_job
from ninedof.cli.options import (
    CENTRE,
    DESIGN_OR_PUBLISHED,
    GRAVITY,
    LC,
    LEG_LIMITS,
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
)
from ninedof.cli.posed import Chosen, named_design, with_length
from ninedof.cli.screen import DONE, NO_RESULT, bold
from ninedof.conditioning.characteristic_length import KINDS
from ninedof.design.limit_numbers import FORCES
from ninedof.motion.follow import wrenches_along
from ninedof.motion.tables import motion_tables, motion_words
from ninedof.records.motion import motion_values
from ninedof.records.record import run_folder, write_run
from ninedof.robot.configuration import arrays_of
from ninedof.robot.geometry import triples
from ninedof.sheet.pose_words import turn_deg, vector_words
from ninedof.sheet.request import Weight, masses_of, masses_words
from ninedof.sheet.tables import load_words, weight_words
from ninedof.support.kept.store import Store
from ninedof.support.units import amount, per, unit_entry

SLACK = 1e-6  # by which a speed may be passed, relative
SHAPES, TIMES = ("circle", "line", "spiral"), ("duration", "points")
EXAMPLES = """
  ninedof path design.toml path.csv --legs 2.5 6.5
  ninedof path runs/20260101-120000 path.csv              the limits of the run's study
  ninedof path design.toml --circle 0.5 --duration 2 --internal-point best
  ninedof path runs/20260101-120000 --line 30 0 20 --mass 5 --centre 0 0 20
  ninedof path --line 0.5 0 0.2 --force 0 0 -9.81 --json | jq .motion.legs.l1"""


@struct
class _Options(JobOptions):
    design: str | None = argument(DESIGN_OR_PUBLISHED, None)
    file: Path | None = argument(
        "Poses (CSV): columns t x y z (or x_rel y_rel z_rel, from the neutral pose), and for the rotation "
        "qw qx qy qz, rx ry rz (or rx_rel ry_rel rz_rel) or yaw pitch roll, in degrees as rx_deg, rx_rel_deg, yaw_deg, "
        "or Q11 to Q33; poses.csv of a run.",
        None,
    )
    circle: float | None = option("A horizontal circle about the neutral pose.", metavar="RADIUS")
    line: Three | None = triple("A line from the neutral pose, from rest to rest.")
    spiral: Two | None = option("Three turns outwards and up, from rest to rest.", metavar="RADIUS HEIGHT")
    duration: float | None = option("Of a circle, line or spiral; 1 by default.")
    points: int | None = option("Poses of a circle, line or spiral; 1001 by default.")
    internal_point: str | None = rule_for_o("carried")
    legs: Two | None = ends(LEG_LIMITS)
    force: Three | None = triple("Force on the platform at its origin.")
    moment: Three | None = triple("Moment on the platform.")
    mass: float | None = option("Mass of the platform, in place of that of the study: its weight and inertia act too.")
    centre: Three | None = triple(CENTRE)
    gravity: Three | None = triple(GRAVITY)
    lc: str | None = option(LC, values=KINDS)


def path(options: _Options) -> None:
    """Compute leg lengths, rates and accelerations along a path, and the limits that break.

    A run brings every limit of its study.
    """
    if options.file is None and options.design is not None and options.design.endswith(".csv"):
        options = replace(options, file=Path(options.design), design=None)
    chosen = with_length(named_design(options.design), options.lc)
    g, home, study = chosen.geometry, chosen.configuration, chosen.study
    trajectory = _trajectory(chosen, options)
    limits: Any = chosen.permitted_lengths if options.legs is None else options.legs
    rule = chosen.rule if options.internal_point is None else rule_option(options.internal_point)
    how: dict[str, Any] = {"internal_point": rule, "limits": limits}
    masses = masses_of(chosen.duty, options.mass, options.centre)
    gravity = chosen.duty.loads.gravity if options.gravity is None else options.gravity
    force, moment, stated = _load(options, chosen.duty)
    question = {
        "geometry": triples(g),
        "home": arrays_of(home),
        **unit_entry(chosen.unit),
        **chosen.stated,
        **how,
        **({"loads": chosen.duty.loads.wrenches} if stated else {"force": force, "moment": moment}),
        **({} if masses is None else {"masses": masses.to_dict(), "gravity": gravity}),
    }
    if options.file:
        question["file"] = str(options.file)
    else:
        question |= options.values_of(*SHAPES) | {"duration": trajectory.time[-1], "points": len(trajectory)}
    with run_folder(options.out) as directory, Store(directory, {"kind": "motion", **question}):
        duty: Any = {"load": (force, moment), "masses": masses, "gravity": gravity}
        result = nd.follow(g, trajectory, home, **how, characteristic_length=chosen.characteristic_length, **duty)
    of_study = nd.path_limits(study, result, home) if study else None
    result = result if of_study is None else replace(result, study_breaks=of_study.breaks)
    motion = motion_values(result, of_study)
    parts: list[Any] = [
        *motion_tables(motion),
        *chosen.tool.remark(chosen.unit),
        *chosen.duty.tolerances.remark(),
        *(bold(*words) for words in motion_words(result, motion)),
        *_turned(trajectory, home),
        *_faster(result, chosen.duty.speeds),
    ]
    if any(one.kind in (FORCES, "power") and one.at == "poses" for one in chosen.duty.limits):
        at = "of a point mass at the plate's origin, beside loads and masses"
        parts.append(f"{nd.payload_along(chosen.machine, result).words}; {at}")
    parts += _acting(result, masses, np.hstack([_rows(moment), _rows(force)]), chosen.tool)
    stated = [*stated, *masses_words(chosen.duty, options.mass)]
    parts += [f"from the study: {', '.join(stated)}"] if stated else []
    write = partial(write_run, result, directory, question=question, results={"motion": motion}, limits=of_study)
    answer = Answer(parts, {"motion": motion}, DONE if result.tracked and not motion["breaks"] else NO_RESULT)
    margins = _margins(result, of_study)
    finish_job(options, directory, answer, write, lambda: [("motion", nd.plot.motion(result, margins))])


def _trajectory(chosen: Chosen, options: _Options) -> nd.Trajectory:
    home, shapes = chosen.configuration, options.values_of(*SHAPES)
    names = [*(["a file"] if options.file else []), *(f"--{name}" for name in shapes)]
    if len(names) != 1:
        got = " and ".join(names) or "none"
        raise ValueError(f"path: got {got}, expected one of a CSV file, --circle, --line and --spiral")
    if options.file is not None:
        options.refuse("with a file: it has its own times", *TIMES)
        return nd.Trajectory.load(options.file, home, chosen.unit)
    ((name, value),) = shapes.items()
    trajectory: nd.Trajectory = getattr(nd.Trajectory, name)(
        home, *(value if name == "spiral" else (value,)), **options.values_of(*TIMES), unit=chosen.unit
    )
    return trajectory


def _load(options: _Options, duty: nd.Study) -> tuple[Any, Any, list[str]]:
    """Return force and moment of the options, or of each load of a study, and what the study states of them."""
    wrenches = duty.loads.wrenches
    if options.force is not None or options.moment is not None or not wrenches:
        return options.force, options.moment, []
    return *wrenches_along(wrenches), ["[loads]" if len(wrenches) == 1 else f"{len(wrenches)} loads of [loads]"]


def _turned(path: nd.Trajectory, home: nd.Configuration) -> Iterator[str]:
    """Yield a line where the neutral pose is turned and a path begins in another orientation: likely a mistake."""
    first = nd.Configuration(path.position[0], path.rotation[0], home.internal_point)
    turn = np.round(turn_deg(first, home.rotation), 4)
    if turn.any() and not np.allclose(home.rotation, np.eye(3)):
        words = "turns from it are columns rx_rel_deg ry_rel_deg rz_rel_deg of a file"
        yield f"the path begins turned {vector_words(turn)}° from the neutral pose; {words}"


def _faster(motion: nd.Followed, speeds: nd.Speeds) -> Iterator[Any]:
    """Yield a line for each speed of a study that a path passes: its limits of rates and powers are for that speed."""
    for name, k, most, shown, unit in (
        ("linear", 3, speeds.linear, 1.0, per(motion.unit, "s")),
        ("angular", 0, speeds.angular, math.degrees(1.0), "°/s"),
    ):
        size = float(np.linalg.norm(motion.velocity[:, k : k + 3], axis=1).max())
        if size > most * (1.0 + SLACK) and (speeds.linear > 0.0 or speeds.angular > 0.0):
            reached, stated = (amount(f"{shown * x:.4g}", unit) for x in (size, most))
            yield bold("faster than the study", f": {name} speed {reached}, [speeds] has {stated}")


def _rows(vectors: Any) -> Any:
    """Return forces or moments of several loads as rows; of one, one row; zeros for None."""
    return np.zeros((1, 3)) if vectors is None else np.asarray(vectors, float).reshape(-1, 3)


def _acting(motion: nd.Followed, masses: nd.Masses | None, loads: Any, tool: nd.Tool) -> Iterator[str]:
    """Yield a line on the loads and masses behind the forces."""
    unit, force_unit = motion.unit, motion.force_unit
    words = [load_words(k, row, unit, force_unit) for k, row in enumerate(loads, start=1) if row.any()]
    if masses is not None:
        own = Weight(masses.platform, masses.centre, motion.gravity) if masses.platform else None
        legs = any((masses.cylinder, masses.rod, masses.internal_point))
        words += [one.removeprefix("each with ") for one in weight_words(own, tool, legs, force_unit)]
        words += ["inertia too"]
    if words:
        yield f"acting: {'; '.join(words)}"


def _margins(result: nd.Followed, of_study: nd.PathLimits | None) -> dict[str, Any] | None:
    """Return the margins of a study's limits along the path, those of the legs first; None without a study."""
    if not of_study:
        return None
    margin = result.leg_margins.min(axis=1)  # infinite without limits
    return ({"leg lengths": margin} if np.isfinite(margin).all() else {}) | of_study.margins
