"""Fronts: as good as solving each limit alone, monotone for any solver, interruptible."""

import math
from dataclasses import replace
from itertools import pairwise

import pytest
from interrupts import interrupter
from region_oracle import worst_at_random
from sizes import size

import ninedof as nd
from ninedof.optimize.check import check
from ninedof.pareto import pareto
from ninedof.pareto import solving as sweeping
from ninedof.pareto.front import front_table
from ninedof.pareto.limits import own_value, resolve, value_of, with_limit, without_degrees
from ninedof.pareto.solving import WIDE, range_words

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


def test_points_of_a_front_pass_the_check(front):
    for result in front.results:
        found = check(result, perturbations=200)
        assert found.passed, found.report()


def test_prices_are_the_slope(front):
    """The price at 2 lies between the slopes of the chords beside it, in logarithms."""
    x, y = ([math.log(v) for v in values] for values in (front.limits, front.objectives))
    before, after = ((y[k] - y[k + 1]) / (x[k + 1] - x[k]) for k in (0, 1))
    assert min(before, after) * 0.9 < front.prices[1] < max(before, after) * 1.1


def test_rows_have_all_fields(front):
    row = front.table()[1]
    assert set(row) == {
        *(
            "limit",
            "status",
            "reason",
            "objective",
            "condition_number",
            "price",
            "active",
            "neutral_condition_number",
            "variables",
            "dominated",
        )
    }
    assert row["status"] == "optimal"
    assert row["variables"] == front.results[1].variables
    assert "radius_ratio" in row["active"]
    assert not row["dominated"]


def test_a_limit_that_does_not_bind_is_marked():
    found = pareto(PAPER, "leg_ratio", values=[2.0, 3.0, 4.0])  # the best design has 2.32
    assert found.dominated == (False, False, True)
    assert found.objectives[1] == pytest.approx(found.objectives[2], rel=1e-12)


def test_a_limit_at_price_0_is_not_reached():
    """The loosest limit that is selected is the value of the design without the limit."""
    found = pareto(PAPER, "radius_ratio", points=2)
    last = found.table()[-1]
    assert last["price"] == 0.0
    assert found.limits[-1] == pytest.approx(value_of(PAPER, "radius_ratio", found.results[-1]), rel=1e-6)
    assert "radius_ratio" not in last["active"]
    assert "radius_ratio" in found.table()[0]["active"]
    shown = [row[-1] for row in front_table(found).rows]
    assert "(radius_ratio without effect)" in shown[-1]
    assert "without effect" not in shown[0]
    first, last = (f"{limit:.5g}" for limit in found.limits)
    words = range_words(found)
    assert words.startswith(f"Limits below {first} may have designs too: the rows end, roughly, where no design")
    assert f"From {last} on nothing changes" in words
    assert "From" not in range_words(replace(found, limits=(found.limits[0], WIDE * 2.0)))  # of a study without an end
    assert range_words(replace(found, limits=(), results=())) == ""


def test_impossible_limits_are_rows_too():
    found = pareto(nd.Study(starts=size(16, 64)), "leg_ratio", values=[0.5, 0.9, 2.0])
    assert [row["status"] for row in found.table()] == ["infeasible", "infeasible", "optimal"]
    assert math.isnan(found.objectives[0])
    assert found.prices[0] is None
    assert found.table()[0]["objective"] is None
    assert found.table()[0]["reason"]
    assert found.dominated == (False, False, False)


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
    found = pareto(replace(study, starts=4), "leg_ratio at neutral", values=[1.9, 2.1])
    assert is_monotone(found)
    assert found.table()[0]["active"].count("leg_ratio at neutral") == 1
    assert all(price > 0.0 for price in found.prices)
    value, best = value_of(study, "leg_ratio at neutral", found.results[0]), found.results[0].best
    legs = nd.leg_lengths(best.geometry, best.configuration)
    assert value == pytest.approx(legs.max() / legs.min(), rel=1e-9) == pytest.approx(1.9, rel=1e-6)


def test_two_indices():
    speed = nd.Study(objective={"index": "speed"})
    for given, against in ((speed, "condition_limit"), (speed, "condition_number"), (nd.Study(), "speed")):
        study, limit = resolve(given, against)
        assert limit == "condition_limit"
        assert study.objective.index == "speed"
        assert with_limit(study, limit, 4.0).objective.condition_limit == 4.0


