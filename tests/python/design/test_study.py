"""A design study: its defaults, its file, its checks. Its value as an object is in test_study_values.py,
what it evaluates in test_design.py."""

import math
import pickle

import numpy as np
import pytest

import ninedof as nd

SIDES, HEIGHTS = ("a1", "a2", "b1", "b2"), ("zp", "zs")
INF = math.inf


def message(entry):
    return rf"(?s)^{entry}: got .+, expected .+"


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


BAD_BOUNDS = {
    "low > high": (2.0, 1.0),
    "nan low": (math.nan, 1.0),
    "nan high": (0.0, math.nan),
    "nan": math.nan,
    "infinite value": INF,
    "both infinite": (INF, INF),
    "negative length": -1.0,
    "negative bound": (-1.0, 1.0),
    "text": "abc",
    "two letters": "ab",
    "text bounds": ("0", "1"),
    "bool": True,
    "bool bounds": (False, True),
    "none": None,
    "none bound": (None, 1.0),
    "three": (0.0, 1.0, 2.0),
    "one": (1.0,),
    "empty": (),
    "table": {"min": 0.0, "max": 1.0},
    "complex": 1j,
    "nested": [[0.0, 1.0], [2.0, 3.0]],
    "array without dimension": np.array(3.0),
    "huge whole number": 10**400,
    "huge bound": (0, 10**400),
}


@pytest.mark.parametrize("bad", BAD_BOUNDS.values(), ids=BAD_BOUNDS.keys())
def test_bad_variable(bad):
    for name in ("a2", "zs"):
        with pytest.raises(ValueError, match=message(name)):
            nd.Study(variables={name: bad})


BAD_LIMITS = {
    "low > high": (2.0, 1.0),
    "nan": (None, math.nan),
    "negative": (-3.0, -1.0),
    "zero": (None, 0.0),
    "infinite low": (INF, None),
    "number": 2.0,
    "none": None,
    "text": "ab",
    "text limit": (None, "2"),
    "bool": (None, True),
    "three": (None, 1.0, 2.0),
    "text in a mapping": {"max": "2"},
    "huge whole number": (None, 10**400),
}


@pytest.mark.parametrize("bad", BAD_LIMITS.values(), ids=BAD_LIMITS.keys())
def test_bad_constraint(bad):
    for name in ("radius_ratio", "leg_ratio", "zs_fraction"):
        with pytest.raises(ValueError, match=message(name)):
            nd.Study(constraints={name: bad})


BAD_LENGTHS = {
    "text": "1",
    "other kind": "longest",
    "huge": 10**400,
    "reversed": (2.0, 1.0),
    "from zero": (0.0, 1.0),
    "open": (1.0, INF),
    "nan": (1.0, math.nan),
    "bools": (False, True),
    "kinds": ("natural", "optimal"),
    "three": (1.0, 2.0, 3.0),
} | {repr(bad): bad for bad in (0.0, -1.0, math.nan, INF, True, None, [1.0], (), {}, 1j, np.bool_(True))}


@pytest.mark.parametrize("bad", BAD_LENGTHS.values(), ids=BAD_LENGTHS.keys())
def test_bad_characteristic_length(bad):
    with pytest.raises(ValueError, match=message("characteristic_length")):
        nd.Study(characteristic_length=bad)


@pytest.mark.parametrize("name", ["starts", "seed"])
@pytest.mark.parametrize("bad", [-1, 1.0, 1.5, "1", True, None, 2**63, math.nan], ids=repr)
def test_bad_whole_number(name, bad):
    with pytest.raises(ValueError, match=message(name)):
        nd.Study(**{name: bad})


def test_no_starts():
    with pytest.raises(ValueError, match=message("starts")):
        nd.Study(starts=0)


@pytest.mark.parametrize("bad", ["hexagonl", "", None, 1, ["hexagonal"]], ids=repr)
def test_bad_family(bad):
    with pytest.raises(ValueError, match=r"^family: got .+, expected one of .*hexagonal"):
        nd.Study(family=bad)


@pytest.mark.parametrize("name", ["variables", "constraints"])
@pytest.mark.parametrize("bad", [None, 3, "a1"], ids=repr)
def test_tables_must_be_tables(name, bad):
    with pytest.raises((ValueError, TypeError), match=name):
        nd.Study(**{name: bad})


@pytest.mark.parametrize(
    ("argument", "slip", "hint"),
    [
        ("variables", "thetaz", "theta_z"),
        ("variables", "theta-z", "theta_z"),
        ("constraints", "radius_ration", "radius_ratio"),
    ],
)
def test_unknown_names_get_a_suggestion(argument, slip, hint):
    with pytest.raises(ValueError, match=rf"^{argument}: got the entry '{slip}', expected .*did you mean '{hint}'"):
        nd.Study(**{argument: {slip: (0.0, 1.0)}})
