"""Signals while the command `ninedof` is being loaded: status 130, 143 or 129 at once, no traceback.

`ninedof` imports this first, before what takes time; `ninedof.cli.app.main` takes over. Programs that use the package
are left alone.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Sequence
from itertools import pairwise

SIGNALS = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]
"""Those that end a run: Ctrl-C, the end of a job, a terminal that was closed (unknown to Windows)."""


def status_of(number: int) -> int:
    """Return the exit status of a process that a signal ended, as a shell shows it."""
    return 128 + number


def is_command(argv: Sequence[str], orig_argv: Sequence[str]) -> bool:
    """Return whether a process is `ninedof` or `python -m ninedof`, whose argv[0] is "-m" while it is being found."""
    name = os.path.basename(argv[0]) if argv else ""
    module = name == "-m" and ("-m", "ninedof") in pairwise(orig_argv)
    return module or name in ("ninedof", "ninedof.exe")


def ending(number: int, *_: object) -> None:
    """End the process: the handler of signals until the command runs, and once it has ended."""
    os._exit(status_of(number))


def unclaimed(number: int) -> bool:
    """Return whether nobody handles or ignores a signal: jobs in the background and of nohup ignore some."""
    return signal.getsignal(number) in (signal.SIG_DFL, signal.default_int_handler)


if is_command(sys.argv, sys.orig_argv):
    for _number in filter(unclaimed, SIGNALS):
        signal.signal(_number, ending)
