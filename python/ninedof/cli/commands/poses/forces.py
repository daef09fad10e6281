"""`ninedof forces`: the leg forces that balance loads on the platform."""

from __future__ import annotations

from typing import Any

import numpy as np

import ninedof as nd
from ninedof.cli.answer import Answer
from ninedof.cli.options import LOAD, loads_option, option, struct
from ninedof.cli.posed import PosesOptions
from ninedof.cli.screen import bold
from ninedof.robot.geometry import LEGS
from ninedof.robot.idle import NEVER_CARRY, unloaded_names
from ninedof.sheet.request import masses_besides_platform, masses_of, weight_of
from ninedof.sheet.tables import load_words, weight_words
from ninedof.support.units import with_unit
from ninedof.tables import Table, columns, grouped
from ninedof.tables.numbers import spread

PLACE = 4
EXAMPLES = """
  ninedof forces design.toml --load "0 0 0 0 0 -100"
  ninedof forces runs/20260101-120000 --load "0 0 0 0 0 -100" --load "0 5 0 0 0 -100" --all-poses
  ninedof forces runs/20260101-120000#7 --load "0 0 0 0 0 -100" --position 10 0 350 --json | jq .forces"""

BALANCED = 1e-9  # of the largest force


@struct
class _Options(PosesOptions):
    load: list[str] | None = option(LOAD)


def forces(options: _Options) -> Answer:
    """Print the forces in the legs that balance loads on the platform, positive where a leg pushes."""
    own = loads_option(options.load)
    at = options.at()
    duty = at.duty
    weight, masses = weight_of(duty, None, None, None), masses_of(duty)
    loads = np.array(own or duty.loads.wrenches or np.zeros((int(masses is not None), 6)))
    if not len(loads):
        raise ValueError("--load: got none, expected one, or a run whose study has [loads] or [masses]")
    balance = nd.inverse_dynamics(at.geometry, at.c, masses=masses, gravity=duty.loads.gravity, load=loads[:, None])
    result, size = balance.forces, np.abs(balance.forces).max(axis=(1, 2))
    heads = columns("leg", *(f">load {k}" for k in range(1, len(loads) + 1)))
    least, most = result.min(axis=1), result.max(axis=1)
    rows = [(leg, *map(spread, least[:, k], most[:, k], size[:, None])) for k, leg in enumerate(LEGS)]
    parts: list[Any] = [load_words(k, row, at.unit, duty.force_unit) for k, row in enumerate(loads, start=1)]
    parts += weight_words(weight, duty.tool, masses_besides_platform(duty) is not None, duty.force_unit)
    if masses is not None or not own:
        parts.append(f"from the study: {', '.join(['[loads]'] * (not own) + ['[masses]'] * (masses is not None))}")
    parts.append(Table(with_unit("Forces", duty.force_unit) + ", + pushes", heads, list(grouped(rows))))
    for k, each in enumerate(result, start=1):
        if (names := unloaded_names(each)) and len(names) < len(LEGS):
            parts.append(bold("never carry load", f" {k}: {', '.join(names)}; {NEVER_CARRY}"))
    left = np.abs(balance.unbalanced).max(axis=(1, 2)) > BALANCED * size
    for k in np.flatnonzero(left).tolist():
        parts.append(bold("singular", f": at some pose no leg forces balance all of load {k + 1}"))
    with_weight = {} if weight is None else {"weight": weight._asdict()}
    data = {"loads": loads, **with_weight, "legs": LEGS, "forces": result, "unbalanced": balance.unbalanced}
    return at.answer(parts, data)
