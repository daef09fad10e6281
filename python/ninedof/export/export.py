"""One design as a file of another program, and the table of formats."""

from __future__ import annotations

import os
import sys
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ninedof.support.arguments import choice, known_keys, path_argument
from ninedof.support.kept.files import read_text, write_whole
from ninedof.support.structs import within

if TYPE_CHECKING:
    from ninedof.export.model import Fields, Format


def export(design: Any, format: str, path: str | os.PathLike[str], *, unit: str | None = None, **options: Any) -> Path:
    """Write a design as a file of another program.

    Parameters
    ----------
    design : Result, Candidate, DesignPoint, or a design of a file
        The best design of a result. What `load` returns for a design file, a run of `optimize` or a point of a front.
    format : {"c", "csv", "dxf", "latex", "mjcf", "sdf", "step", "urdf"}
        What each file holds is on the page of exports.
    path : path
        The file; one that exists is replaced. "urdf" writes a second file beside it, with the suffix .loops.json.
    unit : str, optional
        Name of the length unit; that of the study or of the design file by default. "mjcf", "urdf" and "sdf" are in
        metres where it is known, and in the numbers of the design where it is not.
    options : keywords
        Of the format. "mjcf", "urdf" and "sdf": `leg_mass` and `platform_mass` in kg; by default the `masses` of the
        study, and 1 and 5 where it has none.
        "mjcf": `gravity`, 0 by default, m/s² downward.

    Returns
    -------
    pathlib.Path
        Of the file.

    Raises
    ------
    ValueError
        If there is no design, no such format, no such option or no such folder; the message names it.
    ninedof.support.extras.MissingExtra
        If the format needs a package that is not installed.

    See Also
    --------
    load : reads "mjcf" and "csv" back as a design.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> import ninedof as nd
    >>> result = nd.optimize(nd.Study.paper())
    >>> with tempfile.TemporaryDirectory() as empty:
    ...     nd.export(result, "mjcf", pathlib.Path(empty) / "robot.xml").name
    'robot.xml'

    """
    row = formats()[choice("format", format, formats())]
    if options and not row.options:
        raise ValueError(f"options: got {', '.join(options)}, expected none: {format} takes no options")
    known_keys("options", options, row.options)
    file = path_argument("path", path)
    if not file.absolute().parent.is_dir():
        raise ValueError(f"path: got {file}, expected a file in a folder that exists")
    from ninedof.export.model import model_of  # with the formats, when they are needed

    model = model_of(design, file.name.split(".")[0], unit)
    contents = {file: row.text(model, **options)}
    if row.beside is not None:
        suffix, _, beside = row.beside
        contents[file.with_suffix(suffix)] = beside(model)
    for place, text in contents.items():
        write_whole(place, text.encode())
    return file


@cache
def formats() -> dict[str, Format]:
    """Return the formats by name: the constant `FORMAT` of every module of this room that has one."""
    from pkgutil import iter_modules

    modules = [import_module(f"ninedof.export.{one.name}") for one in iter_modules(sys.modules[__package__].__path__)]
    return {module.FORMAT.name: module.FORMAT for module in modules if hasattr(module, "FORMAT")}


def readable() -> list[str]:
    """Return the suffixes of files that `read_design` reads."""
    return [one.suffix for one in formats().values() if one.read is not None]


def read_design(path: Path) -> Fields:
    """Return the design in a file; ValueError naming the file and what is wrong with it."""
    (read,) = (one.read for one in formats().values() if one.suffix == path.suffix.lower() and one.read is not None)
    text = read_text(path)
    with within(path, ": "):
        return read(text)
