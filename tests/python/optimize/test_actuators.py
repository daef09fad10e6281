"""Rows of a catalogue chosen with the design: held against all combinations, each solved alone."""

import itertools
import math
import random
from dataclasses import replace
from decimal import Decimal
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace

import pytest

import ninedof as nd
from ninedof.design.actuators import LEG_KINDS
from ninedof.optimize.actuator_choice import ActuatorChoice, Combination
from ninedof.optimize.actuators import ActuatorSearch

REQUIREMENT = nd.Study.load(Path(__file__).parents[3] / "examples" / "18_requirement.toml")
LIMITS = {name: limit for name, limit in REQUIREMENT.constraints.items() if name != "stroke_ratio"}
REGION = replace(REQUIREMENT, constraints=LIMITS, starts=4)
POSES = replace(REGION, objective={"poses": nd.poses.box(half=(60.0, 60.0, 40.0))})
SMALL = nd.Actuator("small", 160.0, 260.0, price=100.0)
LARGE = nd.Actuator("large", 400.0, 650.0, price=300.0)
LONG = nd.Actuator("long", 480.0, 740.0, price=400.0)
BOTH = (SMALL, LARGE)


def every_combination(study, external, upper, lower):
    """The objective, the price and the names of each, best first; those that are equal to 6 digits by their price."""
    out = []
    for some in itertools.product(external, upper, lower):
        found = nd.optimize(study.with_actuators(dict(zip(LEG_KINDS, some, strict=True))))
        if found.status == nd.Status.OPTIMAL:
            out.append((float(f"{found.objective:.6g}"), 3 * sum(row.price for row in some), [r.name for r in some]))
    return sorted(out)


def names(combination):
    return [row.name for row in combination.rows.values()]


def assert_choice(result, ranked):
    chosen, other = result.actuators.chosen, result.actuators.next_best
    assert result.status == nd.Status.OPTIMAL
    for one, (objective, price, rows) in zip((chosen, other), ranked, strict=False):
        assert float(f"{one.objective:.6g}") == pytest.approx(objective, rel=1e-5)
        assert (one.price, names(one)) == (price, rows)
    assert (other is None) == (len(ranked) < 2)
    assert result.objective == chosen.objective
    for kind, row in chosen.rows.items():
        assert result.study.constraints[f"{kind}_length"] == (row.shortest, row.longest)


@pytest.mark.slow
def test_the_choice_is_the_best_of_all_combinations():
    result = nd.optimize(replace(POSES, actuators=BOTH))
    ranked = every_combination(POSES, *[BOTH] * 3)
    assert_choice(result, ranked)
    assert result.actuators.combinations == 8
    low, high = result.permitted_lengths
    lengths = nd.leg_lengths(result.geometry, result.configurations)
    assert (lengths >= low * (1 - 1e-9)).all()
    assert (lengths <= high * (1 + 1e-9)).all()
    assert (
        f"actuators: external large, upper small, lower large; price {result.actuators.chosen.price:g}"
        in result.summary()
    )


@pytest.mark.slow
def test_rows_are_compared_without_the_reserve_for_tolerances():
    """The chosen ones were 0.034 % better than the next best with it, and those without it."""
    study = replace(POSES, actuators=BOTH)
    result = nd.optimize(replace(study, tolerances={"legs": 0.05}))
    assert result.reserve.proved
    assert result.actuators.chosen == nd.optimize(study).actuators.chosen
    assert result.objective > result.actuators.chosen.objective


@pytest.mark.slow
def test_the_choice_over_a_region_is_the_best_of_all_combinations():
    study = replace(REGION, starts=2)
    result = nd.optimize(replace(study, actuators=BOTH))
    assert_choice(result, every_combination(study, *[BOTH] * 3))
    assert {one.answer for one in result.certify(time_limit=0.0).limits} == {"proved"}


@pytest.mark.slow
def test_forces_and_rates_choose_too():
    duty = {"loads": {"wrenches": [[0, 0, 0, 0, 0, -500]]}, "speeds": {"linear": 200.0}}
    study = replace(POSES, objective={"poses": nd.poses.box(half=(30.0, 30.0, 20.0))}, starts=2, **duty)
    weak, strong = (replace(LARGE, name=name, force=force, rate=250.0, price=price)
                    for name, force, price in (("weak", 330.0, 300.0), ("strong", 420.0, 500.0)))  # fmt: skip
    rows = [replace(SMALL, force=300.0, rate=250.0), weak, strong]
    result = nd.optimize(replace(study, actuators=rows))
    fit = [weak, strong]  # the strokes of the others are those of another kind of legs, see the tests above
    assert_choice(result, every_combination(study, fit, rows[:1], fit))
    assert names(result.actuators.chosen) == ["weak", "small", "strong"]  # external legs carry nothing
    assert "lower_force" in result.active
    region = replace(
        study.with_actuators(result.actuators.chosen.rows), objective={"region": {"box": (30.0, 30.0, 20.0)}}
    )
    proved = {one.name: one.answer for one in nd.optimize(region).certify(time_limit=0.0).limits}
    assert {proved[name] for name in ("upper_force", "lower_force", "external_rate", "lower_length")} == {"proved"}
    cheap = nd.optimize(replace(study, actuators=rows, greatest_price=2100.0))
    assert names(cheap.actuators.chosen) == ["weak", "small", "weak"]
    assert cheap.objective > 1.01 * result.objective


