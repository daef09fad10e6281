"""A design stands for its geometry, its neutral pose and its characteristic length wherever these are taken."""

import inspect

import numpy as np
import pytest

import ninedof as nd

TAKING = [
    name
    for name in nd.__all__
    if callable(getattr(nd, name))
    and hasattr(getattr(nd, name), "__wrapped__")
    and not isinstance(getattr(nd, name), type)
]
MORE = {  # arguments behind the design
    "forward_velocity": [np.ones(9)],
    "inverse_velocity": [[0.1, 0.2, 0.3], [0.1, 0.0, 0.2], [0.0, 0.1, 0.1]],
    "internal_velocity": [[0.1, 0.2, 0.3], [0.1, 0.0, 0.2]],
    "forward_acceleration": [np.ones(9), np.ones(9)],
    "inverse_acceleration": [[0.1, 0.2, 0.3], [0.1, 0.0, 0.2], [0.0, 0.1, 0.1], *np.ones((3, 3))],
    "jacobian_rate": [*np.ones((3, 3))],
    "error_bounds": [0.01],
    "error_samples": [0.01],
    "leg_forces": [[0.1, 0.0, 0.0], [0.0, 0.0, -1.0]],
    "stiffness": [1e4],
}
SAMPLE = ["singular_values", "condition_number", "manipulability", "characteristic_length", "leg_lengths", "jacobian"]
SAMPLE += ["singularity_margins", "condition_number_bounds", "self_stress", *MORE]


@pytest.fixture(scope="module")
def result():
    study = nd.Study(characteristic_length=2.5, constraints={"radius_ratio": (None, 2.0)}, starts=8)
    return nd.optimize(study)


def numbers(value):
    """All numbers of an answer."""
    if isinstance(value, np.ndarray | float | int):
        return [np.asarray(value, float)]
    if isinstance(value, nd.Configuration):
        return [value.position, value.rotation, value.internal_point]
    fields = value if isinstance(value, tuple | list) else vars(value).values() if hasattr(value, "__dict__") else ()
    return [number for field in fields for number in numbers(field)]


@pytest.mark.parametrize("name", SAMPLE)
def test_a_result_stands_for_its_robot(name, result):
    function = getattr(nd, name)
    more = MORE.get(name, [])
    length = {"characteristic_length": 2.5} if "characteristic_length" in inspect.signature(function).parameters else {}
    expected = numbers(function(result.geometry, result.configuration, *more, **length))
    for design in (result, result.best, nd.Design(result.geometry, result.configuration, 2.5)):
        assert expected
        for a, b in zip(numbers(function(design, *more)), expected, strict=True):
            np.testing.assert_array_equal(a, b)


def test_what_is_given_counts(result):
    other = nd.Configuration.neutral(3.0, 1.5)
    of_pose = nd.condition_number(result, other)
    assert of_pose == nd.condition_number(result.geometry, other, 2.5) != nd.condition_number(result)
    assert nd.condition_number(result, other, 1.0) == nd.condition_number(result.geometry, other, 1.0)
    assert nd.condition_number(result, characteristic_length=1.0) == nd.condition_number(
        result.geometry, result.configuration
    )


def test_functions_that_take_designs_are_many():
    assert len(TAKING) > 35
    assert {"sweep", "forward_position", "best_internal_point"} <= set(TAKING)


def test_a_sweep_a_path_and_a_workspace_of_a_result(result):
    swept = nd.sweep(result, {"x_p": (-0.1, 0.1, 3)})
    assert swept["condition_number"][1] == pytest.approx(nd.condition_number(result), rel=1e-12)
    line = nd.Trajectory.line(result.configuration, [0.1, 0.0, 0.0], points=11)
    along = nd.follow(result, line)
    assert (along.characteristic_length, along.internal_point) == (2.5, "carried")
    assert along.condition_number[0] == pytest.approx(result.condition_number, rel=1e-12)
    with pytest.raises(ValueError, match="home: got none"):
        nd.follow(result.geometry, line)


@pytest.mark.slow
def test_a_workspace_of_a_result_has_the_limits_and_the_actuators_of_its_study():
    study = nd.Study(
        family="symmetric",
        constraints={"stroke_ratio": (None, 1.4), "base_cone": {"max_deg": 50, "axis": [0, 0, 1]}},
        objective={"region": {"box": [0.3, 0.3, 0.3], "tilt_deg": 5}},
        starts=8,
    )
    result = nd.optimize(study)
    g, c = result.geometry, result.configuration
    legs = result.sheet().legs
    permitted, needed = nd.workspace(result), nd.workspace(result, criteria=needs(result, legs))
    assert permitted.volume > needed.volume > 0.36  # that is twice the region
    # By hand: a leg of a length ratio of 1.4 about the lengths that it needs.
    middle = np.sqrt([leg.shortest * leg.longest for leg in legs])
    limits = (middle / np.sqrt(1.4), middle * np.sqrt(1.4))
    by_hand = nd.workspace(
        g,
        ([-4.0, -4.0, c.position[2] - 4.0], [4.0, 4.0, c.position[2] + 4.0]),
        criteria={"leg_limits": limits, "base_cone": {"max": np.radians(50), "axis": (0, 0, 1)}},
        home=c,
        rotation=c.rotation,
        internal_point={"platform": c.rotation.T @ (c.internal_point - c.position)},
    )
    if not by_hand.box_limits and not permitted.box_limits:
        assert by_hand.volume == pytest.approx(permitted.volume, rel=5e-3)


def test_a_certified_workspace_of_a_result_has_the_limits_of_its_study():
    objective = {"region": {"box": [0.3, 0.3, 0.3], "tilt_deg": 5, "internal_point": "held"}}
    study = nd.Study(constraints={"stroke_ratio": (None, 1.4)}, objective=objective, starts=4)
    result = nd.optimize(study)
    proved, estimate = nd.certified_workspace(result, gap=0.2), nd.workspace(result, tolerance=1e-2)
    np.testing.assert_array_equal([proved.box_low, proved.box_high], [estimate.low, estimate.high])
    assert proved.volume[0] <= estimate.volume <= proved.volume[1]
    # By hand: O stays where the design has it, and a leg of a length ratio of 1.4 about the lengths that it needs.
    middle = np.sqrt([leg.shortest * leg.longest for leg in result.sheet().legs])
    by_hand = nd.certified_workspace(
        result.geometry,
        (estimate.low, estimate.high),
        criteria={"leg_limits": (middle / np.sqrt(1.4), middle * np.sqrt(1.4))},
        home=result.configuration,
        internal_point=result.configuration.internal_point,
        gap=0.2,
    )
    np.testing.assert_allclose(proved.volume, by_hand.volume, rtol=0.05)
    wider = nd.certified_workspace(result, criteria={"leg_limits": (middle / 1.4, middle * 1.4)}, gap=0.2)
    assert wider.volume[0] > proved.volume[1]


def needs(result, legs):
    """The criteria of the lengths that the region needs."""
    lengths = ([leg.shortest for leg in legs], [leg.longest for leg in legs])
    return {"leg_limits": lengths, "base_cone": {"max": np.radians(50), "axis": (0, 0, 1)}}


def test_a_result_without_a_design_is_refused():
    nothing = nd.optimize(nd.Study(constraints={"leg_ratio": (None, 1.0001), "leg_length": (9.0, None)}, starts=2))
    for call in (nd.condition_number, nd.leg_lengths, nd.workspace, nd.certified_workspace):
        if nothing.best is None:
            with pytest.raises(ValueError, match="got a result without a design"):
                call(nothing)
