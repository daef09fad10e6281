"""Run folders of sweeps, atlases and fronts: finished chunks, the result and its figure, messages."""

from __future__ import annotations

import shlex
import warnings
from asyncio import CancelledError
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from ninedof.chunks.store import Store
from ninedof.cli.job_report import report_words, told, with_report
from ninedof.cli.remembered import remember
from ninedof.cli.screen import Screen, bold
from ninedof.runs.command_file import FILE, Input
from ninedof.runs.directory import run_directory, used_directory
from ninedof.runs.folder import FILE as RECORD
from ninedof.runs.folder import write_run
from ninedof.support.arguments import LONGEST
from ninedof.support.extras import MissingExtra
from ninedof.support.printable import one_line
from ninedof.sweep import SweepResult
from ninedof.sweep.cluster import dask_executor, is_of_cluster
from ninedof.workspace import CertifiedWorkspace, WorkspaceMap

if TYPE_CHECKING:
    from matplotlib.figure import Figure

CHUNKS = "chunks"
AGAIN = "; the same command with --out {} --resume continues the run"


@contextmanager
def run_folder(out: Path | None, resume: bool, reads: Input | None = None) -> Iterator[Path]:
    """Yield a new run folder, or that of an interrupted run, with the command and the file that it reads."""
    if not resume:
        with run_directory(out) as directory:
            remember(directory, reads)
            with _as_typed(directory):
                yield directory
        return
    if out is None:
        raise ValueError("--resume: got no --out, expected the run folder of the interrupted run")
    if (out / CHUNKS).is_symlink():  # nobody who typed --out chose where it leads
        raise ValueError(f"--resume: got --out {out}, in which {CHUNKS} is a link, expected a folder in its place")
    if not (out / CHUNKS).is_dir() and not (out / FILE).is_file():
        raise ValueError(f"--resume: got --out {out}, which holds no chunks, expected the folder of an interrupted run")
    with used_directory(out):
        remember(out, reads, keep=True)
        with _as_typed(out):
            yield out


@contextmanager
def _as_typed(directory: Path) -> Iterator[None]:
    """Name the run folder where its folder of chunks is refused, which nobody typed."""
    try:
        yield
    except ValueError as error:
        which = f"out: got {directory / CHUNKS}, which "
        if not str(error).startswith(which):
            raise
        rest = str(error).removeprefix(which)
        raise ValueError(f"out: got {directory}, whose folder {CHUNKS} {rest}") from None


S = TypeVar("S", WorkspaceMap, CertifiedWorkspace)


class Finished:
    """Results of one run in its folder, each as soon as it is finished; an interrupted one is none."""

    def __init__(self, folder: Path, question: dict[str, Any]) -> None:
        """Make the folder, or open that of an interrupted run."""
        self._folder, self._question = folder, question
        Store(folder, question, 1).close()

    def result(self, number: int, kind: type[S], compute: Callable[[], S]) -> S:
        """Return a result that was kept, or compute and keep it."""
        with Store(self._folder, self._question, 1) as store:
            if (found := store.read(number)) is not None:
                return kind._made(found)
            result = compute()
            if not result.interrupted:
                with suppress(OSError):  # a full disk: the result is worth more than its piece
                    store.write(number, result._contents())
            return result


def compute(
    asked: Callable[..., SweepResult], title: str, directory: Path, scheduler: str | None, screen: Screen
) -> SweepResult | None:
    """Compute with a progress bar and keep chunks in the run folder; return None if Ctrl-C ends the run."""
    try:
        with _executor(scheduler) as executor, _saying_warnings(screen), screen.points(title) as bar:
            return asked(executor=executor, out=directory / CHUNKS, progress=bar.show)
    except KeyboardInterrupt:
        screen.print(bold("interrupted", f": {_kept(directory)}"))
        screen.data({"interrupted": True, "run": str(directory)})
        return None
    except (Exception, CancelledError) as error:
        if scheduler is None or not is_of_cluster(error):
            raise
        reason = f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
        raise RuntimeError(f"--scheduler: lost {scheduler} ({reason[:LONGEST]}); {_kept(directory, AGAIN)}") from None


def _kept(directory: Path, more: str = "") -> str:
    """Return what is kept of a run that has no record: the folder is looked at, since its disk may be full."""
    if not any((directory / CHUNKS).glob("chunk-*")):
        return "nothing is kept of what was computed"
    return f"finished chunks are kept in {directory}{more.format(shlex.quote(str(directory)))}"


@contextmanager
def _saying_warnings(screen: Screen) -> Iterator[None]:
    """Say what a run warns of at once, and on one line: that the disk is full."""
    with warnings.catch_warnings():
        warnings.simplefilter("always", RuntimeWarning)
        warnings.showwarning = lambda message, *_, **__: screen.say(one_line(str(message)))
        yield


def write(
    result: SweepResult,
    directory: Path,
    stem: str,
    draw: Callable[[], Iterable[tuple[str, Figure]]] | None,
    screen: Screen,
    data: Any,
    words: Callable[[], object],
    report: bool = True,
) -> None:
    """Write the result and its record, say the words, then write figures, each with its name, and the report."""
    names: list[str] = []

    def drawn(folder: Path) -> list[Path]:
        screen.say(f"drawing the {stem}")
        from ninedof import plot

        files: list[Path] = []
        for name, figure in draw() if draw else ():
            names.append(name)
            files += plot.save(figure, folder, name)
        return files

    try:
        with told(screen, words, data) as once:
            drawing = with_report(drawn if draw else None, report and draw is not None, screen, once)
            record = write_run(result, directory, drawing, results=data)
    except OSError as error:
        if not (directory / RECORD).is_file():
            kept = _kept(directory, AGAIN)
            error.add_note(f"{kept[0].upper()}{kept[1:]}.")
        raise
    made = f", figure{'s' * (len(names) > 1)} {', '.join(names)} (PNG, SVG, PDF)" if names else ""
    screen.print(f"run folder {directory}: {record.name}, {stem}.npz{made}{report_words(directory)}")
    screen.data({**data, "record": str(record)})


@contextmanager
def _executor(scheduler: str | None) -> Iterator[Executor | None]:
    if scheduler is None:
        yield None
        return
    with ExitStack() as stack:
        try:
            executor = stack.enter_context(dask_executor(scheduler))
        except (MissingExtra, ValueError) as error:
            raise ValueError(f"--scheduler: {str(error).removeprefix('address: ')}") from None
        yield executor
