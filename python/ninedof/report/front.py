"""The page of a trade-off: its table, a machine for each point, the sheet of the one to look at first."""

from __future__ import annotations

import math
from typing import Any

from ninedof.pareto import Front
from ninedof.pareto.front import front_table, limit_text, preferred
from ninedof.report import origin, proof, scene
from ninedof.report.body import quick_body
from ninedof.report.optimization import design_machine, sheet_html
from ninedof.report.page import Page
from ninedof.report.question import question
from ninedof.tables.html import html_of, joined, paragraphs


def of_front(front: Front, record: Any) -> Page:
    """Return the page of a trade-off."""
    limit = front.limit_name.replace("_", " ")
    sentence = f"What does each value of {limit} cost? The study below is solved once for each."
    sections = {
        "question": joined(paragraphs([sentence]), question(front.study)),
        "answer": html_of(front_table(front)),
        "proof": proof.of_front(front),
        "again": origin.of_front(front, record),
    }
    of_first: tuple[Any, ...] = ()
    first, shown, hint = preferred(front), None, ""
    if first is not None:
        best = front.results[first.number - 1]
        shown, sheet = best.best, best.sheet()
        body, words = quick_body(best, f"RUN#{first.number}")
        of_first, hint = (sheet, body), f"Point {first.number}. {words}"
        sentence = f"Of point {first.number}, {first.words}. Each point has its own: ninedof sheet RUN#1 for the first."
        sections["sheet"] = joined(paragraphs([sentence]), sheet_html(sheet))
    machines: list[dict[str, Any]] = []
    start = 0
    for k, (x, result, value) in enumerate(zip(front.limits, front.results, front.objectives, strict=True), start=1):
        if result.best is None or math.isnan(value):
            continue
        title = f"point {k}: {limit} {limit_text(front, x)}"
        is_first = result.best is shown
        start = len(machines) if is_first else start
        machines.append(design_machine(title, result.best, result.study, *(of_first if is_first else ())))
    if machines:
        sections["machine"] = paragraphs([hint])
    values = [x for x in front.objectives if not math.isnan(x)]
    figures = [
        ("limits solved", len(front)),
        ("objective", f"{max(values):.6f} to {min(values):.6f}" if values else "no design"),
        ("interrupted", "yes" if front.interrupted else "no"),
    ]
    headline = f"{front.study.words[:1].upper()}{front.study.words[1:]} against {limit}"
    view = scene.scene(machines, front.study.unit, start) if machines else None
    machine = None if shown is None else (shown.geometry, shown.configuration)
    return Page("trade-off", headline, figures, sections, view, bool(values) and not front.interrupted, machine)
