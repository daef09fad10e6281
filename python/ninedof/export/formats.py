"""The table of file formats. A format is one module of this room; adding a row and the module adds a format.

A module has `text(model, **options)`, which returns the contents as str or bytes; the options are keywords with
defaults. It may have `beside(model)`, which returns further files as a mapping from suffix to contents: "loops.json"
is written as machine.loops.json beside machine.urdf.
"""

from __future__ import annotations

from importlib import import_module
from types import ModuleType
from typing import NamedTuple

from ninedof.support.arguments import choice


class Format(NamedTuple):
    """A row of the table."""

    module: str
    """In this room. Loaded when it is used, so that the others do without its packages."""
    suffix: str
    words: str
    """What the file is, for people."""
    mark: str = "written by ninedof"
    """What every such file holds."""
    beside: tuple[tuple[str, str], ...] = ()
    """Suffixes of the files beside it, with their marks."""

    def load(self) -> ModuleType:
        """Return the module that writes the format."""
        return import_module(f"ninedof.export.{self.module}")


FORMATS = {
    "mjcf": Format("mjcf", ".xml", "MuJoCo model with closed loops and nine actuators"),
    "urdf": Format(
        "urdf", ".urdf", "URDF tree, with the table of its loops beside it", beside=((".loops.json", "ninedof-loops-"),)
    ),
    "sdf": Format("sdf", ".sdf", "SDFormat model with closed loops"),
    "csv": Format("csv", ".csv", "coordinates of the joints", ",base x"),
    "step": Format("step", ".step", "STEP skeleton: points and axes", "'ninedof "),
    "dxf": Format("dxf", ".dxf", "drawing of the two plates", "NINEDOF"),
    "c": Format("c_header", ".h", "C header of constants with the inverse kinematics"),
    "latex": Format("latex", ".tex", "LaTeX tables"),
}
"""By name."""


def format_named(name: object) -> Format:
    """Return the row of a format, or raise ValueError naming those that exist."""
    return FORMATS[choice("format", name, FORMATS)]
