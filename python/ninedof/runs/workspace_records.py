"""Workspaces in run folders: `record.json` with what was asked and the numbers, `map.npz` with the cells."""

from __future__ import annotations

import os
from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from ninedof.chunks.store import write_whole
from ninedof.runs.records import FILE, to_json, versions
from ninedof.workspace import WorkspaceMap

__all__ = ["write_workspace"]

FORMAT = "ninedof-workspace-record-1"
MAP = "map.npz"


def write_workspace(
    found: WorkspaceMap, asked: Mapping[str, Any], directory: str | os.PathLike[str], files: tuple[str, ...] = ()
) -> Path:
    """Write the record of a workspace into an existing directory and return its path.

    Parameters
    ----------
    found : WorkspaceMap
    asked : mapping
        The robot and the arguments, as plain values.
    directory : path
    files : tuple of str
        Names of the figures beside the record.

    """
    folder = Path(directory)
    found.save(folder / MAP)
    data = {
        "format": FORMAT,
        "asked": asked,
        "workspace": found.to_dict(),
        "versions": versions(),
        "created": datetime.now(UTC).isoformat(timespec="seconds"),
        "files": [MAP, *files],
    }
    write_whole(folder / FILE, (to_json(data) + "\n").encode())
    return folder / FILE
