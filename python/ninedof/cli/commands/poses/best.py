"""`ninedof best`: the best internal point at a pose, or at each pose of a study."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from typing import Any

import numpy as np

import ninedof as nd
from ninedof.cli.answer import Answer
from ninedof.cli.options import LC, LEG_LIMITS, Two, ends, option, struct
from ninedof.cli.posed import DesignAtPoses, PosesOptions, length_at_home, with_length, xyz
from ninedof.cli.screen import DONE, NO_RESULT
from ninedof.conditioning.characteristic_length import KINDS
from ninedof.redundancy.redundancy import CRITERIA
from ninedof.sheet.pose_words import decimals_of, fixed, outside_words, vector_words
from ninedof.support.arrays import Floats
from ninedof.support.units import amount, with_unit
from ninedof.tables import Table, columns

EXAMPLES = """
  ninedof best design.toml --position 0.8 0 3.98
  ninedof best runs/20260101-120000 --all-poses             the leg limits of the run's study
  ninedof best runs/20260101-120000#7 --criterion singularity --legs 200 650 --json | jq .value"""

WORDS = {"condition_number": "condition number", "singularity": "least |det|", "leg_centring": "leg centring"}
SHOWN = 12  # poses, the worst ones


@struct
class _Options(PosesOptions):
    criterion: str = option(f"One of {', '.join(CRITERIA)}.", "condition_number", values=CRITERIA)
    legs: Two | None = ends(LEG_LIMITS)
    lc: str | None = option(LC, values=KINDS)


def best(options: _Options) -> Answer:
    """Print the best place of O at a pose, reached from where it is without passing a singularity."""
    at = with_length(options.at(), options.lc)
    c, length = at.c, length_at_home(at)
    limits: Any = at.permitted_lengths if options.legs is None else options.legs
    how = {"criterion": options.criterion, "limits": limits, "characteristic_length": length}
    result = nd.best_internal_point(at.geometry, c.position, c.rotation, **how, start=c.internal_point)
    now = _now(at, options.criterion, length)
    words, small = WORDS[options.criterion], options.criterion != "singularity"
    if len(c) == 1:
        parts: list[Any] = list(_words(at, result, now, words))
    else:
        parts = [_table(at, result, now, words, small), *_over_poses(result, now, words, small)]
    parts += outside_words(result.configuration, at.tool, at.unit)
    data = {
        "criterion": options.criterion,
        "limits": limits,
        "internal_point": result.configuration.internal_point,
        "value": result.value,
        "now": None if np.isnan(now).all() else now,
        "status": result.status,
        "active": result.active,
    }
    return at.answer(parts, data, status=DONE if np.isfinite(result.value).any() else NO_RESULT)


def _now(at: DesignAtPoses, criterion: str, length: float) -> Floats:
    """Return the criterion where O is; NaN for one that depends on limits."""
    if criterion == "condition_number":
        return np.asarray(nd.condition_number(at.geometry, at.c, length))
    if criterion == "singularity":
        return np.asarray(np.min(np.abs(np.stack(nd.singularity_margins(at.geometry, at.c))), axis=0))
    return np.full(len(at.c), np.nan)


def _over_poses(result: nd.InternalPoint, now: Floats, words: str, small: bool) -> Iterator[str]:
    """Yield the worst over all poses, and how the searches ended."""
    if len(result.value) > SHOWN:
        yield f"the {SHOWN} worst of {len(result.value)} poses"
    pick = np.max if small else np.min
    ended = [] if np.isnan(now).all() else [f"worst {words} now {pick(now):.6g}"]
    if not np.isnan(result.value).any():
        ended.append(f"with the best O {pick(result.value):.6g}")
    statuses = Counter(str(status) for status in result.status)
    yield "; ".join([*ended, ", ".join(f"{count} {status}" for status, count in statuses.items())])


def _words(at: DesignAtPoses, result: nd.InternalPoint, now: Floats, words: str) -> Iterator[str]:
    """Yield O and the criterion at one pose, as they are and at the best."""
    here, there = (amount(vector_words(c.internal_point[0]), at.unit) for c in (at.c, result.configuration))
    if not np.isnan(now[0]):
        yield f"O now {here}: {words} {now[0]:.6g}"
    if not np.isnan(result.value[0]):
        yield f"best O {there}: {words} {result.value[0]:.6g}"
    yield f"{result.status[0]}; limits reached: {', '.join(result.active[0]) or 'nothing'}"


def _table(at: DesignAtPoses, result: nd.InternalPoint, now: Floats, words: str, small: bool) -> Table:
    """Return O and the criterion, as it is and at the best, for the poses that are worst now."""
    c, points = at.c, result.configuration.internal_point
    order = np.argsort(-now if small else now, kind="stable")
    decimals = decimals_of(c.position, points)
    p, o = (xyz(with_unit(name, at.unit)) for name in ("p", "best O"))
    heads = columns(">pose", *p, ">now", ">best", *o, "why")
    rows = []
    for k in order[:SHOWN].tolist():
        place, centre = (
            ["-" if math.isnan(x) else fixed(x, decimals) for x in row] for row in (c.position[k], points[k])
        )
        values = ("-" if math.isnan(x) else f"{x:#.4g}".rstrip(".") for x in (now[k], result.value[k]))
        status = str(result.status[k])
        why = ", ".join([*([] if status == "found" else [status]), *result.active[k]])
        rows.append((str(k), *place, *values, *centre, why))
    if not any(row[-1] for row in rows):
        heads, rows = heads[:-1], [row[:-1] for row in rows]
    return Table(f"Best places of O by {words}", heads, rows)
