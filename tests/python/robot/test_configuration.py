"""Configurations, single or stacked: eq. (6), validation, indexing, value semantics."""

import copy
import math
import pickle

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from scipy.spatial.transform import Rotation

import ninedof as nd

ONE = np.eye(3)
P, S = [0.1, -0.2, 4.0], [0.0, 0.3, 2.0]


def message(argument):
    return rf"(?s)^{argument}: got .+, expected .+"


def test_neutral_twist_turns_x_towards_y():
    twisted = nd.Configuration.neutral(zp=3.0, zs=1.5, theta_z=math.pi / 6)
    assert_allclose(twisted.rotation @ [1.0, 0.0, 0.0], [math.sqrt(0.75), 0.5, 0.0], atol=1e-15)
    assert_allclose(twisted.rotation, Rotation.from_euler("z", 30.0, degrees=True).as_matrix(), atol=1e-15)


def test_neutral_broadcasts():
    c = nd.Configuration.neutral(zp=[[3.0], [4.0]], zs=[1.0, 1.5, 2.0], theta_z=0.2)
    assert c.shape == (2, 3)
    assert_array_equal(c.position[..., 2], [[3.0] * 3, [4.0] * 3])
    assert_array_equal(c.internal_point[..., 2], [[1.0, 1.5, 2.0]] * 2)
    assert_array_equal(c.rotation[1, 2], nd.Configuration.neutral(4.0, 2.0, 0.2).rotation)


def test_rotation_from_scipy_and_by_default():
    turn = Rotation.from_rotvec([0.1, 0.2, -0.3])
    assert_array_equal(nd.Configuration(P, turn, S).rotation, turn.as_matrix())
    assert_array_equal(nd.Configuration(P, internal_point=S).rotation, ONE)
    turns = Rotation.from_rotvec([[0.1, 0.2, -0.3], [0.0, 0.0, 1.0]])
    assert nd.Configuration(P, turns, S).shape == (2,)


def test_the_three_parts_broadcast():
    c = nd.Configuration(np.zeros((4, 1, 3)), np.broadcast_to(ONE, (5, 3, 3)), S)
    assert c.shape == (4, 5)
    assert c.position.shape == (4, 5, 3)
    assert c.rotation.shape == (4, 5, 3, 3)
    assert c.internal_point.shape == (4, 5, 3)
    assert len(c) == 4


@pytest.mark.parametrize("shape", [(0,), (2, 0), (0, 3)])
def test_empty_stacks(shape):
    c = nd.Configuration(np.zeros((*shape, 3)), ONE, S)
    assert c.shape == shape
    assert c.rotation.shape == (*shape, 3, 3)
    assert len(c) == shape[0]


# --- Validation -------------------------------------------------------------------------------------------------------


def test_rotation_tolerance():
    almost = ONE + np.diag([4e-10, 0.0], k=1)
    assert nd.Configuration(P, almost, S).shape == ()


def test_nan_marks_a_pose_without_data_in_a_stack():
    c = nd.Configuration([[0.0, 0.0, 4.0], [math.nan, 0.0, 4.0]], ONE, S)
    assert np.isnan(c.position[1, 0])
    assert nd.Configuration(P, [ONE, ONE * math.nan], S).shape == (2,)
    with pytest.raises(ValueError, match=message("position")):
        nd.Configuration([[0.0, 0.0, 4.0], [math.inf, 0.0, 4.0]], ONE, S)
    with pytest.raises(ValueError, match=message("rotation")):
        nd.Configuration(P, [ONE, -ONE], S)


def test_nan_marks_a_pose_in_a_neutral_stack_too():
    c = nd.Configuration.neutral(zp=4.0, zs=[2.0, math.nan])
    assert_array_equal(np.isnan(c.internal_point[:, 2]), [False, True])


# --- Indexing and value semantics -------------------------------------------------------------------------------------


