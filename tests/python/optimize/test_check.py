"""The check of a result: correct results pass, every kind of wrong result fails."""

import functools
import math
from dataclasses import replace

import numpy as np
import pytest
from limit_oracle import limits_of, margins, robot_of
from region_oracle import condition_margins, index_at
from scipy.optimize import nnls
from sizes import size

import ninedof as nd
from ninedof.optimize import check as check_module
from ninedof.optimize.check import Check, Finding, check

FEW = [
    {"position": [0.1, 0, 0], "unit": "zp"},
    {"position": [-0.1, 0, 0], "unit": "zp"},
    {"rotation_deg": [0, 10, 0]},
    {},
]
BEST = [pose | {"internal_point": "best"} for pose in FEW[:3]] + [{}]
RATIO = {"radius_ratio": (None, 2.0)}
LEGS = RATIO | {"leg_ratio": (None, 3.0)}
HARDWARE = RATIO | {
    "stroke": {"max": 0.5, "of": "zp"},
    "stroke_ratio": (None, 2.0),
    "base_cone": {"max_deg": 55, "axis": [0, 0, 1]},
    "platform_cone": {"max_deg": 30},
    "singularity_free": {"steps": 2},
}
PRACTICAL = RATIO | {
    "leg_ratio": (None, 2.5),
    "zs_fraction": (0.15, 0.85),
    "leg_length": {"min": 0.2, "of": "zp"},
    "joint_height": {"max": 0.3, "of": "radius"},
    "joint_spacing": {"min": 0.1, "of": "radius"},
    "leg_clearance": {"min": 0.05, "of": "zp"},
    "footprint": (None, 5.0),
    "height": (None, 5.0),
}
UPRIGHT = {"axis": [0, 0, 1]}
NEUTRAL = RATIO | {
    "base_cone": [{"max_deg": 45} | UPRIGHT, {"max_deg": 30, "at": "neutral"} | UPRIGHT],
    "leg_ratio": {"max": 2.2, "at": "neutral"},
    "leg_length": {"min": 0.2, "of": "zp", "at": "neutral"},
    "leg_clearance": {"min": 0.02, "of": "zp", "at": "neutral"},
    "singularity_free": [{"steps": 2}, {"min": 0.01, "at": "neutral"}],
}
PLATFORM = [f"platform_{kind}_{i}_{axis}" for kind in ("external", "internal") for i in (1, 2, 3) for axis in "xy"]

STUDIES = {
    "paper": nd.Study.paper(),
    "symmetric": nd.Study("symmetric", constraints=LEGS),
    "practical": nd.Study("symmetric_nonplanar", constraints=PRACTICAL),
    "displaced": nd.Study(constraints=RATIO, objective={"poses": FEW}),
    "weighted": nd.Study(constraints=RATIO, objective={"poses": FEW, "aggregate": "weighted", "weight": 0.3}),
    "mean": nd.Study(constraints=RATIO, objective={"poses": FEW, "aggregate": "mean_inverse"}),
    "best place of O": nd.Study(constraints=RATIO, objective={"poses": BEST}),
    "frobenius": nd.Study(constraints=RATIO, objective={"index": "frobenius", "poses": FEW}),
    "speed": nd.Study(constraints=RATIO, objective={"index": "speed", "condition_limit": 4.5, "poses": FEW}),
    "hardware": nd.Study(
        constraints=HARDWARE,
        objective={"box": {"half": [0.1, 0.1, 0.1], "unit": "zp"}},
        starts=size(2, 8),
    ),
    "neutral": nd.Study("symmetric_nonplanar", constraints=NEUTRAL, objective={"poses": FEW}, starts=2),
    "neutral condition": nd.Study(constraints=RATIO, objective={"poses": FEW, "neutral_condition_limit": 3.8}),
    "mean leg": nd.Study(constraints=RATIO | {"footprint": (None, 3.0)}, characteristic_length="mean_leg"),
    "general": nd.Study(
        "general", variables=dict.fromkeys(PLATFORM, (-6.0, 6.0)), constraints=LEGS, objective={"poses": FEW}, starts=16
    ),
    "twist": nd.Study(variables={"theta_z": (-1.0, 1.0)}, constraints={"radius_ratio": (None, 2.0)}),
    "narrow": nd.Study(constraints={"leg_ratio": (2.0, 2.2), "zs_fraction": (0.3, 0.5)}),
}


