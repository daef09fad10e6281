"""The model of the viewer, without a screen: what goes in, what comes out."""

import math
from pathlib import Path

import numpy as np
import pytest

import ninedof as nd
from ninedof.support.margins import is_violated
from ninedof.viewer.folders import spread_words
from ninedof.viewer.machine import machine_of
from ninedof.viewer.numbers import numbers_of
from ninedof.viewer.panel import limits_html
from ninedof.viewer.state import State


@pytest.fixture(scope="module")
def found():
    """A small study with a limit of every kind that the viewer shows."""
    study = nd.Study(
        constraints={
            "stroke_ratio": (None, 1.9),
            "base_cone": {"max_deg": 60},
            "leg_clearance": {"min": 0.05},
            "radius_ratio": (None, 3.0),
            "external_length": (0.5, 8.0),
        },
        objective={"poses": [{"position": (0.2, 0.1, 0.2)}, {"position": (-0.2, 0.0, -0.1)}]},
    )
    result = nd.optimize(study, starts=2, seed=1)
    assert result.best is not None
    return result


def numbers(state):
    return numbers_of(state.variant, state.configuration)


def shifted(point, by):
    return point + np.array(by)


def moved(c):
    return nd.Configuration(
        shifted(c.position, [0.3, -0.2, 0.1]), c.rotation, shifted(c.internal_point, [0.3, -0.2, 0.1])
    )


def test_numbers_are_those_of_the_public_functions():
    state = State(machine_of())
    g, c = state.variant.geometry, state.configuration
    assert numbers(state).condition_number == nd.condition_number(g, c)
    state.set_pose(position=shifted(c.position, [0.3, -0.2, 0.1]))
    there = moved(c)
    shown = numbers(state)
    np.testing.assert_allclose(state.configuration.internal_point, there.internal_point, atol=1e-12)
    np.testing.assert_allclose(shown.condition_number, nd.condition_number(g, there), rtol=1e-12)
    np.testing.assert_allclose(shown.leg_lengths, nd.leg_lengths(g, there), rtol=1e-12)
    np.testing.assert_allclose(shown.singular_values, nd.singular_values(g, there), rtol=1e-12)
    np.testing.assert_allclose(shown.determinants, nd.singularity_margins(g, there), rtol=1e-10)
    assert shown.limits == ()


@pytest.mark.parametrize("turn", [(10.0, 0.0, 0.0), (5.0, -12.0, 30.0)])
def test_o_follows_its_rule(turn):
    state = State(machine_of())
    home = state.variant.home
    away = {}
    for rule in ("carried", "shifted", "held"):
        state.go_home()
        state.set_rule(rule)
        state.set_pose(position=shifted(home.position, [0.4, 0.1, 0.0]), turn_deg=turn)
        np.testing.assert_allclose(state.coordinates[3:6], turn, atol=1e-9)
        away[rule] = state.configuration
    q = away["carried"].rotation
    own = q.T @ (away["carried"].internal_point - away["carried"].position)
    np.testing.assert_allclose(own, home.internal_point - home.position, atol=1e-12)  # Q is the identity at home
    np.testing.assert_allclose(
        away["shifted"].internal_point, shifted(home.internal_point, [0.4, 0.1, 0.0]), atol=1e-12
    )
    np.testing.assert_array_equal(away["held"].internal_point, home.internal_point)


def test_the_best_o_is_the_best_and_a_hand_takes_it_away():
    state = State(machine_of())
    state.set_pose(position=shifted(state.variant.home.position, [0.8, 0.0, 0.0]))
    before = numbers(state).condition_number
    state.set_rule("best")
    best = nd.best_internal_point(state.variant.geometry, state.configuration.position)
    assert numbers(state).condition_number == pytest.approx(best.value, rel=1e-9)
    assert best.value < before
    state.set_internal_point(shifted(state.configuration.internal_point, [0.0, 0.0, 0.1]))
    assert state.rule == "held"


def test_limits_are_those_of_the_study(found):
    state = State(machine_of(found))
    shown = {(one.name.split(" ")[0], one.side): one for one in numbers(state).limits}
    assert {name for name, _ in shown} == {
        "stroke_ratio",
        "base_cone",
        "leg_clearance",
        "radius_ratio",
        "external_length",
    }
    margins = found.study.evaluate(found.variables).margins
    assert shown["radius_ratio", ""].margin == pytest.approx(margins["radius_ratio"], abs=1e-12)
    # At home the legs stretch the spread of the poses of the study no further.
    assert shown["stroke_ratio", "max"].margin == pytest.approx(margins["stroke_ratio"], abs=1e-9)
    for one in shown.values():
        assert is_violated(one.margin, one.unit, one.limit) == (one.margin < -1e-6)


