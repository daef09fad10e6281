"""Programs that end while a daemon thread is in the core keep their own exit status."""

import subprocess
import sys

import pytest
from sizes import size

HEAD = """
import sys, threading, time
import numpy as np
import ninedof as nd

g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
one = nd.Configuration.neutral(3.9828, 2.3745)
many = nd.Configuration.neutral(3.9828, np.linspace(2.0, 3.0, 200_000))
lengths = np.tile(nd.leg_lengths(g, one), (2000, 1))
study = nd.Study.paper()
inside = threading.Semaphore(0)

def told(*_):
    inside.release()

def for_ever(call):
    while True:
        inside.release()
        call()

"""

CALLS = {
    "short": "lambda: nd.condition_number(g, one)",
    "stack": "lambda: nd.condition_number(g, many, threads=2)",
    "modes": "lambda: nd.forward_position(g, lengths)",
    "search": "lambda: nd.optimize(study, starts=10**6, threads=2)",
    "with progress": "lambda: nd.optimize(study, starts=10**6, threads=2, progress=told)",
    "busy progress": "lambda: nd.optimize(study, starts=10**6, threads=1, progress=lambda *_: sum(range(10**6)))",
}

TAIL = """
for _ in range({threads}):
    threading.Thread(target=for_ever, args=({call},), daemon=True).start()
for _ in range({threads}):
    inside.acquire()
time.sleep({wait})
sys.exit(7)
"""


def ended(program, *options):
    """The status of a program and what it wrote to stderr."""
    done = subprocess.run([sys.executable, *options, "-c", program], capture_output=True, text=True, timeout=60)
    return done.returncode, done.stderr


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize(("call", "threads"), [*((call, 4) for call in CALLS), ("short", 1), ("search", 1)])
def test_the_status_of_the_program_survives_daemon_threads(call, threads):
    for k in range(size(1, 50)):
        program = HEAD + TAIL.format(threads=threads, call=CALLS[call], wait=0.03 * (k % 7))
        assert ended(program) == (7, "")


def test_the_core_works_in_exit_handlers():
    """Also in those that Python calls after ours, and while other threads sleep."""
    handler = "import atexit\natexit.register(lambda: print(nd.condition_number(g, many).max(), file=sys.stderr))\n"
    before = handler.replace("nd.", "sys.modules['ninedof'].").replace("(g, many)", "(*late)")
    program = "import sys\n" + before + HEAD + "late = g, many\n" + handler
    program += TAIL.format(threads=2, call=CALLS["stack"], wait=0.05)
    status, said = ended(program)
    assert status == 7
    assert [round(float(line), 1) for line in said.split()] == [4.3, 4.3]


@pytest.mark.skipif(not hasattr(sys.modules["os"], "fork"), reason="no fork")
def test_a_forked_child_ends_though_its_parent_was_in_the_core():
    program = HEAD + TAIL.format(threads=2, call=CALLS["stack"], wait=0.05).replace("sys.exit(7)", "")
    program += """
import os
child = os.fork()
if child == 0:
    began = time.monotonic()
    import atexit
    nd.condition_number(g, many)
    sys.exit(5)
status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
sys.exit(7 if status == 5 else status)
"""
    assert ended(program)[0] == 7


FORKED = """
import os, signal
children = []

def forked(*_):
    if children and children[0] > 0:
        raise KeyboardInterrupt  # the parent need not go on
    if children:
        return
    children.append(os.fork())
    if children[0] == 0:
        {child}

def alarmed():
    threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    return nd.optimize(study, starts=10**6, threads=2).interrupted

status = 0
try:
    nd.optimize(study, starts=10**5, threads=2, progress=forked)
except KeyboardInterrupt:
    status = 5
except RuntimeError as error:
    status = 5 if "it goes on in the parent only" in str(error) else 1
if children[0] == 0:
    sys.exit(status)
sys.exit(os.waitstatus_to_exitcode(os.waitpid(children[0], 0)[1]))
"""


@pytest.mark.slow(sanitized=True)
@pytest.mark.skipif(not hasattr(sys.modules["os"], "fork"), reason="no fork")
@pytest.mark.parametrize(
    "child",
    [
        "pass  # goes on in the call, whose threads are in the parent",
        "sys.exit(5)",
        "sys.exit(5 if nd.optimize(study, starts=2, threads=2).condition_number < 4.0 else 1)",
        "sys.exit(5 if alarmed() else 1)",
        "os.kill(os.getpid(), signal.SIGINT)",
    ],
    ids=["goes on", "exits", "calls the core", "hears Ctrl-C in a call of its own", "hears Ctrl-C at once"],
)
def test_a_child_forked_in_a_progress_callback_ends_with_its_own_status(child):
    assert ended(HEAD + FORKED.format(child=child)) == (5, "")


@pytest.mark.skipif(sys.version_info >= (3, 13), reason="the module of subinterpreters has another name")
def test_a_subinterpreter_is_refused():
    program = "import _xxsubinterpreters as s\ns.run_string(s.create(), 'import ninedof')\n"
    status, said = ended(program)
    assert status == 1
    assert "ninedof: got a subinterpreter, expected the main interpreter" in said
