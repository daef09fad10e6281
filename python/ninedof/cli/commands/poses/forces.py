"""`ninedof forces`: the leg forces that balance loads on the platform."""

from __future__ import annotations

from typing import Any

import numpy as np

import ninedof as nd
from ninedof.cli.answer import Answer
from ninedof.cli.options import CENTRE, GRAVITY, LOAD, MASS, Three, loads_option, option, struct, triple
from ninedof.cli.posed import PosesOptions
from ninedof.cli.screen import bold
from ninedof.robot.geometry import LEGS
from ninedof.robot.idle import NEVER_CARRY, unloaded_names
from ninedof.sheet.request import masses_besides_platform, masses_of, masses_words, weight_of
from ninedof.sheet.tables import load_words, weight_words
from ninedof.support.units import unit_of_forces, with_unit
from ninedof.tables import Table, columns, grouped
from ninedof.tables.numbers import spread

EXAMPLES = """
  ninedof forces design.toml --load "0 0 0 0 0 -100"
  ninedof forces runs/20260101-120000 --mass 12 --centre 0 0 30
  ninedof forces runs/20260101-120000 --load "0 0 0 0 0 -100" --load "0 5 0 0 0 -100" --all-poses
  ninedof forces runs/20260101-120000#7 --load "0 0 0 0 0 -100" --position 10 0 350 --json | jq .forces"""

BALANCED = 1e-9  # of the largest force


@struct
class _Options(PosesOptions):
    load: list[str] | None = option(LOAD)
    mass: float | None = option(MASS)
    centre: Three | None = triple(CENTRE)
    gravity: Three | None = triple(GRAVITY)


def forces(options: _Options) -> Answer:
    """Print the forces in the legs that balance loads on the platform, positive where a leg pushes."""
    own = loads_option(options.load)
    at = options.at()
    duty = at.duty
    weight = weight_of(duty, options.mass, options.centre, options.gravity)
    masses = masses_of(duty, options.mass, options.centre)
    gravity = duty.loads.gravity if options.gravity is None else options.gravity
    loads = np.array(own or duty.loads.wrenches or np.zeros((int(masses is not None), 6)))
    if not len(loads):
        raise ValueError("--load: got none, expected one, or --mass, or a run whose study has [loads] or [masses]")
    balance = nd.inverse_dynamics(at.geometry, at.c, masses=masses, gravity=gravity, load=loads[:, None])
    result, size = balance.forces, np.abs(balance.forces).max(axis=(1, 2))
    heads = columns("leg", *(f">load {k}" for k in range(1, len(loads) + 1)))
    least, most = result.min(axis=1), result.max(axis=1)
    rows = [(leg, *map(spread, least[:, k], most[:, k], size[:, None])) for k, leg in enumerate(LEGS)]
    force_unit = unit_of_forces(at.unit, masses is not None)
    parts: list[Any] = [load_words(k, row, at.unit, force_unit) for k, row in enumerate(loads, start=1)]
    parts += weight_words(weight, duty.tool, masses_besides_platform(duty) is not None, force_unit)
    stated = ["[loads]"] * (not own and bool(duty.loads.wrenches)) + masses_words(duty, options.mass)
    parts += [f"from the study: {', '.join(stated)}"] * bool(stated)
    parts.append(Table(with_unit("Forces", force_unit) + ", + pushes", heads, list(grouped(rows))))
    for k, each in enumerate(result, start=1):
        if (names := unloaded_names(each)) and len(names) < len(LEGS):
            parts.append(bold("never carry load", f" {k}: {', '.join(names)}; {NEVER_CARRY}"))
    left = np.abs(balance.unbalanced).max(axis=(1, 2)) > BALANCED * size
    for k in np.flatnonzero(left).tolist():
        parts.append(bold("singular", f": at some pose no leg forces balance all of load {k + 1}"))
    with_weight = {} if weight is None else {"weight": weight._asdict()}
    data = {"loads": loads, **with_weight, "legs": LEGS, "forces": result, "unbalanced": balance.unbalanced}
    return at.answer(parts, data)
