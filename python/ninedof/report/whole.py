"""The text of the page of a run: what `report` loads when it is called."""

from __future__ import annotations

import os
import shlex
from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from ninedof.design.study import Study
from ninedof.optimize.pareto import Front
from ninedof.optimize.region_map import region_map
from ninedof.optimize.result import Result
from ninedof.paper.comparison import comparison_table
from ninedof.proof.machine_record import MachineCertificate
from ninedof.records.load import load
from ninedof.records.proofs import certificate_file, kept_certificates, load_certificate
from ninedof.records.record import Record, load_record
from ninedof.report import origin
from ninedof.report.optimization import of_front, of_result
from ninedof.report.page import OWN, Page, figure, figures, image, page, stems
from ninedof.report.recorded import FROM_RECORD, of_recorded, of_workspace
from ninedof.support.kept.store import folder_of
from ninedof.support.units import amount
from ninedof.tables.html import Html, html_of, joined
from ninedof.workspace import WorkspaceMap

STILL = "mechanism"


def page_of_result(run: Result | Front, name: str) -> str:
    """Return the page of a result in memory."""
    record = Record("front" if isinstance(run, Front) else "optimization", run.study, {})
    contents = of_front(run, record) if isinstance(run, Front) else of_result(run, record)
    return _text(contents, record, None, name, run)


def page_of_path(place: Path, point: str, run: str | os.PathLike[str]) -> str:
    """Return the page of a run folder, or of one point of it; `run` names both."""
    folder = folder_of(place)
    name = folder.resolve().name + (f"#{point}" if point else "")
    typed = shlex.quote(str(folder)) + (f"#{point}" if point else "")  # in a shell # within a word is no comment
    record = load_record(place)
    contents = None if record.kind in FROM_RECORD and not point else load(run)
    if isinstance(contents, Result):
        whole = load(place) if point else None
        again = origin.of_front(whole, record, point) if isinstance(whole, Front) else None
        certificate = _certificate_of(contents, run)
        page_ = of_result(contents, record, typed, again, certificate, _kept(contents, run, certificate))
        if record.kind == "comparison" and not point:
            published = html_of(comparison_table(record.results["designs"]))
            page_.sections["answer"] = joined(published, page_.sections["answer"])
    elif isinstance(contents, Front):
        page_ = of_front(contents, record, typed)
    elif isinstance(contents, WorkspaceMap):
        page_ = of_workspace(contents, record)
    else:
        page_ = of_recorded(record, name)
    return _text(page_, record, None if point else folder, name, contents)


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


def _kept(contents: Result, run: str | os.PathLike[str], shown: MachineCertificate | None) -> list[str]:
    """Return which certificates for other tolerances than those of the one shown a run keeps, a sentence each."""
    out = list[str]()
    for file, certificate in kept_certificates(certificate_file(run)).items():
        if not contents.is_certified_by(certificate) or (shown and shown.tolerances == certificate.tolerances):
            continue
        built = certificate.tolerances
        joints, legs = (amount(f"{x:.6g}", certificate.unit) for x in (built.joints, built.legs))
        of = f"for tolerances of {joints} for joint centres and {legs} for leg lengths"
        words = of if built else "of the machine as it is drawn"
        which = "every limit" if certificate.proved else "not every limit"
        out.append(f"Kept in {file.name}: a certificate {words}, by which {which} is proved.")
    return out


def _text(page_: Page, record: Record, folder: Path | None, name: str, run: Any) -> str:
    question = record.question
    if isinstance(question, Study):
        study = question
    else:  # title block, tool and unit, as far as it states them
        study = Study(**{name: question[name] for name in ("about", "tool", "unit") if name in question})
    with TemporaryDirectory() as spare:
        have = {} if folder is None else dict.fromkeys(stems(folder), folder)
        have = _drawn(page_, run, study, have, Path(spare)) | have
        drawn = {stem: figure(have[stem], stem) for stem in OWN if stem in have and page_.machine is not None}
        drawn["still"] = image(have[STILL], STILL) if STILL in have else Html()
        drawn["figures"] = Html() if folder is None else figures(folder)
        return page(page_, name, record.created, drawn, study)


def _drawn(page_: Page, run: Any, study: Study, have: Mapping[str, Path], folder: Path) -> dict[str, Path]:
    """Draw what the page shows and the folder of its run does not have; return the folder of each figure."""
    from ninedof import plot
    from ninedof.plot.files import save_as

    if page_.machine is None:
        return {}
    g, c = page_.machine
    unit = page_.shown["unit"] if page_.shown else ""
    new: dict[str, Any] = {}
    if STILL not in have:
        new[STILL] = plot.mechanisms([plot.Robot("neutral pose", g, c)], unit)
    if "drawing" not in have:
        new["drawing"] = plot.drawing(g, c, unit, study.tool)
    if "region" not in have and isinstance(run, Result) and (of_region := region_map(run)) is not None:
        new["region"] = plot.region_map(of_region)
    for stem, one in new.items():
        for suffix in (".png", ".svg"):  # of which the page takes one
            save_as(one, folder / f"{stem}{suffix}")
    return dict.fromkeys(new, folder)
