"""What the page says of each kind of run: headline and sections."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ninedof.optimize.result import Result, Status
from ninedof.report import origin, proof, scene
from ninedof.report.answer import answer
from ninedof.report.markup import Html, Section, paragraphs
from ninedof.report.question import question
from ninedof.report.sheet_part import sheet_part
from ninedof.sheet.sheet import Sheet


@dataclass(frozen=True)
class Page:
    """The contents of a page."""

    kind: str
    headline: str
    figures: Sequence[tuple[object, object]]
    """Names and values under the headline."""
    sections: Sequence[Section]
    shown: Mapping[str, Any] | None = None
    """What the view shows; None without a machine."""
    good: bool = True


def machine_section(hint: str = "") -> Section:
    """Return the place of the view; `page` fills it."""
    return Section("machine", "Machine", paragraphs([hint] if hint else []))


def of_result(result: Result, record: Any, name: str, again: Html | None = None) -> Page:
    """Return the page of an optimization; `again` says how to reproduce it, where its study alone does not."""
    best, study = result.best, result.study
    sections = [Section("question", "Question", question(study)), Section("answer", "Answer", answer(result))]
    shown, found = None, None
    if best is not None and result.status != Status.UNBOUNDED:  # without a least value there is no design to build
        found = result.sheet()
        sections += [machine_section(), Section("sheet", "Engineering sheet", sheet_part(found))]
        shown = _scene(result, found)
    if again is None:
        again = origin.of_study(study, "ninedof optimize study.toml", record)
    sections += [
        Section("proof", "What is proved, and what is searched", proof.of_result(result)),
        Section("again", "How to reproduce it", again),
    ]
    headline = f"{_capital(study.words)}: no design" if found is None else _capital(study.words)
    return Page("optimization", headline, _key_figures(result, found), sections, shown, result.status == Status.OPTIMAL)


def _scene(result: Result, found: Sheet) -> dict[str, Any]:
    best, study = result.best, result.study
    assert best is not None
    machines = [
        scene.machine(
            "best design", best.geometry, found.configurations, best.characteristic_length, scene.worst_poses(found)
        )
    ]
    for k, other in enumerate(result.candidates[1:4], start=2):
        machines.append(
            scene.machine(f"optimum no. {k}", other.geometry, other.configuration, other.characteristic_length)
        )
    region = study.objective.region
    lines = [] if region is None else scene.region_lines(region, best.configuration)
    return scene.scene(machines, study.unit, lines)


def _key_figures(result: Result, found: Sheet | None) -> list[tuple[object, object]]:
    best = result.best
    if best is None or found is None:
        return [("status", result.status), ("because of", ", ".join(result.causes) or "none found")]
    rows: list[tuple[object, object]] = [("status", result.status), ("objective", f"{best.objective:.6f}")]
    if abs(best.condition_number - best.objective) > 1e-9:
        rows.append(("condition number, neutral pose", f"{best.condition_number:.6f}"))
    rows.append(("limits reached", ", ".join(name.replace("_", " ") for name in best.active) or "none"))
    return rows


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]
