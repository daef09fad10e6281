"""`report`: a run as one page of HTML that needs nothing else."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from ninedof.optimize.result import Result
from ninedof.paper.tables import comparison_table
from ninedof.pareto import Front
from ninedof.proof.machine_record import MachineCertificate
from ninedof.records.certificate import certificate_file, load_certificate
from ninedof.records.load import load, split
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
from ninedof.support.arguments import path_argument, shown
from ninedof.support.files import write_whole
from ninedof.tables.html import Html, html_of, joined
from ninedof.workspace import WorkspaceMap

FILE = "report.html"
STILL = "mechanism"
ODD = (LookupError, TypeError, AttributeError, ArithmeticError)
"""Raised by values of another kind than the record of a run has: entries that are missing, words for numbers."""


def report(run: Result | Front | str | os.PathLike[str], path: str | os.PathLike[str] | None = None) -> Path:
    """Write a run as one page of HTML: question, answer, machine, sheet, figures, what is proved, how to reproduce it.

    The page loads nothing from anywhere. The machine is drawn in the browser and can be turned by hand.

    Parameters
    ----------
    run : path, Result or Front
        A run folder or its record.json, one point of it as "RUN#7", or a result in memory, which has no figures.
    path : path, optional
        The file to write; by default report.html in the run folder, or report-7.html for point 7. For a result in
        memory it must be given.

    Returns
    -------
    pathlib.Path
        Of the page.

    Raises
    ------
    ValueError
        If there is no such run, or no path is given for a result in memory.

    Examples
    --------
    >>> import tempfile
    >>> import ninedof as nd
    >>> found = nd.optimize(nd.Study.paper(), starts=2)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     nd.report(found, folder + "/report.html").name
    'report.html'

    """
    if path is not None and not path_argument("path", path).absolute().parent.is_dir():
        raise ValueError(f"path: got {os.fspath(path)}, expected a file in a folder that exists")
    if not isinstance(run, Result | Front):
        path_argument("run", run)
    if isinstance(run, Result | Front):
        if path is None:
            raise ValueError("path: got none, expected the file to write for a result in memory")
        file = Path(path)
        record = Record("front" if isinstance(run, Front) else "optimization", run.study, {})
        text = _text(_page_of(run, record, file.stem), record, None, file.stem)
        return write_whole(file, text.encode())
    if not isinstance(run, str | os.PathLike):
        raise ValueError(f"run: got {shown(run)}, expected a run folder, a Result or a Front")
    place, point = split(os.fspath(run))
    if place.suffix == ".toml":
        raise ValueError(f"{place}: got a file of a design or study, expected a run folder")
    folder = place if place.is_dir() else place.parent
    name = folder.resolve().name + (f"#{point}" if point else "")
    file = folder / (f"report-{point}.html" if point else FILE) if path is None else Path(path)
    record = load_record(place)
    contents = None if record.kind in FROM_RECORD and not point else load(run)
    whole = load(place) if point else None
    certificate = _certificate_of(contents, run) if isinstance(contents, Result) else None
    made = _page_of(contents, record, name, point, whole, certificate)
    text = _text(made, record, None if point else folder, name)
    return write_whole(file, text.encode())


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
    made = of_result(contents, record, f"RUN#{point}" if point else "RUN", again, certificate)
    if record.kind != "comparison" or point:
        return made
    published = html_of(comparison_table(record.results["designs"]))
    return replace(made, sections={**made.sections, "answer": joined(published, made.sections["answer"])})


def _text(made: Page, record: Record, folder: Path | None, name: str) -> str:
    with TemporaryDirectory() as spare:
        still = Html()
        if made.shown is not None:
            has_still = folder is not None and STILL in stems(folder)
            still = image(folder if folder and has_still else _drawn(made.shown, Path(spare)), STILL)
        return page(made, name, record.created, Html() if folder is None else figures(folder), still)


def _drawn(scene: Any, folder: Path) -> Path:
    """Draw the machine shown first, at its first pose; return the folder of the figure."""
    from ninedof import plot

    one = scene["machines"][scene["start"]]
    pose = one["poses"][0]
    g = Geometry(*(one[body][k : k + 3] for body in ("base", "platform") for k in (0, 3)))
    c = Configuration(pose["p"], pose["q"], pose["s"])
    plot.save(plot.mechanisms([plot.Robot(one["name"], g, c)], scene["unit"]), folder, STILL)
    return folder
