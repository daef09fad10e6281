"""Ctrl-C as a search ends: what is complete is returned, and shows that it was interrupted."""

import signal
import time

import pytest

import ninedof as nd

BOX = ([-4, -4, 0], [4, 4, 8])
LEGS = {"leg_limits": (2.5, 6.5)}
PAPER = nd.Study.paper().with_solver(1)


def late(*_):
    """Interrupt when the core, which needs no GIL, has come to the end of its fraction of a second."""
    time.sleep(1.5)
    signal.raise_signal(signal.SIGINT)


@pytest.mark.slow(sanitized=True)
def test_an_optimization():
    found, whole = nd.optimize(PAPER, progress=late), nd.optimize(PAPER)
    assert (found.status, found.interrupted, whole.interrupted) == (nd.Status.OPTIMAL, True, False)
    assert found.candidates == whole.candidates


@pytest.mark.slow(sanitized=True)
def test_a_proof_of_an_optimum():
    found = nd.prove_optimum(nd.Study.paper(), 3.7627, gap=0.3, progress=late)
    assert (found.complete, found.interrupted) == (True, True)
    assert found.certificate == nd.prove_optimum(nd.Study.paper(), 3.7627, gap=0.3).certificate


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("method", ["grid", "octree"])
def test_a_workspace(published, method):
    asked = {"criteria": LEGS, "method": method, "resolution": 16, "tolerance": 0.2}
    found, whole = (nd.workspace(published, BOX, **asked, progress=call) for call in (late, None))
    assert found.interrupted
    assert found.volume == whole.volume
    assert not whole.interrupted


@pytest.mark.slow(sanitized=True)
def test_a_certified_workspace(published):
    found, whole = (nd.certified_workspace(published, BOX, criteria=LEGS, gap=0.5, progress=p) for p in (late, None))
    assert (found.end, whole.end) == ("stopped", "gap")
    assert found.volume == whole.volume


@pytest.mark.slow(sanitized=True)
def test_a_certificate():
    made = nd.optimize(PAPER)
    found, whole = (made.certify(gap=0.3, progress=call) for call in (late, None))
    assert (found.interrupted, whole.interrupted) == (True, False)
    assert found.condition == whole.condition
    assert found.left_count == 0
