"""The page of a workspace."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ninedof.design.region import box_lines
from ninedof.report import origin, proof, scene
from ninedof.report.page import Page
from ninedof.report.scene import body_of
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.units import amount
from ninedof.tables.html import Html, bullets, html_of, joined, paragraphs
from ninedof.workspace import WorkspaceMap
from ninedof.workspace.tables import criterion_words, rule_words, workspace_table


def of_workspace(workspace: WorkspaceMap, record: Any) -> Page:
    """Return the page of a workspace; without machine and question where the record does not hold them."""
    question, view, machine = record.question, None, None
    sections = {
        "answer": html_of(workspace_table(workspace, most=100)),
        "proof": proof.of_workspace(workspace, question),
        "again": origin.of_question(question, record),
    }
    if "criteria" in question:
        sections["question"] = _question(workspace, question)
    if {"geometry", "home"} <= set(question):
        machine = _machine(question)
        view = _scene(workspace, *machine, float(question.get("characteristic_length", 1.0)))
        hint = "The body is the set of positions of the platform's origin; lines: the box looked at."
        sections["machine"] = paragraphs([hint if view["machines"][0]["body"] else ""])
    cubed = "rad³" if workspace.of_angles else workspace.unit + "³" * bool(workspace.unit)
    figures = [
        ("status", workspace.status),
        ("volume", amount(f"{workspace.volume:.6g} ± {workspace.error:.1g}", cubed)),
        ("worst condition number", f"{workspace.worst_condition_number:.4f}"),
    ]
    headline = f"Workspace: {workspace.archetype.replace('_', ' ')}"
    good = workspace.status in ("converged", "limited")
    return Page("workspace", headline, figures, sections, view, good, machine)


def _machine(question: Any) -> tuple[Geometry, Configuration]:
    g = Geometry(**{key: np.array(value) for key, value in question["geometry"].items()})
    return g, Configuration(**{key: np.array(value) for key, value in question["home"].items()})


def _scene(workspace: WorkspaceMap, g: Geometry, home: Configuration, length: float) -> dict[str, Any]:
    box = [] if workspace.of_angles else box_lines(workspace.low, workspace.high)
    return scene.scene([scene.machine("robot", g, length, [("home", home)], box, body_of(workspace))], workspace.unit)


def _question(workspace: WorkspaceMap, question: Any) -> Html:
    turn, unit = (math.degrees, "deg") if workspace.of_angles else (float, workspace.unit)
    low, high = (", ".join(f"{turn(x):.6g}" for x in ends) for ends in (workspace.low, workspace.high))
    where = f"{'the box' if not workspace.of_angles else 'coordinates'} from ({low}) to {amount(f'({high})', unit)}"
    sentence = f"Which poses keep all limits below? Looked at: {where}."
    if "internal_point" in question:
        sentence += f" O is {rule_words(question, workspace.unit)}."
    limits = (
        words for name, value in question["criteria"].items() for words in criterion_words(name, value, workspace.unit)
    )
    return joined(paragraphs([sentence]), bullets(limits))
