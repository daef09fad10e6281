"""Run folders of sweeps, atlases and fronts: finished chunks, the result and its figure, messages."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from ninedof.chunks.store import Store
from ninedof.cli.remembered import remember
from ninedof.runs.command_file import FILE, Input
from ninedof.runs.directory import run_directory, used_directory
from ninedof.workspace import CertifiedWorkspace, WorkspaceMap

if TYPE_CHECKING:
    pass

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