def test_a_leg_beyond_its_length_is_told(found):
    state = State(machine_of(found))
    assert not any(numbers(state).legs_out)
    state.set_pose(position=shifted(state.variant.home.position, [0.0, 0.0, 6.0]))
    shown = numbers(state)
    lengths = nd.leg_lengths(state.variant.geometry, state.configuration)
    assert (lengths[:3] > 8.0).all()
    assert shown.legs_out[:3] == (True, True, True)
    assert any(one.margin < -1e-6 and one.name.startswith("external_length") for one in shown.limits)
    state.set_pose(position=[9.0, 0.0, float(state.variant.home.position[2])])
    assert ("base", 0) in numbers(state).cones_passed


def test_variables_make_the_design_of_the_family(found):
    state = State(machine_of(found))
    state.set_pose(position=shifted(state.variant.home.position, [0.1, 0.0, 0.0]))
    wider = {"a2": 1.1 * found.variables["a2"]}
    state.set_variables(wider)
    point = found.study.evaluate(found.variables | wider)
    assert state.variant.geometry == point.geometry
    np.testing.assert_allclose(state.configuration.position, shifted(point.configuration.position, [0.1, 0.0, 0.0]))
    of_design = next(one for one in numbers(state).limits if one.name == "radius_ratio")
    assert of_design.margin == pytest.approx(point.margins["radius_ratio"])
    state.reset_design()
    assert state.variant.geometry == found.geometry


def test_a_design_that_does_not_exist_changes_nothing():
    state = State(machine_of())
    before = state.variant.geometry
    state.set_variables({"a1": 0.0, "a2": 0.0})
    assert state.note.startswith("no such design")
    assert state.variant.geometry == before


def test_the_best_conditioned_mode_is_the_first():
    state = State(machine_of())
    state.set_pose(position=shifted(state.variant.home.position, [0.3, -0.2, 0.1]), turn_deg=(4.0, -3.0, 8.0))
    modes, kappa, _, _ = state.find_modes()
    assert (np.diff(kappa) >= 0.0).all()
    assert kappa[-1] > 1.1 * kappa[0]
    own = [nd.condition_number(state.variant.geometry, modes[k]) for k in range(len(modes))]
    np.testing.assert_allclose(kappa, own, rtol=1e-9)
    lengths = nd.leg_lengths(state.variant.geometry, state.configuration)
    assert len(modes) == nd.forward_position(state.variant.geometry, lengths).count
    state.set_configuration(modes[1])
    np.testing.assert_allclose(numbers(state).leg_lengths, lengths, rtol=1e-9)


def test_modes_of_another_design_are_not_listed():
    state = State(machine_of())
    found = state.find_modes()
    state.show_mode(1)
    assert state.configuration == found.configurations[1]
    assert state.modes is found  # another pose of the same design
    state.set_variables({"a1": 0.0, "a2": 0.0})  # no such design
    assert state.modes is found
    state.set_variables({"a1": 0.3})
    assert state.modes is None
    state.find_modes()
    state.reset_design()
    assert state.modes is None


def test_the_characteristic_length_can_be_changed():
    state = State(machine_of())
    low, high = state.length_range
    assert low == pytest.approx(0.25)
    assert high == pytest.approx(4.0)
    state.find_modes()
    state.set_length(1.7)
    g, c = state.variant.geometry, state.configuration
    assert numbers(state).condition_number == pytest.approx(nd.condition_number(g, c, 1.7), rel=1e-12)
    assert numbers(state).condition_number != pytest.approx(nd.condition_number(g, c), rel=1e-3)
    assert state.design.characteristic_length == 1.7
    assert state.modes is None
    assert not state.unmoved
    state.set_variables({"a1": 0.1})
    assert state.variant.length == 1.7
    state.reset_design()
    assert state.variant.length == 1.0
    assert state.unmoved


def test_a_free_characteristic_length_is_a_variable():
    study = nd.Study(family="hexagonal", characteristic_length=(0.5, 6.0))
    found = nd.optimize(study, starts=2, seed=1)
    state = State(machine_of(found))
    best = found.variables["characteristic_length"]
    assert state.variant.length == best
    low, high = state.length_range
    assert 0.5 <= low <= best < high <= 6.0
    state.set_length(1.1 * best)
    assert state.variables["characteristic_length"] == 1.1 * best
    assert state.variant.length == 1.1 * best
    state.reset_design()
    assert state.variant.length == best


