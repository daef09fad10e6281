"""`ninedof modes`: the assembly modes of nine leg lengths."""

from __future__ import annotations

from typing import Any

import numpy as np

import ninedof as nd
from ninedof.cli.answer import Answer
from ninedof.cli.options import option, several, struct
from ninedof.cli.posed import POSE, PoseOptions, length_at_home, xyz
from ninedof.cli.screen import DONE, NO_RESULT
from ninedof.proof.machine_record import outward
from ninedof.robot.configuration import poses_of
from ninedof.sheet.pose_words import decimals_of, fixed, turn_deg
from ninedof.support.arrays import Floats
from ninedof.support.units import unit_entry, with_unit
from ninedof.tables import Table, columns

EXAMPLES = """
  ninedof modes design.toml                          all modes with the leg lengths of the neutral pose
  ninedof modes runs/20260101-120000 --position 10 0 350 --rotation-deg 0 5 0
  ninedof modes design.toml --certify                with a proof that there are no others
  ninedof modes design.toml --lengths "5 5 5 3 3 3 4 4 4" --json | jq .count"""

SAME = 1e-6  # of Q, and of p and O over the longest leg


@struct
class _Options(PoseOptions):
    lengths: str | None = option('Nine leg lengths "l1 l2 l3 q1 q2 q3 r1 r2 r3", in place of those of a pose.')
    certify: bool = option("Also prove how many there are, and enclose each of them.", False, "--certify")


def modes(options: _Options) -> Answer:
    """Print every configuration with the leg lengths of a pose: the assembly modes."""
    if options.lengths is not None:
        options.refuse("beside --lengths", *POSE)
    at = options.at()
    g, unit = at.geometry, at.unit
    lengths = nd.leg_lengths(g, at.c)[0]
    if options.lengths is not None:
        lengths = np.array(several("--lengths", options.lengths, "l1 l2 l3 q1 q2 q3 r1 r2 r3"))
    result = nd.forward_position(g, lengths, certify=options.certify)
    kappa = nd.condition_number(g, result, length_at_home(at)) if result.count else np.zeros(0)
    this = _this(result, float(lengths.max()), at.c) if options.lengths is None else -1
    certain = "" if result.certain else ", the count is not sure"
    parts: list[Any] = [] if options.lengths is None else at.tool.remark(unit)
    parts += [f"{result.count} assembly modes: {result.status}{certain}"]
    parts += [result.reason] if result.reason else []
    parts += [_proof(result.certificate)] if options.certify else []
    parts += [_table(result, kappa, this, at.configuration.rotation, unit)] if result.count else []
    parts += ["* the given pose"] if this >= 0 else []
    data = {
        "lengths": lengths,
        **{name: getattr(result, name) for name in ("status", "reason", "count", "certain")},
        "given_pose": this + 1 if this >= 0 else None,
        "modes": poses_of(result),
        "condition_number": kappa,
    }
    if options.certify:
        data["certificate"] = result.certificate._asdict() | {"places": poses_of(result.certificate.places)}
    if options.lengths is None:
        parts = list(at.answer(parts, {}).parts)
    return Answer(parts, unit_entry(unit) | data, DONE if result.count else NO_RESULT)


def _this(result: nd.AssemblyModes, size: float, c: nd.Configuration) -> int:
    """Return the number of the mode that is the given pose, -1 without one."""
    moved = (result.position - c.position[0]) / size, (result.internal_point - c.internal_point[0]) / size
    apart = (*moved, (result.rotation - c.rotation[0]).reshape(-1, 9))
    near = np.flatnonzero(np.abs(np.concatenate(apart, axis=1)).max(axis=1, initial=0.0) <= SAME)
    return int(near[0]) if len(near) == 1 else -1


def _proof(proof: nd.ModesCertificate) -> str:
    boxes = f"({proof.boxes} boxes)"
    if proof.complete:
        within = f", each to {outward(proof.radius.max(), True, 2)} of the longest leg" if proof.proved else ""
        return f"proved: exactly {proof.proved} modes{within} {boxes}"
    return f"proved: {proof.proved} modes; {proof.undecided} boxes are undecided and may hold others {boxes}"


def _table(result: nd.AssemblyModes, kappa: Floats, this: int, neutral: Floats, unit: str) -> Table:
    """Return a row for each mode: p, the rotation vector from the neutral orientation, O, the condition number."""
    p, o = (xyz(with_unit(name, unit)) for name in ("p", "O"))
    heads = columns(">", *p, *xyz("turn °"), *o, ">cond.\nno.")
    decimals, turns = decimals_of(result.position, result.internal_point), turn_deg(result, neutral)
    rows = []
    for k in range(len(result)):
        at, centre = ([fixed(x, decimals) for x in row] for row in (result.position[k], result.internal_point[k]))
        turn = [fixed(x, 1) for x in turns[k]]
        rows.append((f"{k + 1}{'*' if k == this else ''}", *at, *turn, *centre, f"{kappa[k]:.4g}"))
    return Table("", heads, rows)
