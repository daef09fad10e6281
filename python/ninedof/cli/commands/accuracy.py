"""`ninedof accuracy`: what errors of legs and joints do to the pose."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np
import typer

from ninedof.cli.answer import Answer
from ninedof.cli.options import JOINT_ERROR, LEG_ERROR, Two
from ninedof.cli.posed import DesignAtPoses, PosesOptions, at_worst
from ninedof.design.duty import Tolerances
from ninedof.sheet.allotment import tolerances_for
from ninedof.statics.accuracy import DISTRIBUTIONS, MOST_SAMPLES, ErrorBounds, error_bounds, error_samples
from ninedof.support.arguments import choice, finite, whole
from ninedof.support.units import amount, unit_entry
from ninedof.tables import RIGHT, Column, Line, Table

PLACE = 4
EXAMPLES = """[bold]Examples[/bold]

  ninedof accuracy design.toml --leg-error 0.01 --joint-error 0.02

  ninedof accuracy runs/20260101-120000 --leg-error 0.01 --all-poses

  ninedof accuracy runs/20260101-120000 --within 0.1    which tolerances keep p within 0.1?

  ninedof accuracy runs/20260101-120000#7 --leg-error 0.01 --samples 10000 --json | jq .position"""

GROUPS = ("turn about", "p along", "O along")  # in the order of the components


@dataclass(frozen=True, kw_only=True)
class AccuracyOptions(PosesOptions):
    """The options."""

    leg_error: Annotated[float | None, LEG_ERROR] = None
    joint_error: Annotated[float | None, JOINT_ERROR] = None
    distribution: Annotated[
        str, typer.Option(help="Of the errors behind the standard deviation: uniform or normal (three sigma).")
    ] = DISTRIBUTIONS[0]
    within: Annotated[
        float | None, typer.Option(help="Largest displacement of p that is allowed: prints the tolerances for it.")
    ] = None
    within_deg: Annotated[float | None, typer.Option(help="The same of the angle the platform turns, degrees.")] = None
    weights: Annotated[
        Two, typer.Option(metavar="JOINTS LEGS", help="Parts of the allowed error that joints and legs may make.")
    ] = (1.0, 1.0)
    samples: Annotated[
        int | None, typer.Option(help="Random robots within the tolerances, without linearization, at one pose.")
    ] = None


def accuracy(options: AccuracyOptions) -> Answer:
    """Print the errors of platform and O for tolerances of legs and joints, worst case and standard deviation."""
    given = {"leg_error": options.leg_error, "joint_error": options.joint_error}
    for name, value in given.items():
        if value is not None:
            finite(f"--{name.replace('_', '-')}", value, 0.0)
    if options.samples is not None:
        whole("--samples", options.samples, 1, MOST_SAMPLES)
        if options.all_poses:
            raise ValueError("--samples: got it with --all-poses, expected one pose")
    at = DesignAtPoses.at(options)
    if options.within is not None or options.within_deg is not None:
        return _allotted(options, at)
    choice("--distribution", options.distribution, DISTRIBUTIONS)
    g, unit, duty = at.chosen.geometry, at.chosen.unit, at.chosen.duty.tolerances
    stated = {"leg_error": duty.legs, "joint_error": duty.joints}
    errors = {name: stated[name] if value is None else value for name, value in given.items()}
    if not any(errors.values()):
        raise ValueError("accuracy: got neither --leg-error nor --joint-error, expected a tolerance")
    bounds = error_bounds(g, at.c, errors["leg_error"], errors["joint_error"], options.distribution)
    rows = [(*row[:3], at.first(row[3])) if row else () for row in _rows(bounds, unit)]
    deviation = f"standard deviation\n({options.distribution} errors)"
    columns = [
        Column(),
        Column("largest", "", RIGHT),
        Column(deviation, "", RIGHT),
        Column("pose", "", "d"),
    ]
    if len(at.c) == 1:
        columns, rows = columns[:3], [row[:3] for row in rows]
    sizes = (f"{name.split('_')[0]}s {amount(f'{value:g}', unit)}" for name, value in errors.items())
    source = " of the study" * (None in given.values() and bool(duty != Tolerances()))
    parts: list[Any] = [f"tolerances{source}: {', '.join(sizes)}", Table("Errors of first order", columns, rows)]
    data: dict[str, Any] = errors | {
        "position": bounds.position,
        "rotation_deg": np.degrees(bounds.rotation),
        "internal_point": bounds.internal_point,
        "covariance": bounds.covariance,
    }
    if options.samples is not None:
        data["samples"] = _quantiles(
            error_samples(g, at.c[0], errors["leg_error"], errors["joint_error"], options.samples), unit
        )
        parts += data["samples"]["words"]
    return at.answer(parts, data, (row[3] for row in rows if len(row) > 3))


def _allotted(options: AccuracyOptions, at: DesignAtPoses) -> Answer:
    """Return the tolerances that keep the machine within an error, over the poses of its study."""
    for name in ("leg_error", "joint_error", "samples", "all_poses"):
        if getattr(options, name):
            raise ValueError(f"--{name.replace('_', '-')}: got it with --within, expected one of the two")
    if named := options.named():
        raise ValueError(f"{named[0]}: got it with --within, expected none: it is about all poses of the study")
    turn = None if options.within_deg is None else math.radians(options.within_deg)
    design, unit = at.chosen.result or at.chosen.design, at.chosen.unit
    kept = tolerances_for(design, options.within, turn, options.weights)
    rows = [Line("joint centres, radius", [f"{kept.joints:.4g}"], unit=unit)]
    rows += [Line("leg lengths, plus or minus", [f"{kept.legs:.4g}"], unit=unit)]
    limits = [] if options.within is None else [f"p errs by at most {amount(f'{options.within:g}', unit)}"]
    limits += [] if turn is None else [f"the platform turns by at most {options.within_deg:g}°"]
    study = at.chosen.study
    where = (
        "the neutral pose" if study is None else "the region" if study.objective.region else "the poses of the study"
    )
    title = f"Tolerances with which {' and '.join(limits)}, to first order, over {where}"
    return Answer([Table(title, [Column(), Column("", "", RIGHT)], rows)], unit_entry(unit) | kept.to_dict())


def _rows(bounds: ErrorBounds, unit: str) -> Iterator[tuple[Any, ...]]:
    """Yield the largest error of each component over the poses, its standard deviation there, and that pose."""
    deviation = np.sqrt(np.diagonal(bounds.covariance, axis1=-2, axis2=-1))
    for k in range(9):
        value, at = at_worst(bounds.components[:, k])
        texts = (_text(x, k < 3, unit) for x in (value, float(deviation[at, k])))
        yield f"{GROUPS[k // 3]} {'xyz'[k % 3]}", *texts, at
        if k % 3 == 2:
            yield ()
    names = {"turn": bounds.rotation, "displacement of p": bounds.position, "displacement of O": bounds.internal_point}
    for name, values in names.items():
        value, at = at_worst(values)
        yield f"any {name}", _text(value, name == "turn", unit), None, at


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
