"""Fronts: as good as solving each limit alone, monotone for any solver, interruptible."""

import math
from dataclasses import replace
from itertools import pairwise

import pytest
from region_oracle import worst_at_random
from sizes import size

import ninedof as nd
from ninedof.optimize.pareto import pareto
from ninedof.optimize.pareto import solving as sweeping
from ninedof.optimize.pareto.front import front_table
from ninedof.optimize.pareto.limits import own_value, resolve, value_of, with_limit, without_degrees
from ninedof.optimize.pareto.solving import WIDE, range_words

PAPER = nd.Study.paper()


@pytest.fixture(scope="module")
def front():
    return pareto(PAPER, "radius_ratio", values=[3.0, 1.5, 2.0, 1.5])


SHIFTED = [{"position": [0.1, 0, 0], "unit": "zp"}, {"rotation_deg": [0, 10, 0]}, {}]
ROOMY = {"radius_ratio": (None, 2.0), "leg_ratio": (None, 3.0), "stroke": {"max": 0.3, "of": "zp"}}
MOVING = nd.Study("symmetric", constraints=ROOMY, objective={"poses": SHIFTED})

TRADED = {
    "radius ratio": (PAPER, "radius_ratio"),
    "leg ratio": (PAPER, "leg_ratio"),
    "height": (PAPER, "height"),
    "footprint": (PAPER, "footprint"),
    "stroke in parts of zp": (MOVING, "stroke"),
    "cone about the neutral legs": (MOVING, "platform_cone"),
}


def objectives(front):
    return [value for value in front.objectives if not math.isnan(value)]


def is_monotone(front):
    values = objectives(front)
    return all(after <= before * (1.0 + 1e-9) for before, after in pairwise(values))


# --- Given limits -----------------------------------------------------------------------------------------------------


def test_given_limits_are_solved_in_order(front):
    assert front.limits == (1.5, 2.0, 3.0)
    assert front.against == "radius_ratio"
    assert len(front) == len(front.results) == 3
    assert [r.study.constraints["radius_ratio"][1] for r in front.results] == [1.5, 2.0, 3.0]
    assert [result.objective for result in front] == list(front.objectives)
    assert not front.interrupted


def test_each_limit_is_as_good_as_solved_alone(front):
    for limit, value in zip(front.limits, front.objectives, strict=True):
        alone = nd.optimize(nd.Study(constraints={"radius_ratio": (None, limit)}))
        assert value == pytest.approx(alone.objective, rel=1e-9)
    assert front.objectives[1] == pytest.approx(3.762659078596, rel=1e-9)


def test_prices_are_the_slope(front):
    """The price at 2 lies between the slopes of the chords beside it, in logarithms."""
    x, y = ([math.log(v) for v in values] for values in (front.limits, front.objectives))
    before, after = ((y[k] - y[k + 1]) / (x[k + 1] - x[k]) for k in (0, 1))
    assert min(before, after) * 0.9 < front.prices[1] < max(before, after) * 1.1


def test_rows_have_all_fields(front):
    row = front.table()[1]
    names = "limit status reason objective condition_number price active neutral_condition_number variables dominated"
    assert set(row) == set(names.split())
    assert row["status"] == "optimal"
    assert row["variables"] == front.results[1].variables
    assert "radius_ratio" in row["active"]
    assert not row["dominated"]


def test_a_limit_that_does_not_bind_is_marked():
    curve = pareto(PAPER, "leg_ratio", values=[2.0, 3.0, 4.0])  # the best design has 2.32
    assert curve.dominated == (False, False, True)
    assert curve.objectives[1] == pytest.approx(curve.objectives[2], rel=1e-12)


