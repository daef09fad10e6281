"""`ninedof accuracy`: what errors of legs and joints do to the pose."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from ninedof.cli.answer import Answer
from ninedof.cli.options import JOINT_ERROR, LEG_ERROR, Two, option, struct
from ninedof.cli.posed import POSE, DesignAtPoses, PosesOptions
from ninedof.sheet.allotment import tolerances_for
from ninedof.statics.accuracy import DISTRIBUTIONS, MOST_SAMPLES, ErrorBounds, error_bounds, error_samples
from ninedof.support.arguments import finite, whole
from ninedof.support.units import amount, unit_entry
from ninedof.tables import Line, Table, columns

EXAMPLES = """
  ninedof accuracy design.toml --leg-error 0.01 --joint-error 0.02
  ninedof accuracy runs/20260101-120000 --leg-error 0.01 --all-poses
  ninedof accuracy runs/20260101-120000 --within 0.1    which tolerances keep p within 0.1?
  ninedof accuracy runs/20260101-120000#7 --leg-error 0.01 --samples 10000 --json | jq .position"""

GROUPS = ("turn about", "p along", "O along")  # in the order of the components


@struct
class _Options(PosesOptions):
    leg_error: float | None = option(LEG_ERROR)
    joint_error: float | None = option(JOINT_ERROR)
    distribution: str = option(
        "Of the errors behind the standard deviation: uniform or normal (three sigma).",
        DISTRIBUTIONS[0],
        values=DISTRIBUTIONS,
    )
    within: float | None = option("Largest displacement of p that is allowed: prints the tolerances for it.")
    within_deg: float | None = option("The same of the angle the platform turns, degrees.")
    weights: Two = option(
        "Parts of the allowed error that joints and legs may make.", (1.0, 1.0), metavar="JOINTS LEGS"
    )
    samples: int | None = option("Random robots within the tolerances, without linearization, at one pose.")


def accuracy(options: _Options) -> Answer:
    """Print the errors of platform and O for tolerances of legs and joints, worst case and standard deviation."""
    if options.samples is not None:
        whole("--samples", options.samples, 1, MOST_SAMPLES)
        if options.all_poses:
            raise ValueError("--samples: got it with --all-poses, expected one pose")
    at = options.at()
    if options.within is not None or options.within_deg is not None:
        return _allotted(options, at)
    g, unit, duty = at.geometry, at.unit, at.duty.tolerances
    legs = duty.legs if options.leg_error is None else finite("--leg-error", options.leg_error, 0.0)
    joints = duty.joints if options.joint_error is None else finite("--joint-error", options.joint_error, 0.0)
    if not legs and not joints:
        raise ValueError("accuracy: got neither --leg-error nor --joint-error, expected a tolerance")
    bounds = error_bounds(g, at.c, legs, joints, options.distribution)
    rows = list(_rows(bounds, at))
    used = [row[3] for row in rows if row]
    heads = columns("", ">largest", f">standard deviation\n({options.distribution} errors)", ">pose")
    if len(at.c) == 1:
        heads, rows = heads[:3], [row[:3] for row in rows]
    sizes = {"legs": (legs, options.leg_error), "joints": (joints, options.joint_error)}
    words = (
        amount(f"{name} {size:g}", unit) + " of the study" * (option_value is None and size > 0.0)
        for name, (size, option_value) in sizes.items()
    )
    parts: list[Any] = [f"tolerances: {', '.join(words)}", Table("Errors of first order", heads, rows)]
    data: dict[str, Any] = {
        "leg_error": legs,
        "joint_error": joints,
        "position": bounds.position,
        "rotation_deg": np.degrees(bounds.rotation),
        "internal_point": bounds.internal_point,
        "covariance": bounds.covariance,
    }
    if options.samples is not None:
        data["samples"] = _quantiles(error_samples(g, at.c[0], legs, joints, options.samples), unit)
        parts += data["samples"]["words"]
    return at.answer(parts, data, used)


def _allotted(options: _Options, at: DesignAtPoses) -> Answer:
    """Return the tolerances that keep the machine within an error, over the poses of its study."""
    options.refuse("with --within: it asks for the tolerances", "leg_error", "joint_error")
    options.refuse("with --within: it is about all poses of the study", "samples", "all_poses", *POSE)
    turn = None if options.within_deg is None else math.radians(finite("--within-deg", options.within_deg, 0.0))
    design, unit = at.machine, at.unit
    tolerances = tolerances_for(design, options.within, turn, options.weights)
    rows = [
        Line("joint centres, radius", [f"{tolerances.joints:.4g}"], unit=unit),
        Line("leg lengths, plus or minus", [f"{tolerances.legs:.4g}"], unit=unit),
    ]
    limits = [] if options.within is None else [f"p errs by at most {amount(f'{options.within:g}', unit)}"]
    limits += [] if turn is None else [f"the platform turns by at most {options.within_deg:g}°"]
    study = at.study
    where = (
        "the neutral pose" if study is None else "the region" if study.objective.region else "the poses of the study"
    )
    title = f"Tolerances with which {' and '.join(limits)}, to first order, over {where}"
    notes = ["Both hold together: joints and legs may be off by so much at once."] * (
        min(tolerances.joints, tolerances.legs) > 0.0
    )
    return Answer([Table(title, columns("", ">"), rows, notes)], unit_entry(unit) | tolerances.to_dict())


def _rows(bounds: ErrorBounds, at: DesignAtPoses) -> Iterator[tuple[Any, ...]]:
    """Yield the largest error of each component over the poses, its standard deviation there, and that pose."""
    unit, deviation = at.unit, np.sqrt(np.diagonal(bounds.covariance, axis1=-2, axis2=-1))
    for k, values in enumerate(bounds.components.T):
        pose = int(np.argmax(values))
        texts = (_text(x, k < 3, unit) for x in (values[pose], deviation[pose, k]))
        yield f"{GROUPS[k // 3]} {'xyz'[k % 3]}", *texts, at.first(pose)
        if k % 3 == 2:
            yield ()
    names = {"turn": bounds.rotation, "displacement of p": bounds.position, "displacement of O": bounds.internal_point}
    for name, values in names.items():
        pose = int(np.argmax(values))
        yield f"any {name}", _text(values[pose], name == "turn", unit), None, at.first(pose)


def _text(value: float, angle: bool, unit: str) -> str:
    return f"{np.degrees(value):.4g}°" if angle else amount(f"{value:.4g}", unit)


def _quantiles(samples: Any, unit: str) -> dict[str, Any]:
    """Return how far 95 % of the random robots go, in numbers and in words."""
    reached = samples[~np.isnan(samples).any(axis=1)]
    lost = len(samples) - len(reached)
    turn, p, o = (
        float(np.quantile(np.linalg.norm(reached[:, k : k + 3], axis=1), 0.95)) if len(reached) else float("inf")
        for k in (0, 3, 6)
    )
    words = [
        f"95 % of {len(reached)} random robots: p within {_text(p, False, unit)}, turned less than "
        f"{_text(turn, True, unit)}, O within {_text(o, False, unit)}"
    ]
    words += [f"{lost} more did not reach a pose near this one"] if lost else []
    numbers = {"count": len(samples), "lost": lost, "rotation_deg": np.degrees(turn), "position": p}
    return numbers | {"internal_point": o, "words": words}
