"""The page of a trade-off: its table, a machine for each point, the sheet of the one to look at first."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from ninedof.optimize.result import Result
from ninedof.pareto import Front
from ninedof.pareto.front import row_words
from ninedof.pareto.knee import preferred
from ninedof.report import origin, proof, scene
from ninedof.report.body import quick_body
from ninedof.report.markup import Html, Section, joined, paragraphs, table
from ninedof.report.pages import Page, machine_section, region_of
from ninedof.report.question import question
from ninedof.report.sheet_part import sheet_part
from ninedof.sheet.sheet import Sheet
from ninedof.support.units import with_unit


def of_front(front: Front, record: Any) -> Page:
    """Return the page of a trade-off."""
    limit = front.limit_name.replace("_", " ")
    asked = f"What does each value of {limit} cost? The study below is solved once for each."
    first = preferred(front)
    best, sheet, body, hint = None, None, None, ""
    if first is not None:
        best = front.results[first.number - 1]
        sheet = best.sheet()
        body, said = quick_body(best, f"RUN#{first.number}")
        hint = f"Point {first.number}. {said}"
    machines, start = _machines(front, best, sheet, body)
    sections = [
        Section("question", "Question", joined(paragraphs([asked]), question(front.study))),
        Section("answer", "Answer", _front_table(front)),
        *([machine_section(hint)] if machines else []),
    ]
    if first is not None and sheet is not None:
        said = f"Of point {first.number}, {first.words}. Each point has its own: ninedof sheet RUN#1 for the first."
        sections.append(Section("sheet", "Engineering sheet", joined(paragraphs([said]), sheet_part(sheet))))
    sections += [
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
    shown = scene.scene(machines, front.study.unit, start) if machines else None
    return Page("trade-off", headline, figures, sections, shown, bool(found) and not front.interrupted)


def _machines(
    front: Front, shown: Result | None, sheet: Sheet | None, body: Mapping[str, Any] | None
) -> tuple[list[dict[str, Any]], int]:
    """Return a machine for each point with a design, and the place of the one with the sheet."""
    machines: list[dict[str, Any]] = []
    start, limit = 0, front.limit_name.replace("_", " ")
    for k, (x, result) in enumerate(zip(front.limits, front.results, strict=True), start=1):
        if (b := result.best) is None or math.isnan(front.objectives[k - 1]):
            continue
        title, length = f"point {k}: {limit} {_limit(front, x)}", b.characteristic_length
        lines = region_of(result.study, b.configuration)
        if sheet is not None and result is shown:
            start, poses = len(machines), scene.worst_poses(sheet)
            machines.append(scene.machine(title, b.geometry, sheet.configurations, length, poses, lines, body))
        else:
            machines.append(scene.machine(title, b.geometry, b.configuration, length, lines=lines))
    return machines, start


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
    return table("The least objective for each limit", head, rows, (5,))


def _limit(front: Front, value: float) -> str:
    return f"{math.degrees(value) if front.unit == 'rad' else value:.5g}"
