"""SIGINT ends every call of the core that can take long: within half a second on a busy machine, by measurement."""

import signal
import subprocess
import sys
import time

import pytest

HEAD = """
import sys
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


CALLS = """
for line in LINES:
    print("go", flush=True)
    try:
        print(eval(line).interrupted, flush=True)
    except KeyboardInterrupt:
        print("KeyboardInterrupt", flush=True)
    sys.stdin.readline()
"""


@pytest.fixture(scope="module")
def heard():
    """How each call ended in one program, and how long after its SIGINT."""
    ends, pipe = {}, subprocess.PIPE
    program = f"LINES = {list(LONG.values())!r}\n{HEAD}{CALLS}"
    with subprocess.Popen([sys.executable, "-c", program], stdin=pipe, stdout=pipe, text=True, bufsize=1) as child:
        for name in LONG:
            child.stdout.readline()
            time.sleep(0.4)
            sent = time.monotonic()
            child.send_signal(signal.SIGINT)
            ends[name] = child.stdout.readline().strip(), time.monotonic() - sent
            if child.poll() is not None:
                break
            child.stdin.write("next\n")
    return ends


@pytest.mark.slow
@pytest.mark.timing
@pytest.mark.parametrize("name", LONG)
def test_ctrl_c_is_heard(heard, name):
    ended, seconds = heard[name]
    assert ended == ("True" if name in PARTIAL else "KeyboardInterrupt")
    assert seconds < MOST_SECONDS
