"""Designs read from files of other programs. A reader is one module with `read(path)`."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path

from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry

READERS = {".xml": "mjcf_reader", ".csv": "csv_reader"}
"""The module of this room that reads a file with this suffix."""

Read = tuple[Geometry, Configuration, float | str, str]
"""Geometry, neutral configuration, characteristic length and unit: the fields of a design of a file, in order."""


def read_design(path: Path) -> Read:
    """Return the design in a file; ValueError naming the file and what is wrong with it.

    The module's `read(path)` may raise OSError and ValueError; the name of the file is added here.
    """
    module = import_module(f"ninedof.export.{READERS[path.suffix.lower()]}")
    try:
        found: Read = module.read(path)
    except OSError as error:
        raise ValueError(f"{path}: cannot be read ({error.strerror or error})") from None
    except ValueError as error:
        text = str(error)
        raise ValueError(text if text.startswith(str(path)) else f"{path}: {text}") from None
    return found
