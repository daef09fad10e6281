"""The pages of fronts, of workspaces and of runs that only have figures."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from ninedof.design.indices import LEGS
from ninedof.pareto import Front
from ninedof.pareto.front import row_words
from ninedof.report import origin, proof, scene
from ninedof.report.body import body_of
from ninedof.report.markup import Html, Section, beside, facts, joined, paragraphs, table
from ninedof.report.numbers import short
from ninedof.report.pages import Page, machine_section
from ninedof.report.question import question
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.units import amount, with_unit
from ninedof.workspace import WorkspaceMap

NAMES = ("a1", "a2", "b1", "b2", "zp", "zs")
LENGTHS = ("leg_limits", "leg_clearance")


def of_front(front: Front, record: Any, name: str) -> Page:
    """Return the page of a trade-off."""
    limit = front.limit_name.replace("_", " ")
    asked = f"What does each value of {limit} cost? The study below is solved once for each."
    machines = [
        scene.machine(f"point {k}: {limit} {_limit(front, x)}", b.geometry, b.configuration, b.characteristic_length)
        for k, (x, result) in enumerate(zip(front.limits, front.results, strict=True), start=1)
        if (b := result.best) is not None and not math.isnan(front.objectives[k - 1])
    ]
    sections = [
        Section("question", "Question", joined(paragraphs([asked]), question(front.study))),
        Section("answer", "Answer", _front_table(front)),
        *([machine_section()] if machines else []),
        Section(
            "sheet", "Engineering sheet", paragraphs([f"Each point has its own: ninedof sheet {name}#1 for the first."])
        ),
        Section("proof", "What is proved, and what is searched", proof.of_front(front)),
        Section("again", "How to reproduce it", origin.of_front(front, record)),
    ]
    found = [x for x in front.objectives if not math.isnan(x)]
    ends = f"{max(found):.6f} to {min(found):.6f}" if found else "no design"
    figures = [
        ("limits solved", len(front)),
        ("objective", ends),
        ("interrupted", "yes" if front.interrupted else "no"),
    ]
    headline = f"{front.study.words[:1].upper()}{front.study.words[1:]} against {limit}"
    shown = scene.scene(machines, front.study.unit) if machines else None
    return Page("trade-off", headline, figures, sections, shown, bool(found) and not front.interrupted)


def _front_table(front: Front) -> Html:
    unit = "deg" if front.unit == "rad" else front.unit
    limit = with_unit(f"{front.limit_name.replace('_', ' ')} at most", unit)
    head = (
        "no.",
        limit,
        "objective",
        "neutral condition number",
        "price, % for 1 %",
        "limits reached, or why no design",
    )
    rows = []
    for k, row in enumerate(front.table(), start=1):
        missing = row["objective"] is None
        price = "-" if row["price"] is None else f"{row['price']:.3f}"
        values = ("-", "-") if missing else (f"{row['objective']:.6f}", f"{row['condition_number']:.6f}")
        rows.append((k, _limit(front, row["limit"]), *values, price, row_words(front, row).replace("_", " ")))
    return table(f"{front.study.words} for each limit", head, rows, (5,))


def _limit(front: Front, value: float) -> str:
    return f"{math.degrees(value) if front.unit == 'rad' else value:.5g}"


def of_workspace(found: WorkspaceMap, record: Any, name: str) -> Page:
    """Return the page of a workspace; without machine and question where the record does not hold them."""
    asked = record.asked
    shown = _scene(found, asked) if {"geometry", "home"} <= set(asked) else None
    hint = "The body is the set of positions of the platform's origin; lines: the box looked at."
    sections = [
        *([Section("question", "Question", _asked(found, asked))] if "criteria" in asked else []),
        Section("answer", "Answer", _volume(found)),
        *([machine_section(hint if shown["body"] else "")] if shown else []),
        Section("proof", "What is proved, and what is searched", proof.of_workspace(found, asked)),
        Section("again", "How to reproduce it", origin.of_question(asked, record)),
    ]
    figures = [
        ("status", found.status),
        ("volume", amount(f"{found.volume:.6g} ± {found.error:.1g}", _cubed(found))),
        ("worst condition number", f"{found.worst_condition_number:.4f}"),
    ]
    headline = f"Workspace: {found.archetype.replace('_', ' ')}"
    good = found.status in ("converged", "limited")
    return Page("workspace", headline, figures, sections, shown, good)


def _scene(found: WorkspaceMap, asked: Any) -> dict[str, Any]:
    g = Geometry(**{key: np.array(value) for key, value in asked["geometry"].items()})
    home = Configuration(**{key: np.array(value) for key, value in asked["home"].items()})
    box = [] if found.of_angles else [scene.numbers(line) for line in scene.box_lines(found.low, found.high)]
    machines = [scene.machine("robot", g, home, float(asked.get("characteristic_length", 1.0)), (("home", 0),))]
    return scene.scene(machines, found.unit, box, body_of(found))


def _asked(found: WorkspaceMap, asked: Any) -> Html:
    rows = []
    for name, limit in asked["criteria"].items():
        if name == "leg_limits" and np.ndim(limit[0]):
            rows += [
                (leg, _criterion(name, ends, found.unit))
                for leg, ends in zip(LEGS, zip(*limit, strict=True), strict=True)
            ]
        else:
            rows.append((name.replace("_", " "), _criterion(name, limit, found.unit)))
    turn, unit = _scale(found)
    low, high = (", ".join(f"{turn(x):.6g}" for x in ends) for ends in (found.low, found.high))
    where = f"{'the box' if not found.of_angles else 'coordinates'} from ({low}) to {amount(f'({high})', unit)}"
    rule = _rule(asked.get("internal_point", "held"))
    said = f"Which poses keep all limits below? Looked at: {where}. O is {rule}."
    return joined(paragraphs([said]), table("Limits", ("limit", "allowed"), rows, (1,)))


def _cubed(found: WorkspaceMap) -> str:
    return "rad³" if found.of_angles else found.unit + "³" * bool(found.unit)


def _scale(found: WorkspaceMap) -> tuple[Callable[[float], float], str]:
    """Return how coordinates of a workspace are shown, and their unit: angles in degrees."""
    return (math.degrees, "deg") if found.of_angles else (float, found.unit)


def _rule(given: Any) -> str:
    if isinstance(given, str):
        return {"best": "at its best place for each pose"}.get(given, given)
    if isinstance(given, int | float):
        return f"at a share of {given:.4g} of the way between the plates"
    if isinstance(given, dict):
        return "fixed to the platform"
    return f"at ({', '.join(f'{x:.6g}' for x in given)})"


def _criterion(name: str, limit: Any, unit: str) -> str:
    if name.endswith("cone"):
        most = limit["max"] if isinstance(limit, dict) else limit
        return f"{math.degrees(most):.4g}°"
    if isinstance(limit, bool):
        return "yes" if limit else "no"
    if isinstance(limit, int | float):
        return amount(f"{limit:g}", unit if name in LENGTHS else "")
    return amount(" to ".join(f"{end:.6g}" for end in limit), unit)


def _volume(found: WorkspaceMap) -> Html:
    turn, unit = _scale(found)
    rows: list[tuple[object, object]] = [
        (with_unit("volume", _cubed(found)), f"{found.volume:.6g}"),
        ("error, estimated", f"{found.error:.2g}"),
        ("share of what was looked at", f"{100.0 * found.share:.3g} %"),
        ("connected pieces", len(found.pieces)),
    ]
    if found.ball_radius > 0.0:
        sides = found.box_high - found.box_low
        rows += [
            (with_unit("largest ball, radius", unit), f"{turn(found.ball_radius):.5g}"),
            (with_unit("its centre", unit), ", ".join(f"{turn(x):.4g}" for x in found.ball_centre)),
            (with_unit("largest box, sides", unit), " × ".join(f"{turn(x):.4g}" for x in sides)),
        ]
    rows += [
        ("global conditioning index", f"{found.conditioning_index:.5f}"),
        ("condition number, median", f"{found.percentiles[50]:.4f}"),
        ("condition number, 95 %", f"{found.percentiles[95]:.4f}"),
        ("condition number, worst", f"{found.worst_condition_number:.4f}"),
    ]
    shares = [(k.replace("_", " "), f"{100.0 * v:.1f} %") for k, v in found.limits().items()]
    ends = table("What ends the workspace", ("limit", "share of the boundary"), shares) if shares else Html()
    return beside(facts(rows), ends)


def of_comparison(rows: Any) -> Html:
    """Return the published optimum beside ours."""
    head = ("design", "condition number", "a1, a2", "b1, b2", "zp", "zs")
    among = [row["variables"][name] for row in rows for name in NAMES]
    cells = []
    for row in rows:
        v = row["variables"]
        a1, a2, b1, b2, zp, zs = (short(v[name], among) for name in NAMES)
        cells.append((row["title"], f"{row['condition_number']:.6f}", f"{a1}, {a2}", f"{b1}, {b2}", zp, zs))
    return table("The published optimum beside ours, lengths in units of l_c", head, cells)
