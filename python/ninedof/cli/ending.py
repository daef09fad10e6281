"""Maps errors and signals to exit statuses, which `screen` lists, and one line on standard error.

Ctrl-C, SIGTERM and SIGHUP while a command runs raise KeyboardInterrupt once: what was done so far is saved. The exit
status is 130, 143 or 129. A second Ctrl-C ends the process at once.
"""

from __future__ import annotations

import os
import re
import signal
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from itertools import pairwise
from threading import current_thread, main_thread
from time import monotonic
from traceback import walk_tb

from typer import Abort, BadParameter

from ninedof.cli.options import typed
from ninedof.cli.screen import BAD_INPUT, FAILED, INTERRUPTED, REFUSED, status_of
from ninedof.support.extras import MissingExtra
from ninedof.support.running import how_to_go_on
from ninedof.support.starting import ending
from ninedof.support.text import escaped, one_line
from ninedof.support.units import DEG, plain_name

PACKAGE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
# What typer raises for options that it cannot read; without a type, as it has no name there.
ClickException = BadParameter.__mro__[2]
SIGNALS = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]
# Arguments whose option has another name; of those that are something else too, where the option was typed.
OPTIONS = {"at": "set", "condition_number": "condition", "time_limit": "time"}
IF_TYPED = OPTIONS | {
    "changes": "set",
    "characteristic_length": "lc",
    "radius": "circle",
    "leg_lengths": "lengths",
    "leg_length": "legs",
}
# Options whose values name what they are of: --set zp=480.
NAMING = ("--set", "--vary", "--over")
ONE_PRESS = 0.1  # seconds: a terminal and a program in between may both hand on one Ctrl-C


@contextmanager
def interruptible() -> Iterator[None]:
    """Handle signals for the time of a command; a SystemExit with 130 gets the status of the signal that came."""
    first: list[tuple[int, float]] = []  # the signal that came first, and when

    def handler(number: int, *_: object) -> None:
        if not first:
            first.append((number, monotonic()))
            raise KeyboardInterrupt
        if number == signal.SIGINT and monotonic() - first[0][1] > ONE_PRESS:
            os._exit(128 + first[0][0])

    before = {number: signal.getsignal(number) for number in SIGNALS}
    ours = (signal.SIG_DFL, signal.default_int_handler, ending)  # jobs of nohup ignore some
    mine = [n for n in SIGNALS if before[n] in ours] if current_thread() is main_thread() else []
    for number in mine:
        signal.signal(number, handler)
    try:
        yield
    except SystemExit as end:
        if end.code == 128 + signal.SIGINT and first:
            raise SystemExit(128 + first[0][0]) from None
        raise
    finally:
        for number in mine:
            signal.signal(number, before[number])


def finish(work: Callable[[], object], arguments: Sequence[str]) -> int:
    """Do some work; return the exit status, after one line on standard error where an error ended it.

    Where Ctrl-C or the time ended the work, the line to type to go on follows.
    """
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")  # characters that the encoding of a console does not have
    try:
        status = status_of(work())
    except SystemExit as error:
        status = status_of(error.code)
    except (KeyboardInterrupt, Abort):  # the command line makes one of the other
        status = INTERRUPTED
    except Exception as error:  # whatever it is: the table of statuses has a row for it
        if sys.flags.dev_mode:
            raise
        status = _fail(*_told(error, arguments))
    if words := how_to_go_on(interrupted=status == INTERRUPTED):
        print(escaped(f"ninedof: {words}"), file=sys.stderr)
    return _flush(status)


def _flush(status: int) -> int:
    """Flush standard output; a reader that went away is no error. Python would fail to write it again as it ends."""
    try:
        if sys.stdout is not None:
            sys.stdout.flush()
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        if not isinstance(error, BrokenPipeError):
            return _fail(f"standard output: cannot be written ({error.strerror})", REFUSED)
    return status


def _fail(words: str, status: int) -> int:
    print(f"ninedof: {one_line(words)}", file=sys.stderr)
    return status


def _told(error: Exception, arguments: Sequence[str]) -> tuple[str, int]:
    """Return what to say, of an error that is not the user's what kind it is, and the exit status."""
    if isinstance(error, ClickException):
        context = getattr(error, "ctx", None)
        more = "" if context is None else f"; see `{context.command_path} --help`"
        return f"{error.format_message().rstrip('.')}{more}", BAD_INPUT  # type: ignore[attr-defined]
    if isinstance(error, MissingExtra) or (isinstance(error, ValueError) and _is_ours(error)):
        return as_typed(str(error), arguments), BAD_INPUT
    notes = "".join(f". {note}" for note in getattr(error, "__notes__", ()))
    if isinstance(error, OSError):
        files = [os.fsdecode(file) for file in (error.filename, error.filename2) if isinstance(file, str | bytes)]
        reason = error.strerror or str(error) or repr(error)
        return (f"{' and '.join(files)}: {reason}" if files and error.strerror else reason) + notes, REFUSED
    if isinstance(error, MemoryError):
        return f"out of memory{f' ({error})' if str(error) else ''}{notes}", FAILED
    words = str(error) if type(error) is RuntimeError else f"{type(error).__name__}: {error}"
    return (words or type(error).__name__) + notes, FAILED


def _is_ours(error: Exception) -> bool:
    """Return whether an error was raised here, or by the core that was called here: its innermost frame is ours."""
    frames = [frame for frame, _ in walk_tb(error.__traceback__)]
    return bool(frames) and os.path.abspath(frames[-1].f_code.co_filename).startswith(PACKAGE + os.sep)


def as_typed(message: str, arguments: Sequence[str]) -> str:
    """Return a message that begins with names of arguments, "leg_mass: got 0", with the options as they were typed."""
    before, colon, rest = message.partition(": ")
    if not colon or any(before in (word, os.path.basename(word)) for word in arguments):  # a file
        return message
    names = before.split(", ")
    known = [_as_option(name, arguments, len(names) == 1) or name for name in names]
    return f"{', '.join(known)}: {rest}"


def _as_option(name: str, arguments: Sequence[str], alone: bool) -> str:
    """Return --vary a2 for vary.a2, --set zp for zp where --set zp=480 was typed; nothing for what was not.

    Names that no option has are renamed where they stand alone, as the value may be one that was not typed.
    """
    if not (parts := re.fullmatch(r"(\w+)(?:\.(\w+)|\['(\w+)'\])?", name)):
        return ""
    argument, *of = (part for part in parts.groups() if part)
    own = IF_TYPED.get(argument, argument)
    for option in (typed(own), typed(f"{own}{DEG}")):
        was_typed = any(word == option or word.startswith(f"{option}=") for word in arguments)
        if was_typed or (alone and argument in OPTIONS):
            return " ".join([option, *of])
    words = [word for one in arguments for word in one.split("=")]
    pairs = [(option, word) for option, word in pairwise(words) if option in NAMING]
    return next((f"{option} {word}" for option, word in pairs if name in (word, plain_name(word))), "")
