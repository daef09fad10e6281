"""The text of the page of a run: what `report` loads when it is called."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from ninedof.optimize.result import Result
from ninedof.paper.comparison import comparison_table
from ninedof.pareto import Front
from ninedof.proof.machine_record import MachineCertificate
from ninedof.records.certificate import certificate_file, load_certificate
from ninedof.records.load import load
from ninedof.records.record import Record, load_record
from ninedof.report import origin
from ninedof.report.figures import figures, image, stems
from ninedof.report.front import of_front
from ninedof.report.optimization import of_result
from ninedof.report.page import Page, page
from ninedof.report.recorded import FROM_RECORD, of_recorded
from ninedof.report.workspace import of_workspace
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.tables.html import Html, html_of, joined
from ninedof.workspace import WorkspaceMap

STILL = "mechanism"


def page_of_result(run: Result | Front, name: str) -> str:
    """Return the page of a result in memory."""
    record = Record("front" if isinstance(run, Front) else "optimization", run.study, {})
    return _text(_page_of(run, record, name), record, None, name)


def page_of_path(place: Path, point: str, run: str | os.PathLike[str]) -> str:
    """Return the page of a run folder, or of one point of it; `run` names both."""
    folder = place if place.is_dir() else place.parent
    name = folder.resolve().name + (f"#{point}" if point else "")
    record = load_record(place)
    contents = None if record.kind in FROM_RECORD and not point else load(run)
    whole = load(place) if point else None
    certificate = _certificate_of(contents, run) if isinstance(contents, Result) else None
    contents_page = _page_of(contents, record, name, point, whole, certificate)
    return _text(contents_page, record, None if point else folder, name)


def _certificate_of(contents: Result, run: str | os.PathLike[str]) -> MachineCertificate | None:
    """Return what `ninedof certify` proved of a run, if it did."""
    file = certificate_file(run)
    if not file.is_file():
        return None
    certificate = load_certificate(run)
    if not contents.is_certified_by(certificate):
        raise ValueError(
            f"{file}: got a certificate of another machine, expected that of the run: once it is removed, `ninedof "
            f"certify {os.fspath(run)}` writes it anew"
        )
    return certificate


def _page_of(
    contents: Any,
    record: Record,
    name: str,
    point: str = "",
    whole: Any = None,
    certificate: MachineCertificate | None = None,
) -> Page:
    """Return the page of what a record holds, or of one point of the whole."""
    if isinstance(contents, Front):
        return of_front(contents, record)
    if isinstance(contents, WorkspaceMap):
        return of_workspace(contents, record)
    if not isinstance(contents, Result):
        return of_recorded(record, name)
    again = origin.of_front(whole, record, point) if isinstance(whole, Front) else None
    page_ = of_result(contents, record, f"RUN#{point}" if point else "RUN", again, certificate)
    if record.kind != "comparison" or point:
        return page_
    published = html_of(comparison_table(record.results["designs"]))
    return replace(page_, sections={**page_.sections, "answer": joined(published, page_.sections["answer"])})


def _text(contents: Page, record: Record, folder: Path | None, name: str) -> str:
    with TemporaryDirectory() as spare:
        still = Html()
        if contents.shown is not None:
            has_still = folder is not None and STILL in stems(folder)
            still = image(folder if folder and has_still else _drawn(contents.shown, Path(spare)), STILL)
        return page(contents, name, record.created, Html() if folder is None else figures(folder), still)


def _drawn(scene: Any, folder: Path) -> Path:
    """Draw the machine shown first, at its first pose; return the folder of the figure."""
    from ninedof import plot

    one = scene["machines"][scene["start"]]
    pose = one["poses"][0]
    g = Geometry(*(one[body][k : k + 3] for body in ("base", "platform") for k in (0, 3)))
    c = Configuration(pose["p"], pose["q"], pose["s"])
    plot.save(plot.mechanisms([plot.Robot(one["name"], g, c)], scene["unit"]), folder, STILL)
    return folder