@functools.cache
def solved(name):
    study = STUDIES[name]
    return nd.optimize(study.with_solver(size(min(study.starts, 16), study.starts)))


@pytest.fixture(scope="module")
def paper():
    return nd.optimize(nd.Study.paper())


def with_best(result, **changed):
    """The result with its best candidate altered: what a wrong solver would return."""
    return replace(result, candidates=(replace(result.candidates[0], **changed), *result.candidates[1:]))


def moved(result, **shifts):
    """The result at another design, with all numbers of that design: it is only not an optimum."""
    study = result.study
    variables = dict(result.variables)
    for name, shift in shifts.items():
        variables[name] += shift
    point = study.evaluate(variables)
    names = ("objective", "neutral_condition_number", "conditions", "geometry", "configuration", "configurations")
    return with_best(result, variables=variables, **{name: getattr(point, name) for name in names})


# --- Right results ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", STUDIES)
def test_an_optimum_passes(name):
    result = solved(name)
    assert result.status == "optimal"
    found = check(result, perturbations=size(120, 1000))
    assert found.passed, found.report()
    assert found
    names = [finding.name for finding in found.findings]
    assert names[:3] == ["design", "condition numbers", "objective"]
    stated = [limit.label for limit in result.study.limits]
    assert [f"limit: {name}" for name in stated] == [n for n in names if n.startswith("limit")]
    assert {"stationarity", "perturbations", "bound: isotropy"} <= set(names)
    assert ("bound: hexagonal" in names) == (result.study.family == "hexagonal")
    rho = (result.variables["zp"] - result.variables["zs"]) / result.best.characteristic_length
    assert ("bound: distance of O" in names) == (result.study.family != "general" and rho >= 0.51)
    assert found["perturbations"].figure <= 1e-8


def test_limits_at_the_neutral_pose_bind_and_have_their_price():
    """The cone of 30 degrees binds, not that of 45: its price is the slope of the optimum over it."""
    result = solved("neutral")
    assert "base_cone at neutral" in result.active
    assert "base_cone" not in result.active
    assert "1 % more base_cone at neutral gains" in result.summary()

    def optimum(factor):
        cone = [{"max_deg": 45} | UPRIGHT, {"max_deg": 30 * factor, "at": "neutral"} | UPRIGHT]
        study = replace(result.study, constraints=NEUTRAL | {"base_cone": cone}, starts=1)
        return math.log(nd.optimize(study, warm=result).objective)

    h = 1e-4
    slope = (optimum(math.exp(-h)) - optimum(math.exp(h))) / (2.0 * h)
    assert result.prices["base_cone at neutral"] == pytest.approx(slope, rel=1e-3)


def test_a_limit_at_the_neutral_pose_that_is_violated_is_found():
    result = solved("neutral")
    tight = [{"max_deg": 45} | UPRIGHT, {"max_deg": 20, "at": "neutral"} | UPRIGHT]
    found = check(replace(result, study=replace(result.study, constraints=NEUTRAL | {"base_cone": tight})), 0)
    assert [f.name for f in found.findings if f.name.startswith("limit") and not f.passed] == [
        "limit: base_cone at neutral"
    ]
    assert found["limit: base_cone at neutral"].figure == pytest.approx(1.0 - 30 / 20, abs=1e-6)


def test_report_lists_the_tests(paper):
    text = check(paper, perturbations=60).report()
    assert text.startswith("check of a design of the hexagonal family: 10 tests, all passed")
    for words in ("general path", "60 steps of 0.1 to 1e-06", "no design with", "(proved)", "(searched)", "balance to"):
        assert words in text


