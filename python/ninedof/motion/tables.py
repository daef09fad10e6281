"""The tables of a motion, from its plain values as `Followed.to_dict` and records have them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from ninedof.redundancy.rules import where_o
from ninedof.robot.geometry import LEGS
from ninedof.robot.idle import NEVER_CARRY
from ninedof.support.margins import margin_words
from ninedof.support.units import amount, kind_unit, per, times, watt_note, with_unit
from ninedof.tables import RIGHT, Column, Table, columns, grouped

POWERS, WORKS = ("power", "braking"), ("work", "returned")
FORCES = ("push", "pull", "rms")
SHOWN = 12  # breaks of limits
FEW = 50  # poses of a path: fewer need not show what happens between them


def legs_table(motion: Mapping[str, Any]) -> Table:
    """Return the table of the nine legs."""
    legs, unit = motion["legs"], motion.get("unit", "")
    columns = {"shortest": ("least", unit), "longest": ("most", unit)}
    if any(leg["low"] > 0.0 or math.isfinite(leg["high"]) for leg in legs.values()):
        columns |= {"low": ("low", unit), "high": ("high", unit), "margin": ("margin", "")}
    columns |= {"speed": ("speed", per(unit, "s")), "acceleration": ("accel.", per(unit, "s²"))}
    largest = {key: max((abs(leg[key]) for leg in legs.values()), default=0.0) for key in columns if key != "margin"}

    def text(key: str, value: float) -> str:
        if key == "margin":
            return margin_words(value, "length")
        return "0" if math.isfinite(largest[key]) and abs(value) < 1e-12 * largest[key] else f"{value:.6g}"

    rows = [(name, *(text(key, leg[key]) for key in columns)) for name, leg in legs.items()]
    heads = [Column("leg"), *(Column(*head, RIGHT) for head in columns.values())]
    return Table("Legs along the path", heads, list(grouped(rows)))


def drives_table(motion: Mapping[str, Any]) -> Table | None:
    """Return the table of forces, powers and work of the legs; None without forces."""
    legs = motion["legs"]
    newton, unit = motion.get("force_unit", ""), motion.get("unit", "")
    power, work = ("W", "J") if newton else (times("force", per(unit, "s")), times("force", unit))
    groups = ((newton, FORCES), (power, POWERS), (work, WORKS))
    units = {name: unit for unit, names in groups for name in names if all(name in leg for leg in legs.values())}
    if not units:
        return None
    most = {
        name: max(leg.get(one, 0.0) for leg in legs.values() for one in names) for _, names in groups for name in names
    }

    def text(name: str, value: float) -> str:
        return "0" if abs(value) <= 1e-6 * most[name] else f"{value:.4g}"

    rows = [(leg, *(text(name, values[name]) for name in units)) for leg, values in legs.items()]
    body: list[Any] = list(grouped(rows))
    several = motion.get("loads", 1) > 1
    if "work" in units and not several:  # the largest of several loads do not add up
        totals = {name: f"{sum(leg[name] for leg in legs.values()):.4g}" for name in WORKS}
        body += [(), ("all", *(totals.get(name, "") for name in units))]
    heads = [Column("leg"), *(Column(name, unit, RIGHT) for name, unit in units.items())]
    of = f", each figure the largest of {motion['loads']} loads" if several else ""
    return Table(f"Drives along the path{of}", heads, body)


def limits_table(motion: Mapping[str, Any]) -> Table:
    """Return the other limits of the study: where each has its least margin."""
    heads = columns("limit", "", ">allowed", ">worst", ">margin", with_unit(">at t", seconds_of(motion)))
    rows = []
    for row in motion.get("limits", ()):
        if "limit_deg" in row:
            ends = [f"{row[key]:.2f}°" for key in ("limit_deg", "value_deg")]
        else:
            unit = kind_unit(row["kind"], motion.get("unit", ""), motion.get("force_unit", ""))
            ends = [amount(f"{row[key]:.6g}", unit) for key in ("limit", "value")]
        margin = margin_words(row["margin"], row["kind"])
        rows.append((f"{row['name']} {row['part']}".strip(), row["side"], *ends, margin, f"{row['at']:.6g}"))
    watts = motion.get("force_unit") and any(row["kind"] == "power" for row in motion.get("limits", ()))
    notes = [watt_note(motion["unit"])] if watts else []
    return Table("Limits of the study along the path", heads, rows, notes)


def seconds_of(motion: Mapping[str, Any]) -> str:
    """Return "s" where lengths have a unit; times have none without one."""
    return "s" * bool(motion.get("unit"))


def motion_tables(motion: Mapping[str, Any]) -> list[Table]:
    """Return the tables of a motion: legs, drives where there are forces, limits where a study has some."""
    drives = drives_table(motion)
    limits = [limits_table(motion)] if motion.get("limits") else []
    return [legs_table(motion), *([] if drives is None else [drives]), *limits]


def motion_words(followed: Any, motion: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield remarks on the tables, one sentence each: words to be stressed, and the rest."""
    kappa, near = motion["condition_number"], motion["nearest_singularity"]
    o, seconds = where_o(motion["internal_point"]), seconds_of(motion)
    moments = {"end": motion["end"], "worst": kappa["at"], "near": near["at"], "tracked": motion["tracked_until"]}
    at = {name: amount(f"{t:.6g}", seconds) for name, t in moments.items()}
    if motion["poses"] < FEW:
        yield (
            f"at {motion['poses']} poses only",
            f": between them nothing is looked at, and rates are of polynomials through them; give at least {FEW}",
        )
    yield "", f"{motion['poses']} poses from t = {motion['begin']:g} to {at['end']}; O: {o}"
    if motion["idle_legs"]:
        yield "", f"never move: {', '.join(motion['idle_legs'])}; with --internal-point best or 0.5 they help"
    if motion.get("unloaded_legs"):
        yield "", f"never carry load: {', '.join(motion['unloaded_legs'])}; {NEVER_CARRY}"
    ends = f"{kappa['first']:.4f} at the start, {kappa['last']:.4f} at the end"
    yield "", f"condition number at worst {kappa['worst']:.4f} at t = {at['worst']}; {ends}"
    yield "", f"nearest singularity: {near['determinant']} = {near['value']:.4f} at t = {at['near']}"
    turning, moving = (float(np.linalg.norm(followed.velocity[:, k : k + 3], axis=1).max()) for k in (0, 3))
    speed, time = amount(f"{moving:.5g}", per(followed.unit, "s")), "second" if followed.unit else "unit of time"
    yield "", f"platform: speed at most {speed}, turning at most {math.degrees(turning):.5g} degrees per {time}"
    breaks = motion["breaks"]
    units = dict.fromkeys(LEGS, followed.unit)
    units |= {
        row["name"]: kind_unit(row["kind"], followed.unit, followed.force_unit) for row in motion.get("limits", ())
    }
    for entry in breaks[:SHOWN]:
        yield _break_words(entry, units, seconds)
    if len(breaks) > SHOWN:
        yield "", f"and {len(breaks) - SHOWN} more breaks of limits: see record.json"
    error = f"largest difference {motion['tracking_error']:.1e}"
    if motion["tracked"]:
        yield "", f"tracked back from the leg lengths, every step proved: {error}"
    else:
        yield "not tracked back", f" beyond t = {at['tracked']}: {error}"


def _break_words(entry: Mapping[str, Any], units: Mapping[str, str], seconds: str) -> tuple[str, str]:
    limit, begin = entry["limit"], f"{entry['begin']:.6g}"
    if limit.startswith("det"):
        return "singularity", f": {limit} changes sign at t = {amount(begin, seconds)}"
    if "worst_deg" in entry:
        worst = f"{entry['worst_deg']:.5g}°"
    else:
        worst = amount(f"{entry['worst']:.5g}", units.get(limit.split()[0], ""))
    end, at = (amount(f"{entry[key]:.6g}", seconds) for key in ("end", "at"))
    return "limit breaks", f": {limit}, from t = {begin} to {end}, at worst {worst} at {at}"
