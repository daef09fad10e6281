"""The tables of an engineering sheet, whole and in short."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np
from rich.table import Table

from ninedof.cli.result_table import short
from ninedof.sheet.limit_rows import limit_amount
from ninedof.sheet.pose_words import pose_words, vector_words
from ninedof.sheet.sheet import Extreme, Sheet
from ninedof.sheet.words import MECHANISMS, PERMITTED, WAYS, lengths_title, motion_words, over, region_words
from ninedof.support.margins import margin_words
from ninedof.support.units import amount, heading, per, times, with_unit

ROUNDING = 1e-11  # of the largest number of a column


def sheet_tables(found: Sheet) -> Iterator[Table | str]:
    """Return the tables and lines of a sheet in the order of printing."""
    yield _joints(found)
    yield from region_words(found)
    yield _lengths(found)
    yield _motions(found)
    yield from motion_words(found)
    if found.motion.twist is not None:
        yield _twist(found)
    if len(found.loads):
        yield _forces(found)
    yield _worst(found)
    if found.limits:
        yield limits_table(found)


def poses_table(found: Sheet) -> Table:
    """Return the condition numbers and the legs over the poses, in short."""
    table = _table(over(found).capitalize() + ", the neutral pose included", "", "")
    table.show_header = False
    worst = found.condition_number
    table.add_row("worst condition number", f"{worst.value:.6f}")
    table.add_row("at", _pose(found, worst.pose))
    table.add_row("mean condition number", f"{found.mean_condition_number:.6f}", end_section=True)
    for k in (0, 3, 6):
        legs = found.legs[k : k + 3]
        ranges = "  ".join(f"{short(leg.shortest)} to {short(leg.longest)}" for leg in legs)
        table.add_row(with_unit(f"legs {' '.join(leg.name for leg in legs)}", found.unit), ranges)
    table.add_row("largest stroke ratio", short(max(leg.stroke_ratio for leg in found.legs)))
    if found.idle:
        table.add_row("never move", ", ".join(found.idle))
    return table


def _table(title: str, *columns: str) -> Table:
    table = Table(title=title, title_justify="left", title_style="bold")
    for k, column in enumerate(columns):
        table.add_column(column, justify="right" if k else "left", overflow="fold")
    return table


def _joints(found: Sheet) -> Table:
    table = _table(
        "Joints: in the frame of base or platform, and in base axes at the neutral pose",
        *("joint", *(heading(name, found.unit) for name in ("x", "y", "z", "neutral x", "y", "z"))),
    )
    for k, (name, own, placed) in enumerate(found.joints()):
        numbers = (short(round(float(x), 9)) for x in (*own, *placed))
        table.add_row(name.replace("_", " "), *numbers, end_section=k % 3 == 2)
    return table


def _lengths(found: Sheet) -> Table:
    names = ("shortest", "longest", "neutral", "stroke", *(PERMITTED if found.leg_ranges else ()))
    lengths = (heading(name, found.unit) for name in names)
    table = _table(lengths_title(found), "leg", *lengths, "ratio")
    table.pad_edge = not found.leg_ranges  # so that all columns fit into 80 characters
    for k, leg in enumerate(found.legs):
        numbers = (leg.shortest, leg.longest, leg.neutral, leg.stroke, *(leg.permitted or ()), leg.stroke_ratio)
        table.add_row(leg.name, *(short(x) for x in numbers), end_section=k % 3 == 2)
    return table


def _motions(found: Sheet) -> Table:
    speeds = heading("speed", per(found.unit, "s")), heading("acceleration", per(found.unit, "s²"))
    columns = (*speeds, "base cone", "platform cone")
    table = _table(f"Legs {over(found)}: speeds and cones", "leg", *columns)
    for k, leg in enumerate(found.legs):
        cones = ("-" if a is None else f"{math.degrees(a):.2f}°" for a in (leg.base_cone, leg.platform_cone))
        table.add_row(leg.name, f"{leg.speed:.5g}", f"{leg.acceleration:.5g}", *cones, end_section=k % 3 == 2)
    return table


def _twist(found: Sheet) -> Table:
    """Return the rates and accelerations for the given twist."""
    heads = heading("speed", per(found.unit, "s")), heading("acceleration", per(found.unit, "s²"))
    table = _table(f"Legs {over(found)}: least to largest for the twist", "leg", *heads)
    columns = [[getattr(leg, name) for leg in found.legs] for name in ("twist_speed", "twist_acceleration")]
    for k, leg in enumerate(found.legs):
        table.add_row(leg.name, *(_ends(column[k], column) for column in columns), end_section=k % 3 == 2)
    twist, rate = (np.array(x) for x in (found.motion.twist, found.motion.twist_rate))
    table.caption = "\n".join(
        f"{words}angular {vector_words(x[:3])}, linear {vector_words(x[3:])}"
        for words, x in (("", twist), ("rate: ", rate))
    )
    return table


def _ends(ends: tuple[float, float], column: Sequence[tuple[float, float]]) -> str:
    """Return the two ends of a range; 0 where only rounding is left."""
    largest = max(abs(end) for row in column for end in row)
    low, high = (f"{0.0 if abs(x) < ROUNDING * largest else x:.4g}" for x in ends)
    return low if low == high else f"{low} to {high}"


def _forces(found: Sheet) -> Table:
    count = range(1, len(found.loads) + 1)
    table = _table(
        f"Leg forces, least to largest {over(found)}, pushing positive", "leg", *(f"load {k}" for k in count)
    )
    columns = [list(column) for column in zip(*(leg.forces for leg in found.legs), strict=True)]
    for k, leg in enumerate(found.legs):
        table.add_row(
            leg.name, *(_ends(x, column) for x, column in zip(leg.forces, columns, strict=True)), end_section=k % 3 == 2
        )
    table.caption = "\n".join(
        f"load {k}: moment {amount(vector_words(load[:3]), times('force', found.unit))}, force {vector_words(load[3:])}"
        for k, load in zip(count, found.loads, strict=True)
    )
    if (weight := found.weight) is not None:
        table.caption += (
            f"\neach with the weight of a mass of {weight.mass:g}, centre {vector_words(weight.centre)} in the "
            f"platform, gravity {vector_words(weight.gravity)}"
        )
    return table


def _worst(found: Sheet) -> Table:
    title = "At the neutral pose" if len(found.configurations) == 1 else f"Worst {over(found)}"
    table = _table(title, "", "value", "pose", "")
    used: set[int] = set()

    def add(label: str, value: str, pose: int, words: str = "", end: bool = False) -> None:
        used.add(pose)
        table.add_row(label, value, str(pose) if pose else "neutral", words, end_section=end)

    add("condition number", f"{found.condition_number.value:.6f}", found.condition_number.pose)
    look = found.region
    spread = "" if look is None else f"± {look.mean_error:.1g}, even over the region"
    table.add_row("mean condition number", f"{found.mean_condition_number:.6f}", "", spread, end_section=True)
    add(
        "leg clearance",
        amount(short(found.clearance.value), found.unit),
        found.clearance.pose,
        " and ".join(found.clearance.legs),
    )
    for name in sorted(found.determinants, key=lambda n: found.determinants[n].value):
        one = found.determinants[name]
        words = MECHANISMS[name] + ", CROSSED between poses" * one.changes_sign
        add(f"|det {name[-1].upper()}|", f"{one.value:.6f}", one.pose, words)
    table.add_section()
    for name, near in found.singularities.items():
        distance = f"{math.degrees(near.distance):.2f}°" if name == "turn" else amount(short(near.distance), found.unit)
        det = f"det {near.mechanism.upper()} = 0" if near.mechanism else "none"
        where = f"{det} {'about' if name == 'turn' else 'toward'} {vector_words(np.round(near.direction, 3))}"
        add(f"nearest singularity: {WAYS[name]}", distance, near.pose, where if near.mechanism else det)
    table.add_section()
    if found.accuracy is not None:
        a = found.accuracy
        add("position error", amount(f"{a.position.value:.4g}", found.unit), a.position.pose)
        add("rotation error", f"{math.degrees(a.rotation.value):.4g}°", a.rotation.pose)
        add("error of O", amount(f"{a.internal_point.value:.4g}", found.unit), a.internal_point.pose, end=True)
    if found.stiffness is not None:
        units = (per("force", found.unit), times("force", found.unit))
        labels = ("stiffness", "turning stiffness, per rad")
        for label, unit, least in zip(labels, units, found.stiffness, strict=True):
            add(f"least {label}", amount(f"{Extreme(*least).value:.4g}", unit), least.pose)
    table.caption = "\n".join(f"pose {k}: {_pose(found, k)}" for k in sorted(used) if k)
    table.caption_justify = "left"
    return table


def limits_table(found: Sheet) -> Table:
    """Return the limits of the study beside the values and margins."""
    where = "at its poses" if found.region is None else "over its region"
    table = _table(f"Limits of the study, {where}", "limit", "", "allowed", "here", "margin")
    for row in found.limits:
        allowed, here = (limit_amount(row, value, short, found.unit) for value in (row.limit, row.value))
        table.add_row(row.name, row.side, allowed, here, margin_words(row.margin, row.unit))
    return table


def _pose(found: Sheet, k: int) -> str:
    return pose_words(found.configurations[k], found.configurations.rotation[0], found.unit)
