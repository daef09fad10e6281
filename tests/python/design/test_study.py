"""A study as an object: its defaults, lengths, families, immutable copies, full vectors of variables.

What it evaluates is in test_design_point.py, what it refuses in test_bad_entries.py.
"""

import copy
import dataclasses
import math
import pickle

import numpy as np
import pytest

import ninedof as nd
from ninedof import poses

SIDES, HEIGHTS = ("a1", "a2", "b1", "b2"), ("zp", "zs")
INF = math.inf


def test_the_study_of_the_paper():
    s = nd.Study.paper()
    assert s.family == "hexagonal"
    assert s.variables == {**dict.fromkeys(SIDES, (0.0, 60.0)), **dict.fromkeys(HEIGHTS, (0.05, 80.0)), "theta_z": 0.0}
    assert s.free_variables == (*SIDES, *HEIGHTS)
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


def test_bounds_may_touch_and_may_be_open():
    s = nd.Study(variables={"a1": (1, 1), "a2": (0, INF), "theta_z": (-INF, INF)})
    assert s.variables["a1"] in (1.0, (1.0, 1.0))
    assert s.variables["a2"] == (0.0, INF)


@pytest.mark.parametrize("given", [np.float32(0.5), np.int64(2), 3, "optimal", "mean_leg", [0.5, 2], np.array([1, 2])])
def test_characteristic_lengths_of_every_kind(given):
    found = nd.Study(characteristic_length=given).characteristic_length
    if isinstance(given, str):
        assert found == given
    else:
        assert np.array_equal(found, given)
        assert type(found) is (float if np.ndim(given) == 0 else tuple)


def test_touching_bounds_of_the_characteristic_length_are_a_number():
    assert nd.Study(characteristic_length=(2.0, 2.0)) == nd.Study(characteristic_length=2.0)


def test_default_lengths_are_plain_where_the_characteristic_length_is_no_number():
    for length in ("optimal", "natural", (10.0, 20.0)):
        assert nd.Study(characteristic_length=length).variables == nd.Study().variables


def test_default_coordinates_scale_with_the_characteristic_length_and_angles_do_not():
    one, thousand = (nd.Study(family="general", characteristic_length=lc) for lc in (1.0, 1000.0))
    for name, bound in one.variables.items():
        scale = 1.0 if name in one.angles else 1000.0
        assert np.array(thousand.variables[name]) == pytest.approx(scale * np.array(bound))
    assert one.angles == ("theta_z",)


@pytest.mark.parametrize("family", ["hexagonal", "symmetric", "symmetric_nonplanar", "general"])
def test_every_family_makes_a_robot(family, tmp_path):
    study = nd.Study(family=family)
    problem = study.problem()
    assert problem.names == list(study.variables)
    x = problem.starts(1, 0)[0].tolist()
    point = study.evaluate(dict(zip(problem.names, x, strict=True)))
    assert point.condition_number == pytest.approx(nd.condition_number(point.geometry, point.configuration), rel=1e-9)
    study.save(tmp_path / "study.toml")
    assert nd.Study.load(tmp_path / "study.toml") == study


def test_a_study_cannot_be_changed_from_outside():
    bounds, axis = [0.0, 7.0], [0.0, 0.0, 1.0]
    variables = {"a1": bounds}
    s = nd.Study(variables=variables, constraints={"base_cone": {"max": 1.0, "axis": axis}})
    before = s.to_dict()
    variables["a2"], bounds[1], axis[0] = 3.0, 9.0, 5.0
    s.to_dict()["variables"]["a1"] = 0.0
    assert s.to_dict() == before
    for mapping, key in ((s.variables, "a1"), (s.constraints, "base_cone"), (s.constraints["base_cone"], "max")):
        with pytest.raises(TypeError):
            mapping[key] = 1.0