def test_indexing(stack):
    assert stack[1].shape == ()
    assert_array_equal(stack[1].internal_point, stack.internal_point[1])
    assert stack[-1] == stack[4]
    assert_array_equal(stack[1:3].rotation, stack.rotation[1:3])
    keep = np.array([True, False, True, False, False])
    assert_array_equal(stack[keep].position, stack.position[keep])
    assert_array_equal(stack[[3, 3, 0]].rotation, stack.rotation[[3, 3, 0]])
    assert stack[None].shape == (1, 5)
    assert stack[...] == stack
    assert [c.shape for c in stack] == [()] * 5
    assert stack[:0].shape == (0,)
    grid = nd.Configuration.neutral([[3.0], [4.0]], [1.0, 1.5, 2.0])
    assert grid[1, 2] == nd.Configuration.neutral(4.0, 2.0)
    assert grid[:, 0].shape == (2,)


def test_bad_indexing(stack, neutral):
    with pytest.raises(IndexError):
        stack[5]
    with pytest.raises(IndexError):
        stack[0, 0]
    with pytest.raises(TypeError, match="single configuration"):
        neutral[0]
    with pytest.raises(TypeError, match="single configuration"):
        len(neutral)


def test_a_single_configuration_is_true(neutral):
    """A single configuration has no length but is true, so that `if configuration:` works."""
    assert neutral


def test_immutable(stack):
    for name in ("position", "rotation", "internal_point"):
        with pytest.raises(AttributeError):
            setattr(stack, name, None)
        with pytest.raises(ValueError, match="read-only"):
            getattr(stack, name)[0] = 1.0
    with pytest.raises(AttributeError):
        stack.color = "red"
    source = np.array(P)
    c = nd.Configuration(source, ONE, S)
    source[:] = 99.0
    assert_array_equal(c.position, P)


def test_equality(stack, neutral):
    assert stack == nd.Configuration(stack.position, stack.rotation, stack.internal_point)
    assert stack != neutral
    assert stack[0] != stack[1]
    assert stack != "configuration"
    missing = nd.Configuration([[math.nan, 0.0, 4.0], [0.0, 0.0, 4.0]], ONE, S)
    assert missing == missing[:]
    with pytest.raises(TypeError, match="unhashable"):
        hash(stack)


def test_copies_and_pickles(stack, neutral):
    missing = nd.Configuration([[math.nan, 0.0, 4.0], [0.0, 0.0, 4.0]], ONE, S)
    for c in (stack, neutral, stack[:0], missing, missing[0]):
        for twin in (pickle.loads(pickle.dumps(c)), copy.copy(c), copy.deepcopy(c)):
            assert twin == c
            assert not twin.position.flags.writeable


def test_repr(stack, neutral):
    assert eval(repr(neutral), {"Configuration": nd.Configuration}) == neutral
    assert "(5,)" in repr(stack)


@pytest.mark.parametrize("dtype", [np.float16, np.float32, np.int64, ">f8"])
def test_any_real_array_is_taken(dtype):
    c = nd.Configuration(
        np.array([0, 0, 4], dtype), np.asfortranarray(np.eye(3)).astype(dtype), np.array([0, 0, 2], dtype)
    )
    assert c == nd.Configuration.neutral(4.0, 2.0)
    assert c.position.dtype == np.float64


def test_memory_layout_does_not_matter(published):
    rng = np.random.default_rng(1)
    p = np.ascontiguousarray(rng.normal(size=(3, 6)).T)[::2]
    q = Rotation.from_rotvec(0.2 * rng.normal(size=(3, 3))).as_matrix()
    plain = nd.Configuration(p.copy(), q, S)
    odd = nd.Configuration(np.asfortranarray(p), np.asfortranarray(q), np.array([S] * 6, order="F")[::2])
    assert plain == odd
    assert odd.rotation.flags.c_contiguous
    assert_array_equal(nd.leg_lengths(published, odd), nd.leg_lengths(published, plain))


@pytest.mark.parametrize("shape", [(), (4,), (2, 3), (0,)])
def test_no_flag_makes_a_configuration_changeable(shape):
    at = nd.Configuration.neutral(3.9828, np.full(shape, 2.3745))
    for same_pose in (at, at.moved(np.zeros(9)), pickle.loads(pickle.dumps(at)), copy.deepcopy(at)):
        for array in (same_pose.position, same_pose.rotation, same_pose.internal_point):
            base = array
            while isinstance(base, np.ndarray):
                assert base.flags.aligned
                with pytest.raises(ValueError, match="WRITEABLE"):
                    base.flags.writeable = True
                base = base.base
