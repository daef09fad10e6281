"""Run folders of all kinds, written and read. Each has a `record.json` of one form.

The record has `format`, `kind`, `study` or `question` (what was asked), `results`, `versions`, `created`, `command` if
one made it, `files`: the names of the arrays and figures beside it, and `digest`. It is written whole or not at all,
before the figures are drawn.
"""

from __future__ import annotations

import itertools
import math
import os
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from ninedof.design.study import Study
from ninedof.motion import Followed
from ninedof.optimize.pareto import Front
from ninedof.optimize.pareto.limits import with_limit, without_degrees
from ninedof.optimize.result import Result, result_from
from ninedof.paper.comparison import PaperComparison
from ninedof.proof.optimum_proof import FILE as CERTIFICATE
from ninedof.records.motion import motion_values, write_tables
from ninedof.sheet.path_limits import PathLimits
from ninedof.support.extras import versions
from ninedof.support.kept.files import json_bytes, read_json, write_whole
from ninedof.support.kept.store import folder_of, require_run_or_nothing
from ninedof.support.running import command_line, goes_on
from ninedof.support.structs import entries_of
from ninedof.sweep import SweepResult
from ninedof.workspace import CertifiedWorkspace, WorkspaceMap
from ninedof.workspace.certified_record import CERTIFICATE as WORKSPACE_CERTIFICATE

RUNS = Path("runs")


@contextmanager
def run_folder(out: Path | None) -> Iterator[Path]:
    """Yield the folder of a run: `out`, which is missing, empty or that of a run to go on with, or runs/<time> here.

    Whether the run there has the same question is for its `Store` to say, which also makes `out`. A folder of runs/
    in which nothing is kept is removed. The command that is typed again goes on in the folder.
    """
    if out is not None:
        require_run_or_nothing(out)
        goes_on(out)
        yield out
        return
    folder = _of_now()
    goes_on(folder)
    try:
        yield folder
    finally:
        with suppress(OSError):
            folder.rmdir()
            RUNS.rmdir()


def _of_now() -> Path:
    stamp = datetime.now().strftime("%Y%m%d-%H%M%S")
    for attempt in itertools.count():
        path = RUNS / (f"{stamp}-{attempt}" if attempt else stamp)
        with suppress(FileExistsError):  # another run began in this second
            path.mkdir(parents=True)
            return path
    raise AssertionError("unreachable")


FILE = "record.json"

Run = Result | PaperComparison | Front | WorkspaceMap | SweepResult | Followed

CERTIFIED = "certified.npz"  # beside the map of a workspace
ARRAYS: dict[str, tuple[type[WorkspaceMap | SweepResult | Followed], str]] = {
    "workspace": (WorkspaceMap, "map.npz"),
    "sweep": (SweepResult, "sweep.npz"),
    "atlas": (SweepResult, "atlas.npz"),
    "motion": (Followed, "motion.npz"),
}
"""Kinds of runs whose numbers lie in a file beside the record."""


@dataclass(frozen=True)
class Record:
    """A run: what was asked, with which versions, what came out."""

    kind: str
    """"optimization", "comparison" (with the published optimum), "front", "workspace", "sweep", "atlas",
    "motion" or "paper"."""
    question: Study | Mapping[str, Any]
    """The study, or the question as plain values."""
    results: Mapping[str, Any]
    """Named results as plain values."""
    versions: Mapping[str, str] = field(default_factory=versions)
    created: str = field(default_factory=lambda: datetime.now(UTC).isoformat(timespec="seconds"))
    files: tuple[str, ...] = ()
    """Arrays and figures beside the record."""
    command: str = field(default_factory=command_line)
    """The command line that made the run; "" without one."""

    @property
    def study(self) -> Study:
        """The study; ValueError if the run was none of one."""
        if not isinstance(self.question, Study):
            raise ValueError(f"got the record of a run of kind {self.kind}, expected one with a study")
        return self.question


