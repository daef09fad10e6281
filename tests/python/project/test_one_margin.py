"""A margin is one number and one text wherever it is shown, for every limit; by hand from value and limit."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from duty_oracle import DUTY
from limit_oracle import EVERY_LIMIT, limits_of, margins, robot_of
from region_oracle import condition_margins
from scipy.spatial.transform import Rotation
from sizes import size

import ninedof as nd
from ninedof import _core
from ninedof.cli.commands.runs.certify import certificate_table
from ninedof.design.limits import ROWS, split_label
from ninedof.export.latex import _limits as latex_limits
from ninedof.proof.machine import certify
from ninedof.sheet.path_limits import limits_at_poses
from ninedof.sheet.rows import limit_rows
from ninedof.sheet.tables import limits_table
from ninedof.support.margins import is_violated, margin_of, margin_words, tolerance_of
from ninedof.tables.table import plain_text
from ninedof.viewer.machine import Variant
from ninedof.viewer.numbers import numbers_of
from ninedof.viewer.panel import limits_html

LIMITS = EVERY_LIMIT | {
    "leg_clearance": {"radius": 0.05},
    "base_cone": [{"max_deg": 60, "axis": [0, 0, 1]}, {"max_deg": 50, "axis": [0, 0, 1], "at": "neutral"}],
    "platform_cone": {"max_deg": 40},
    "singularity_free": {"min": 0.01, "steps": 1},
}


def machine(seed):
    """A random design, its study with every limit, and its poses."""
    objective = {"poses": nd.poses.box(half=(0.1, 0.15, 0.1)), "condition_limit": 40.0}
    study = nd.Study(family="symmetric_nonplanar", constraints=LIMITS, objective=objective, **DUTY)
    problem = study.problem()
    variables = dict(zip(problem.names, problem.starts(1, seed)[0].tolist(), strict=True))
    return study, variables, study.evaluate(variables)


def by_hand(row):
    """What is left of a limit: a share of it, or the distance where there is no scale."""
    away = row.limit - row.value if row.side == "max" else row.value - row.limit
    return away if row.unit == "sign" else away / row.limit


def text(margin, kind):
    if margin == -np.inf:  # of a limit that is violated, and bounded by nothing
        return "-∞"
    if kind == "sign":
        return f"{margin:.4f}"
    return "over 10000 %" if margin >= 100.0 else "below -10000 %" if margin <= -100.0 else f"{100.0 * margin:.2f} %"


@pytest.mark.parametrize("seed", range(size(3, 40)))
def test_every_place_has_the_same_margin(seed):
    study, variables, point = machine(seed)
    rows = limit_rows(study, variables)
    expected = {(row.name, row.side): by_hand(row) for row in rows}
    for row in rows:
        assert row.margin == pytest.approx(expected[row.name, row.side], rel=1e-12, abs=1e-12)
    for name, margin in point.margins.items():
        least = min(found for (label, _), found in expected.items() if label == name)
        assert margin == pytest.approx(least, rel=1e-12, abs=1e-12)
    # By definition, in numpy
    robot = robot_of(study, variables)
    for limit in limits_of(study):
        least = min(found for (label, _), found in expected.items() if label == limit.label)
        assert margins(limit, robot).min() == pytest.approx(least, rel=1e-9, abs=1e-9)
    (condition,) = condition_margins(study, robot)
    assert condition.min() == pytest.approx(expected["condition_limit", "max"], rel=1e-9, abs=1e-9)
    # The viewer, at each pose
    g, home = point.geometry, point.configuration
    legs = nd.leg_lengths(g, point.configurations)
    ends = np.zeros(9), np.full(9, np.inf)
    variant = Variant(g, home, point.characteristic_length, *ends, study, legs, point.margins)
    shown = {}
    for k in range(len(point.configurations)):
        for one in numbers_of(variant, point.configurations[k]).limits:
            key = one.name.split(" ")[0] if one.side else one.name, one.side
            shown.setdefault(key, []).append(one.margin)
    assert len(shown) > 18
    for (name, side), found in shown.items():
        if name == "singularity_free":  # the study looks at the ways to the poses too
            assert min(found) >= expected[name, "min"] - 1e-9
            continue
        sides = [side] if side else [s for label, s in expected if label == name]
        assert min(found) == pytest.approx(min(expected[name, s] for s in sides), rel=1e-9, abs=1e-9)
    # `ninedof certify`
    proved = certify(study, g, point.configurations, point.characteristic_length, time_limit=20.0, gap=1e-6)
    found = {(one.name, one.side): one for one in proved.limits[1:]}
    assert set(found) == set(expected)
    for key, one in found.items():
        if key[0] != "singularity_free":
            widest = (one.value[1] - one.value[0]) / one.limit
            assert expected[key] - widest - 1e-9 <= one.margin <= expected[key] + 1e-9
            width = one.value[1] - one.value[0]  # upper legs do not move while O is shifted: a rate of 0
            assert one.answer == "violated" or width <= 0.05 * one.value[1] + 1e-9 * one.limit
    regular = proved.limits[0]
    assert regular.margin == regular.value[0]


@pytest.mark.parametrize("seed", range(size(2, 20)))
def test_every_place_has_the_same_text(seed):
    study, variables, point = machine(seed)
    rows = limit_rows(study, variables)
    every = [text(by_hand(row), row.unit) for row in rows]
    assert [margin_words(row.margin, row.unit) for row in rows] == every
    found = nd.sheet(point)
    object.__setattr__(found, "limits", rows)
    (shown,) = limits_table(found).texts()
    assert [row[5] for row in shown] == every
    assert (
        re.findall(r"((?:over |below )?-?[\d.]+(?: %)?)(?: +violated)?$", plain_text(limits_table(found)), re.MULTILINE)
        == every
    )
    latex = [
        word.replace(r"\,\%", " %")
        for word in re.findall(r"\$((?:over |below )?-?[\d.]+(?:\\,\\%)?)\$ *\\\\", latex_limits(rows, ""))
    ]
    assert latex == every
    ends = np.zeros(9), np.full(9, np.inf)
    at_home = numbers_of(
        Variant(point.geometry, point.configuration, 1.0, *ends, study, None, point.margins), point.configuration
    )
    cells = re.findall(r'text-align:right">([^<]*)</td></tr>', limits_html(at_home, "mm"))
    assert cells == [text(one.margin, one.unit) for one in at_home.limits]
    proved = certify(study, point.geometry, point.configurations, 1.0, time_limit=0.0)
    cells = [row[3] for row in certificate_table(proved).rows][9 : 9 + len(proved.limits)]
    unbounded = -math.inf  # of a row that is undecided: no margin to show
    assert cells == ["" if one.margin == unbounded else text(one.margin, one.kind) for one in proved.limits]


@pytest.mark.parametrize("kind", ["ratio", "length", "angle", "sign", "number", "rate"])
@pytest.mark.parametrize("side", ["min", "max"])
def test_a_margin_is_negative_beyond_the_limit(kind, side):
    rng = np.random.default_rng(5)
    limits, values = np.exp(rng.uniform(-9.0, 9.0, size=(2, 500)))
    found = margin_of(kind, side, limits, values)
    for limit, value, margin in zip(limits.tolist(), values.tolist(), found.tolist(), strict=True):
        assert (margin < 0.0) == (value > limit if side == "max" else value < limit)


def test_values_beside_loose_and_tiny_limits_keep_their_digits():
    """1 - value / max is 1 to the last bit where the limit is 1e18 times the value, and the value was read off it."""
    design = {"a1": 0.0, "a2": 5.8124, "b1": 2.9062, "b2": 0.0, "zp": 3.9, "zs": 2.4, "theta_z": 0.0}
    limits = {"leg_length": (None, 1e18), "height": (None, 1e13), "leg_clearance": (1e-9, None)}
    study = nd.Study(constraints=limits, variables={"a1": 0.0, "b2": 0.0})
    values = {row.name: row.value for row in limit_rows(study, design)}
    assert values["height"] == pytest.approx(3.9, rel=1e-13)
    longest = nd.leg_lengths(study.problem().geometry(list(design.values())), nd.Configuration.neutral(3.9, 2.4)).max()
    assert values["leg_length"] == pytest.approx(longest, rel=1e-13)
    near = replace(study, constraints={"leg_clearance": (0.1, None)})
    (row,) = limit_rows(near, design)
    assert values["leg_clearance"] == pytest.approx(row.value, rel=1e-12)  # pairs with a joint in common do not count
    assert row.value > 1.0


def test_a_singularity_that_is_passed_is_no_rounding():
    """The margin of a determinant is no share of its limit: 1e-6 of the limit may be missing, and not 1e-6."""
    assert is_violated(-8.8e-7, "sign", 1e-7)
    assert not is_violated(-0.9e-9, "sign", 1e-3)
    assert is_violated(-1e-300, "sign", 0.0)
    time = np.linspace(0.0, 1.0, 11)
    margin = np.full(11, 1e-3)
    margin[5] = -5e-7 - 1e-7
    found = _core.stretches("singularity_free", time, margin, margin, tolerance_of("sign", 1e-7))
    assert len(found) == 1


def test_no_text_has_an_exponent():
    for margin in (64.58, -64.58, 1e3, -1e3, 1e300, -1e304, 0.0, -0.0, 1e-12, -1e-12):
        for kind in ("ratio", "length", "angle"):
            assert re.fullmatch(r"-?\d{1,4}\.\d\d %|over 10000 %|below -10000 %", margin_words(margin, kind))
    assert margin_words(-1e-12, "length") == "0.00 %"
    assert margin_words(0.64584, "sign") == "0.6458"
    assert [margin_words(x, "ratio") for x in (np.inf, -np.inf, np.nan)] == ["∞", "-∞", "-"]


def test_a_design_on_its_limit_keeps_it():
    """Over a region the optimizer may leave up to 1e-7, which a motion and the viewer called a violation."""
    assert not is_violated(-0.9e-6)
    assert is_violated(-1.1e-6)
    assert is_violated(np.nan)
    worst = np.inf
    study = nd.Study(
        variables={
            "a1": 0.0,
            "a2": 850.0,
            "b1": (200.0, 350.0),
            "b2": 0.0,
            "zp": (400.0, 560.0),
            "zs": 320.0,
            "theta_z": 0.0,
        },
        constraints={"leg_length": {"max": 690.0}},
        objective={"region": {"box": (40.0, 40.0, 20.0), "tilt": 0.09}},
        characteristic_length=150.0,
        starts=1,
    )
    found = nd.optimize(study)
    assert "no limit is violated" in found.region.words
    tighter = replace(study, constraints={"leg_length": {"max": 690.0 * (1.0 - 1e-7)}})  # it leaves less here
    home, round_ = found.best.configuration, np.linspace(0.0, 2.0 * np.pi, 20_001)
    tilts = 0.09 * np.stack([np.cos(round_), np.sin(round_), 0.0 * round_], axis=1)
    for corner in np.array(np.meshgrid([-40.0, 40.0], [-40.0, 40.0], [-20.0, 20.0])).reshape(3, -1).T:
        shift = np.tile(corner, (len(tilts), 1))
        turned = Rotation.from_rotvec(tilts).as_matrix() @ home.rotation
        poses = nd.Configuration(home.position + shift, turned, home.internal_point + shift)
        least = min(float(one.margin.min()) for one in limits_at_poses(tighter, found.geometry, poses, home, 150.0))
        worst = min(worst, least)
    assert -1.1e-7 < worst < -1e-9
    assert not is_violated(worst)


def test_kinds_are_those_of_the_table():
    study, variables, _ = machine(0)
    for row in limit_rows(study, variables):
        name = split_label(row.name)[0]
        if name in ROWS:
            assert (row.unit == "sign") == (ROWS[name].kind == "sign")
