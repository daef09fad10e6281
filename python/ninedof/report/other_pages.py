"""The page of a workspace, and the table of the comparison with the published design."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from ninedof.design.region_outline import box_lines
from ninedof.report import origin, proof, scene
from ninedof.report.body import body_of
from ninedof.report.markup import Html, Section, beside, facts, joined, paragraphs, table
from ninedof.report.numbers import short
from ninedof.report.pages import Page, machine_section
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.robot.leg_names import LEGS
from ninedof.support.units import amount, with_unit
from ninedof.workspace import WorkspaceMap
from ninedof.workspace.question_words import rule_words

NAMES = ("a1", "a2", "b1", "b2", "zp", "zs")
LENGTHS = ("leg_limits", "leg_clearance")


def of_workspace(found: WorkspaceMap, record: Any, name: str) -> Page:
    """Return the page of a workspace; without machine and question where the record does not hold them."""
    asked = record.asked
    shown = _scene(found, asked) if {"geometry", "home"} <= set(asked) else None
    hint = "The body is the set of positions of the platform's origin; lines: the box looked at."
    sections = [
        *([Section("question", "Question", _asked(found, asked))] if "criteria" in asked else []),
        Section("answer", "Answer", _volume(found)),
        *([machine_section(hint if shown["machines"][0]["body"] else "")] if shown else []),
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
    box = [] if found.of_angles else box_lines(found.low, found.high)
    length = float(asked.get("characteristic_length", 1.0))
    return scene.scene([scene.machine("robot", g, home, length, (("home", 0),), box, body_of(found))], found.unit)


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
    said = f"Which poses keep all limits below? Looked at: {where}."
    if "internal_point" in asked:
        said += f" O is {rule_words(asked, found.unit)}."
    return joined(paragraphs([said]), table("Limits", ("limit", "allowed"), rows, (1,)))


def _cubed(found: WorkspaceMap) -> str:
    return "rad³" if found.of_angles else found.unit + "³" * bool(found.unit)


def _scale(found: WorkspaceMap) -> tuple[Callable[[float], float], str]:
    """Return how coordinates of a workspace are shown, and their unit: angles in degrees."""
    return (math.degrees, "deg") if found.of_angles else (float, found.unit)


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