# --- Limits that are found --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", TRADED)
def test_a_found_front_is_monotone_and_spans_the_range(name):
    study, against = TRADED[name]
    points = size(4, 9)
    study = study.with_solver(size(2, study.starts))
    found = pareto(study, against, points=points)
    assert len(objectives(found)) == points
    assert is_monotone(found)
    assert list(found.limits) == sorted(found.limits)
    without = nd.optimize(with_limit(study, against, None))
    assert found.objectives[-1] == pytest.approx(without.objective, rel=1e-6)
    assert max(objectives(found)) <= 3.0 * without.objective * (1.0 + 1e-9)
    assert not any(found.dominated[:-1])


def test_a_front_of_two_indices_spans_both_optima():
    found = pareto(PAPER, "speed", points=7)
    assert found.against == "condition_limit"
    assert found.study.objective.index == "speed"
    assert len(objectives(found)) == 7
    assert is_monotone(found)
    assert found.limits[0] == pytest.approx(3.762659, rel=0.01)
    for limit, result in zip(found.limits, found.results, strict=True):
        assert max(result.conditions) <= limit * (1.0 + 1e-8)


def test_steep_parts_get_more_points():
    points, study = size(9, 13), replace(PAPER, starts=size(16, 64))
    found = pareto(study, "radius_ratio", points=points)
    values = objectives(found)
    steps = [before - after for before, after in pairwise(values)]
    evenly = pareto(study, "radius_ratio", values=_geometric(found.limits[0], found.limits[-1], points))
    coarse = objectives(evenly)
    assert max(steps) < max(before - after for before, after in pairwise(coarse))


def _geometric(low, high, count):
    return [low * (high / low) ** (k / (count - 1)) for k in range(count)]


def test_an_infeasible_study_has_one_row():
    found = pareto(nd.Study(constraints={"leg_ratio": (None, 0.5)}, starts=size(16, 64)), "radius_ratio")
    assert [row["status"] for row in found.table()] == ["infeasible"]
    assert found.limits == (math.inf,)


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
    found = pareto(PAPER, "radius_ratio", values=[1.5, 2.0, 3.0])
    assert is_monotone(found)
    if bad_calls < 3:
        assert found.objectives[1] == pytest.approx(3.762659078596, rel=1e-9)
    else:  # the design of the tighter limit is shown, and no optimum is claimed
        assert found.objectives[1] == found.objectives[0]
        assert found.results[1].status == "stopped"
        assert "limit 1.5 is better" in found.results[1].reason
        assert found.prices[1] is None
        assert found.results[1].study.constraints["radius_ratio"] == (None, 2.0)


def test_neighbours_are_passed_on(monkeypatch):
    given = []

    def watched(study, **options):
        given.append((study.constraints["radius_ratio"][1], options["warm"]))
        return nd.optimize(study, **options)

    monkeypatch.setattr(sweeping, "optimize", watched)
    pareto(PAPER, "radius_ratio", values=[1.5, 2.0, 3.0])
    assert [limit for limit, _ in given] == [3.0, 2.0, 1.5, 1.5, 2.0, 3.0]
    assert given[0][1] is None
    ratios = [[r.study.constraints["radius_ratio"][1] for r in warm] for _, warm in given[1:]]
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

    found = pareto(PAPER, "radius_ratio", values=[1.5, 2.0, 3.0], progress=stop)
    assert found.interrupted
    assert len(found) <= 3
    assert list(found.limits) == [1.5, 2.0, 3.0][max(0, 4 - solved) :] or solved >= 3
    assert is_monotone(found)


def test_interrupted_inside_the_solver_keeps_the_solved_limits(monkeypatch):
    def slow(study, **options):
        result = nd.optimize(study, **options)
        return replace(result, interrupted=study.constraints["radius_ratio"][1] == 1.5)

    monkeypatch.setattr(sweeping, "optimize", slow)
    found = pareto(PAPER, "radius_ratio", values=[1.5, 2.0, 3.0])
    assert found.interrupted
    assert found.limits == (2.0, 3.0)


def test_ctrl_c(monkeypatch):
    """SIGINT while the core works on the third limit, which would take minutes: the two before it are the front."""
    solved, most = [], 10**6

    def interrupted(study, **options):
        with interrupter() as progress:
            third = {"starts": most, "progress": progress} if len(solved) == 2 else {}
            solved.append(nd.optimize(study, **options, **third))
        return solved[-1]

    monkeypatch.setattr(sweeping, "optimize", interrupted)
    found = pareto(PAPER, "radius_ratio", values=_geometric(1.0, 5.0, 400), threads=1)
    assert found.interrupted
    assert [result.interrupted for result in solved] == [False, False, True]
    assert solved[-1].starts_done < most
    assert [result.objective for result in found] == [solved[1].objective, solved[0].objective]


