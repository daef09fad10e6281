"""Calls of the core that take long: progress rises, exceptions of it and SIGINT end them, at the last moment too.

How soon SIGINT ends every such call is measured in project/test_ctrl_c.py.
"""

import itertools
import math
import signal
import time

import numpy as np
import pytest
from interrupts import interrupted_on_entry, interrupter
from sizes import size

import ninedof as nd

G = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
BOX, WIDE = ([-2.5, -2.5, 3.0], [2.5, 2.5, 7.0]), ([-4, -4, 0], [4, 4, 8])
LEGS = {"leg_limits": (2.5, 6.5)}
PAPER, LEAST = nd.Study.paper(), 3.762659078596047
UNBOUNDED = nd.Study(variables=dict.fromkeys(["a1", "a2", "b1", "b2", "zp", "zs"], (1e-3, math.inf)))
HUGE = 10**6  # starts: minutes of work
SLOW = pytest.mark.slow(sanitized=True)


def optimize(study=PAPER, starts=HUGE):
    return lambda progress: nd.optimize(study, starts=starts, progress=progress)


def proof(gap=None):
    return lambda progress: nd.prove_optimum(PAPER, LEAST, **({"gap": gap} if gap else {}), progress=progress)


def places(n):
    x = np.linspace(-1.6, 1.6, n)
    return np.stack([*np.meshgrid(x, x, indexing="ij"), np.full((n, n), 3.9828)], axis=-1)


def best_map(n):
    return lambda progress: nd.best_internal_map(G, places(n), progress=progress)


def workspace(box=BOX, criteria=LEGS, **options):
    return lambda progress: nd.workspace(G, box, criteria=criteria, **options, progress=progress)


def certified(box=WIDE, criteria=LEGS, **options):
    return lambda progress: nd.certified_workspace(G, box, criteria=criteria, **options, progress=progress)


def certificate(progress):
    return nd.optimize(PAPER, starts=1).certify(gap=0.3, progress=progress)


# --- Progress ---------------------------------------------------------------------------------------------------------


def falls_to_the_optimum(result, values):
    assert all(a >= b for a, b in itertools.pairwise(values))
    assert values[-1] == pytest.approx(result.condition_number, rel=1e-9)
    assert min(values) >= LEAST * (1.0 - 1e-9)  # an end that uses up the tolerance of a constraint is no record


STARTS = size(1500, 4000)
RISING = {  # calls, the total they announce (None for an estimate), what is true of the values that come with it
    "optimize": (optimize(starts=STARTS), STARTS, falls_to_the_optimum),
    "map": (best_map(64), 64 * 64, lambda _, values: set(values) == {None}),
    "workspace": (workspace(tolerance=size(6e-4, 1e-4)), None, lambda *_: True),
}


@pytest.mark.parametrize("name", [pytest.param(name, marks=[SLOW] * (name == "map")) for name in RISING])
def test_progress_rises_to_the_total(name):
    (call, expected, judge), seen = RISING[name], []
    result = call(lambda *report: seen.append(report))
    done, total, values = zip(*seen, strict=True)
    assert all(type(count) is int for count in (*done, *total))
    assert all(count <= most for count, most in zip(done, total, strict=True))
    if expected is None:
        assert list(done) == sorted(done)
        assert done[-1] <= result.evaluations
    else:
        assert len(seen) > 1
        assert set(total) == {expected}
        assert all(a < b for a, b in itertools.pairwise(done))
        assert done[-1] == expected
    assert judge(result, values) is not False


LONG = {
    "optimize": optimize(),
    "proof": proof(),
    "map": best_map(30),
    "workspace": workspace(tolerance=1e-6),
    "certified workspace": certified(gap=1e-6),
    "certificate": certificate,
}