@pytest.mark.slow
def test_equally_good_rows_go_by_their_price():
    """The lower legs of the optimum use little of their rows."""
    wide = [replace(LARGE, name=name, shortest=LARGE.shortest - k, price=price)
            for k, (name, price) in enumerate({"dear": 310.0, "cheap": 300.0, "dearer": 320.0}.items())]  # fmt: skip
    result = nd.optimize(replace(POSES, actuators=[SMALL, *wide]))
    assert names(result.actuators.chosen)[2] == "cheap"
    assert result.actuators.next_best.price > result.actuators.chosen.price


@pytest.mark.slow
def test_a_row_that_another_replaces_is_left_out():
    worse = nd.Actuator("worse", 420.0, 640.0, price=300.0)
    short = nd.Actuator("short", 500.0, 550.0, price=10.0)  # of a stroke below 80, the least of external and lower legs
    search = ActuatorSearch(replace(REGION, actuators=[worse, *BOTH, short]), lambda *_: None)
    assert search.rows == [[*BOTH], [*BOTH, short], [*BOTH]]
    assert ActuatorSearch(replace(REGION, actuators=[LARGE, replace(LARGE, name="same")]), None).rows[0] == [LARGE]
    result = nd.optimize(replace(POSES, actuators=[worse, *BOTH]))
    assert result.actuators.left_out == ("worse",)
    assert names(result.actuators.chosen) == ["large", "small", "large"]


def test_all_legs_may_take_one_row():
    tall = nd.Actuator("tall", 150.0, 800.0, price=500.0)
    result = nd.optimize(replace(POSES, actuators=[*BOTH, tall], actuators_for="all"))
    assert (names(result.actuators.chosen), result.actuators.chosen.price) == (["tall"] * 3, 4500.0)
    assert "actuators: tall for all legs; price 4500" in result.actuators.words
    assert result.actuators.combinations == 3


@pytest.mark.slow
def test_a_price_may_be_too_low():
    thrifty = nd.Actuator("thrifty", 420.0, 650.0, price=280.0)
    study = replace(POSES, actuators=[*BOTH, thrifty])
    cheap = nd.optimize(replace(study, greatest_price=2000.0))
    assert names(cheap.actuators.chosen) == ["thrifty", "small", "thrifty"]
    assert cheap.actuators.next_best is None or cheap.actuators.next_best.price <= 2000.0
    none = nd.optimize(replace(study, greatest_price=1000.0))
    assert none.status == nd.Status.INFEASIBLE
    assert none.reason == "rows fit each kind of legs, but no combination of at most 1000 does; the cheapest costs 900"
    assert none.study.actuators == study.actuators


def test_prices_are_compared_as_decimals():
    """Nine times 109.9 is 989.1, and was more than that."""
    for price in ("109.9", "50.01", "0.07"):
        row = nd.Actuator("one", 150.0, 800.0, price=float(price))
        most = float(9 * Decimal(price))
        for limit, within in ((most, True), (most - 0.01, False)):
            search = ActuatorSearch(replace(REGION, actuators=[row], greatest_price=limit), None)
            assert search._is_within_price((row,) * 3) == within


def test_a_study_without_an_answer_is_no_bound():
    """It counted as one without a design: a combination four times as good was never looked at."""
    search = ActuatorSearch(replace(REGION, actuators=[LARGE]), None)
    for status, bound in ((nd.Status.STOPPED, 0.0), (nd.Status.INFEASIBLE, math.inf)):
        none = SimpleNamespace(best=None, status=status)
        assert (search._value(none), search._value(none, complete=True)) == (bound, math.inf)


