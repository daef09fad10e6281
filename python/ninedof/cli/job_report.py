"""The end of a job: its record, what it says, its figures and its report."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from ninedof.cli.answer import Answer
from ninedof.cli.screen import Screen
from ninedof.report.report import FILE, report
from ninedof.runs.command_file import FILE as COMMAND
from ninedof.runs.folder import FILE as RECORD
from ninedof.support.printable import one_line

Draw = Callable[[Path], Sequence[Path]]
FIGURES = (".png", ".svg", ".pdf")


def with_report(draw: Draw | None, wanted: bool, screen: Screen, words: Callable[[], object] = lambda: None) -> Draw:
    """Return what follows the record of a run: words on it, figures, if there are any, and its report, if wanted.

    A report that fails does not fail the job: the screen says why in one line. The report of an interrupted run that
    was continued is removed at first: it would not agree with the record.
    """

    def drawn(folder: Path) -> list[Path]:
        (folder / FILE).unlink(missing_ok=True)
        words()
        try:
            files = [] if draw is None else list(draw(folder))
            return files + written(folder) if wanted else files
        except KeyboardInterrupt:
            screen.print(f"interrupted while drawing; run folder {folder} has the record")
            raise

    def written(folder: Path) -> list[Path]:
        screen.say("writing the report")
        try:
            return [report(folder)]
        except Exception as error:  # whatever it is: the run is solved and kept, its report can be written again
            words = str(error) if isinstance(error, OSError | ValueError) else repr(error)
            screen.print(one_line(f"the report could not be written: {' '.join(words.split())}"))
        return []

    return drawn


@contextmanager
def told(screen: Screen, words: Callable[[], object], data: Any) -> Iterator[Callable[[], None]]:
    """Yield what says the words on a run, once. Where its files cannot be written they are said all the same.

    So is the JSON: a full disk does not lose what was computed. The error follows.
    """
    said = False

    def once() -> None:
        nonlocal said
        if not said:
            said = True
            words()

    try:
        yield once
    except OSError:
        once()
        screen.data(data)
        raise


def write_job(
    screen: Screen, answer: Answer, write: Callable[[Draw], Path], draw: Draw | None = None, report: bool = False
) -> Path:
    """Write a run, print its answer, draw its figures and write its report; return its record."""
    with told(screen, lambda: screen.print(*answer.parts), answer.data) as once:
        record = write(with_report(draw, report, screen, once))
        once()
    return record


def folder_words(folder: Path) -> str:
    """Return what a run folder has in it."""
    names = sorted(path.name for path in folder.iterdir() if path.is_file() and not path.name.startswith("."))
    stems = [Path(name).stem for name in names if name.endswith(FIGURES[0])]
    others = [name for name in names if not name.endswith(FIGURES) and name not in (RECORD, FILE, COMMAND)]
    figures = [f"figure{'s' * (len(stems) > 1)} {', '.join(stems)} (PNG, SVG, PDF)"] if stems else []
    return f"run folder {folder}: {', '.join([RECORD, *others, *figures, *([FILE] if FILE in names else [])])}"


def report_words(directory: Path) -> str:
    """Return how a message goes on where the folder has a report."""
    return f", {FILE}" if (directory / FILE).is_file() else ""