def test_a_limit_at_price_0_is_not_reached():
    """The loosest limit that is selected is the value of the design without the limit."""
    curve = pareto(PAPER, "radius_ratio", points=2)
    last = curve.table()[-1]
    assert last["price"] == 0.0
    assert curve.limits[-1] == pytest.approx(value_of(PAPER, "radius_ratio", curve.results[-1]), rel=1e-6)
    assert "radius_ratio" not in last["active"]
    assert "radius_ratio" in curve.table()[0]["active"]
    shown = [row[-1] for row in front_table(curve).rows]
    assert "(radius_ratio without effect)" in shown[-1]
    assert "without effect" not in shown[0]
    first, last = (f"{limit:.5g}" for limit in curve.limits)
    words = range_words(curve)
    assert words.startswith(f"Limits below {first} may have designs too: the rows end, roughly, where no design")
    assert f"From {last} on nothing changes" in words
    assert "From" not in range_words(replace(curve, limits=(curve.limits[0], WIDE * 2.0)))  # of a study without an end
    assert range_words(replace(curve, limits=(), results=())) == ""


def test_impossible_limits_are_rows_too():
    curve = pareto(nd.Study(starts=size(16, 64)), "leg_ratio", values=[0.5, 0.9, 2.0])
    assert [row["status"] for row in curve.table()] == ["infeasible", "infeasible", "optimal"]
    assert math.isnan(curve.objectives[0])
    assert curve.prices[0] is None
    assert curve.table()[0]["objective"] is None
    assert curve.table()[0]["reason"]
    assert curve.dominated == (False, False, False)


def test_other_options_of_the_limit_are_kept():
    study = nd.Study(constraints={"zs_fraction": (0.2, 0.9), "leg_ratio": (None, 3.0)})
    moved = with_limit(study, "zs_fraction", 0.5)
    assert moved.constraints["zs_fraction"] == (0.2, 0.5)
    assert moved.constraints["leg_ratio"] == (None, 3.0)
    stroke = with_limit(MOVING, "stroke", 0.1).constraints["stroke"]
    assert dict(stroke) == {"max": 0.1, "of": "zp"}
    assert with_limit(study, "zs_fraction", None).constraints["zs_fraction"] == (0.2, None)
    assert "leg_ratio" not in with_limit(study, "leg_ratio", None).constraints
    assert study.constraints["zs_fraction"] == (0.2, 0.9)


def test_a_limit_at_the_neutral_pose_is_swept_beside_that_at_the_poses():
    both = [{"max": 3.0}, {"max": 2.5, "at": "neutral"}]
    study = replace(MOVING, constraints=ROOMY | {"leg_ratio": both})
    low, high = with_limit(study, "leg_ratio", 2.9), with_limit(study, "leg_ratio at neutral", 2.0)
    assert low.constraints["leg_ratio"] == ({"max": 2.9}, {"max": 2.5, "at": "neutral"})
    assert high.constraints["leg_ratio"] == ({"max": 3.0}, {"max": 2.0, "at": "neutral"})
    assert with_limit(study, "leg_ratio at neutral", None).constraints["leg_ratio"] == (None, 3.0)
    assert with_limit(study, "leg_ratio", None).constraints["leg_ratio"] == {"max": 2.5, "at": "neutral"}
    assert with_limit(MOVING, "leg_ratio at neutral", 2.0) == high
    curve = pareto(replace(study, starts=4), "leg_ratio at neutral", values=[1.9, 2.1])
    assert is_monotone(curve)
    assert curve.table()[0]["active"].count("leg_ratio at neutral") == 1
    assert all(price > 0.0 for price in curve.prices)
    value, best = value_of(study, "leg_ratio at neutral", curve.results[0]), curve.results[0].best
    legs = nd.leg_lengths(best.geometry, best.configuration)
    assert value == pytest.approx(legs.max() / legs.min(), rel=1e-9) == pytest.approx(1.9, rel=1e-6)


def test_two_indices():
    speed = nd.Study(objective={"index": "speed"})
    for own, against in ((speed, "condition_limit"), (speed, "condition_number"), (nd.Study(), "speed")):
        study, limit = resolve(own, against)
        assert limit == "condition_limit"
        assert study.objective.index == "speed"
        assert with_limit(study, limit, 4.0).objective.condition_limit == 4.0