def test_a_general_machine_has_its_own_sliders():
    rng = np.random.default_rng(3)
    g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    shaken = nd.Geometry(*(getattr(g, n) + 0.1 * rng.normal(size=(3, 3)) for n in nd_triples()))
    state = State(machine_of(nd.Design(shaken, nd.Configuration.neutral(3.98, 2.44))))
    assert state.machine.family == "general"
    assert {v.name for v in state.machine.sliders} == set(state.variables)
    assert all(v.low <= state.variables[v.name] <= v.high and v.low < v.high for v in state.machine.sliders)


def nd_triples():
    return "base_external", "base_internal", "platform_external", "platform_internal"


def test_a_machine_without_a_family_is_shown_without_sliders():
    g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    state = State(machine_of(nd.Design(g, nd.Configuration([0.1, 0, 3.98], internal_point=[0.0, 0.2, 2.4]))))
    assert state.machine.sliders == []
    assert math.isfinite(numbers(state).condition_number)


def test_a_path_is_played_at_its_own_times_and_between_its_poses():
    state = State(machine_of())
    home = state.variant.home
    turned = nd.Configuration.neutral(3.98, 2.44, theta_z=[0.0, 0.4, 0.4]).rotation
    away = shifted(home.position, [[0, 0, 0], [1, 0, 0], [1, 1, 0]])
    state.open_path("mine.csv", nd.Trajectory([1.0, 2.0, 4.0], away, turned))
    player = state.player
    assert player.duration == 3.0
    state.advance(1.0)
    assert player.time == 0.0  # not playing
    state.toggle()
    state.speed = 0.5
    state.advance(1.0)
    c = state.configuration
    np.testing.assert_allclose(c.position - home.position, [0.5, 0, 0], atol=1e-12)
    np.testing.assert_allclose(math.atan2(c.rotation[1, 0], c.rotation[0, 0]), 0.2)
    state.advance(6.0)
    assert player.time == pytest.approx(0.5)  # begun again


def test_the_model_needs_no_screen():
    folder = Path(nd.__file__).parent / "viewer"
    for name in ("state", "numbers", "machine", "body"):
        text = (folder / f"{name}.py").read_text(encoding="utf-8")
        assert "viser" not in text
        assert "plot" not in text


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("rule", ["shifted", "best"])
def test_spreads_are_those_of_the_region(rule):
    region = {"box": (0.3, 0.3, 0.2), "tilt_deg": 6.0, "internal_point": rule}
    study = nd.Study(
        variables={"a1": 0.0, "a2": 5.8124, "b1": 2.9062, "b2": 0.0, "zp": 3.9828, "zs": 2.3745},
        constraints={"stroke_ratio": (None, 1.5), "leg_ratio": (None, 4.0)},
        objective={"region": region},
    )
    result = nd.optimize(study)
    state = State(machine_of(result))
    legs = nd.sheet(result).legs[: 9 if rule == "shifted" else 3]  # O placed anew: what is known of l alone
    lengths = state.variant.study_lengths[:, : len(legs)]
    np.testing.assert_allclose(lengths.min(axis=0), [leg.shortest for leg in legs], rtol=1e-7)
    np.testing.assert_allclose(lengths.max(axis=0), [leg.longest for leg in legs], rtol=1e-7)
    shown = next(one for one in numbers(state).limits if one.name.startswith("stroke_ratio"))
    assert shown.value >= max(leg.stroke_ratio for leg in legs) * (1.0 - 1e-7)
    over = {"shifted": "the region", "best": "the region (q and r: the poses of the study)"}[rule]
    assert spread_words(state.machine) == (
        f"Stroke ratio and leg ratio compare the lengths of the legs over {over} and at the pose shown."
    )


def test_forces_are_in_newtons_where_the_study_states_masses():
    study = nd.Study(
        variables={"a1": 0.0, "a2": 5.8, "b1": 2.9, "b2": 0.0, "zp": 4.0, "zs": 2.4, "theta_z": 0.0},
        constraints={"force": (None, 700.0)},
        loads={"wrenches": [[0.0, 0.0, 0.0, 0.0, 0.0, -50.0]]},
        masses={"platform": 2.0},
        unit="m",
        characteristic_length=1.0,
    )
    machine = machine_of(nd.optimize(study))
    state = State(machine)
    assert "≤ 700.0 N</td>" in limits_html(numbers(state), machine.unit, machine.force_unit)
    assert machine_of().force_unit == ""
