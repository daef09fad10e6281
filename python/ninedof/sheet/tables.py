"""The tables and sentences of an engineering sheet; `sheet` is a Sheet."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from ninedof.redundancy.rules import WORDS
from ninedof.robot.idle import NEVER_CARRY, NEVER_MOVE, unloaded_names
from ninedof.sheet.pose_words import gravity_words, outside_words, pose_words, vector_words
from ninedof.sheet.rows import limit_amount
from ninedof.support.margins import margin_words
from ninedof.support.units import amount, metres, per, times, watt_note
from ninedof.tables import DEGREES, RIGHT, SHORT, Column, Line, Table, grouped
from ninedof.tables.numbers import load_text, short, spread
from ninedof.tables.table import Part

WAYS = {"shift": "shift with O", "turn": "turn, O at rest", "internal": "O alone"}
MECHANISMS = {
    "det_b": "O in the plane of the lower internal joints",
    "det_c": "O in the plane of the upper internal joints",
    "det_n": "the platform turns about a line through O",
}
BESIDE = 4  # loads; a table of more has no room for another at its side


def sheet_parts(sheet: Any) -> Iterator[Part]:
    """Yield the tables and sentences of a sheet."""
    yield _joints(sheet)
    yield from summary_parts(sheet)
    if sheet.motion.twist is not None:
        yield _twist(sheet)
    if len(sheet.loads):
        tables = _forces(sheet), _powers(sheet)
        yield from [tables] if len(sheet.loads) <= BESIDE else tables
    yield worst_table(sheet)
    if sheet.limits:
        yield limits_table(sheet)


def summary_parts(sheet: Any) -> Iterator[Part]:
    """Yield lengths, speeds and cones of the legs, and what is meant by them."""
    yield from region_words(sheet)
    yield from _study_words(sheet)
    yield from outside_words(sheet.configurations, sheet.tool, sheet.unit)
    yield lengths_table(sheet), _motions(sheet)
    yield from _motion_words(sheet)


def poses_table(sheet: Any) -> Table:
    """Return the condition numbers and the legs over the poses, in short."""
    worst = sheet.condition_number
    rows: list[Any] = [
        Line("worst condition number", [worst.value], ".6f"),
        Line("at", [pose_of(sheet, worst.pose)]),
        Line("mean condition number", [sheet.mean_condition_number], ".6f"),
        (),
    ]
    for legs in (sheet.legs[k : k + 3] for k in (0, 3, 6)):
        among = [leg.longest for leg in legs]
        ranges = "  ".join(f"{short(leg.shortest, among, 5)} to {short(leg.longest, among, 5)}" for leg in legs)
        rows.append(Line(f"legs {' '.join(leg.name for leg in legs)}", [ranges], unit=sheet.unit))
    rows.append(Line("largest stroke ratio", [max(leg.stroke_ratio for leg in sheet.legs)], ".4f"))
    if sheet.idle:
        rows.append(Line("never move", [", ".join(sheet.idle)]))
    return Table(f"{over(sheet).capitalize()}, the neutral pose included", [Column(), Column("", "", RIGHT)], rows)


def limits_table(sheet: Any) -> Table:
    """Return the limits of the study beside the values and margins."""
    where = "at its poses" if sheet.region is None else "over its region"
    parts = any(row.part for row in sheet.limits)
    columns = [Column("limit"), *[Column()] * parts, Column(), *columns_of("allowed", "here", "margin")]
    rows = []
    for row in sheet.limits:
        ends = (limit_amount(row, value, sheet.unit, sheet.force_unit) for value in (row.limit, row.value))
        rows.append([row.name, *[row.part] * parts, row.side, *ends, margin_words(row.margin, row.unit)])
    if any(row.violated for row in sheet.limits):
        columns.append(Column())
        rows = [[*cells, "violated" * row.violated] for cells, row in zip(rows, sheet.limits, strict=True)]
    notes = [watt_note(sheet.unit)] * (bool(sheet.force_unit) and any(row.unit == "power" for row in sheet.limits))
    return Table(f"Limits of the study, {where}", columns, rows, notes)


def worst_table(sheet: Any) -> Table:
    """Return the worst values with their poses, which the notes describe."""
    title = "At the neutral pose" if len(sheet.configurations) == 1 else f"Worst {over(sheet)}"
    columns = [Column(), *columns_of("value", "pose")]
    rows = list(_worst_rows(sheet))
    used = sorted({row[2] for row in rows if row and row[2]})
    cells = [(*row[:2], "" if row[2] is None else row[2] or "neutral") if row else () for row in rows]
    remarks = [f"{row[0]}: {row[3]}" for row in rows if row and row[3]]
    return Table(
        title, columns, cells, [*remarks, *_stiffness_words(sheet), *(f"pose {k}: {pose_of(sheet, k)}" for k in used)]
    )


def _stiffness_words(sheet: Any) -> Iterator[str]:
    """Yield the stiffness of the legs that was given."""
    if sheet.leg_stiffness:
        ends = dict.fromkeys(f"{end(sheet.leg_stiffness):g}" for end in (min, max))
        of_each = amount(" to ".join(ends), per(sheet.force_unit or "force", sheet.unit))
        yield f"stiffness: of each leg {of_each}, as given; all are locked"


def _worst_rows(sheet: Any) -> Iterator[tuple[Any, ...]]:
    """Yield label, value, pose and remark; pose None where none belongs to it."""
    unit, worst = sheet.unit, sheet.condition_number
    yield "condition number", f"{worst.value:.6f}", worst.pose, ""
    look = sheet.region
    error = "" if look is None else f"± {look.mean_error:.1g}, even over the region"
    yield "mean condition number", f"{sheet.mean_condition_number:.6f}", None, error
    yield ()
    clear = sheet.clearance
    yield "leg clearance", amount(short(clear.value), unit), clear.pose, " and ".join(clear.legs)
    for name, det in sorted(sheet.determinants.items(), key=lambda item: item[1].value):
        words = MECHANISMS[name] + ", CROSSED between poses" * det.changes_sign
        yield f"|det {name[-1].upper()}|", f"{det.value:.6f}", det.pose, words
    yield ()
    for name, near in sheet.singularities.items():
        turn = name == "turn"
        far = f"{math.degrees(near.distance):.2f}°" if turn else amount(short(near.distance), unit)
        way = f"{'about' if turn else 'toward'} {vector_words(np.round(near.direction, 3))}"
        remark = f"det {near.mechanism.upper()} = 0 {way}" if near.mechanism else "none"
        rests = name == "shift" and sheet.motion.internal == "held"
        yield f"nearest singularity: {'shift, O at rest' if rests else WAYS[name]}", far, near.pose, remark
    yield ()
    if (errors := sheet.accuracy) is not None:
        yield "position error", amount(f"{errors.position.value:.4g}", unit), errors.position.pose, ""
        yield "rotation error", f"{math.degrees(errors.rotation.value):.4g}°", errors.rotation.pose, ""
        yield "error of O", amount(f"{errors.internal_point.value:.4g}", unit), errors.internal_point.pose, ""
        yield ()
    if sheet.stiffness is not None:
        (shifting, turning), force = sheet.stiffness, sheet.force_unit or "force"
        yield "least stiffness", amount(f"{shifting.value:.4g}", per(force, unit)), shifting.pose, ""
        text = amount(f"{turning.value:.4g}", times(force, unit))
        yield "least turning stiffness, per rad", text, turning.pose, ""


def columns_of(*names: str, form: str = RIGHT, unit: str = "") -> list[Column]:
    """Return columns of one kind."""
    return [Column(name, unit, form) for name in names]


def _joints(sheet: Any) -> Table:
    columns = [Column("joint"), *columns_of("x", "y", "z", "neutral x", "y", "z", form=SHORT, unit=sheet.unit)]
    rows = [
        (name.replace("_", " "), *(round(float(x), 9) for x in (*own, *at_neutral)))
        for name, own, at_neutral in sheet.joints()
    ]
    title = "Joints in the frame of their plate, and in base axes at the neutral pose"
    return Table(title, columns, list(grouped(rows)))


def _of_legs(title: str, sheet: Any, columns: Sequence[Column], rows: Any, notes: Sequence[str] = ()) -> Table:
    named = ((leg.name, *row) for leg, row in zip(sheet.legs, rows, strict=True))
    return Table(title, [Column("leg"), *columns], list(grouped(named)), notes)


def lengths_table(sheet: Any) -> Table:
    """Return the lengths of the legs."""
    names, title = ["shortest", "longest", "neutral", "stroke"], "lengths"
    if any(leg.permitted for leg in sheet.legs):
        names = ["needs from", "needs to", "neutral", "stroke", "permitted from", "permitted to"]
        title = "lengths that the poses need, and that limits permit"
    columns = [*columns_of(*names, form=SHORT, unit=sheet.unit), Column("ratio", "", ".4f")]
    rows = (
        (leg.shortest, leg.longest, leg.neutral, leg.stroke, *(leg.permitted or ()), leg.stroke_ratio)
        for leg in sheet.legs
    )
    return _of_legs(f"Legs {over(sheet)}: {title}", sheet, columns, rows)


def _motions(sheet: Any) -> Table:
    columns = [*_speeds(sheet, ".5g"), *columns_of("base cone", "platform cone", form=DEGREES)]
    rows = ((leg.speed, leg.acceleration, leg.base_cone, leg.platform_cone) for leg in sheet.legs)
    return _of_legs(f"Legs {over(sheet)}: speeds and cones", sheet, columns, rows)


def _speeds(sheet: Any, form: str = RIGHT) -> list[Column]:
    return [Column("speed", per(sheet.unit, "s"), form), Column("acceleration", per(sheet.unit, "s²"), form)]


def _ranges(rows: Sequence[Sequence[tuple[float, float]]]) -> list[list[str]]:
    """Return ranges as text; what is rounding beside the largest number of its column is 0."""
    columns = [[end for ends in column for end in ends] for column in zip(*rows, strict=True)]
    return [[spread(*ends, column) for ends, column in zip(row, columns, strict=True)] for row in rows]


def _twist(sheet: Any) -> Table:
    """Return the rates and accelerations for the given twist."""
    rows = _ranges([(leg.twist_speed, leg.twist_acceleration) for leg in sheet.legs])
    twists = (("", sheet.motion.twist), ("rate: ", sheet.motion.twist_rate))
    notes = [f"{words}angular {vector_words(x[:3])}, linear {vector_words(x[3:])}" for words, x in twists]
    return _of_legs(f"Legs {over(sheet)}: least to largest for the twist", sheet, _speeds(sheet), rows, notes)


def _forces(sheet: Any) -> Table:
    notes = [load_words(k, load, sheet.unit, sheet.force_unit) for k, load in enumerate(sheet.loads, start=1)]
    notes += weight_words(sheet.weight, sheet.tool, sheet.has_leg_masses, sheet.force_unit)
    for k, names in enumerate(map(unloaded_names, sheet.forces()), start=1):
        if 0 < len(names) < len(sheet.legs):
            notes.append(f"{', '.join(names)} never carry load {k}: {NEVER_CARRY}")
    title = f"Leg forces, least to largest {over(sheet)}, pushing positive"
    return _of_legs(title, sheet, load_columns(sheet), _ranges([leg.forces for leg in sheet.legs]), notes)


def load_columns(sheet: Any) -> list[Column]:
    """Return a column for each load."""
    return columns_of(*(f"load {k}" for k in range(1, len(sheet.loads) + 1)), unit=sheet.force_unit)


def _powers(sheet: Any) -> Table:
    """Return the drives beside each other: greatest force, speed and power of each leg."""
    speed = per(sheet.unit, "s")
    force, scale = sheet.force_unit, metres(sheet.unit) if sheet.force_unit else 1.0
    power = "W" if force else times("force", speed)
    columns = [Column("force", force, RIGHT), Column("speed", speed, RIGHT), Column("power", power, RIGHT)]
    numbers = [(leg.largest_force, leg.speed, scale * leg.power) for leg in sheet.legs]
    among = list(zip(*numbers, strict=True))
    rows = ([load_text(*pair) for pair in zip(row, among, strict=True)] for row in numbers)
    note = "power: the most of force times speed at one pose, at rest or at constant speed"
    return _of_legs(f"Drives, largest {over(sheet)}", sheet, columns, rows, [note])


def weight_words(weight: Any, tool: Any, legs: bool, force_unit: str = "") -> list[str]:
    """Return which weights act beside the loads; the centre of the platform's in the frame of the plate."""
    words = []
    if weight is not None:
        x, y, z = tool.own(weight.centre).tolist()
        mass = f"{weight.mass:g}{' kg' if force_unit else ''}"
        words.append(
            f"each with the weight of a mass of {mass}, centre {vector_words((x, y, z))} in the frame of the plate, "
            f"{gravity_words(weight.gravity, force_unit)}"
        )
    return [*words, *["each with the weights of the legs and of O"] * legs]


