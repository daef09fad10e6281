"""The array boundary of the indices: shapes, stacks, `out`, threads, and invalid arguments.

Oracle: the same function called for one pose at a time.
"""

import numpy as np
import pytest
from numpy.testing import assert_array_equal

import ninedof as nd
from ninedof import _core
from ninedof.robot.configuration import Flat

INDICES = (nd.condition_number, nd.manipulability, nd.isotropy_residual)


def test_one_characteristic_length_for_each_pose(published, stack):
    lc = np.array([0.5, 1.0, 2.0, 3.0, 0.1])
    expected = [nd.condition_number(published, c, x) for c, x in zip(stack, lc, strict=True)]
    assert_array_equal(nd.condition_number(published, stack, lc), expected)
    assert_array_equal(nd.condition_number(published, stack, list(lc)), expected)
    assert_array_equal(nd.condition_number(published, stack, np.repeat(lc, 2)[::2]), expected)
    assert_array_equal(nd.condition_number(published, stack, [2.0]), nd.condition_number(published, stack, 2.0))


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
