"""Run folders of all kinds, written and read. Each has a `record.json` of one form.

The record has `format`, `kind`, `study` or `question` (what was asked), `results`, `versions`, `created`, `command` if
one made it, `files`: the names of the arrays and figures beside it, and `digest`, which tells a record that was
changed. It is written whole or not at all, before the figures are drawn.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from ninedof.design.study import Study
from ninedof.optimize.result import Result, result_from
from ninedof.paper.comparison import Comparison
from ninedof.pareto import Front
from ninedof.proof.optimum import FILE as CERTIFICATE
from ninedof.runs.describe import describe_comparison, describe_front, front_from
from ninedof.support.arguments import choice, table
from ninedof.support.command import command_line
from ninedof.support.fields import entries_of
from ninedof.support.json import decode
from ninedof.support.reading import JSON, read_text
from ninedof.support.seal import unsealed, write_sealed
from ninedof.support.versions import versions
from ninedof.sweep import SweepResult
from ninedof.workspace import CertifiedWorkspace, WorkspaceMap

FORMAT = "ninedof-record-3"
STUDIES_1, WORKSPACES_1 = "ninedof-record-1", "ninedof-workspace-record-1"
EARLIER = ("ninedof-record-2", STUDIES_1, WORKSPACES_1)  # of earlier releases: without a digest
FILE = "record.json"

Run = Result | Comparison | Front | WorkspaceMap | SweepResult
CERTIFIED = "certified.npz"  # beside the map of a workspace
KINDS = ("optimization", "comparison", "front", "workspace", "sweep", "atlas", "motion", "paper")
OF_A_STUDY = ("optimization", "comparison", "front")
ARRAYS = {"workspace": "map.npz", "sweep": "sweep.npz", "atlas": "atlas.npz"}


@dataclass(frozen=True)
class Record:
    """A run: what was asked, with which versions, what came out."""

    kind: str
    """"optimization", "comparison" (with the published optimum), "front", "workspace", "sweep", "atlas",
    "motion" or "paper"."""
    asked: Study | Mapping[str, Any]
    """The study, or the question as plain values."""
    results: Mapping[str, Any]
    """Named results as plain values."""
    versions: Mapping[str, str] = field(default_factory=versions)
    created: str = field(default_factory=lambda: datetime.now(UTC).isoformat(timespec="seconds"))
    files: tuple[str, ...] = ()
    """Arrays and figures beside the record."""
    command: str = field(default_factory=command_line)
    """The command line that made the run; "" without one, and in records of earlier releases."""

    @property
    def study(self) -> Study:
        """The study.

        Raises
        ------
        ValueError
            If the run was none of a study.

        """
        if not isinstance(self.asked, Study):
            raise ValueError(f"got the record of a run of kind {self.kind}, expected one with a study")
        return self.asked


def write_run(
    run: Run,
    directory: str | os.PathLike[str],
    draw: Callable[[Path], Sequence[Path]] | None = None,
    asked: Mapping[str, Any] | None = None,
    results: Mapping[str, Any] | None = None,
) -> Path:
    """Write a run into an existing directory; return the path of its record.

    Parameters
    ----------
    run : Result, Comparison, Front, WorkspaceMap or SweepResult
    directory : path
    draw : callable, optional
        Called with the directory after the record was written; draws figures there and returns their paths.
    asked : mapping, optional
        What was asked, where the run does not hold it itself: of a workspace.
    results : mapping, optional
        What the record says of a sweep or an atlas; the arrays lie beside it.

    """
    folder = Path(directory)
    record = _record_of(run, asked or {}, results or {})
    if isinstance(run, WorkspaceMap | SweepResult):
        run.save(folder / ARRAYS[record.kind])
        record = replace(record, files=(ARRAYS[record.kind],))
    if isinstance(run, WorkspaceMap) and run.certified is not None:
        record = replace(record, files=(*record.files, run.certified.save(folder / CERTIFIED).name))
    result = run.result if isinstance(run, Comparison) else run
    if isinstance(result, Result) and result.proof is not None and result.proof.certificate:
        record = replace(record, files=(result.proof.save(folder / CERTIFICATE).name,))
    return write_drawn(record, folder, draw)


def write_drawn(record: Record, folder: Path, draw: Callable[[Path], Sequence[Path]] | None) -> Path:
    """Write a record, then draw, then write it with the names of the figures; return its path."""
    path = write_record(record, folder)
    if draw is not None:
        write_record(replace(record, files=(*record.files, *(file.name for file in draw(folder)))), folder)
    return path


def _record_of(run: Run, asked: Mapping[str, Any], results: Mapping[str, Any]) -> Record:
    if isinstance(run, Result):
        return Record("optimization", run.study, {"optimization": run.to_dict()})
    if isinstance(run, Comparison):
        return Record("comparison", run.result.study, describe_comparison(run))
    if isinstance(run, Front):
        return Record("front", run.study, {"front": describe_front(run)})
    if isinstance(run, WorkspaceMap):
        return Record("workspace", asked, {"workspace": run.to_dict()})
    question = {name: value for name, value in run.attributes.items() if name not in versions()}
    return Record("atlas" if run.attributes.get("kind") == "atlas" else "sweep", question, results)


def load(path: str | os.PathLike[str]) -> Result | Front | WorkspaceMap | SweepResult:
    """Read what a run folder holds, of every kind but a motion: `ninedof.load` reads those too.

    Parameters
    ----------
    path : path
        The folder or its record.json.

    Returns
    -------
    Result, Front, WorkspaceMap or SweepResult
        Robots are made anew from their variables; all other numbers are those written.

    Raises
    ------
    ValueError
        If there is no such record, or it is not whole; the message names the file.

    """
    record = load_record(path)
    if record.kind in ARRAYS:
        return _arrays(record, Path(path))
    study = record.study  # a run of another kind has none
    name = "front" if record.kind == "front" else "optimization"
    if name not in record.results:
        raise ValueError(f"{os.fspath(path)}: results: got a {record.kind} without {name}, expected a whole one")
    found = table(f"{os.fspath(path)}: results.{name}", record.results[name])
    try:
        return front_from(study, found) if name == "front" else result_from(study, found)
    except ValueError as error:
        raise ValueError(f"{os.fspath(path)}: results.{name}: {error}") from None


def _arrays(record: Record, place: Path) -> WorkspaceMap | SweepResult:
    """Return a run whose numbers lie in files beside its record."""
    folder = place if place.is_dir() else place.parent
    if record.kind != "workspace":
        return SweepResult.load(folder / ARRAYS[record.kind])
    found = WorkspaceMap.load(folder / ARRAYS[record.kind])
    certified = CertifiedWorkspace.load(folder / CERTIFIED) if CERTIFIED in record.files else None
    if certified is not None and certified.estimate not in (None, (found.volume, found.error)):
        raise ValueError(f"{folder / CERTIFIED}: got what is proved of another map, expected that of this run")
    return replace(found, certified=certified)


def write_record(record: Record, directory: str | os.PathLike[str]) -> Path:
    """Write `record.json` into an existing directory and return its path."""
    study = isinstance(record.asked, Study)
    data = {
        "format": FORMAT,
        "kind": record.kind,
        "study" if study else "question": record.study.to_dict() if study else record.asked,
        "results": record.results,
        "versions": record.versions,
        "created": record.created,
        **({"command": record.command} if record.command else {}),
        "files": record.files,
    }
    return write_sealed(Path(directory) / FILE, data, JSON)


def load_record(path: str | os.PathLike[str]) -> Record:
    """Read a record from its file or its directory; those of earlier releases too.

    Raises
    ------
    ValueError
        If there is no record, or it is not one of ours; the message names the file.

    """
    file = Path(path)
    if file.is_dir():
        file = file / FILE
    try:
        data = decode(read_text(file, JSON))
    except OSError as error:
        raise ValueError(f"{file}: cannot be read ({error.strerror})") from None
    except ValueError as error:
        raise ValueError(f"{file}: not a JSON file: {error}") from None
    if not isinstance(data, dict) or data.get("format") not in (FORMAT, *EARLIER):
        raise ValueError(f"{file}: got no {FORMAT!r} mark, expected a record written by ninedof")
    data = unsealed(data, file, required=data["format"] == FORMAT)
    try:
        return _record(data)
    except ValueError as error:
        raise ValueError(f"{file}: {error}") from None


def _record(data: dict[str, Any]) -> Record:
    """Return the record of plain values, those of earlier releases too; raise ValueError naming the entry."""
    if data["format"] == WORKSPACES_1:
        data |= {"kind": "workspace", "question": data.get("asked"), "results": {"workspace": data.get("workspace")}}
    elif data["format"] == STUDIES_1:
        data["kind"] = _kind(table("results", data.get("results")))
    asked = Study.from_dict(data["study"]) if "study" in data else table("question", data.get("question"))
    if missing := [name for name in ("kind", "versions", "created", "files") if name not in data]:
        raise ValueError(f"{missing[0]}: got none, expected that of the run")  # not that of the program that reads it
    known = entries_of(Record, data, skipped=["asked", "results"])
    choice("kind", known["kind"], KINDS)
    if known["kind"] in OF_A_STUDY and not isinstance(asked, Study):
        raise ValueError(f"study: got none, expected that of a record of kind {known['kind']}")
    return Record(**known, asked=asked, results=table("results", data.get("results")))


def _kind(results: Mapping[str, Any]) -> str:
    """Return the kind of a run of a study from the names of its results."""
    return "front" if "front" in results else "comparison" if "designs" in results else "optimization"