# --- Limits that are found --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", TRADED)
def test_a_found_front_is_monotone_and_spans_the_range(name):
    study, against = TRADED[name]
    points = size(4, 9)
    study = study.with_solver(size(2, study.starts))
    curve = pareto(study, against, points=points)
    assert len(objectives(curve)) == points
    assert is_monotone(curve)
    assert list(curve.limits) == sorted(curve.limits)
    without = nd.optimize(with_limit(study, against, None))
    assert curve.objectives[-1] == pytest.approx(without.objective, rel=1e-6)
    assert max(objectives(curve)) <= 3.0 * without.objective * (1.0 + 1e-9)
    assert not any(curve.dominated[:-1])


def test_a_front_of_two_indices_spans_both_optima():
    curve = pareto(PAPER, "speed", points=7)
    assert curve.against == "condition_limit"
    assert curve.study.objective.index == "speed"
    assert len(objectives(curve)) == 7
    assert is_monotone(curve)
    assert curve.limits[0] == pytest.approx(3.762659, rel=0.01)
    for limit, result in zip(curve.limits, curve.results, strict=True):
        assert max(result.conditions) <= limit * (1.0 + 1e-8)


def test_steep_parts_get_more_points():
    points, study = size(9, 13), replace(PAPER, starts=size(16, 64))
    curve = pareto(study, "radius_ratio", points=points)
    values = objectives(curve)
    steps = [before - after for before, after in pairwise(values)]
    evenly = pareto(study, "radius_ratio", values=_geometric(curve.limits[0], curve.limits[-1], points))
    coarse = objectives(evenly)
    assert max(steps) < max(before - after for before, after in pairwise(coarse))


def _geometric(low, high, count):
    return [low * (high / low) ** (k / (count - 1)) for k in range(count)]


def test_an_infeasible_study_has_one_row():
    curve = pareto(nd.Study(constraints={"leg_ratio": (None, 0.5)}, starts=size(16, 64)), "radius_ratio")
    assert [row["status"] for row in curve.table()] == ["infeasible"]
    assert curve.limits == (math.inf,)


def test_without_a_scale_limits_must_be_given():
    boundless = nd.Study(variables={n: (0.0, math.inf) for n in ("a1", "a2", "b1", "b2", "zp", "zs")})
    with pytest.raises(
        ValueError, match=r"^values: got None, expected limits to sweep: without a limit on radius_ratio"
    ):
        pareto(boundless, "radius_ratio")
    limited_itself = replace(boundless, constraints={"radius_ratio": (None, 1.0)})
    limited_itself = replace(limited_itself, starts=size(8, 64))
    assert is_monotone(pareto(limited_itself, "radius_ratio", points=size(3, 5)))


# --- Monotone, whatever the solver does -------------------------------------------------------------------------------


def worse(result, factor):
    """The result of a solver that misses the best design."""
    wrong = tuple(replace(c, objective=factor * c.objective) for c in result.candidates)
    return replace(result, candidates=wrong)


@pytest.mark.parametrize("bad_calls", [1, 2, 99])
def test_missed_optima_are_repaired(monkeypatch, bad_calls):
    """At the limit 2 the solver returns a design 30 % worse: once, twice (both sweeps), or always."""
    calls = []

    def unlucky(study, **options):
        result = nd.optimize(study, **options)
        if study.constraints["radius_ratio"][1] == 2.0:
            calls.append(options["warm"])
            return worse(result, 1.3) if len(calls) <= bad_calls else result
        return result

    monkeypatch.setattr(sweeping, "optimize", unlucky)
    curve = pareto(PAPER, "radius_ratio", values=[1.5, 2.0, 3.0])
    assert is_monotone(curve)
    if bad_calls < 3:
        assert curve.objectives[1] == pytest.approx(3.762659078596, rel=1e-9)
    else:  # the design of the tighter limit is shown, and no optimum is claimed
        assert curve.objectives[1] == curve.objectives[0]
        assert curve.results[1].status == "stopped"
        assert "limit 1.5 is better" in curve.results[1].reason
        assert curve.prices[1] is None
        assert curve.results[1].study.constraints["radius_ratio"] == (None, 2.0)