def test_same_seed_same_check(paper):
    first, second = (check(paper, perturbations=300, seed=5).to_dict() for _ in range(2))
    assert first == second
    assert first != check(paper, perturbations=300, seed=6).to_dict()


def test_optimality_is_tested_for_optimal_results_only(paper):
    stopped = replace(moved(paper, zp=0.1), status=nd.Status.STOPPED)
    found = check(stopped)
    assert found.passed, found.report()
    assert "stationarity" not in [finding.name for finding in found.findings]


# --- Wrong results ----------------------------------------------------------------------------------------------------


def failed(result, **options):
    return {finding.name for finding in check(result, **options).findings if not finding.passed}


def test_a_wrong_number_fails(paper):
    kappa = paper.condition_number
    assert failed(with_best(paper, neutral_condition_number=kappa * (1 + 1e-7)), perturbations=0) == {
        "condition numbers"
    }
    assert failed(with_best(paper, objective=kappa * (1 - 1e-7)), perturbations=0) == {"objective"}
    assert failed(with_best(paper, conditions=(kappa, kappa)), perturbations=0) == {"condition numbers"}
    assert failed(with_best(paper, neutral_condition_number=math.nan), perturbations=0) == {"condition numbers"}


def test_another_geometry_fails(paper):
    other = nd.Geometry.hexagonal(0.0, 6.0, 3.0, 0.0)
    assert failed(with_best(paper, geometry=other), perturbations=0) >= {"design"}


@pytest.mark.parametrize("shift", [0.3, 1e-3, 1e-5])
def test_a_design_near_the_optimum_is_not_stationary(paper, shift):
    assert failed(moved(paper, zp=shift), perturbations=0) == {"stationarity"}


@pytest.mark.parametrize("shift", [0.3, 0.01])
def test_perturbations_find_a_better_design_near_the_optimum(paper, shift):
    wrong = check(moved(paper, zp=shift), perturbations=size(300, 4000))
    assert not wrong["perturbations"].passed
    assert wrong["perturbations"].figure > 1e-6
    assert "FAILED  perturbations" in wrong.report()
    assert "failed" in wrong.report().splitlines()[0]


def test_a_broken_limit_fails(paper):
    wrong = check(moved(paper, a2=1e-3), perturbations=0)
    assert not wrong["limit: radius_ratio"].passed
    assert wrong["limit: radius_ratio"].figure == pytest.approx(-1e-3 / paper.variables["a2"], rel=1e-3)


def test_a_broken_bound_fails(paper):
    assert "design" in failed(moved(paper, zp=100.0), perturbations=0)  # 80 at most


def test_what_a_certificate_proves_is_of_the_worst_pose(monkeypatch):
    study = nd.Study(objective={"poses": [{"position": (1.0, 0.0, 0.5), "rotation": (0.5, 0.0, 0.0)}]}, starts=8)
    result = nd.optimize(study)
    neutral, worst = result.best.neutral_condition_number, result.condition_number
    assert neutral < 0.999 * worst
    for value, passed in ((0.5 * (neutral + worst), True), (1.001 * worst, False)):
        bound = nd.LowerBound("certificate", value, True, "no design is below it")
        monkeypatch.setattr(check_module, "applicable_bounds", lambda _, bound=bound: [bound])
        assert failed(result, perturbations=0) == (set() if passed else {"bound: certificate"})


def test_a_value_below_a_proved_bound_fails(paper):
    """No design is below a bound, so a bound that is too high must fail."""
    bound = nd.applicable_bounds(paper)[0]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(
            check_module, "applicable_bounds", lambda _: [replace(bound, value=paper.condition_number * 1.001)]
        )
        assert failed(paper, perturbations=0) == {"bound: leg ratio"}


def test_a_check_is_as_true_as_its_findings(paper):
    with pytest.raises(KeyError, match="there are design, "):
        check(paper, perturbations=0)["no such test"]
    assert not Check((Finding("one", True, 0.0, "right"), Finding("two", False, 0.0, "wrong")))


