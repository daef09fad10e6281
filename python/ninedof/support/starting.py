"""Ctrl-C while the command `ninedof` is being loaded: status 130 at once, no traceback.

`ninedof` imports this first, before what takes time; `ninedof.cli.app.main` takes over. Programs that use the package
are left alone.
"""

from __future__ import annotations

import os
import signal
import sys
from itertools import pairwise


def ending(number: int, *_: object) -> None:
    """End the process: the handler of Ctrl-C until the command runs."""
    os._exit(128 + number)


_is_command = os.path.basename(sys.argv[0] if sys.argv else "") in ("ninedof", "ninedof.exe")
_is_heard = signal.getsignal(signal.SIGINT) is signal.default_int_handler  # jobs in the background ignore it
if _is_heard and (_is_command or ("-m", "ninedof") in pairwise(sys.orig_argv)):
    signal.signal(signal.SIGINT, ending)