def load_words(number: int, load: Any, unit: str, force_unit: str = "") -> str:
    """Return a load in words; `force_unit` is "N", or "" for a unit without a name."""
    moment = amount(vector_words(load[:3]), times(force_unit or "force", unit))
    return f"load {number}: moment {moment}, force {amount(vector_words(load[3:]), force_unit)}"


def region_words(sheet: Any) -> Iterator[str]:
    """Yield a sentence on how the region was looked over, if there is one."""
    if (look := sheet.region) is not None:
        how = "a sample and descents from the worst of it"
        how += "" if sheet.leg_ranges is None else " for the lengths of the legs"
        yield f"Region: {look.region}. Poses looked at: {look.looked_at}, {how}."
    if sheet.leg_ranges is not None:
        yield "O is placed anew at every pose, where the worst of the index and the limits is least."
        if sheet.leg_ranges:
            yield (
                "Placing O keeps each leg between its permitted lengths. Shortest and longest are those that the "
                "region was found to need."
            )


def _study_words(sheet: Any) -> Iterator[str]:
    """Yield what the study states beside its limits: the tool, and the tables that gave options of the sheet."""
    yield from (f"{words}." for words in sheet.tool.remark(sheet.unit))
    if sheet.stated:
        yield f"From the study: {', '.join(f'[{name}]' for name in sheet.stated)}."