@pytest.mark.parametrize("error", [RuntimeError("mine"), SystemExit(3), GeneratorExit()], ids=repr)
@pytest.mark.parametrize("name", LONG)
def test_an_exception_of_progress_ends_the_call_and_is_passed_on(name, error):
    calls = []

    def fail(*report):
        calls.append(report)
        raise error

    with pytest.raises(type(error)) as raised:
        LONG[name](fail)
    assert raised.value is error
    assert len(calls) == 1


def test_progress_with_the_wrong_signature_is_an_error():
    with pytest.raises(TypeError, match="positional argument"):
        LONG["optimize"](lambda done: None)


# --- SIGINT -----------------------------------------------------------------------------------------------------------


def is_part_of_a_search(result):
    assert (result.status, "interrupted" in result.reason) == (nd.Status.STOPPED, True)
    assert 0 < result.starts_done < HUGE
    assert 2.5 < result.condition_number < LEAST * (1.0 + 1e-9)
    assert len(result.candidates) >= 1


CONDITION = LEGS | {"condition_number": 5.0}


def is_proved(result):
    estimate = nd.workspace(G, BOX, criteria=CONDITION, tolerance=0.01)
    assert result.end == "stopped"
    assert result.volume[0] <= estimate.volume + estimate.error
    assert result.volume[1] >= estimate.volume - estimate.error


MANY = {"archetype": "inclusive", "orientations": 400, "region": {"angle": 0.2}, "most_evaluations": 10**9}
HEARD = {  # calls that return what they have, and what is true of it
    "optimize": (optimize(), is_part_of_a_search),
    "optimize, unbounded": (optimize(UNBOUNDED), is_part_of_a_search),
    "proof": (proof(), lambda result: not result.complete and 1.0 < result.lower_bound < LEAST),
    "workspace": (workspace(criteria=CONDITION, tolerance=1e-6, **MANY), lambda result: result.status == "stopped"),
    "certified workspace": (certified(BOX, CONDITION, gap=1e-6, time_limit=None), is_proved),
}


@pytest.mark.parametrize(("call", "judge"), HEARD.values(), ids=HEARD)
def test_sigint_returns_what_there_is(call, judge):
    with interrupter() as progress:
        result = call(progress)
    assert progress.sent is not None
    assert result.interrupted
    assert judge(result) is not False


def test_sigint_ends_a_map():
    reports = []
    with interrupter() as interrupt, pytest.raises(KeyboardInterrupt):
        best_map(200)(lambda *report: reports.append(report) or interrupt())
    assert 0 < reports[-1][0] < 200 * 200


@pytest.mark.parametrize("search", [nd.best_internal_point, nd.best_internal_path])
def test_sigint_ends_a_search_without_progress(search):
    """A second thread interrupts a call that would take minutes."""
    with interrupted_on_entry(search.__name__), pytest.raises(KeyboardInterrupt):
        search(G, places(300).reshape(-1, 3))


# --- The last moment --------------------------------------------------------------------------------------------------


def late(*_):
    """Interrupt when the core, which needs no GIL, has come to the end of its fraction of a second."""
    time.sleep(1.5)
    signal.raise_signal(signal.SIGINT)


WHOLE = {  # calls, and what of their result an interruption at the end does not change
    "optimize": (optimize(starts=1), lambda result: (result.status, result.candidates)),
    "proof": (proof(0.3), lambda result: (result.complete, result.certificate)),
    "grid": (workspace(WIDE, method="grid", resolution=16), lambda result: result.volume),
    "octree": (workspace(WIDE, method="octree", tolerance=0.2), lambda result: result.volume),
    "certified workspace": (certified(gap=0.5), lambda result: result.volume),
    "certificate": (certificate, lambda result: (result.condition, result.left_count)),
}


@SLOW
@pytest.mark.parametrize(("call", "content"), WHOLE.values(), ids=WHOLE)
def test_interrupted_as_it_ends_a_result_is_whole_and_says_so(call, content):
    result, whole = call(late), call(None)
    assert (result.interrupted, whole.interrupted) == (True, False)
    assert content(result) == content(whole)
