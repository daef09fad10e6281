"""The array boundary of the indices: shapes, stacks, `out`, threads, and invalid arguments.

Oracle: the same function called for one pose at a time.
"""

import itertools

import numpy as np
import numpy_model as model
import pytest
from numpy.testing import assert_array_equal

import ninedof as nd
from ninedof import _core
from ninedof.robot.configuration import Flat

INDICES = (nd.condition_number, nd.manipulability, nd.isotropy_residual)


@pytest.mark.parametrize("index", INDICES)
def test_shapes(published, neutral, stack, index):
    assert np.ndim(index(published, neutral)) == 0
    assert isinstance(index(published, neutral), float)
    assert index(published, stack).shape == (5,)
    assert index(published, stack[:0]).shape == (0,)
    grid = nd.Configuration.neutral([[3.0], [4.0]], [1.0, 1.5, 2.0])
    assert_array_equal(index(published, grid), [[index(published, grid[i, k]) for k in range(3)] for i in range(2)])
    assert nd.singular_values(published, grid).shape == (2, 3, 6)


def test_one_characteristic_length_for_each_pose(published, stack):
    lc = np.array([0.5, 1.0, 2.0, 3.0, 0.1])
    expected = [nd.condition_number(published, c, x) for c, x in zip(stack, lc, strict=True)]
    assert_array_equal(nd.condition_number(published, stack, lc), expected)
    assert_array_equal(nd.condition_number(published, stack, list(lc)), expected)
    assert_array_equal(nd.condition_number(published, stack, np.repeat(lc, 2)[::2]), expected)
    assert_array_equal(nd.condition_number(published, stack, [2.0]), nd.condition_number(published, stack, 2.0))


@pytest.mark.parametrize("index", [*INDICES, nd.singular_values, nd.characteristic_length])
def test_missing_and_singular_poses_stay_alone(published, index):
    c = nd.Configuration.neutral(4.0, [2.0, 1.0, 2.0])
    p = c.position.copy()
    p[1, 0] = np.nan
    result = index(published, nd.Configuration(p, c.rotation, c.internal_point))
    assert_array_equal(result[[0, 2]], index(published, c)[[0, 2]])
    assert np.isnan(result[1]).all()


@pytest.mark.parametrize("index", INDICES)
def test_out(published, stack, neutral, index):
    out = np.full(5, -1.0)
    assert index(published, stack, out=out) is out
    assert_array_equal(out, index(published, stack))
    single = np.zeros(())
    assert index(published, neutral, out=single) is single
    assert single == index(published, neutral)


def off_by_one(array):
    """Return equal numbers at an address that no double may have, as they come out of packed records and messages."""
    array = np.asarray(array, dtype=float)
    moved = np.frombuffer(bytearray(array.nbytes + 1), np.uint8)[1:].view(np.float64).reshape(array.shape)
    moved[...] = array
    assert not moved.flags.aligned
    return moved


# Told from luck by the sanitized run only: this processor reads doubles anywhere. The functions of the package make
# aligned copies of what they are given, so that these tests go below them.


def test_a_geometry_out_of_misaligned_arrays(published):
    triples = published.__getstate__()
    assert nd.Geometry(*map(off_by_one, triples)) == published
    thawed = nd.Geometry.__new__(nd.Geometry)  # as unpickled from views into a message
    thawed.__setstate__(tuple(map(off_by_one, triples)))
    assert thawed == published


@pytest.mark.parametrize("name", ["condition_number_two", "manipulability", "singular_values"])
def test_misaligned_arrays_are_read(published, stack, name):
    index = getattr(_core, name)
    source = [stack.position, stack.rotation, stack.internal_point]
    lengths = np.array([0.5, 1.0, 2.0, 3.0, 0.1])
    misaligned = index(published, Flat(*map(off_by_one, source)), off_by_one(lengths), 1, None)
    assert_array_equal(misaligned, index(published, Flat(*map(np.ascontiguousarray, source)), lengths, 1, None))


def test_misaligned_designs_are_read():
    designs = np.array([[1.0, 2.0, 1.0, 0.5, 3.0, 1.5], [0.5, 2.0, 1.5, 0.5, 3.0, 1.0]])
    expected = _core.hexagonal_condition_numbers(designs, 1, None)
    assert_array_equal(_core.hexagonal_condition_numbers(off_by_one(designs), 1, None), expected)


@pytest.mark.parametrize("norm", ["2", "frobenius"])
def test_threads_do_not_change_a_bit(published, norm):
    m = model.random_robots(np.random.default_rng(2), 5000)
    c, results = m.configuration(), []
    for threads in (1, 2, 3, None):
        results.append(nd.condition_number(published, c, norm=norm, threads=threads))
    for a, b in itertools.pairwise(results):
        assert_array_equal(a, b)
    assert_array_equal(
        results[0][::500], [nd.condition_number(published, c[k], norm=norm) for k in range(0, 5000, 500)]
    )