@pytest.mark.parametrize(
    ("values", "solved"), [([1.5, 2.0, 3.0], 1), ([1.5, 2.0, 3.0], 5), (None, 3)], ids=["first", "back", "derived"]
)
def test_an_interrupted_front_continues_in_its_folder(tmp_path, monkeypatch, solved, values):
    """The same front as in one go, and nothing is solved twice."""
    options = {"study": replace(PAPER, starts=8), "against": "radius_ratio", "values": values, "points": 3}
    calls = []

    def counted(study, **given):
        calls.append(study)
        return nd.optimize(study, **given)

    def stop(done, total, value):
        if done == solved:
            raise KeyboardInterrupt

    monkeypatch.setattr(sweeping, "optimize", counted)
    whole = pareto(**options)
    needed = len(calls)
    calls.clear()
    assert pareto(**options, out=tmp_path / "kept", progress=stop).interrupted
    assert len(calls) == solved
    again = pareto(**options, out=tmp_path / "kept")
    assert len(calls) == needed
    assert not again.interrupted
    assert again.table() == whole.table()
    assert [dict(r.to_dict(), seconds=0) for r in again] == [dict(r.to_dict(), seconds=0) for r in whole]
    assert pareto(**options, out=tmp_path / "kept").table() == whole.table()
    assert len(calls) == needed
    with pytest.raises(ValueError, match=r"^out: .* another question"):
        pareto(PAPER, "leg_ratio", values=[2.0], out=tmp_path / "kept")


@pytest.mark.skipif(size(True, False), reason="two seconds")
def test_a_front_over_a_region_continues(tmp_path):
    def stop(done, total, value):
        raise KeyboardInterrupt

    study = replace(PAPER, objective={"region": {"box": [0.2, 0.0, 0.0]}}, starts=1)
    options = {"against": "radius_ratio", "values": [2.0]}
    assert pareto(study, **options, out=tmp_path / "kept", progress=stop).interrupted
    assert pareto(study, **options, out=tmp_path / "kept").table() == pareto(study, **options).table()


def test_same_front_for_any_number_of_threads():
    one, two = (pareto(PAPER, "leg_ratio", values=[1.5, 2.0], threads=n) for n in (1, 2))
    assert one.table() == two.table()


# --- Over a region ----------------------------------------------------------------------------------------------------

CUBE = nd.Study(
    variables={"a1": 0.0, "a2": (2.0, 10.0), "b1": (1.0, 5.0), "b2": 0.0, "zp": (3.0, 6.0), "zs": (1.0, 5.0)},
    objective={"region": {"box": [0.4, 0.4, 0.3], "tilt_deg": 6}},
    starts=size(4, 32),
)


@pytest.mark.slow(sanitized=True)
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
    found = pareto(study, against, points=2)
    free = nd.optimize(with_limit(study, name, None))
    assert found.objectives[-1] == pytest.approx(free.objective, rel=1e-6)
    assert found.results[-1].status == "optimal"
    value = value_of(study, name, free)
    assert own_value(found.results[-1].study, name) == pytest.approx(value, rel=1e-6)
    # Random poses come near the worst.
    within, beyond = (with_limit(study, name, value * factor) for factor in (1.0 + 1e-6, 0.98))
    x = free.variables
    worst = [worst_at_random(one, x, size(2_000, 10_000), 1)[1] for one in (within, beyond)]
    assert worst[0] > 0.0 > worst[1]


@pytest.mark.parametrize("own", [{"radius_ratio": (1.2, None)}, {"leg_length": (2.0, None)}, {"height": (3.5, 6.0)}])
def test_a_limit_may_have_a_least_value(own):
    """A min above 1 without a max, and rows that end at the min: the study has no designs below."""
    ((name, (low, _)),) = own.items()
    found = pareto(replace(PAPER, constraints=own, starts=4), name, points=2)
    assert found.limits[0] >= low
    assert ("Limits below" in range_words(found)) == (found.limits[0] > low * (1.0 + 1e-9))


@pytest.mark.slow(sanitized=True)
def test_of_a_reserve_nothing_is_said_beyond_the_last_row():
    with_tolerances = replace(MOVING, tolerances={"joints": 1e-3, "legs": 1e-3}, starts=2)
    assert "nothing changes" not in range_words(pareto(with_tolerances, "leg_ratio", points=2))
