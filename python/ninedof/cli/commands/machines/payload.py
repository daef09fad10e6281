"""`ninedof payload`: the largest payload for given leg forces."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from ninedof.cli.answer import Answer
from ninedof.cli.options import LOAD, ONE_DESIGN, Options, Three, argument, loads_option, option, struct, triple
from ninedof.cli.posed import Chosen, named_design, searching
from ninedof.cli.screen import DONE, NO_RESULT
from ninedof.robot.geometry import LEGS
from ninedof.sheet.payload import Payload, largest_payload
from ninedof.sheet.pose_words import gravity_words, vector_words
from ninedof.sheet.request import masses_of
from ninedof.sheet.tables import load_words
from ninedof.support.arguments import Vector
from ninedof.support.units import amount, with_unit
from ninedof.tables import Table, columns, grouped
from ninedof.tables.numbers import load_text

EXAMPLES = """
  ninedof payload runs/20260101-120000    by the limit of force of its study
  ninedof payload runs/20260101-120000 --force 500
  ninedof payload runs/20260101-120000 --force 500 --pull 200 --centre 0 0 40 --json | jq .mass"""


@struct
class _Options(Options):
    design: str = argument(ONE_DESIGN)
    force: float | None = option(
        "Greatest force of each leg that pushes, and without --pull of one that pulls; in N for a payload in kg. The "
        "limits of the study by default."
    )
    pull: float | None = option("Greatest force of each leg that pulls; --force by default.")
    centre: Three | None = triple("Of the payload in the frame of the plate; its origin by default.")
    load: list[str] | None = option(LOAD)


def payload(options: _Options) -> Answer:
    """Print the greatest mass on the platform that the legs hold at every pose.

    Loads, masses and gravity of a run's study act besides it. A region is searched: no proof.
    """
    chosen = named_design(options.design)
    loads = loads_option(options.load) or None
    centre = options.centre or (0.0, 0.0, 0.0)
    with searching(options.screen, "payload", chosen):
        result = largest_payload(chosen.machine, options.force, options.pull, centre, loads)
    parts = [*chosen.tool.remark(chosen.unit), *_parts(result, chosen), _meant(result, chosen, centre, loads)]
    if result.fits and result.without_loads < result.mass:
        words = "loads count as always there, also one that carries a part of the payload"
        mass = amount(f"{result.without_loads:.6g}", "kg" * bool(result.force_unit))
        parts.append(f"without the loads {mass}; {words}")
    if options.force is None:
        parts.append(f"from the study: force {_of_kinds(result.limits[0].tolist(), result.force_unit)}")
    if result.not_looked_at:
        parts.append(f"limits of the study that are not looked at: {', '.join(result.not_looked_at)}")
    parts += chosen.duty.tolerances.remark()
    return Answer(parts, result.to_dict(), DONE if result.fits else NO_RESULT)


def _of_kinds(most: list[float], unit: str) -> str:
    """Return the limits of nine legs in words: one number, or one for each kind of legs that has one."""
    if len(set(most)) == 1:
        return amount(f"at most {most[0]:g}", unit)
    ends = {k: amount(f"at most {most[k]:g}", unit) for k in (0, 3, 6) if np.isfinite(most[k])}
    kinds = [f"of {LEGS[k]} to {LEGS[k + 2]} {end}" for k, end in ends.items()]
    return ", ".join(kinds) + "; the others are not limited" * (len(kinds) < 3)


def _parts(result: Payload, chosen: Chosen) -> Iterator[Any]:
    yield result.words if result.fits else f"{result.words}, at the pose below"
    if result.leg:
        yield f"worst pose: {chosen.words(result.configuration)}"
        rows = [(leg, load_text(force, result.forces)) for leg, force in zip(LEGS, result.forces.tolist(), strict=True)]
        title = f"{with_unit('Leg forces', result.force_unit)} there, with{'' if result.fits else 'out'} the payload"
        yield Table(f"{title}, + pushes", columns("leg", ">force"), list(grouped(rows)))
    if result.region is not None:
        yield f"searched, not proved: {result.region.looked_at} poses of the region looked at, {result.region.region}"


def _meant(result: Payload, chosen: Chosen, centre: Vector, loads: list[list[float]] | None) -> str:
    """Return where the payload is, and what acts beside it."""
    study = chosen.duty
    at = f"{amount(vector_words(centre), chosen.unit)} in the frame of the plate (--centre)"
    at += ", not at the tool's point" * (bool(chosen.tool) and tuple(centre) != chosen.tool.position)
    rows = loads or study.loads.wrenches
    beside = [load_words(result.load + 1, rows[result.load], chosen.unit, study.force_unit)] if rows else []
    beside += ["the masses of the study"] if masses_of(study) is not None else []
    return (
        f"the payload is a point mass at {at}; {gravity_words(study.loads.gravity, study.force_unit)}; "
        f"beside it {' and '.join(beside) or 'nothing'}"
    )
