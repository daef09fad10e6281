"""A design study: its defaults. Its value as an object is in test_study_values.py, what it evaluates in
test_design.py, what it refuses in test_bad_entries.py."""

import math
import pickle

import numpy as np
import pytest

import ninedof as nd

SIDES, HEIGHTS = ("a1", "a2", "b1", "b2"), ("zp", "zs")
INF = math.inf


def test_the_study_of_the_paper():
    s = nd.Study.paper()
    assert s.family == "hexagonal"
    assert s.variables == {**dict.fromkeys(SIDES, (0.0, 60.0)), **dict.fromkeys(HEIGHTS, (0.05, 80.0)), "theta_z": 0.0}
    assert s.constraints == {"radius_ratio": (None, 2.0)}
    assert (s.characteristic_length, s.starts, s.seed) == (1.0, 64, 0)


def test_variables_left_out_take_defaults():
    s = nd.Study(variables={"b1": (1, 2), "zs": 1.5})
    assert s.variables == nd.Study().variables | {"b1": (1.0, 2.0), "zs": 1.5}
    assert list(s.variables) == [*SIDES, *HEIGHTS, "theta_z"]
    assert s.constraints == {}


def test_default_lengths_scale_with_the_characteristic_length():
    s = nd.Study(characteristic_length=1000.0, variables={"a2": (0, 7)})
    assert s.variables["a1"] == (0.0, 60_000.0)
    assert s.variables["zp"] == (50.0, 80_000.0)
    assert s.variables["a2"] == (0.0, 7.0)
    assert s.variables["theta_z"] == 0.0


def test_numbers_of_any_kind_become_floats():
    s = nd.Study(
        variables={"a1": [0, 1], "a2": np.array([0.0, 2.0]), "b1": np.float32(0.5), "zp": np.int64(3)},
        starts=np.int32(5),
    )
    assert s.variables["a1"] == (0.0, 1.0)
    assert s.variables["a2"] == (0.0, 2.0)
    assert [type(s.variables[name]) for name in ("b1", "zp")] == [float, float]
    assert type(s.starts) is int


def test_value_semantics():
    assert nd.Study.paper() == nd.Study.paper()
    assert nd.Study.paper() != nd.Study()
    assert pickle.loads(pickle.dumps(nd.Study.paper())) == nd.Study.paper()
    with pytest.raises(AttributeError):
        nd.Study.paper().seed = 1


def test_bounds_may_touch_and_may_be_open():
    s = nd.Study(variables={"a1": (1, 1), "a2": (0, INF), "theta_z": (-INF, INF)})
    assert s.variables["a1"] in (1.0, (1.0, 1.0))
    assert s.variables["a2"] == (0.0, INF)
