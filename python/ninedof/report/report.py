"""`report`: a run as one page of HTML that needs nothing else."""

from __future__ import annotations

import os
from pathlib import Path

from ninedof.optimize.pareto import Front
from ninedof.optimize.result import Result
from ninedof.records.load import split
from ninedof.support.arguments import path_argument
from ninedof.support.kept.files import write_whole
from ninedof.support.kept.store import folder_of

FILE = "report.html"


def report(run: Result | Front | str | os.PathLike[str], path: str | os.PathLike[str] | None = None) -> Path:
    """Write a run as one page of HTML: question, answer, machine, sheet, figures, what is proved, how to reproduce it.

    The page loads nothing from anywhere. The machine is drawn in the browser and can be turned by hand.

    Parameters
    ----------
    run : path, Result or Front
        A run folder or its record.json, one point of it as "RUN#7", or a result in memory, which has no figures.
    path : path, optional
        The file to write; by default report.html in the run folder, or report-7.html for point 7. For a result in
        memory it must be given.

    Returns
    -------
    pathlib.Path
        Of the page.

    Raises
    ------
    ValueError
        If there is no such run, or no path is given for a result in memory.

    Examples
    --------
    >>> import tempfile
    >>> import ninedof as nd
    >>> found = nd.optimize(nd.Study.paper(), starts=2)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     nd.report(found, folder + "/report.html").name
    'report.html'

    """
    if path is not None and not path_argument("path", path).absolute().parent.is_dir():
        raise ValueError(f"path: got {os.fspath(path)}, expected a file in a folder that exists")
    from ninedof.report.whole import page_of_path, page_of_result  # with all that pages are made of

    if isinstance(run, Result | Front):
        if path is None:
            raise ValueError("path: got none, expected the file to write for a result in memory")
        return write_whole(Path(path), page_of_result(run, Path(path).stem).encode())
    path_argument("run", run)
    place, point = split(os.fspath(run))
    if place.suffix == ".toml":
        raise ValueError(f"{place}: got a file of a design or study, expected a run folder")
    folder = folder_of(place)
    file = folder / (f"report-{point}.html" if point else FILE) if path is None else Path(path)
    return write_whole(file, page_of_path(place, point, run).encode())
