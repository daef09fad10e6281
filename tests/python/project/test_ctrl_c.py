"""SIGINT ends every call of the core that can take long: within half a second on a busy machine, by measurement."""

import signal
import subprocess
import sys
import time

import pytest

HEAD = """
import numpy as np
import ninedof as nd

g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
x = np.linspace(-1.6, 1.6, 300)
plane = np.stack([*np.meshgrid(x, x, indexing="ij"), np.full((300, 300), 3.98)], axis=-1)
study = nd.Study.paper()
heights = np.linspace(2.0, 3.0, 300_000)
many = nd.Configuration.neutral(3.9828, heights)
cloud = [{"position": x} for x in np.random.default_rng(0).uniform(-0.3, 0.3, (100, 3)).tolist()]
free = {"radius_ratio": (None, 2.0), "singularity_free": {"steps": 1000}}
dense = nd.Study(constraints=free, objective={"poses": cloud})
box, legs = ([-2.5, -2.5, 3.0], [2.5, 2.5, 7.0]), {"leg_limits": (2.5, 6.5)}


def for_ever(call):
    while True:
        call()


print("go", flush=True)
"""

LONG = {
    "best_internal_path": "nd.best_internal_path(g, plane.reshape(-1, 3))",
    "best_internal_point": "nd.best_internal_point(g, plane)",
    "starts": "study.problem().starts(10**8, 0)",
    "sample": "nd.workspace(g, box, criteria=legs, method='sample', points=10**7)",
    "grid": "nd.workspace(g, box, criteria=legs, method='grid', resolution=250, most_evaluations=10**9)",
    "octree": "nd.workspace(g, box, criteria=legs, tolerance=1e-7, most_evaluations=10**9)",
    "optimize": "nd.optimize(study, starts=10**6)",
    "hundred_thousand_places": "nd.optimize(dense)",
    "forward_position": "for_ever(lambda: nd.forward_position(g, nd.leg_lengths(g, many)))",
    "condition_number": "for_ever(lambda: nd.condition_number(g, many, 'optimal'))",
    "bounds": "for_ever(lambda: nd.condition_number_bounds(g, many))",
    "Configuration": "for_ever(lambda: nd.Configuration.neutral(3.9, np.linspace(2.0, 3.0, 3_000_000)))",
    "nearest_singularity": "nd.nearest_singularity(g, many[:100_000])",
    "moved": "for_ever(lambda: many.moved(np.zeros(9)))",
    "follow": "nd.follow(g, nd.Trajectory.circle(many[0], 0.5, points=3_000_000), many[0])",
    "trace": "for_ever(lambda: nd.trace(study, dict(zip(study.variables, study.problem().starts(1, 0)[0]))))",
}

MOST_SECONDS = 10.0
"""The machine of the tests may be ten times slower than an idle one."""

PARTIAL = ("sample", "grid", "octree", "optimize", "hundred_thousand_places")
"""These return what they have, as stopped."""


@pytest.mark.slow
@pytest.mark.timing
@pytest.mark.parametrize("name", LONG)
def test_ctrl_c_is_heard(name):
    call = f"found = {LONG[name]}\nassert found.interrupted\n" if name in PARTIAL else LONG[name]
    program = [sys.executable, "-c", HEAD + call]
    with subprocess.Popen(program, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as child:
        try:
            child.stdout.readline()
            time.sleep(0.4)
            assert child.poll() is None, child.stderr.read()
            sent = time.monotonic()
            child.send_signal(signal.SIGINT)
            _, said = child.communicate(timeout=60)
            seconds = time.monotonic() - sent
        finally:
            child.kill()
    assert child.returncode == (0 if name in PARTIAL else -signal.SIGINT), said
    assert seconds < MOST_SECONDS
