"""What the page says of each kind of run: headline and sections."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ninedof.design.region_outline import region_lines
from ninedof.design.study import Study
from ninedof.optimize.result import Result, Status
from ninedof.optimize.result_html import SHOWN
from ninedof.proof.machine_record import MachineCertificate
from ninedof.report import origin, proof, scene
from ninedof.report.answer import answer
from ninedof.report.body import quick_body
from ninedof.report.markup import Html, Section, paragraphs
from ninedof.report.question import question
from ninedof.report.sheet_part import sheet_part
from ninedof.robot.configuration import Configuration
from ninedof.sheet.sheet import Sheet
from ninedof.support.arrays import Floats


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


def of_result(
    result: Result,
    record: Any,
    run: str = "RUN",
    again: Html | None = None,
    certificate: MachineCertificate | None = None,
) -> Page:
    """Return the page of an optimization; `again` says how to reproduce it, where its study alone does not.

    `run` is the run in the commands of the page: "RUN#7" for a point of a front.
    """
    best, study = result.best, result.study
    sections = [Section("question", "Question", question(study)), Section("answer", "Answer", answer(result))]
    shown, found = None, None
    if best is not None and result.status != Status.UNBOUNDED:  # without a least value there is no design to build
        found = result.sheet()
        body, said = quick_body(result, run)
        sections += [machine_section(said), Section("sheet", "Engineering sheet", sheet_part(found))]
        shown = _scene(result, found, body)
    if again is None:
        again = origin.of_study(study, "ninedof optimize study.toml", record)
    sections += [
        Section("proof", "What is proved, and what is searched", proof.of_result(result, certificate)),
        Section("again", "How to reproduce it", again),
    ]
    headline = f"{_capital(study.words)}: no design" if found is None else _capital(result.words)
    return Page("optimization", headline, _key_figures(result, found), sections, shown, result.status == Status.OPTIMAL)


def _scene(result: Result, found: Sheet, body: Mapping[str, Any] | None) -> dict[str, Any]:
    best, study = result.best, result.study
    assert best is not None
    poses = scene.worst_poses(found)
    lines = region_of(study, best.configuration)
    length = best.characteristic_length
    machines = [scene.machine("best design", best.geometry, found.configurations, length, poses, lines, body)]
    for k, other in enumerate(result.candidates[1:SHOWN], start=2):
        home, length = other.configuration, other.characteristic_length
        machines.append(scene.machine(f"optimum no. {k}", other.geometry, home, length, lines=region_of(study, home)))
    return scene.scene(machines, study.unit)


def region_of(study: Study, home: Configuration) -> list[Floats]:
    """Return the region of a study about a home pose as lines; none without a region."""
    region = study.objective.region
    return [] if region is None else region_lines(region, home)


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