@pytest.mark.slow
def test_a_known_design_that_the_region_excludes_leads_nowhere():
    """Starts followed it, and the study with it ended without a design: rows were chosen that are four times as bad."""
    study = nd.Study(
        unit="mm",
        characteristic_length=150.0,
        starts=4,
        variables={"a1": 0.0, "a2": (100.0, 850.0), "b1": (50.0, 350.0), "b2": (0.0, 100.0), "zp": (250.0, 700.0)}
        | {"zs": (50.0, 650.0), "theta_z": (-0.5, 0.5)},
        tool={"position": [24.2081, 0.0, -90.0]},
        constraints={"leg_clearance": {"min": 15.0}},
        objective={"region": {"ball": 40.0, "tilt": 0.150897, "internal_point": "held"}},
    )
    rows = {"A": (257.8, 364.2), "B": (478.2, 491.2), "C": (617.8, 799.5)}
    catalogue = {name: nd.Actuator(name, *ends) for name, ends in rows.items()}
    most = nd.Actuator("any", 257.8, 799.5)
    known = nd.optimize(study.with_actuators({"external": most, "upper": most, "lower": most}))
    upper = study.with_actuators({"external": most, "upper": catalogue["A"], "lower": most})
    assert nd.optimize(upper, warm=known.best).objective == pytest.approx(nd.optimize(upper).objective, rel=1e-6)
    result = nd.optimize(replace(study, actuators=list(catalogue.values())))
    best = study.with_actuators({kind: catalogue[name] for kind, name in zip(LEG_KINDS, "CAB", strict=True)})
    assert names(result.actuators.chosen) == ["C", "A", "B"]
    assert result.objective == pytest.approx(nd.optimize(best).objective, rel=1e-6)


def tight_for_tolerances():
    """A study with one variable and rows for it; the first row fits the drawing alone."""
    variables = {"a1": 0.0, "a2": 700.0, "b1": 200.0, "b2": 0.0, "zp": 450.0, "zs": (200.0, 400.0), "theta_z": 0.0}
    study = replace(POSES, constraints={}, variables=variables)
    lengths = nd.leg_lengths(nd.optimize(study).geometry, nd.optimize(study).configurations[1:])
    legs = (("cheap", lengths[:, :3], 0.3), ("upper", lengths[:, 3:6], 20.0), ("lower", lengths[:, 6:], 20.0))
    rows = [nd.Actuator(name, x.min() - room, x.max() + room, price=100.0) for name, x, room in legs]
    return replace(study, actuators=rows, tolerances={"joints": 0.5, "legs": 0.1}), lengths[:, :3]


@pytest.mark.slow
def test_rows_that_leave_no_room_for_tolerances_are_passed_over(monkeypatch):
    study, external = tight_for_tolerances()
    dear = nd.Actuator("dear", external.min() - 10.0, external.max() + 10.0, price=110.0)
    more = replace(study, actuators=[*study.actuators, dear])
    drawn = nd.optimize(replace(more, tolerances={}))
    assert names(drawn.actuators.chosen) == ["cheap", "upper", "lower"]
    result = nd.optimize(more)
    assert (result.status, result.reserve.proved) == (nd.Status.OPTIMAL, True)
    assert names(result.actuators.chosen) == ["dear", "upper", "lower"]
    note = "passed over, as they leave no room for the tolerances: external cheap, upper upper, lower lower"
    assert note in result.summary()
    none = nd.optimize(study)
    assert (none.status, none.best, none.actuators) == (nd.Status.INFEASIBLE, None, None)
    assert none.reason.endswith(
        "; the actuators are external cheap, upper upper, lower lower, and no others leave room for the tolerances"
    )
    real = import_module("ninedof.optimize.optimize").ActuatorSearch.result

    def once(search):
        if search.passed_over:
            search._chosen = lambda choices: (_ for _ in ()).throw(KeyboardInterrupt)
        return real(search)

    with monkeypatch.context() as patch:
        patch.setattr(ActuatorSearch, "result", once)
        interrupted = nd.optimize(more)
    assert interrupted.interrupted
    assert interrupted.actuators is None or names(interrupted.actuators.chosen) != ["cheap", "upper", "lower"]
    monkeypatch.setattr(import_module("ninedof.optimize.optimize"), "OTHERS", 0)
    stopped = nd.optimize(more)
    assert (stopped.status, stopped.best) == (nd.Status.STOPPED, None)
    assert stopped.reason.endswith("the next 0 combinations leave no room either, and no others were tried")


def test_the_next_best_is_one_of_those_tried_and_may_be_better():
    """The chosen one is solved again, with another choice of starts: it is no better then, as a rule."""
    row = nd.Actuator("A", 1.0, 9.0)
    chosen = Combination(row, row, row, objective=4.0)
    for objective, left_out, words in (
        (4.0, (), "the next best: A for all legs has the same objective"),
        (4.4, ("B",), "the next best of the rows that were tried: A for all legs has 4.400000, 10 % more"),
        (3.8, (), "the next best: A for all legs has 3.800000, 5 % less"),
    ):
        other = replace(chosen, objective=objective)
        assert ActuatorChoice(chosen, other, 3, 4, left_out).words[1] == words


