"""Progress and interruption of a search for a workspace."""

from time import perf_counter

import pytest
from interrupts import interrupter
from sizes import size

import ninedof as nd

BOX = ([-2.5, -2.5, 3.0], [2.5, 2.5, 7.0])
LEGS = {"leg_limits": (2.5, 6.5)}


def test_progress_counts_up(published):
    seen, tolerance = [], size(6e-4, 1e-4)
    found = nd.workspace(published, BOX, criteria=LEGS, tolerance=tolerance, progress=lambda *told: seen.append(told))
    assert seen
    done = [told[0] for told in seen]
    assert done == sorted(done)
    assert done[-1] <= found.evaluations
    assert all(expected >= count for count, expected, _ in seen)


def test_an_exception_of_progress_reaches_the_caller(published):
    def stop(*_):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        nd.workspace(published, BOX, criteria=LEGS, tolerance=1e-6, progress=stop)


@pytest.mark.slow
def test_ctrl_c_returns_a_stopped_map(published):
    with interrupter() as progress:
        found = nd.workspace(
            published,
            BOX,
            archetype="inclusive",
            orientations=400,
            region={"angle": 0.2},
            criteria=LEGS | {"condition_number": 6.0},
            tolerance=1e-6,
            most_evaluations=10**9,
            progress=progress,
        )
    assert found.interrupted
    assert found.status == "stopped"


def test_an_interruption_at_the_end_is_not_lost(published):
    """The map is complete, so that only the exception can show the interruption."""

    def stop(*_):
        raise KeyboardInterrupt

    for _ in range(5):
        try:
            heard = nd.workspace(published, BOX, criteria=LEGS, method="grid", resolution=8, progress=stop).interrupted
        except KeyboardInterrupt:
            heard = True
        assert heard


@pytest.mark.timing
def test_ctrl_c_ends_the_finest_levels(published):
    """Very many cells are numbered and judged there; the summary takes a second for each million."""
    enough = size(600_000, 4_000_000)
    with interrupter() as interrupt:
        found = nd.workspace(
            published,
            BOX,
            criteria=LEGS,
            tolerance=1e-7,
            most_evaluations=10**9,
            progress=lambda done, *_: done > enough and interrupt(),
        )
        seconds = perf_counter() - interrupt.sent
    assert found.status == "stopped"
    assert found.evaluations > enough
    assert seconds < 12.0


def test_the_poses_announced_are_about_those_evaluated():
    """The error of the first level is a bound: taken for an estimate it announced ten times as many poses."""
    g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    totals = []
    found = nd.workspace(
        g,
        ([-4, -4, 0], [4, 4, 8]),
        criteria={"leg_limits": (1.5, 6.5), "condition_number": 5.0},
        progress=lambda done, total, volume: totals.append(total),
    )
    assert found.status == "converged"
    assert max(totals) < 1.5 * found.evaluations
