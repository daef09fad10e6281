"""A command: a call that takes a struct of options. Its answer is printed, or written as a job with figures."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import fields
from inspect import Parameter, Signature, get_annotations
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, NoReturn, get_type_hints

import typer

import ninedof as nd
from ninedof.cli.screen import DONE, INTERRUPTED, Screen
from ninedof.records.record import FILE as RECORD
from ninedof.records.record import add_files
from ninedof.report.report import FILE, report
from ninedof.support.kept.store import QUESTION
from ninedof.support.text import one_line

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FIGURES = (".png", ".svg", ".pdf")
Figures = Iterable[tuple[str, "Figure"]]
"""Figures as they are drawn, each behind the name of its files."""


class Answer(NamedTuple):
    """Answer of a command."""

    parts: Iterable[Any]
    """Sentences and tables."""
    data: Any
    """For --json."""
    status: int = DONE


def command(call: Callable[..., Answer | None]) -> Callable[..., object]:
    """Return a command of a call that takes a struct of options; options that it shares with others come last."""
    kind: Any = next(iter(get_type_hints(call).values()))
    hints, names = get_type_hints(kind), dict.fromkeys(name for part in kind.__mro__ for name in get_annotations(part))
    marks = {one.name: one.metadata["typer"] for one in fields(kind)}

    def parsed(**values: Any) -> None:
        options: Any = kind(**values)
        if (answer := call(options)) is not None:
            _print_parts(options.screen, answer)
            options.screen.data(answer.data)
            raise typer.Exit(answer.status)

    parsed.__name__, parsed.__doc__ = call.__name__, call.__doc__
    parameters = [Parameter(n, Parameter.KEYWORD_ONLY, default=marks[n], annotation=hints[n]) for n in names]
    parsed.__signature__ = Signature(parameters)  # type: ignore[attr-defined]  # what typer reads
    parsed.__annotations__ = {}
    return parsed


def write_and_print(screen: Screen, answer: Answer, write: Callable[[], Path]) -> Path:
    """Write what was computed, and print its answer; return the file.

    Where it cannot be written the answer is printed all the same, its JSON too: a full disk does not lose it.
    """
    try:
        file = write()
    except OSError:
        _print_parts(screen, answer)
        screen.data(answer.data)
        raise
    _print_parts(screen, answer)
    return file


def _print_parts(screen: Screen, answer: Answer) -> None:
    """Print each part as soon as it is there: the last one may be a check of minutes."""
    for part in answer.parts:
        screen.print(part)


def finish_job(
    options: Any, folder: Path, answer: Answer, write: Callable[[], Path], draw: Callable[[], Figures] | None
) -> NoReturn:
    """Write a run, print its answer, draw its figures, write its report, and end with the status of the answer.

    An interrupted run has no figures. `options` say whether to draw and to report, as `JobOptions`.
    """
    screen = options.screen
    try:
        record = write_and_print(screen, answer, write)
        _draw_and_report(options, folder, answer, draw)
    except KeyboardInterrupt:
        if (folder / RECORD).exists():
            screen.print(f"interrupted; run folder {folder} has the record")
        raise
    screen.print(folder_words(folder))
    screen.data({**answer.data, "record": str(record)} if isinstance(answer.data, dict) else answer.data)
    raise typer.Exit(answer.status)


def _draw_and_report(options: Any, folder: Path, answer: Answer, draw: Callable[[], Figures] | None) -> None:
    screen, with_figures = options.screen, options.figures and answer.status != INTERRUPTED
    try:
        (folder / FILE).unlink(missing_ok=True)  # that of an interrupted run would not agree with the record
        files = []
        for stem, figure in draw() if with_figures and draw is not None else ():
            files += nd.plot.save(figure, folder, stem)
            screen.say(f"drawn: {stem}")
        add_files(folder, files + (_report(folder, screen) if with_figures and options.report else []))
    except OSError:
        screen.data(answer.data)
        raise


def _report(folder: Path, screen: Screen) -> list[Path]:
    """Write the report; one that fails does not fail the job."""
    screen.say("writing the report")
    try:
        return [report(folder)]
    except Exception as error:  # whatever it is: the run is solved and kept, its report can be written again
        words = str(error) if isinstance(error, OSError | ValueError) else repr(error)
        screen.print(one_line(f"the report could not be written: {' '.join(words.split())}"))
    return []


def folder_words(folder: Path) -> str:
    """Return what a run folder has in it."""
    names = sorted(path.name for path in folder.iterdir() if path.is_file() and not path.name.startswith("."))
    stems = [Path(name).stem for name in names if name.endswith(FIGURES[0])]
    others = [name for name in names if not name.endswith(FIGURES) and name not in (RECORD, FILE, QUESTION)]
    figures = [f"figure{'s' * (len(stems) > 1)} {', '.join(stems)} (PNG, SVG, PDF)"] if stems else []
    return f"run folder {folder}: {', '.join([RECORD, *others, *figures, *([FILE] if FILE in names else [])])}"
