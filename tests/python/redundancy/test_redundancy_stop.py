"""Progress and interruption of the searches for an internal point."""

import itertools

import numpy as np
import pytest
from interrupts import interrupted_on_entry, interrupter

import ninedof as nd


def plane(n, reach=1.6, height=3.9828):
    x = np.linspace(-reach, reach, n)
    return np.stack([*np.meshgrid(x, x, indexing="ij"), np.full((n, n), height)], axis=-1)


@pytest.mark.slow
def test_progress_of_a_map_rises_to_the_total(published):
    history = []
    nd.best_internal_map(published, plane(64), progress=lambda *a: history.append(a))
    done, total, value = zip(*history, strict=True)
    assert set(total) == {64 * 64}
    assert set(value) == {None}
    assert all(a < b for a, b in itertools.pairwise(done))
    assert done[-1] == 64 * 64
    assert len(history) > 2  # at most one call in a tenth of a second


@pytest.mark.parametrize("error", [RuntimeError("mine"), SystemExit(3)], ids=repr)
def test_an_exception_of_progress_ends_a_map(published, error):
    def fail(*_):
        raise error

    with pytest.raises(type(error)):
        nd.best_internal_map(published, plane(30), progress=fail)


def test_ctrl_c_ends_a_map(published):
    history = []
    with interrupter() as interrupt, pytest.raises(KeyboardInterrupt):
        nd.best_internal_map(published, plane(200), progress=lambda *calls: history.append(calls) or interrupt())
    assert 0 < history[-1][0] < 200 * 200


@pytest.mark.parametrize("search", [nd.best_internal_point, nd.best_internal_path])
def test_ctrl_c_ends_the_search_of_many_poses(published, search):
    """A second thread interrupts a call that would take minutes."""
    poses = plane(300).reshape(-1, 3)
    with interrupted_on_entry(search.__name__), pytest.raises(KeyboardInterrupt):
        search(published, poses)