def test_copies_are_equal_and_immutable():
    study = nd.Study(
        constraints={"base_cone": {"max_deg": 30, "axis": [0, 0, 1]}, "force": (None, 500.0)},
        objective=nd.Objective(poses=poses.ball(0.1, points=3)),
        loads={"wrenches": [[0, 0, 0, 0, 0, -100]]},
    )
    assert study == dataclasses.replace(study) != nd.Study()
    with pytest.raises(AttributeError):
        study.seed = 1
    copies = [copy.copy(study), copy.deepcopy(study), pickle.loads(pickle.dumps(study)), dataclasses.replace(study)]
    for other in copies:
        assert other == study
        with pytest.raises(TypeError):
            other.variables["a1"] = 0.0
        with pytest.raises(TypeError):
            other.constraints["base_cone"]["max"] = 0.0
    assert all(other.defaulted == study.defaulted for other in copies[:3])


def test_another_number_of_starts_keeps_the_defaulted_variables():
    study = nd.Study(variables={"a1": (0.0, 1.0)})
    assert study.with_solver(starts=3).defaulted == study.defaulted == ("a2", "b1", "b2", "zp", "zs")


def test_objective_may_be_given_as_a_table():
    table = {"index": "frobenius", "poses": [{"position": [0.1, 0, 0]}]}
    assert nd.Study(objective=table) == nd.Study(objective=nd.Objective.from_dict(table))


def test_a_design_point_has_its_robot_and_slopes_by_name():
    """Slopes by differences; those of the core are in tests/cpp: optimize/evaluate.cpp, problem/constraints.cpp."""
    study = nd.Study(variables={"a1": 0.0, "b2": 0.0, "theta_z": (-1.0, 1.0)}, constraints={"zs_fraction": (0.1, 0.9)})
    at = {"a2": 5.8124, "b1": 2.9062, "zp": 3.9828, "zs": 2.3745, "theta_z": 0.2}
    point, h = study.evaluate(at), 1e-5
    assert point.geometry == nd.Geometry.hexagonal(0.0, 5.8124, 2.9062, 0.0)
    assert point.configuration == nd.Configuration.neutral(3.9828, 2.3745, 0.2)
    assert point.variables == at | {"a1": 0.0, "b2": 0.0}  # what is fixed may be left out
    for name in at:
        up, down = (study.evaluate(at | {name: at[name] + way * h}) for way in (1, -1))
        assert point.gradient[name] == pytest.approx((up.objective - down.objective) / (2 * h), abs=1e-8)
        slope = (up.margins["zs_fraction"] - down.margins["zs_fraction"]) / (2 * h)
        assert point.margin_gradients["zs_fraction"][name] == pytest.approx(slope, abs=1e-8)


def test_vector_completes_free_lengths_and_offsets():
    design = {"a1": 0.0, "a2": 5.8124, "b1": 2.9062, "b2": 0.0, "zp": 3.9828, "zs": 2.3745}
    at = nd.Objective(poses=(nd.Pose(position=(0.1, 0, 0), internal_point="best"),))
    study = nd.Study(characteristic_length="optimal", objective=at)
    names = study.problem().names
    assert names[7:] == ["characteristic_length", "pose1.s_x", "pose1.s_y", "pose1.s_z"]
    x = dict(zip(names, study.vector(design), strict=True))
    robot = nd.Geometry.hexagonal(0.0, 5.8124, 2.9062, 0.0), nd.Configuration.neutral(3.9828, 2.3745)
    assert x["characteristic_length"] == pytest.approx(nd.characteristic_length(*robot, "optimal"), rel=1e-9)
    assert [x[name] for name in names[8:]] == [0.0, 0.0, 0.0]
    bounded = dataclasses.replace(study, characteristic_length=(100.0, 200.0))
    assert bounded.vector(design)[7] == 100.0
    assert study.vector(design | {"characteristic_length": 2.0, "pose1.s_x": 0.1})[7:9] == [2.0, 0.1]
    for slip in ("pose2.s_x", "pose1.s_w"):
        with pytest.raises(ValueError, match=rf"variables: got the entry '{slip}'"):
            study.vector(design | {slip: 0.0})
    point = study.evaluate(design)
    assert point.configurations.shape == (2,)
    assert point.configuration == point.configurations[0]
    assert point.objective == pytest.approx(point.conditions[0], rel=1e-12)
    assert list(point.variables) == list(point.gradient) == names