def write_run(
    run: Run,
    directory: str | os.PathLike[str],
    question: Mapping[str, Any] | None = None,
    results: Mapping[str, Any] | None = None,
    limits: PathLimits | None = None,
) -> Path:
    """Write a run into an existing directory; return the path of its record.

    One that was interrupted leaves the record of an earlier run as it is. `question` is what was asked where the run
    does not hold it: of a workspace or a motion, and of a sweep besides what it holds. `results` are what the record
    says of a sweep, an atlas or a motion, whose arrays lie beside it; `limits` those of a study along a motion.
    """
    folder = Path(directory)
    result = run.result if isinstance(run, PaperComparison) else run
    if getattr(result, "interrupted", False) and (folder / FILE).is_file():
        return folder / FILE
    record, files = _record_of(run, question or {}, results or {}), []
    if isinstance(run, Followed):
        files += write_tables(run, folder, limits)
    if isinstance(run, WorkspaceMap | SweepResult | Followed):
        files.append(run.save(folder / ARRAYS[record.kind][1]))
    if isinstance(run, WorkspaceMap) and run.certified is not None:
        files.append(run.certified.save(folder / CERTIFIED))
        if run.certified.certificate.size:
            files.append(run.certified.save_certificate(folder / WORKSPACE_CERTIFICATE))
    if isinstance(result, Result) and result.proof is not None and result.proof.certificate:
        files.append(result.proof.save(folder / CERTIFICATE))
    return write_record(replace(record, files=tuple(file.name for file in files)), folder)


def add_files(folder: Path, files: Iterable[Path]) -> None:
    """Add the names of figures and pages, made after the record was written, to it."""
    if names := [file.name for file in files]:
        record = load_record(folder)
        write_record(replace(record, files=(*record.files, *names)), folder)


def _record_of(run: Run, question: Mapping[str, Any], results: Mapping[str, Any]) -> Record:
    if isinstance(run, Result):
        return Record("optimization", run.study, {"optimization": run.to_dict()})
    if isinstance(run, PaperComparison):
        return Record("comparison", run.result.study, run.to_dict())
    if isinstance(run, Front):
        front = {**run.to_dict(), "results": [result.to_dict() for result in run.results]}
        return Record("front", run.study, {"front": front})
    if isinstance(run, WorkspaceMap):
        return Record("workspace", question, {"workspace": run.to_dict()})
    if isinstance(run, Followed):
        return Record("motion", question, results or {"motion": motion_values(run, None)})
    own = {name: value for name, value in run.attributes.items() if name not in versions()}
    question = {**question, **own}
    return Record("atlas" if run.attributes.get("kind") == "atlas" else "sweep", question, results)


def write_record(record: Record, directory: str | os.PathLike[str]) -> Path:
    """Write `record.json` into an existing directory and return its path."""
    question = (
        {"study": record.question.to_dict()} if isinstance(record.question, Study) else {"question": record.question}
    )
    others = {name: getattr(record, name) for name in ("results", "versions", "created", "command", "files")}
    if not record.command:
        del others["command"]
    return write_whole(Path(directory) / FILE, json_bytes("record", {"kind": record.kind, **question, **others}))


def load_record(path: str | os.PathLike[str]) -> Record:
    """Read a record from its file or its directory; ValueError names a file that is missing or was changed."""
    data = read_json(folder_of(path) / FILE if Path(path).is_dir() else Path(path), "record")
    question = Study.from_dict(data.pop("study")) if "study" in data else data.pop("question")
    return Record(**{"command": "", **data, "files": tuple(data["files"])}, question=question)


def load_run(path: str | os.PathLike[str]) -> Result | Front | WorkspaceMap | SweepResult | Followed:
    """Read what a run folder, or the record there, holds.

    Robots are made anew from their variables; all other numbers are those written.
    """
    record, folder = load_record(path), folder_of(path)
    if record.kind in ARRAYS:
        kind, name = ARRAYS[record.kind]
        run = kind.load(folder / name)
        if not isinstance(run, WorkspaceMap) or CERTIFIED not in record.files:
            return run
        certified = CertifiedWorkspace.load(folder / CERTIFIED)
        if certified.estimate not in (None, (run.volume, run.error)):
            raise ValueError(f"{folder / CERTIFIED}: got what is proved of another map, expected that of this run")
        return replace(run, certified=certified)
    study = record.study  # a run of another kind has none
    return _front(study, record) if record.kind == "front" else result_from(study, record.results["optimization"])


def _front(study: Study, record: Record) -> Front:
    data = record.results["front"]
    limits = tuple(float(row["limit"]) for row in data["rows"])
    fields = entries_of(Front, data, skipped=["study", "limits", "results"])
    plain, degrees = without_degrees(fields["against"])
    values = [None if math.isinf(limit) else math.radians(limit) if degrees else limit for limit in limits]
    each = zip(values, data["results"], strict=True)
    results = tuple(result_from(with_limit(study, plain, value), entries) for value, entries in each)
    return Front(study, **fields, limits=limits, results=results)
