"""Progress and interruption of the searches for an internal point."""

import itertools
import os
import signal
import subprocess
import sys
import threading

import numpy as np
import pytest

import ninedof as nd


def plane(n, reach=1.6, height=3.9828):
    x = np.linspace(-reach, reach, n)
    return np.stack([*np.meshgrid(x, x, indexing="ij"), np.full((n, n), height)], axis=-1)


def test_progress_of_a_map_rises_to_the_total(published):
    seen = []
    nd.best_internal_map(published, plane(64), progress=lambda *a: seen.append(a))
    done, total, value = zip(*seen, strict=True)
    assert set(total) == {64 * 64}
    assert set(value) == {None}
    assert all(a < b for a, b in itertools.pairwise(done))
    assert done[-1] == 64 * 64
    assert len(seen) > 5


@pytest.mark.parametrize("error", [RuntimeError("mine"), SystemExit(3)], ids=repr)
def test_an_exception_of_progress_ends_a_map(published, error):
    def fail(*_):
        raise error

    with pytest.raises(type(error)):
        nd.best_internal_map(published, plane(30), progress=fail)


INTERRUPTED = """
import numpy as np, ninedof as nd
g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
p = np.zeros((1500, 500, 3))
p[..., 0], p[..., 1], p[..., 2] = np.linspace(-1, 1, 1500)[:, None], np.linspace(-1, 1, 500), 3.98
try:
    nd.best_internal_map(g, p, progress=lambda done, *_: done and print(done, flush=True))
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGINT to a process")
def test_ctrl_c_ends_a_map():
    with subprocess.Popen([sys.executable, "-c", INTERRUPTED], stdout=subprocess.PIPE, text=True) as run:
        assert run.stdout.readline().strip().isdigit()
        run.send_signal(signal.SIGINT)
        rest, _ = run.communicate(timeout=60)
    *before, last = rest.split()
    assert last == "interrupted"
    assert len(before) < 1000


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGINT to a process")
@pytest.mark.parametrize("search", [nd.best_internal_point, nd.best_internal_path])
def test_ctrl_c_ends_the_search_of_many_poses(published, search):
    """A second thread interrupts a call that would take minutes."""
    poses = plane(300).reshape(-1, 3)
    timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            search(published, poses)
    finally:
        timer.cancel()
