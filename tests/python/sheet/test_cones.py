"""Cones of joints: external and internal joints with limits and axes of their own, and what a sheet says of them."""

import numpy as np
import pytest
from tall_machine import VARIABLES

import ninedof as nd

UP, DOWN = [0, 0, 1], [0, 0, -1]


def study(constraints, **region):
    return nd.Study(
        family="symmetric",
        variables=VARIABLES,
        constraints=constraints,
        objective={"region": {"box": [30, 30, 30], "tilt_deg": 8.0, **region}},
        characteristic_length=150.0,
        starts=8,
        unit="mm",
    )


def angles(result, body, legs, axis, count=4000):
    """The angles of legs from an axis at random poses of the region, by numpy, in degrees."""
    random, g, home = np.random.default_rng(1), result.geometry, result.configuration
    shift = random.uniform(-30, 30, (count, 3))
    heading, tilt = random.uniform(0, 2 * np.pi, count), np.radians(8.0) * np.sqrt(random.uniform(0, 1, count))
    turn = np.stack([tilt * np.cos(heading), tilt * np.sin(heading), np.zeros(count)], axis=1)
    from scipy.spatial.transform import Rotation

    q = Rotation.from_rotvec(turn).as_matrix() @ home.rotation
    p, s = home.position + shift, home.internal_point + shift
    out = []
    for leg in legs:
        kind, i = leg[0], int(leg[1]) - 1
        base = {"l": g.base_external, "r": g.base_internal}.get(kind)
        top = {"l": g.platform_external, "q": g.platform_internal}.get(kind)
        low = s if base is None else np.broadcast_to(base[i], s.shape)
        high = s if top is None else p + q @ top[i]
        d = high - low if kind != "q" else s - high
        if body == "platform":
            d = np.einsum("nji,nj->ni", q, d if kind == "q" else -d)
        d /= np.linalg.norm(d, axis=1, keepdims=True)
        out.append(np.degrees(np.arccos(d @ np.array(axis))))
    return np.array(out)


@pytest.mark.slow(sanitized=True)
def test_external_and_internal_joints_have_limits_of_their_own():
    result = nd.optimize(
        study(
            {
                "base_cone_external": {"max_deg": 30, "axis": UP},
                "base_cone_internal": {"max_deg": 42, "axis": UP},
                "platform_cone_external": {"max_deg": 40, "axis": DOWN},
                "platform_cone_internal": {"max_deg": 50, "axis": DOWN},
            }
        )
    )
    assert result.status == "optimal"
    limits = {row.name: row for row in result.sheet().limits}
    for name, body, legs, axis, most in (
        ("base_cone_external", "base", ("l1", "l2", "l3"), UP, 30),
        ("base_cone_internal", "base", ("r1", "r2", "r3"), UP, 42),
        ("platform_cone_external", "platform", ("l1", "l2", "l3"), DOWN, 40),
        ("platform_cone_internal", "platform", ("q1", "q2", "q3"), DOWN, 50),
    ):
        seen = angles(result, body, legs, axis).max()
        assert seen <= np.degrees(limits[name].value) + 1e-6 <= most + 1e-5
        assert limits[name].part in legs
    assert set(result.active) & {f"{body}_cone_{kind}" for body in ("base", "platform") for kind in ("external",)}


@pytest.mark.slow(sanitized=True)
def test_the_cones_of_one_kind_of_joint_are_those_of_its_legs():
    """Both halves together limit as the whole does."""
    whole = nd.optimize(study({"base_cone": {"max_deg": 38, "axis": UP}}))
    halves = {f"base_cone_{kind}": {"max_deg": 38, "axis": UP} for kind in ("external", "internal")}
    parts = nd.optimize(study(halves))
    assert parts.objective == pytest.approx(whole.objective, rel=1e-8)
    certificate = whole.certify(time_limit=0.0)
    in_parts = parts.certify(time_limit=0.0)
    assert certificate.proved
    assert in_parts.proved
    workspace = [
        nd.workspace(
            whole.geometry,
            ([-300, -300, 300], [300, 300, 900]),
            criteria=criteria,
            home=whole.configuration,
            rotation=whole.configuration.rotation,
        )
        for criteria in (
            {"base_cone": {"max": 0.7, "axis": UP}},
            {f"base_cone_{kind}": {"max": 0.7, "axis": UP} for kind in ("external", "internal")},
        )
    ]
    assert workspace[1].volume == pytest.approx(workspace[0].volume, rel=2e-3)


@pytest.mark.slow(sanitized=True)
def test_a_sheet_has_angles_about_the_axis_that_the_limit_has():
    result = nd.optimize(
        study({"base_cone": {"max_deg": 40, "axis": UP}, "base_cone_internal": {"max_deg": 60, "axis": [0.1, 0, 1]}})
    )
    sheet = result.sheet()
    assert sheet.cone_axes["base_cone_external"] == (0.0, 0.0, 1.0)
    assert sheet.cone_axes["base_cone_internal"] == (0.1, 0.0, 1.0)
    assert sheet.cone_axes["platform_cone_external"] == ()
    tilted = np.array([0.1, 0.0, 1.0]) / np.hypot(0.1, 1.0)
    for k, leg in enumerate(("l1", "l2", "l3")):
        seen = angles(result, "base", (leg,), UP).max()
        assert seen <= np.degrees(sheet.legs[k].base_cone) + 1e-6 < seen + 3.0
    for k, leg in enumerate(("r1", "r2", "r3")):
        seen = angles(result, "base", (leg,), tilted).max()
        assert seen <= np.degrees(sheet.legs[6 + k].base_cone) + 1e-6 < seen + 3.0
    assert "the axis (0, 0, 1) at external joints of the base" in sheet.summary()
    assert "the direction at the neutral pose at the platform" in sheet.summary()


@pytest.mark.slow(sanitized=True)
def test_a_reversed_axis_is_named():
    result = nd.optimize(
        study({"platform_cone": {"max_deg": 45, "axis": UP}, "base_cone": {"max_deg": 60, "axis": UP}})
    )
    assert result.status == "infeasible"
    assert "axis of platform_cone points against the legs" in result.reason
    assert "base_cone points" not in result.reason


@pytest.mark.slow(sanitized=True)
def test_needed_and_permitted_lengths_are_two_columns():
    result = nd.optimize(study({"leg_length": (80.0, 900.0), "lower_length": (500.0, None)}))
    sheet = result.sheet()
    assert [leg.permitted for leg in sheet.legs] == [(80.0, 900.0)] * 6 + [(500.0, 900.0)] * 3
    head = next(line for line in sheet.summary().splitlines() if "permitted" in line and "leg" in line)
    assert head.split("  ")[0] == "leg"
    assert all(words in head for words in ("needs from", "needs to", "permitted from", "permitted to"))
    assert "permitted_shortest (mm)" in sheet.to_csv()
    assert nd.optimize(study({})).sheet().legs[0].permitted is None
