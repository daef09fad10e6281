"""Calls that Windows does not have stand in one file, `support/kept/store.py`; planted ones are found."""

import ast
from pathlib import Path

import pytest

import ninedof as nd

ROOT = Path(nd.__file__).parent
SYSTEM = "support/kept/store.py"
MODULES = {"fcntl", "msvcrt", "resource", "termios", "tty", "pty", "pwd", "grp", "syslog", "posix", "nt", "winreg"}
OF_OS = set(
    """fork forkpty register_at_fork kill killpg getuid geteuid getgid setsid mkfifo nice O_CLOEXEC O_NONBLOCK
    O_NOFOLLOW O_DIRECTORY O_TMPFILE uname chown sched_getaffinity sysconf statvfs pread pwrite posix_fallocate sendfile
    wait waitpid getpgid chroot""".split()
)
OF_SIGNAL = set("alarm setitimer pause sigwait pthread_kill pthread_sigmask siginterrupt".split())
EVERYWHERE = {"SIGINT", "SIGTERM", "SIGABRT", "SIGFPE", "SIGILL", "SIGSEGV"}  # the signals of every system


def posix_only(text):
    """Names in a module that not every system has."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            yield from (a.name for a in node.names if a.name.split(".")[0] in MODULES)
        elif isinstance(node, ast.ImportFrom):
            if node.module in MODULES:
                yield node.module
            yield from (a.name for a in node.names if node.module == "os" and a.name in OF_OS)
            yield from (a.name for a in node.names if node.module == "signal" and _foreign(a.name))
        elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            if node.value.id == "os" and node.attr in OF_OS:
                yield node.attr
            if node.value.id == "signal" and _foreign(node.attr):
                yield node.attr


def _foreign(name):
    signals = name.startswith("SIG") and not name.startswith("SIG_") and name not in EVERYWHERE
    return signals or name in OF_SIGNAL


@pytest.mark.parametrize(
    "text",
    [
        *("import fcntl", "from fcntl import lockf", "import os\nos.register_at_fork()", "from os import fork"),
        *("import os\nos.open('a', os.O_NONBLOCK)", "import signal\nsignal.SIGHUP", "from signal import SIGKILL"),
        *("def f():\n    import resource", "import os\nos.kill(1, 2)", "import signal\nsignal.alarm(1)"),
    ],
)
def test_a_planted_call_is_found(text):
    assert list(posix_only(text))


def test_one_file_knows_the_system():
    files = {path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8") for path in ROOT.rglob("*.py")}
    found = {name: sorted(set(posix_only(text))) for name, text in files.items()}
    assert {name for name, calls in found.items() if calls} == {SYSTEM}, found
