"""The geometry: eqs. (37)-(38), C3 orbits, validation, value semantics."""

import copy
import pickle

import numpy as np
import pytest
from numpy.testing import assert_array_equal

import ninedof as nd

TRIPLES = ("base_external", "base_internal", "platform_external", "platform_internal")
TRIANGLE = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]


def build(**changes):
    return nd.Geometry(**(dict.fromkeys(TRIPLES, TRIANGLE) | changes))


def test_positional_arguments_are_in_the_order_of_the_paper():
    assert nd.Geometry.hexagonal(0.5, 2.0, 1.0, 0.25) == nd.Geometry.hexagonal(a1=0.5, a2=2.0, b1=1.0, b2=0.25)
    four = [np.array(TRIANGLE) * k for k in (1.0, 2.0, 3.0, 4.0)]
    for name, given_triple in zip(TRIPLES, four, strict=True):
        assert_array_equal(getattr(nd.Geometry(*four), name), given_triple)


# --- Value semantics --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "same",
    [
        np.array(TRIANGLE, dtype=np.float32),
        np.eye(3, dtype=int),
        np.asfortranarray(np.eye(3)),
        np.repeat(np.eye(3), 2, axis=1)[:, ::2],
        np.eye(3)[::-1, ::-1],
        np.eye(3, dtype=">f8"),
        np.eye(3, dtype=np.longdouble),
        tuple(map(tuple, TRIANGLE)),
    ],
    ids=["float32", "int", "fortran", "strided", "reversed", "big-endian", "long double", "tuples"],
)
def test_any_real_array_is_taken(same):
    g = build(platform_external=same)
    assert_array_equal(g.platform_external, np.eye(3))
    assert g == build()


def test_immutable(published):
    before = published.base_external.copy()
    with pytest.raises(AttributeError):
        published.base_external = before
    with pytest.raises(AttributeError):
        published.color = "red"
    with pytest.raises(ValueError, match="read-only"):
        published.base_external[0, 0] = 9.0
    source = np.eye(3)
    g = build(base_external=source)
    source[0, 0] = 7.0
    assert g.base_external[0, 0] == 1.0
    assert_array_equal(published.base_external, before)


@pytest.mark.parametrize("name", TRIPLES)
def test_equality_and_hash_go_by_value(name):
    other = build(**{name: np.diag([1.0, 1.0, 2.0])})
    assert build() == build()
    assert hash(build()) == hash(build())
    assert build() != other
    assert build() != "geometry"
    assert len({build(), build(), other}) == 2


def test_equal_geometries_hash_alike_with_negative_zeros():
    negative = np.where(np.eye(3) == 0.0, -0.0, np.eye(3))
    assert build(base_external=negative) == build()
    assert hash(build(base_external=negative)) == hash(build())


def test_copies_and_pickles(published):
    for twin in (pickle.loads(pickle.dumps(published)), copy.copy(published), copy.deepcopy(published)):
        assert twin == published
        assert hash(twin) == hash(published)


def test_repr_builds_the_same_geometry(published):
    assert eval(repr(published), {"Geometry": nd.Geometry}) == published
    assert type(published).__module__ == "ninedof"
