"""The pages of runs that are read from their records: a workspace, a motion, a sweep, an atlas, the paper."""

from __future__ import annotations

import math
from typing import Any

from ninedof.design.domains.region import box_lines
from ninedof.design.limits import kind_of
from ninedof.design.tool import Tool
from ninedof.motion.tables import motion_tables, seconds_of
from ninedof.paper.verdicts import verdicts_table
from ninedof.redundancy.rules import where_o
from ninedof.report import origin, proof, scene
from ninedof.report.page import Page
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.margins import is_violated
from ninedof.support.units import amount
from ninedof.sweep.result import atlas_table, summary_table
from ninedof.tables.html import Html, bullets, facts, html_of, joined, paragraphs
from ninedof.workspace import WorkspaceMap
from ninedof.workspace.tables import criterion_words, cut_words, rule_words, workspace_table, workspace_words


def of_workspace(workspace: WorkspaceMap, record: Any) -> Page:
    """Return the page of a workspace; without machine and question where the record does not hold them."""
    question, view, machine = record.question, None, None
    table = workspace_table(workspace, most=100)
    tool = Tool.from_dict(question.get("tool", {}))
    remarks = [f"{first}{rest}" for first, rest in (*cut_words(workspace), *workspace_words(workspace))]
    sections = {
        "answer": joined(paragraphs(f"{one[0].upper()}{one[1:]}." for one in remarks), html_of(table)),
        "proof": proof.of_workspace(workspace, question),
        "again": origin.of_question(question, record),
    }
    if "criteria" in question:
        sections["question"] = _question(workspace, question, tool)
    if {"geometry", "home"} <= set(question):
        machine = Geometry(**question["geometry"]), Configuration(**question["home"])
        box = [] if workspace.of_angles else box_lines(workspace.low, workspace.high)
        length, poses = float(question.get("characteristic_length", 1.0)), [("home", machine[1])]
        shown = scene.machine("robot", machine[0], length, poses, box, scene.body_of(workspace), tool)
        view = scene.scene([shown], workspace.unit)
        point = "tool's point" if tool else "platform's origin"
        hint = f"The body is the set of positions of the {point}; lines: the box looked at."
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


def _question(workspace: WorkspaceMap, question: Any, tool: Tool) -> Html:
    turn, unit = (math.degrees, "deg") if workspace.of_angles else (float, workspace.unit)
    low, high = (", ".join(f"{turn(x):.6g}" for x in ends) for ends in (workspace.low, workspace.high))
    where = f"{'the box' if not workspace.of_angles else 'coordinates'} from ({low}) to {amount(f'({high})', unit)}"
    sentence = f"Which poses keep all limits below? Looked at: {where}."
    if "internal_point" in question:
        sentence += f" O is {rule_words(question, workspace.unit)}."
    criteria = question["criteria"].items()
    limits = (words for name, value in criteria for words in criterion_words(name, value, workspace.unit, tool))
    return joined(paragraphs([sentence]), bullets(limits))


PAPER = "paper"
FROM_RECORD = (PAPER, "sweep", "atlas")  # kinds whose arrays, which may be large, no page shows


def of_recorded(record: Any, name: str) -> Page:
    """Return the page of a run by the kind of its record; of an unknown kind, its figures and its question."""
    results = record.results or {}
    headline, good = f"{record.kind.capitalize()} {name}", True
    sentence, answer = f"A run of kind “{record.kind}”; its figures are below.", Html()
    top: list[Any] = []
    if (motion := results.get("motion")) is not None:
        sentence, answer, top = _motion(motion, record.question.get("unit", ""))
        good = top[0][1] == 0 and motion["tracked"]
    elif (sweep := results.get("sweep")) is not None:
        ends = {name: row for name, row in sweep["indices"].items() if row.get("least")}
        axes = dict.fromkeys(axis for row in ends.values() for axis in row["least"]["at"])
        sentence, top = f"How does {_listed(ends)} vary over {_listed(axes)}?", [("indices", len(ends))]
        answer = html_of(summary_table(sweep["indices"], "Least and greatest", sweep["units"]))
    elif (atlas := results.get("atlas")) is not None:
        sentence = f"Which condition numbers have {atlas['designs']} designs drawn at random?"
        answer, top = html_of(atlas_table(atlas["best"])), [("designs", atlas["designs"])]
    elif record.kind == PAPER:
        rows = results["verdicts"]
        headline = "The paper's numbers beside ours"
        sentence = "Which numbers of the paper hold? Each is computed anew; the seven figures are drawn anew."
        answer, top = html_of(verdicts_table(rows)), [("numbers and claims", len(rows))]
    sections = {"question": paragraphs([sentence]), "again": origin.of_question(record.question, record)}
    if answer:
        sections["answer"] = answer
    return Page(record.kind, headline, top, sections, None, good)


def _motion(motion: dict[str, Any], unit: str) -> tuple[str, Html, list[Any]]:
    motion = {"unit": unit, **motion}
    kappa, near = motion["condition_number"], motion["nearest_singularity"]
    broken = len(motion["breaks"])
    for limit in motion.get("limits", ()):
        broken += is_violated(limit["margin"], kind_of(limit["name"]), limit.get("limit", 0.0))

    def moment(t: float) -> str:
        return amount(f"{t:.6g}", seconds_of(motion))

    until = "whole path" if motion["tracked"] else f"up to t = {moment(motion['tracked_until'])}"
    rows = [
        ("condition number, worst", f"{kappa['worst']:.4f} at t = {moment(kappa['at'])}"),
        ("at the start and at the end", f"{kappa['first']:.4f}, {kappa['last']:.4f}"),
        ("nearest singularity", f"{near['determinant']} = {near['value']:.4f} at t = {moment(near['at'])}"),
        ("never move", ", ".join(motion["idle_legs"]) or "none: all nine legs move"),
        ("tracked back from the leg lengths", f"{until}, largest difference {motion['tracking_error']:.1e}"),
    ]
    sentence = (
        f"What do the nine legs do along {motion['poses']} poses from t = {motion['begin']:g} to "
        f"{moment(motion['end'])}, "
        f"and which limits break? O is {where_o(motion['internal_point'])}."
    )
    top = [("limits broken", broken), ("worst condition number", f"{kappa['worst']:.4f}")]
    return sentence, joined(facts(rows), *map(html_of, motion_tables(motion))), top


def _listed(names: Any) -> str:
    return " and ".join(name.replace("_", " ") if "_" in name and len(name) > 4 else name for name in names)
