"""The command of a run is remembered in its folder, until `ninedof resume` has brought it to its end."""

from __future__ import annotations

import shlex
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from dataclasses import dataclass, replace
from pathlib import Path

from ninedof.cli.interruption import INTERRUPTED
from ninedof.cli.screen import BAD_INPUT, DONE, NO_RESULT
from ninedof.runs.command_file import FILE, MOST, Asked, Input, asked, read_command
from ninedof.runs.directory import FILES
from ninedof.support.files import is_leftover, write_whole
from ninedof.support.printable import one_line
from ninedof.support.reading import read_file


@dataclass
class _Now:
    """The command that runs."""

    arguments: tuple[str, ...]
    resumed: Asked | None = None
    given: str | None = None
    """What stands for the file that a resumed command reads."""
    file: Path | None = None
    before: bytes | None = None
    """What was there: a command that is refused does not take the place of another."""
    asked: Asked | None = None


_NOW: ContextVar[_Now | None] = ContextVar("now", default=None)


@contextmanager
def remembering(arguments: Sequence[str]) -> Iterator[None]:
    """Note in the run folder of a command how it ends; say how to go on where it was interrupted."""
    now = _Now(tuple(arguments))
    token = _NOW.set(now)
    try:
        yield
    except SystemExit as end:
        _ended(now, end.code)
        raise
    finally:
        _NOW.reset(token)


def given(name: str) -> str:
    """Return the argument that names a file, or what stands for it in a run that is resumed."""
    now = _NOW.get()
    return name if now is None or now.resumed is None or now.given is None else now.given


def resumed() -> bool:
    """Return whether `ninedof resume` runs."""
    now = _NOW.get()
    return now is not None and now.resumed is not None


def remember(directory: Path, reads: Input | None, file: str = FILE, keep: bool = False) -> None:
    """Write the command that runs, with the file that it reads, into its run folder; `keep` the same that is there."""
    now = _NOW.get()
    if now is None:  # called from Python
        return
    now.file, now.asked = directory / file, now.resumed
    with suppress(OSError):
        now.before = read_file(now.file, MOST)
    if now.asked is None:
        now.asked = anew = asked(now.arguments, reads)
        if keep and now.file.exists():
            with suppress(ValueError):
                kept = read_command(now.file)
                if kept.same_work(anew):
                    now.asked = kept
                    if kept.status is None:
                        return
                    now.asked = replace(kept, status=None)
        now.asked.write(now.file)


@contextmanager
def resuming(again: Asked, stands_for: str | None) -> Iterator[None]:
    """Run a command that is remembered: `stands_for` is its file."""
    now = _NOW.get() or _Now(again.arguments)
    now.resumed, now.given = again, stands_for
    token = _NOW.set(now)
    try:
        yield
    finally:
        _NOW.reset(token)


def _ended(now: _Now, code: object) -> None:
    if now.file is None or now.asked is None:
        return
    if code in (None, DONE, NO_RESULT):
        with suppress(OSError):
            for left in now.file.parent.iterdir():
                if is_leftover(left, FILES):  # of a run that was killed
                    left.unlink(missing_ok=True)
        with suppress(OSError):  # it would only be done again
            now.asked.ended(code if isinstance(code, int) else DONE).write(now.file)
    elif code == BAD_INPUT:
        with suppress(OSError):
            if now.before is not None:
                write_whole(now.file, now.before)
            else:
                now.file.unlink(missing_ok=True)
    elif code == INTERRUPTED:
        with suppress(OSError, ValueError):  # nobody reads
            again = f"ninedof resume {shlex.quote(str(now.file.parent))}"
            print(one_line(f"ninedof: `{again}` continues the run"), file=sys.stderr)
