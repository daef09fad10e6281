"""The tables of a motion, from its plain values as `Followed.to_dict` and records have them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from ninedof.motion.followed import Followed
from ninedof.redundancy.rules import where_o
from ninedof.robot.leg_names import LEGS
from ninedof.support.margins import margin_words
from ninedof.support.units import amount, per
from ninedof.tables import RIGHT, Column, Table, grouped

OF_LENGTHS = ("leg_clearance", "stroke")
SHOWN = 12  # breaks of limits


def legs_table(motion: Mapping[str, Any]) -> Table:
    """Return the table of the nine legs."""
    legs, unit = motion["legs"], motion.get("unit", "")
    columns = {"shortest": Column("least", unit, RIGHT), "longest": Column("most", unit, RIGHT)}
    if any(leg["low"] > 0.0 or math.isfinite(leg["high"]) for leg in legs.values()):
        columns |= {"low": Column("low", unit, RIGHT), "high": Column("high", unit, RIGHT)}
        columns["margin"] = Column("margin", "", RIGHT)
    columns |= {"speed": Column("speed", per(unit, "s"), RIGHT)}
    columns |= {"acceleration": Column("accel.", per(unit, "s²"), RIGHT)}
    if all("push" in leg for leg in legs.values()):
        columns |= {name: Column(name, "", RIGHT) for name in ("push", "pull")}
    largest = {key: max((abs(leg[key]) for leg in legs.values()), default=0.0) for key in columns if key != "margin"}
    if "push" in columns:
        largest["push"] = largest["pull"] = max(largest["push"], largest["pull"])

    def text(key: str, value: float) -> str:
        if key == "margin":
            return margin_words(value, "length")
        return "0" if math.isfinite(largest[key]) and abs(value) < 1e-12 * largest[key] else f"{value:.6g}"

    rows = [(name, *(text(key, leg[key]) for key in columns)) for name, leg in legs.items()]
    return Table("Legs along the path", [Column("leg"), *columns.values()], list(grouped(rows)))


def limits_table(motion: Mapping[str, Any]) -> Table:
    """Return the other limits of the study: where each has its least margin."""
    heads = [Column("limit"), Column(), *(Column(name, "", RIGHT) for name in ("allowed", "worst", "margin", "at t"))]
    rows = [_limit_row(row, motion.get("unit", "")) for row in motion.get("limits", ())]
    return Table("Limits of the study along the path", heads, rows)


def _limit_row(row: Mapping[str, Any], unit: str) -> tuple[str, ...]:
    if "limit_deg" in row:
        ends = [f"{row[key]:.2f}°" for key in ("limit_deg", "value_deg")]
    else:
        of = unit if row["name"] in OF_LENGTHS else ""
        ends = [amount(f"{row[key]:.6g}", of) for key in ("limit", "value")]
    margin = margin_words(row["margin"], "sign" if row["name"] == "singularity_free" else "")
    return f"{row['name']} {row['part']}".strip(), row["side"], *ends, margin, f"{row['at']:.6g}"


def motion_words(followed: Followed, motion: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield remarks on the tables, one sentence each: words to be stressed, and the rest."""
    kappa, near = motion["condition_number"], motion["nearest_singularity"]
    o = where_o(motion["internal_point"])
    yield "", f"{motion['poses']} poses from t = {motion['begin']:g} to {motion['end']:g}; O: {o}"
    if motion["idle_legs"]:
        yield "", f"never move: {', '.join(motion['idle_legs'])}; with --internal-point best or 0.5 they help"
    ends = f"{kappa['first']:.4f} at the start, {kappa['last']:.4f} at the end"
    yield "", f"condition number at worst {kappa['worst']:.4f} at t = {kappa['at']:.6g}; {ends}"
    yield "", f"nearest singularity: {near['determinant']} = {near['value']:.4f} at t = {near['at']:.6g}"
    turning, moving = (float(np.linalg.norm(followed.velocity[:, k : k + 3], axis=1).max()) for k in (0, 3))
    speed, time = amount(f"{moving:.5g}", per(followed.unit, "s")), "second" if followed.unit else "unit of time"
    yield "", f"platform: speed at most {speed}, turning at most {math.degrees(turning):.5g} degrees per {time}"
    breaks = motion["breaks"]
    for broken in breaks[:SHOWN]:
        yield _break_words(broken, followed.unit)
    if len(breaks) > SHOWN:
        yield "", f"and {len(breaks) - SHOWN} more breaks of limits: see record.json"
    error = f"largest difference {motion['tracking_error']:.1e}"
    if motion["tracked"]:
        yield "", f"tracked back from the leg lengths, every step proved: {error}"
    else:
        yield "not tracked back", f" beyond t = {motion['tracked_until']:.6g}: {error}"


def _break_words(broken: Mapping[str, Any], unit: str) -> tuple[str, str]:
    limit = broken["limit"]
    if limit.startswith("det"):
        return "singularity", f": {limit} changes sign at t = {broken['begin']:.6g}"
    worst = f"{broken['worst_deg']:.5g}°" if "worst_deg" in broken else f"{broken['worst']:.5g}"
    if limit.split()[0] in (*LEGS, *OF_LENGTHS):
        worst = amount(worst, unit)
    when = f"from t = {broken['begin']:.6g} to {broken['end']:.6g}"
    return "limit breaks", f": {limit}, {when}, at worst {worst} at {broken['at']:.6g}"
