"""`export`: one design as a file of another program."""

from __future__ import annotations

import inspect
import os
from pathlib import Path
from typing import Any

from ninedof.export.formats import format_named
from ninedof.export.model import model_of
from ninedof.support.arguments import known_keys, path_argument
from ninedof.support.files import write_whole


def export(design: Any, format: str, path: str | os.PathLike[str], *, unit: str | None = None, **options: Any) -> Path:
    """Write a design as a file of another program.

    Parameters
    ----------
    design : Result, Candidate, DesignPoint, or a design of a file
        The best design of a result. What `load` returns for a design file, a run of `optimize` or a point of a front.
    format : {"mjcf", "urdf", "sdf", "csv", "step", "dxf", "c", "latex"}
        What each file holds is on the page of exports.
    path : path
        The file; one that exists is replaced. "urdf" writes a second file beside it, with the suffix .loops.json.
    unit : str, optional
        Name of the length unit; that of the study or of the design file by default. "mjcf", "urdf" and "sdf" are in
        metres where it is known, and in the numbers of the design where it is not.
    options : keywords
        Of the format. "mjcf", "urdf" and "sdf": `leg_mass` (1 by default) and `platform_mass` (5 by default), in kg.
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
    >>> found = nd.optimize(nd.Study.paper())
    >>> with tempfile.TemporaryDirectory() as empty:
    ...     nd.export(found, "mjcf", pathlib.Path(empty) / "robot.xml").name
    'robot.xml'

    """
    module, taken = format_named(format).load(), options_of(format)
    if options and not taken:
        raise ValueError(f"options: got {', '.join(options)}, expected none: {format} takes no options")
    known_keys("options", options, taken)
    file = path_argument("path", path)
    if not file.absolute().parent.is_dir():
        raise ValueError(f"path: got {file}, expected a file in a folder that exists")
    model = model_of(design, file.name.split(".")[0], unit)
    contents = {file: module.text(model, **options)}
    if hasattr(module, "beside"):
        contents |= {file.with_suffix(f".{suffix}"): text for suffix, text in module.beside(model).items()}
    for place, text in contents.items():
        write_whole(place, text if isinstance(text, bytes) else text.encode())
    return file


def options_of(format: str) -> list[str]:
    """Return the names of the options that a format takes."""
    return [name for name in inspect.signature(format_named(format).load().text).parameters if name != "model"]
