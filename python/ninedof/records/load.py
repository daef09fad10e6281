"""Runs and designs as objects: `load` returns what a path names, `save` writes it there."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

from ninedof.motion import Followed
from ninedof.optimize.pareto import Front
from ninedof.optimize.result import Result, with_fixed_design
from ninedof.records.design_file import Design, load_design, save_design
from ninedof.support.arguments import path_argument, shown
from ninedof.sweep import SweepResult
from ninedof.workspace import WorkspaceMap

POINT = "#"

Loaded = Result | Front | WorkspaceMap | SweepResult | Followed | Design


def load(path: str | os.PathLike[str]) -> Loaded:
    """Read what a path names: a run folder, one point of it, or a design file.

    Parameters
    ----------
    path : path
        A run folder or its record.json; a design file (TOML), or one that `export` wrote as MJCF (.xml) or as
        coordinates (.csv); or "RUN#7", point 7 of the front in the folder RUN, counted from 1 as its table numbers
        them. Of an optimization "RUN#2" is the second-best optimum.

    Returns
    -------
    Result, Front, WorkspaceMap, SweepResult, Followed or Design
        An atlas is a SweepResult; a point of a front is a Result, whose study has the limit of that point; a design
        file is a Design. Robots are made anew from their variables; all other numbers are those written.

    Raises
    ------
    ValueError
        If there is no such record, file or point, or it is not whole; the message names it.

    See Also
    --------
    save : the reverse.

    Examples
    --------
    >>> import tempfile
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> swept = nd.sweep(g, nd.Configuration.neutral(3.9828, 2.4432), {"x_p": (-1.0, 1.0, 5)})
    >>> with tempfile.TemporaryDirectory() as empty:
    ...     path = nd.save(swept, empty)
    ...     nd.load(empty)
    <SweepResult condition_number(x_p: 5)>

    """
    from ninedof.export.export import read_design, readable  # with the formats, when they are needed
    from ninedof.records.record import load_run

    path_argument("path", path)
    place, point = split(os.fspath(path))
    if place.suffix == ".toml" or place.suffix.lower() in readable():
        if point:
            raise ValueError(f"{os.fspath(path)}: got a point of a design file, expected one of a run")
        return load_design(place) if place.suffix == ".toml" else Design(*read_design(place))
    if place.suffix and place.suffix != ".json" and place.is_file():
        endings = ", ".join([".toml", *readable()])
        raise ValueError(f"{place}: got a file that ends in {place.suffix}, expected {endings}, or a run folder")
    run = load_run(place)
    return _point(run, point, os.fspath(path)) if point else run


def save(run: Loaded, path: str | os.PathLike[str]) -> Path:
    """Write what a run or a design is, so that `load` gives it back.

    Parameters
    ----------
    run : Result, Front, WorkspaceMap, SweepResult, Followed or Design
    path : path
        The run folder, new or empty: a run never overwrites another. A Design is written as a TOML file.

    Returns
    -------
    pathlib.Path
        Of the record in the folder, or of the design file.

    Raises
    ------
    ValueError
        If the folder exists and is not empty, or it is no run.
    OSError
        If the folder cannot be made or written.

    See Also
    --------
    load : the reverse, with an example.

    """
    from ninedof.records.record import write_run  # with all kinds of runs, when they are needed

    path_argument("path", path)
    if isinstance(run, Design):
        if Path(path).is_dir():
            raise ValueError(f"path: got the folder {os.fspath(path)}, expected a file name for a design")
        return save_design(run, path)
    if not isinstance(run, Result | Front | WorkspaceMap | SweepResult | Followed):
        raise ValueError(f"run: got {shown(run)}, expected a run or a design")
    folder = Path(path)
    if os.path.lexists(folder) and not (folder.is_dir() and not any(folder.iterdir())):
        raise ValueError(f"path: got {folder}, which exists and is not an empty folder, expected a new one")
    folder.mkdir(parents=True, exist_ok=True)
    return write_run(run, folder)


def design_and_result(run: object, name: str) -> tuple[Design, Result | None]:
    """Return the design of what `load` returned for a name, and the result that it is the best of."""
    if isinstance(run, Design):
        return run, None
    if isinstance(run, Front):
        points = "RUN" if name == "design" else name
        which = f": {points}#1 to {points}#{len(run)}" if len(run) else ""
        raise ValueError(f"{name}: got a front{'' if which else ' without a point'}, expected one of its points{which}")
    if not isinstance(run, Result):
        what = shown(run) if name == "design" else "a run without a design"
        raise ValueError(f"{name}: got {what}, expected a design file, a Design or a run with a design")
    result, study = with_fixed_design(run), run.study
    if (best := result.best) is None:
        raise ValueError(f"{name}: the record holds no design: {run.reason}")
    length = best.characteristic_length
    return Design(best.geometry, best.configuration, length, study.unit, study.tool), result


def split(name: str) -> tuple[Path, str]:
    """Return the path and the point of "RUN#7"; no point where there is none, or a file has this name."""
    before, mark, point = name.rpartition(POINT)
    return (Path(before), point) if mark and before and not Path(name).exists() else (Path(name), "")


def _point(run: Loaded, point: str, name: str) -> Result:
    if isinstance(run, Front):
        points, what = run.results, "a front"
    elif isinstance(run, Result):
        points = tuple(replace(run, candidates=run.candidates[k:]) for k in range(len(run.candidates)))
        what = "an optimization"
    else:
        raise ValueError(f"{name}: got a point of a run that has none, expected a front or an optimization")
    number = int(point) if point.isdecimal() else 0
    if not 1 <= number <= len(points):
        expected = f"a number from 1 to {len(points)}" if points else "no number: it has no design"
        raise ValueError(f"{name}: got {point} of {what}, expected {expected}")
    return points[number - 1]
