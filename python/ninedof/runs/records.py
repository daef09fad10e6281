"""What a run leaves behind: inputs, versions, seed and results in one JSON file, written whole or not at all."""

from __future__ import annotations

import json
import math
import os
import platform
from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np

from ninedof import _core
from ninedof.design.study import Study
from ninedof.optimize.result import Result

__all__ = ["Record", "load_record", "write_record"]

FORMAT = "ninedof-record-1"
FILE = "record.json"


@dataclass(frozen=True)
class Record:
    """A run: what was asked, with which versions, what came out."""

    study: Study
    results: Mapping[str, Any]
    """Named results as plain JSON values."""
    versions: Mapping[str, str] = field(default_factory=lambda: versions())
    created: str = field(default_factory=lambda: datetime.now(UTC).isoformat(timespec="seconds"))
    files: tuple[str, ...] = ()
    """Figures beside the record."""


def versions() -> dict[str, str]:
    """Return the versions a result depends on."""
    return {
        "ninedof": _core.version,
        "python": platform.python_version(),
        "numpy": np.__version__,
        "machine": platform.machine(),
        **_core.built_with,
    }


def describe_result(result: Result) -> dict[str, Any]:
    """Return a result as plain JSON values."""
    return result.to_dict()


def to_json(value: Any) -> str:
    """Return JSON text. JSON has no infinity: non-finite numbers are written as "inf", "-inf" and "nan"."""
    return json.dumps(_plain(value), indent=2, allow_nan=False)


def write_record(record: Record, directory: str | os.PathLike[str]) -> Path:
    """Write `record.json` into an existing directory, whole or not at all, and return its path."""
    path = Path(directory) / FILE
    # The fields one by one: dataclasses.asdict copies deeply, and the study's mappings are read-only views.
    data = {
        "format": FORMAT,
        "study": record.study.to_dict(),
        "results": record.results,
        "versions": record.versions,
        "created": record.created,
        "files": record.files,
    }
    temporary = path.with_name(f".{FILE}.{os.getpid()}")
    try:
        temporary.write_text(to_json(data) + "\n", encoding="utf-8")
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)
    return path


def load_record(path: str | os.PathLike[str]) -> Record:
    """Read a record from its file or its directory.

    Raises
    ------
    ValueError
        If there is no record, or it is not one of ours; the message names the file.

    """
    file = Path(path)
    if file.is_dir():
        file = file / FILE
    try:
        data = json.loads(file.read_text(encoding="utf-8"))
    except OSError as error:
        raise ValueError(f"{file}: cannot be read ({error.strerror})") from None
    except ValueError as error:
        raise ValueError(f"{file}: not a JSON file: {error}") from None
    if not isinstance(data, dict) or data.get("format") != FORMAT:
        raise ValueError(f"{file}: got no {FORMAT!r} mark, expected a record written by ninedof")
    try:
        study = Study.from_dict(_numbers(data["study"]))
        return Record(study, data["results"], data["versions"], data["created"], tuple(data["files"]))
    except (KeyError, TypeError) as error:
        raise ValueError(f"{file}: got a record without {error}, expected a whole one") from None
    except ValueError as error:
        raise ValueError(f"{file}: {error}") from None


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _plain(v) for key, v in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(v) for v in value]
    if isinstance(value, np.ndarray):
        return _plain(value.tolist())
    if isinstance(value, float | np.floating):
        return float(value) if math.isfinite(value) else repr(float(value))
    return value


def _numbers(value: Any) -> Any:
    """Undo the spelling of non-finite numbers."""
    if isinstance(value, dict):
        return {key: _numbers(v) for key, v in value.items()}
    if isinstance(value, list):
        return [_numbers(v) for v in value]
    return float(value) if value in ("inf", "-inf", "nan") else value
