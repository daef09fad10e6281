"""The pages of runs that are read from their records: a motion, a sweep, an atlas."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ninedof.design.limits import kind_of
from ninedof.redundancy.rules import where_o
from ninedof.report import origin
from ninedof.report.markup import Html, Section, beside, facts, joined, paragraphs, table
from ninedof.report.numbers import short
from ninedof.report.pages import Page
from ninedof.sheet.path_limits import row_words
from ninedof.support.margins import is_violated
from ninedof.support.units import per, with_unit

SHOWN = 24  # lines of a table
PAPER = "paper"
FROM_RECORD = (PAPER, "sweep", "atlas")  # kinds whose arrays, which may be large, no page shows


def of_recorded(record: Any, name: str) -> Page:
    """Return the page of a run by the kind of its record; of an unknown kind, its figures and its question."""
    results = record.results or {}
    again = Section("again", "How to reproduce it", origin.of_question(record.asked, record))
    if (motion := results.get("motion")) is not None:
        return _of_motion(motion, record, name, again)
    if (sweep := results.get("sweep")) is not None:
        ends = {index: found for index, found in sweep["indices"].items() if found.get("least")}
        rows = [_ends(index, found) for index, found in ends.items()]
        answer = table("Least and greatest", ("index", "least", "at", "greatest", "at"), rows, (2, 4))
        said = f"How does {_listed(ends)} vary over {_listed(_axes(ends))}?"
        return _page(record, name, said, answer, [("indices", len(ends))], again)
    if (atlas := results.get("atlas")) is not None:
        best = atlas["best"][:: max(1, len(atlas["best"]) // SHOWN)]
        among = [b["condition_number"] for b in best]
        rows = [(f"{b['radius_ratio']:.4g}", short(b["condition_number"], among)) for b in best]
        answer = table(
            "The best design met up to a ratio of base to platform radius", ("up to", "condition number"), rows
        )
        said = f"Which condition numbers have {atlas['designs']} designs drawn at random?"
        return _page(record, name, said, answer, [("designs", atlas["designs"])], again)
    if record.kind == PAPER:
        rows = [tuple(row[key] for key in ("where", "printed", "ours", "verdict")) for row in results["verdicts"]]
        head = ("where", "printed", "ours", "verdict")
        answer = table("The paper's numbers and ours, lengths in units of l_c", head, rows, (1, 2, 3))
        said = "Which numbers of the paper hold? Each is computed anew; the seven figures are drawn anew."
        page = _page(record, name, said, answer, [("numbers and claims", len(rows))], again)
        return Page(page.kind, "The paper's numbers beside ours", page.figures, page.sections)
    return _page(record, name, f"A run of kind “{record.kind}”; its figures are below.", Html(), [], again)


def _page(record: Any, name: str, said: str, answer: Html, top: list[tuple[str, object]], again: Section) -> Page:
    sections = [Section("question", "Question", paragraphs([said]))]
    if answer:
        sections.append(Section("answer", "Answer", answer))
    return Page(record.kind, f"{record.kind.capitalize()} {name}", top, [*sections, again])


def _of_motion(motion: dict[str, Any], record: Any, name: str, again: Section) -> Page:
    unit, kappa, near = record.asked.get("unit", ""), motion["condition_number"], motion["nearest_singularity"]
    broken = len(motion["breaks"])
    for limit in motion.get("limits", ()):
        broken += is_violated(limit["margin"], kind_of(limit["name"]), limit.get("limit", 0.0))
    rows: list[tuple[object, object]] = [
        ("condition number, worst", f"{kappa['worst']:.4f} at t = {kappa['at']:.6g}"),
        ("at the start and at the end", f"{kappa['first']:.4f}, {kappa['last']:.4f}"),
        ("nearest singularity", f"{near['determinant']} = {near['value']:.4f} at t = {near['at']:.6g}"),
        ("never move", ", ".join(motion["idle_legs"]) or "none: all nine legs move"),
        ("tracked back from the leg lengths", _tracked(motion)),
    ]
    units = {"shortest": unit, "longest": unit, "speed": per(unit, "s"), "acceleration": per(unit, "s²")}
    legs = [(leg, *(f"{found[key]:.6g}" for key in units)) for leg, found in motion["legs"].items()]
    head = ("leg", *(with_unit(*column) for column in units.items()))
    limits = table(
        "Limits along the path", ("limit", "", "allowed", "worst", "margin", "at t"), _limits(motion, unit), (1,)
    )
    answer = joined(beside(facts(rows), table("Legs", head, legs)), limits if motion.get("limits") else Html())
    said = (
        f"What do the nine legs do along {motion['poses']} poses from t = {motion['begin']:g} to {motion['end']:g}, "
        f"and which limits break? O is {where_o(motion['internal_point'])}."
    )
    top: list[tuple[str, object]] = [("limits broken", broken), ("worst condition number", f"{kappa['worst']:.4f}")]
    page = _page(record, name, said, answer, top, again)
    return Page(page.kind, page.headline, page.figures, page.sections, page.shown, broken == 0 and motion["tracked"])


def _tracked(motion: dict[str, Any]) -> str:
    until = "whole path" if motion["tracked"] else f"up to t = {motion['tracked_until']:.6g}"
    return f"{until}, largest difference {motion['tracking_error']:.1e}"


def _limits(motion: dict[str, Any], unit: str) -> Iterator[tuple[str, ...]]:
    for row in motion.get("limits", ()):
        name, *cells = row_words(row, unit)
        yield name.replace("_", " "), *cells


def _ends(index: str, found: dict[str, Any]) -> tuple[str, ...]:
    cells = [index.replace("_", " ")]
    for end in (found["least"], found["greatest"]):
        at = (
            f"{axis} = {value if isinstance(value, str) else format(value, '.6g')}" for axis, value in end["at"].items()
        )
        cells += [short(float(end["value"])), ", ".join(at)]
    return tuple(cells)


def _axes(ends: dict[str, Any]) -> dict[str, None]:
    return dict.fromkeys(axis for found in ends.values() for axis in found["least"]["at"])


def _listed(names: Any) -> str:
    return " and ".join(name.replace("_", " ") if "_" in name and len(name) > 4 else name for name in names)