@pytest.mark.slow
def test_what_fails_where_no_row_fits():
    rows = [nd.Actuator("tiny", 20.0, 60.0), nd.Actuator("less tiny", 40.0, 120.0)]
    result = nd.optimize(replace(POSES, actuators=rows))
    assert (result.status, result.best) == (nd.Status.INFEASIBLE, None)
    assert (
        "no row fits the external legs; the nearest, less tiny: no design found has external_length <= 120"
        in result.reason
    )
    assert "no row fits the lower legs; the nearest, less tiny: " in result.reason
    assert {"external_length", "lower_length"} <= set(result.causes)
    impossible = replace(POSES, actuators=BOTH, constraints=LIMITS | {"height": (None, 100.0)})
    assert "without limits of actuators too" in nd.optimize(impossible).reason


def test_columns_without_effect_are_named():
    strong = nd.Actuator("strong", 150.0, 800.0, force=800.0, rate=300.0)
    result = nd.optimize(replace(POSES, actuators=[strong], loads={"wrenches": [[0, 0, 0, 0, 0, -100]]}, starts=1))
    assert result.actuators.notes == ("the rates of the actuators are not looked at: the study states no speeds",)
    assert result.study.constraints["lower_force"] == (None, 800.0)
    assert "lower_rate" not in result.study.constraints


@pytest.mark.slow
def test_interrupted_the_best_so_far_is_returned(tmp_path):
    study, begun = replace(POSES, actuators=[*BOTH, LONG]), []

    class Ends:
        def __init__(self, at):
            self.at = at

        def __call__(self, *_):
            if self.at in begun[-1]:
                raise KeyboardInterrupt

        def phase(self, words):
            begun.append(words)

    early = nd.optimize(study, progress=Ends("any, any, any"), out=tmp_path / "run")
    assert (early.interrupted, early.best, early.actuators) == (True, None, None)
    assert "before a combination was solved" in early.reason
    whole = nd.optimize(study, progress=Ends("never"))
    last = [words for words in begun if "any" not in words][-1].split(" (")[0]
    late = nd.optimize(study, progress=Ends(last), out=tmp_path / "run")
    assert late.interrupted
    assert late.actuators is None or late.objective >= whole.objective * (1 - 1e-9)
    on = nd.optimize(study, out=tmp_path / "run")
    assert on.actuators == whole.actuators
    assert on.candidates == whole.candidates
    assert nd.optimize(study, out=tmp_path / "run").candidates == whole.candidates


def test_the_time_limit_ends_the_search():
    result = nd.optimize(replace(POSES, actuators=[*BOTH, LONG]), time_limit=1e-3)
    assert (result.status, result.interrupted) == (nd.Status.STOPPED, False)
    assert result.reason.startswith("the search of actuators ended after 0 studies")


def test_who_does_not_choose_rows_refuses_them():
    study = replace(POSES, actuators=BOTH)
    for call in (lambda: nd.pareto(study, "base_cone"), lambda: nd.admissible(study, ("a2", "b1"))):
        with pytest.raises(ValueError, match="study: got one with actuators, expected the run of `optimize`"):
            call()


def test_the_best_of_all_combinations_comes_first_whatever_is_solved_early(monkeypatch):
    """The guess was taken with its bound: rows without a design, or a wrong next best. Values are invented."""
    rows = [nd.Actuator(name, 1.0 + k, 2.0 + k) for k, name in enumerate("ABC")]
    for seed, count in itertools.product(range(300), (1, 3)):
        rng = random.Random(seed)
        values = {some: rng.choice([math.inf, rng.uniform(4.0, 9.0)]) for some in itertools.product(rows, repeat=count)}

        def solved(some, values=values):
            least = min(v for full, v in values.items() if all(a in (None, b) for a, b in zip(some, full, strict=True)))
            return SimpleNamespace(best=None if least == math.inf else some, least=least)

        search = ActuatorSearch(REGION, None)
        search.groups, search.rows = [("external",)] * count, [rows] * count
        guess = tuple(rng.choice(rows) for _ in range(count))
        monkeypatch.setattr(search, "_guess", lambda root, guess=guess: guess)
        monkeypatch.setattr(search, "_value", lambda result, complete=False: result.least)
        monkeypatch.setattr(search, "_ask", lambda some, s=search, f=solved: s.results.setdefault(some, f(some)))
        found = [values[some] for some in search._best_first()]
        assert found == [value for value in sorted(values.values())[:2] if value < math.inf]