def test_neighbours_are_passed_on(monkeypatch):
    calls = []

    def watched(study, **options):
        calls.append((study.constraints["radius_ratio"][1], options["warm"]))
        return nd.optimize(study, **options)

    monkeypatch.setattr(sweeping, "optimize", watched)
    pareto(PAPER, "radius_ratio", values=[1.5, 2.0, 3.0])
    assert [limit for limit, _ in calls] == [3.0, 2.0, 1.5, 1.5, 2.0, 3.0]
    assert calls[0][1] is None
    ratios = [[r.study.constraints["radius_ratio"][1] for r in warm] for _, warm in calls[1:]]
    assert ratios == [[3.0], [2.0], [2.0, 1.5], [1.5, 3.0, 2.0], [2.0, 3.0]]


# --- Interruption and progress ----------------------------------------------------------------------------------------


def test_progress_counts_to_the_end():
    seen = []
    pareto(PAPER, "radius_ratio", values=[1.5, 2.0], progress=lambda *told: seen.append(told))
    assert [(done, total) for done, total, _ in seen] == [(1, 4), (2, 4), (3, 4), (4, 4)]
    assert all(value > 1.0 for *_, value in seen)


@pytest.mark.parametrize("solved", [1, 3, 5])
def test_interrupted_between_limits(solved):
    def stop(done, total, value):
        if done == solved:
            raise KeyboardInterrupt

    curve = pareto(PAPER, "radius_ratio", values=[1.5, 2.0, 3.0], progress=stop)
    assert curve.interrupted
    assert len(curve) <= 3
    assert list(curve.limits) == [1.5, 2.0, 3.0][max(0, 4 - solved) :] or solved >= 3
    assert is_monotone(curve)


def test_same_front_for_any_number_of_threads():
    one, two = (pareto(PAPER, "leg_ratio", values=[1.5, 2.0], threads=n) for n in (1, 2))
    assert one.table() == two.table()


# --- Over a region ----------------------------------------------------------------------------------------------------

CUBE = nd.Study(
    variables={"a1": 0.0, "a2": (2.0, 10.0), "b1": (1.0, 5.0), "b2": 0.0, "zp": (3.0, 6.0), "zs": (1.0, 5.0)},
    objective={"region": {"box": [0.4, 0.4, 0.0], "tilt_deg": 4}},
    starts=size(4, 32),
)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("against", "options"),
    [
        ("stroke_ratio", {}),
        ("stroke", {"of": "zp"}),
        ("base_cone_deg", {"axis": [0, 0, 1]}),
        ("leg_ratio", {}),
    ],
)
def test_the_loosest_limit_is_the_value_over_the_region(against, options):
    """The best design without the limit is allowed by it; a few poses that rule the design do not say by which."""
    name = without_degrees(against)[0]
    study = replace(CUBE, constraints={name: {"max": 1.0, **options}})
    curve = pareto(study, against, points=2)
    free = nd.optimize(with_limit(study, name, None))
    assert curve.objectives[-1] == pytest.approx(free.objective, rel=1e-6)
    assert curve.results[-1].status == "optimal"
    value = value_of(study, name, free)
    assert own_value(curve.results[-1].study, name) == pytest.approx(value, rel=1e-6)
    # Random poses come near the worst.
    within, beyond = (with_limit(study, name, value * factor) for factor in (1.0 + 1e-6, 0.98))
    x = free.variables
    worst = [worst_at_random(one, x, size(2_000, 10_000), 1)[1] for one in (within, beyond)]
    assert worst[0] > 0.0 > worst[1]


@pytest.mark.parametrize("own", [{"radius_ratio": (1.2, None)}, {"leg_length": (2.0, None)}, {"height": (3.5, 6.0)}])
def test_a_limit_may_have_a_least_value(own):
    """A min above 1 without a max, and rows that end at the min: the study has no designs below."""
    ((name, (low, _)),) = own.items()
    curve = pareto(replace(PAPER, constraints=own, starts=4), name, points=2)
    assert curve.limits[0] >= low
    assert ("Limits below" in range_words(curve)) == (curve.limits[0] > low * (1.0 + 1e-9))


@pytest.mark.slow
def test_of_a_reserve_nothing_is_said_beyond_the_last_row():
    with_tolerances = replace(MOVING, tolerances={"joints": 1e-3, "legs": 1e-3}, starts=2)
    assert "nothing changes" not in range_words(pareto(with_tolerances, "leg_ratio", points=2))
