"""One law for every function of a robot at poses: a stack is its rows, bit for bit, and what is missing stays alone.

The oracle of a row is the call for its pose alone; what that returns is tested in the room of the function.
"""

import dataclasses
import functools
import inspect

import numpy as np
import pytest
from numpy.testing import assert_array_equal

import ninedof as nd

G = nd.Geometry.hexagonal(a1=0.3, a2=5.5, b1=2.9, b2=0.2)
BEYOND_A_BLOCK = 3000
VECTOR, WRENCH, LEGS, JOINTS, POSITIVE, WEIGHTS, LENGTH = "vector wrench legs joints positive weights length".split()
SHAPES = {VECTOR: (3,), WRENCH: (6,), LEGS: (9,), JOINTS: (12,), POSITIVE: (9,), WEIGHTS: (9,), LENGTH: ()}
SIGNED = (VECTOR, WRENCH, LEGS)
INDEX = [LENGTH]


def ellipsoid(function, part):
    return lambda c, lc: function(G, c, part, lc)


def dynamics(c, velocity, acceleration, load):
    masses = nd.Masses(platform=2.0, centre=(0.1, 0.2, 0.3), cylinder=0.5, rod=0.3)
    return nd.inverse_dynamics(G, c, (velocity, acceleration), masses, load=load)


CALLS = {
    "leg_lengths": [],
    "null_motion": [],
    "error_map": [],
    "characteristic_length": [],
    "singularity_margins": [],
    "singularity": [],
    **dict.fromkeys(["velocity_matrices", "jacobian", "condition_number", "reciprocal_condition_number"], INDEX),
    **dict.fromkeys(["manipulability", "isotropy_residual", "singular_values", "axis_singular_values"], INDEX),
    "forward_velocity": [LEGS],
    "inverse_velocity": [VECTOR] * 3,
    "internal_velocity": [VECTOR, VECTOR, WEIGHTS],
    "forward_acceleration": [LEGS] * 2,
    "inverse_acceleration": [VECTOR] * 6,
    "jacobian_rate": [*[VECTOR] * 3, LENGTH],
    "leg_forces": [VECTOR] * 3,
    "stiffness": [POSITIVE],
    "error_bounds": [POSITIVE, JOINTS],
    "distance_to_singularity": [LEGS],
}
OTHERS = {
    **{f"velocity_ellipsoid {part}": (ellipsoid(nd.velocity_ellipsoid, part), INDEX) for part in ("rotation", "twist")},
    **{f"force_ellipsoid {part}": (ellipsoid(nd.force_ellipsoid, part), INDEX) for part in ("translation", "twist")},
    "inverse_dynamics": (dynamics, [LEGS, LEGS, WRENCH]),
    "inverse_velocity, O chosen": (
        lambda c, omega, pdot, weights: nd.inverse_velocity(G, c, omega, pdot, weights=weights),
        [VECTOR, VECTOR, WEIGHTS],
    ),
    "stiffness, O held": (lambda c, k: nd.stiffness(G, c, k, internal=True), [POSITIVE]),
    "condition_number, frobenius": (lambda c, lc: nd.condition_number(G, c, lc, norm="frobenius"), INDEX),
}
TABLE = {name: (functools.partial(getattr(nd, name), G), kinds) for name, kinds in CALLS.items()} | OTHERS
EVERY = pytest.mark.parametrize("name", TABLE)


def poses(rng, shape, on_axis=False):
    """Neutral poses, moved at random but for the function that wants them on the axis."""
    c = nd.Configuration.neutral(
        rng.uniform(3.5, 4.5, shape), rng.uniform(1.8, 2.6, shape), rng.uniform(-0.4, 0.4, shape)
    )
    return c if on_axis else c.moved(0.2 * rng.normal(size=(*shape, 9)))


def drawn(name, shape, lead):
    """The function of a row, poses of a shape and its other arguments with leading dimensions."""
    rng = np.random.default_rng(7)
    function, kinds = TABLE[name]
    more = [rng.normal(size=(*(() if kind == LENGTH and 1 in lead else lead), *SHAPES[kind])) for kind in kinds]
    more = [a if kind in SIGNED else np.abs(a) + 0.1 for a, kind in zip(more, kinds, strict=True)]
    return function, poses(rng, shape, name.startswith("axis")), more


def parts(result):
    """All arrays and numbers of a result, of tuples in tuples too."""
    if dataclasses.is_dataclass(result):
        result = tuple(getattr(result, field.name) for field in dataclasses.fields(result))
    return [array for one in result for array in parts(one)] if isinstance(result, tuple) else [result]


def assert_rows(result, rows):
    for whole, each in zip(parts(result), zip(*map(parts, rows), strict=True), strict=True):
        assert_array_equal(whole, np.stack(each))


@EVERY
def test_a_stack_is_its_rows_whatever_is_beside_them(name):
    function, c, more = drawn(name, (5,), (5,))
    rows = [function(c[k], *(a[k] for a in more)) for k in range(5)]
    assert_rows(function(c, *more), rows)
    assert not [one for one in parts(rows[0]) if isinstance(one, np.ndarray) and one.ndim == 0]  # but floats and words
    p = c.position.copy()
    p[1, 2] = np.nan
    holed = function(nd.Configuration(p, c.rotation, c.internal_point), *more)
    good = [0, 2, 3, 4]
    assert_rows(tuple(part[good] for part in parts(holed)), [tuple(parts(rows[k])) for k in good])
    assert any(np.isnan(part[1]).any() for part in parts(holed) if part.dtype == float)
    for k, kind in enumerate(TABLE[name][1]):
        if kind in (WEIGHTS, LENGTH):  # NaN is refused
            continue
        with_nan = [a.copy() for a in more]
        with_nan[k][1, -1] = np.nan
        holed = function(c, *with_nan)
        assert_rows(tuple(part[good] for part in parts(holed)), [tuple(parts(rows[n])) for n in good])
        assert any(np.isnan(part[1]).any() for part in parts(holed) if part.dtype == float)


@EVERY
def test_leading_dimensions_broadcast_and_may_be_empty(name):
    function, c, more = drawn(name, (5,), (4, 1))
    if set(TABLE[name][1]) - {LENGTH}:  # that has the shape of the poses
        result = parts(function(c, *more))
        assert {part.shape[:2] for part in result} == {(4, 5)}
        assert_rows(
            tuple(part[3] for part in result),
            [function(c[k], *(a[3, 0] if a.ndim else a for a in more)) for k in range(5)],
        )
    function, grid, more = drawn(name, (2, 3), ())
    result = parts(function(grid, *more))
    assert {part.shape[:2] for part in result} == {(2, 3)}
    assert_rows(tuple(part[1] for part in result), [function(grid[1, k], *more) for k in range(3)])
    assert {part.shape[0] for part in parts(function(grid[:0], *more))} == {0}


@EVERY
def test_many_poses_hold_the_bits_of_each_on_any_number_of_threads(name):
    function, c, more = drawn(name, (BEYOND_A_BLOCK,), (BEYOND_A_BLOCK,))
    some = range(0, BEYOND_A_BLOCK, 600)
    result = parts(function(c, *more))
    assert_rows(tuple(part[some] for part in result), [function(c[k], *(a[k] for a in more)) for k in some])
    if "threads" in inspect.signature(getattr(nd, name, len)).parameters:
        for threads in (1, 3):
            again = parts(getattr(nd, name)(G, c, *more, threads=threads))
            assert [part.tobytes() for part in again] == [part.tobytes() for part in result]