@pytest.mark.parametrize("name", ["displaced", "best place of O", "frobenius", "speed", "hardware", "general"])
def test_beside_the_optimum_every_kind_of_study_fails(name):
    wrong = check(moved(solved(name), zs=1e-3), perturbations=0)
    assert not wrong["stationarity"].passed
    assert wrong["stationarity"].figure > 1e-5


def test_a_design_without_a_free_variable_is_checked_in_its_own_radius():
    """Three platform joints tie for the characteristic length, and nothing can be varied."""
    values = {"a1": 1.0, "a2": 5.0, "b1": 2.5, "b2": 0.5, "zp": 4.0, "zs": 2.4}
    study = nd.Study(variables={k: (x, x) for k, x in values.items()}, characteristic_length="platform_radius")
    found = check(nd.optimize(study))
    assert found.passed, found.report()
    assert found["perturbations"].sentence.startswith("of 0 steps")


# --- Oracles ----------------------------------------------------------------------------------------------------------


def residual_by_samples(result):
    """The least convex combination of gradients near a design and of its active limits and bounds, in numpy.

    Near a kink gradients at different points are those of different pieces (Burke, Lewis, Overton: gradient sampling).
    """
    study, names = result.study, list(result.study.problem().names)
    bounds = [study.variables[name] for name in names]
    low, high = np.array([b if isinstance(b, tuple) else (b, b) for b in bounds]).T
    x, length = np.array([result.variables[name] for name in names]), result.characteristic_length
    size_of = np.array([1.0 if name in study.angles else np.hypot(v, length) for name, v in zip(names, x, strict=True)])
    free = np.flatnonzero(low < high)

    def slopes(f, at, h=1e-6):
        out = []
        for k in free:
            up, down = (np.clip(at + sign * h * size_of * np.eye(len(x))[k], low, high) for sign in (1.0, -1.0))
            out.append((f(up) - f(down)) * size_of[k] / (up[k] - down[k]))
        return np.array(out)

    def robot(at):
        return robot_of(study, dict(zip(names, at.tolist(), strict=True)))

    def every_margin(at):
        return np.concatenate([margins(limit, robot(at)) for limit in limits_of(study)])

    rng, near = np.random.default_rng(1), 1e-4
    points = x + near * size_of * (low < high) * rng.uniform(-1.0, 1.0, (30, len(x)))
    gradients = [slopes(lambda y: np.log(index_at(study, robot(y)).max()), np.clip(at, low, high)) for at in points]
    active = -slopes(every_margin, x)[:, every_margin(x) <= 1e-6].T
    walls = [-row for k, row in enumerate(np.eye(len(free))) if x[free[k]] <= low[free[k]]]
    walls += [row for k, row in enumerate(np.eye(len(free))) if x[free[k]] >= high[free[k]]]
    rows = np.vstack([*gradients, active, *walls])
    heavy = 1e3 * (np.arange(len(rows)) < len(gradients))
    return nnls(np.vstack([rows.T, heavy]), np.append(np.zeros(len(free)), 1e3))[1]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["paper", "displaced", "frobenius", "neutral", "narrow"])
def test_stationarity_agrees_with_sampled_gradients(name):
    result = solved(name)
    assert residual_by_samples(result) < 1e-3
    beside = moved(result, zs=0.05)
    core = check(beside, perturbations=0)["stationarity"].figure
    assert residual_by_samples(beside) == pytest.approx(core, rel=0.3)
    assert core > 1e-3


@pytest.mark.parametrize("name", STUDIES)
def test_numbers_agree_with_their_definitions(name):
    """The check trusts the evaluator of the core; here every limit and the worst index are computed in numpy."""
    result = solved(name)
    robot = robot_of(result.study, result.variables)
    findings = check(result, perturbations=0)
    for limit in limits_of(result.study):
        least = float(margins(limit, robot).min())
        assert findings[f"limit: {limit.label}"].figure == pytest.approx(least, rel=1e-9, abs=1e-9)
    if result.study.objective.aggregate == "worst":
        assert index_at(result.study, robot).max() == pytest.approx(result.objective, rel=1e-9)
    for margin in condition_margins(result.study, robot):
        assert margin.min() >= -1e-8