def over(sheet: Any) -> str:
    """Return which poses a sheet is over."""
    if sheet.region is not None:
        return "over the region"
    count = len(sheet.configurations)
    return f"over {count} poses" if count > 1 else "at the neutral pose"


def _motion_words(sheet: Any) -> Iterator[str]:
    """Yield how speeds, accelerations and cones of a sheet are meant, and which legs never move."""
    linear, angular = sheet.motion.linear_speed, math.degrees(sheet.motion.angular_speed)
    most = "no more than that" if linear * angular else "the largest"
    internal = sheet.motion.internal
    o = "O moves for the least leg rates" if internal == "least" else f"O {WORDS[internal]}"
    yield (
        f"Speed: the largest in any direction for a platform speed of {amount(f'{linear:g}', per(sheet.unit, 's'))}, "
        f"turning {angular:g}° per {'second' if sheet.unit else 'time unit'}, {o}. "
        f"Acceleration: {most} while both are constant. Cones: from {_axes_words(sheet.cone_axes)}."
    )
    if sheet.idle:
        yield f"{', '.join(sheet.idle)} never move {over(sheet)}: {NEVER_MOVE}."


def _axes_words(axes: Mapping[str, Sequence[float]]) -> str:
    if len({*axes.values()}) < 2 and not any(axes.values()):
        return "the direction at the neutral pose"
    words = []
    for body in ("base", "platform"):
        kinds = {name.rpartition("_")[2]: axis for name, axis in axes.items() if name.startswith(body)}
        if len({*kinds.values()}) == 1:
            kinds = {"": next(iter(kinds.values()))}
        for kind, axis in kinds.items():
            joints = f"at {kind} joints of the {body}" if kind else f"at the {body}"
            of = f"the axis {vector_words(axis)}" if axis else "the direction at the neutral pose"
            words.append(f"{of} {joints}")
    return ", ".join(words)


def pose_of(sheet: Any, k: int) -> str:
    """Return a pose of a sheet in words."""
    return pose_words(sheet.configurations[k], sheet.configurations.rotation[0], sheet.unit)
