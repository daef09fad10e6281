"""Ctrl-C while the command `ninedof` is being loaded: it ends at once with status 130, without a traceback.

`ninedof` imports this first, before what takes time; `ninedof.cli.app.main` takes over. Programs that use the package
are left alone.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

INTERRUPTED = 130


def is_command(argv: Sequence[str], orig_argv: Sequence[str]) -> bool:
    """Return whether a process is `ninedof` or `python -m ninedof`, whose argv[0] is "-m" while it is being found."""
    name = os.path.basename(argv[0]) if argv else ""
    module = name == "-m" and ("-m", "ninedof") in pairwise(orig_argv)
    return module or name in ("ninedof", "ninedof.exe")


def ending(*_: Any) -> None:
    """End the process: the handler of SIGINT until the command runs."""
    os._exit(INTERRUPTED)


if is_command(sys.argv, sys.orig_argv) and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
    signal.signal(signal.SIGINT, ending)
