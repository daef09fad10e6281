"""The failure of legs as tables and sentences."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import partial
from typing import Any

import numpy as np

from ninedof.sheet.pose_words import vector_words
from ninedof.sheet.tables import columns_of, load_columns, load_words, over, pose_of, region_words
from ninedof.support.arrays import Floats
from ninedof.support.units import amount
from ninedof.tables import SHORT, Column, Table, grouped
from ninedof.tables.numbers import cell
from ninedof.tables.table import Cell, Part

PURE = 1e-9  # a part of a motion below this beside the other is rounding


def failure_parts(failure: Any) -> Iterator[Part]:
    """Yield the tables and sentences of a failure."""
    yield from list(region_words(failure))[:2]  # the last is of lengths
    healthy = failure.healthy
    where = pose_of(failure, healthy.pose) if healthy.pose else "the neutral pose"
    yield f"Nine legs at work: worst condition number met {healthy.value:.6f}, at {where}."
    yield locked_table(failure, failure.locked)
    yield (
        "Locked: at its length at the pose. An external leg takes the motion of its platform joint along the leg, "
        "in every design: one freedom, and the condition number is that of the five others."
    )
    if failure.pairs:
        yield pairs_table(failure)
        yield from _pairs_beside(failure)
    yield free_table(failure)
    yield from (f"{one.leg} free: {motion_words(failure, np.array(one.twist))}" for one in failure.free)
    if len(failure.loads):
        yield loads_table(failure)
        yield "Locked legs bear load as before: a locked leg changes no force."


def locked_table(failure: Any, locked: Sequence[Any]) -> Table:
    """Return what is left with each of some sets of legs locked."""
    columns = [
        Column("locked"),
        *columns_of("freedoms"),
        *columns_of("worst", "times", form=SHORT),
        *columns_of("pose"),
    ]
    notes = ["times: of the worst with nine legs at work"]
    rows: list[list[Cell]] = [
        [", ".join(one.legs), str(one.freedoms), _number(one.remaining), _number(one.ratio), str(one.pose or "neutral")]
        for one in locked
    ]
    if failure.region is not None:
        columns += columns_of("share", "from home")
        for row, one in zip(rows, locked, strict=True):
            row += [_percent(one.share if one.freedoms == 6 else None), _percent(one.share_from_home)]
        notes.append(
            f"share: of the region's poses with six freedoms and a condition number of at most {failure.bound:g}"
        )
        notes.append("from home: the same with the leg at its length at home, O moved to the nearest point for it")
    notes += [f"pose {k}: {pose_of(failure, k)}" for k in sorted({one.pose for one in locked} - {0})]
    what = "one leg locked" if len(locked[0].legs) == 1 else "two legs locked"
    return Table(f"Condition number with {what}, worst {over(failure)}", columns, list(grouped(rows)), notes)


def pairs_table(failure: Any) -> Table:
    """Return the condition numbers with two internal legs locked, as a triangle."""
    names = sorted({leg for one in failure.pairs for leg in one.legs if leg[0] != "l"})
    numbers = {one.legs: one for one in failure.pairs if one.freedoms == 6}
    rows = []
    for k, leg in enumerate(names[:-1]):
        cells = [_number(numbers[leg, other].condition_number) for other in names[k + 1 :]]
        rows.append((leg, *[""] * k, *cells))
    columns = [Column("and"), *columns_of(*names[1:], form=SHORT)]
    worst = max(numbers.values(), key=lambda one: one.condition_number)
    place = f"at pose {worst.pose}: {pose_of(failure, worst.pose)}" if worst.pose else "at the neutral pose"
    notes = [f"worst: {' and '.join(worst.legs)}, {_words(worst.condition_number)}, {place}"]
    if worst.share is not None:
        least = min(numbers.values(), key=lambda one: one.share)
        notes.append(f"least share of the region: {' and '.join(least.legs)}, {_percent(least.share)}")
    return Table(f"Condition number with two internal legs locked, worst {over(failure)}", columns, rows, notes)


def free_table(failure: Any) -> Table:
    """Return the size of the motion that each free leg leaves to itself."""
    columns = [Column("free"), Column("at home", "", SHORT), *columns_of("of largest")]
    columns += columns_of("least", "most", form=SHORT)
    rows = [
        (one.leg, _number(one.size), _percent(one.share), _number(one.least.value), _number(one.largest.value))
        for one in failure.free
    ]
    notes = [
        "its column of J': the motion (l_c omega, pdot) for a unit of its length, the other eight locked",
        f"least, most: {over(failure)}; of largest: of the nine columns at home",
    ]
    return Table("One leg free: the motion that is lost", columns, list(grouped(rows)), notes)


def loads_table(failure: Any) -> Table:
    """Return which loads the other eight legs bear."""
    columns = [Column("free"), *load_columns(failure)]
    values = [value for one in failure.free for x in one.loads for value in (x.largest, x.carries)]
    text = partial(cell, form=SHORT, among=[x for x in values if math.isfinite(x)])
    rows = []
    for one in failure.free:
        cells = [text(x.largest) if x.borne else f"not borne ({text(x.carries)})" for x in one.loads]
        rows.append((one.leg, *cells))
    notes = [load_words(k, load, failure.unit, failure.force_unit) for k, load in enumerate(failure.loads, start=1)]
    notes += [] if failure.masses is None else ["each with the weights of the masses of the study"]
    notes.append("the largest force in the other legs; in brackets what the leg has to carry")
    return Table(f"Loads with one leg free, {over(failure)}", columns, list(grouped(rows)), notes)


def motion_words(failure: Any, twist: Floats) -> str:
    """Return a motion (omega, pdot) of the platform at the neutral pose as a screw, in words."""
    if np.isnan(twist).any():
        return "the pose is singular"
    omega, pdot = twist[:3], twist[3:]
    turn, shift = float(np.linalg.norm(omega)), float(np.linalg.norm(pdot))
    if turn * failure.characteristic_length <= PURE * shift:
        return "the platform rests" if shift == 0.0 else f"the platform shifts along {_direction(pdot / shift)}"
    point = failure.configurations.position[0] + np.cross(omega, pdot) / turn**2
    rise = float(omega @ pdot) / turn**2 * math.tau
    through = amount(vector_words(float(f"{x:.4g}") for x in point), failure.unit)
    words = f"the platform turns about {_direction(omega / turn)} through {through}"
    if abs(rise) <= PURE * shift / turn:
        return words
    return f"{words}, advancing {amount(f'{rise:.4g}', failure.unit)} a turn"


def _pairs_beside(failure: Any) -> Iterator[str]:
    for count, words in ((5, "One external leg in a pair: five"), (4, "Two external legs: four")):
        some = [one for one in failure.pairs if one.freedoms == count]
        worst = max(some, key=lambda one: one.remaining)
        number = _words(worst.remaining)
        yield f"{words} freedoms left, worst condition number met {number} ({' and '.join(worst.legs)})."


def _direction(v: Floats) -> str:
    return vector_words(np.round(v, 3) + 0.0)


def _number(value: float) -> Cell:
    return "lost" if math.isinf(value) else value


def _words(value: float) -> str:
    return "lost" if math.isinf(value) else f"{value:.6g}"


def _percent(share: float | None) -> str:
    return "-" if share is None or math.isnan(share) else f"{100.0 * share:.2f} %"
