"""What is proved of a machine at every pose of a region.

Oracle: poses sampled in the region from its definition, rotations by scipy, every number by the numpy model; segments
by points on them. None of it shares code with the proofs.
"""

import math
from dataclasses import replace
from fractions import Fraction
from functools import partial
from pathlib import Path

import numpy as np
import numpy_model as model
import pytest
from proved_machine import LIMITS, REGIONS, VARIABLES, apart, at_pose, proved, sampled, study
from singular_robots import unit_rows
from sizes import size
from workspace_oracle import angles

import ninedof as nd
from ninedof import _core
from ninedof.proof import machine
from ninedof.proof.machine import certify, machine_digest
from ninedof.proof.machine_record import MachineCertificate, outward

EXAMPLES = Path(__file__).parents[3] / "examples"


@pytest.mark.parametrize("shape", REGIONS)
def test_no_sampled_pose_of_a_proved_region_passes_what_is_proved(shape):
    region = REGIONS[shape]
    geometry, neutral, certificate = proved(region, gap=0.25)
    by_name = {(one.name, one.side): one for one in certificate.limits}
    assert certificate.left_count == 0
    rng = np.random.default_rng(7)
    reached = {"condition": 0.0, "longest": np.zeros(9), "base": 0.0}
    for _ in range(size(1, 100)):
        m = sampled(region, geometry, neutral, rng, 25_000)
        lengths = model.lengths(m)
        low, high = np.transpose(certificate.lengths)
        assert (lengths >= low * (1.0 - 1e-13)).all()
        assert (lengths <= high * (1.0 + 1e-13)).all()
        strokes = lengths.max(axis=0) - lengths.min(axis=0)
        assert strokes.max() <= by_name["stroke", "max"].value[1]
        assert lengths.max() / lengths.min() <= by_name["leg_ratio", "max"].value[1]
        first = m.at(slice(0, 4_000))
        condition = model.condition_number(first, 150.0)
        assert condition.max() <= certificate.condition[1]
        start = model.robot(geometry, neutral)
        side = np.sign(np.linalg.det(np.stack(unit_rows(start))))
        determinants = np.linalg.det(np.stack(unit_rows(m))) * side
        assert determinants.min() >= by_name["no singularity", "min"].value[0]
        base = angles(m, False, home=start)
        assert base.max() <= by_name["base_cone", "max"].value[1]
        axis = np.array(LIMITS["platform_cone"]["axis"])
        assert angles(m, True, axis).max() <= by_name["platform_cone", "max"].value[1]
        assert apart(first, rng).min() >= by_name["leg_clearance", "min"].value[0]
        reached["condition"] = max(reached["condition"], condition.max())
        reached["longest"] = np.maximum(reached["longest"], lengths.max(axis=0))
        reached["base"] = max(reached["base"], base.max())
    # What is said to be met is met nearly by a sample too, and the bounds are not far above it.
    assert reached["condition"] > 0.93 * certificate.condition[0]
    assert (reached["longest"] > 0.97 * high).all()
    assert reached["base"] > 0.9 * by_name["base_cone", "max"].value[0]
    assert certificate.condition[1] <= 1.25 * certificate.condition[0] * (1.0 + 1e-12)


PLANTED = {
    "leg_length": lambda m, start: model.lengths(m).max(),
    "base_cone": lambda m, start: angles(m, False, home=start).max(),
    "stroke": None,
    "leg_clearance": None,
}


@pytest.mark.parametrize("name", PLANTED)
def test_a_limit_passed_in_a_thin_corner_alone_is_found(name):
    """The limit is a millionth part tighter than what was met: it is passed in a tiny part of the region alone."""
    region = REGIONS["box"]
    _, _, before = proved(region, time_limit=0.01)
    side = "min" if name == "leg_clearance" else "max"
    one = next(p for p in before.limits if p.name == name and p.side == side)
    worst = one.value[side == "min"]
    tight = worst * (1.0 + 2e-6) if side == "min" else worst * (1.0 - 2e-6)
    limit = {side: tight}
    geometry, neutral, certificate = proved(region, {name: limit}, time_limit=0.01)
    planted = next(p for p in certificate.limits if p.name == name and p.side == side)
    assert planted.answer != "proved"
    if PLANTED[name] is not None:
        assert planted.answer == "violated"
        (met,) = planted.at
        found = PLANTED[name](at_pose(met, geometry, neutral), model.robot(geometry, neutral))
        assert found == pytest.approx(planted.value[0], rel=1e-9)
        assert found > tight


def test_a_bound_below_the_worst_condition_number_is_never_proved():
    region = REGIONS["box"]
    geometry, neutral, certificate = proved(region, gap=0.5)
    met = model.condition_number(at_pose(certificate.condition_at, geometry, neutral), 150.0)
    assert met == pytest.approx(certificate.condition[0], rel=1e-9)
    for below, answer in ((1.0 - 1e-5, "violated"), (1.0 + 1e-9, "undecided"), (0.8, "violated")):
        bound = float(met) * below
        _, _, again = proved(region, condition_number=bound, gap=0.5, slack=0.0, time_limit=0.2)
        assert again.limits[-1].answer == answer


def test_a_singular_pose_in_the_region_is_found():
    """O held in the plane of the upper joints at one place of the region: det C changes its sign."""
    region = nd.Region(box=(20.0, 20.0, 120.0), internal_point="held")
    *_, certificate = proved(region, time_limit=0.5)
    singular = certificate.limits[0]
    assert singular.answer == "violated"
    assert singular.which == "det C"
    assert singular.value[1] < 0.0
    assert math.isinf(certificate.condition[1])
    assert certificate.left_count > 0
    assert "Violated: no singularity, det C" in str(certificate)


@pytest.mark.slow
def test_an_interrupted_proof_goes_on_where_it_stopped():
    region = REGIONS["box"]
    *_, whole = proved(region, gap=0.25)
    *_, part = proved(region, gap=1e-5, time_limit=0.02)  # minutes of work, on any machine
    assert part.left_count
    assert part.condition[1] > part.target
    again = MachineCertificate.from_dict(part.to_dict())
    *_, rest = proved(region, gap=0.25, resume=again)
    assert rest.left_count == 0
    *_, kept = proved(region, gap=0.01, time_limit=0.02, resume=replace(rest, left=()))
    assert kept.condition[1] <= rest.condition[1]
    with pytest.raises(ValueError, match=r"^resume: got a certificate over a box"):
        proved(REGIONS["path"], resume=rest)
    assert rest.condition[1] <= max(rest.target, whole.condition[1]) * (1.0 + 1e-12)


def test_a_study_without_a_region_is_proved_at_its_poses():
    poses = (nd.Pose(position=(30.0, 0.0, 0.0)), nd.Pose(rotation=(0.0, 0.1, 0.05), internal_point=(5.0, 0.0, -3.0)))
    asked = nd.Study(
        family="symmetric",
        variables={name: (value, value) for name, value in VARIABLES.items()},
        constraints=LIMITS,
        characteristic_length=150.0,
        objective=nd.Objective(poses=poses),
    )
    problem = asked.problem()
    configurations = nd.Configuration(*problem.configurations(list(VARIABLES.values())))
    geometry = problem.geometry(list(VARIABLES.values()))
    certificate = certify(asked, geometry, configurations, 150.0)
    worst = model.condition_number(model.robot(geometry, configurations[1:]), 150.0)
    low, high = certificate.condition
    assert low <= worst.max() * (1.0 + 1e-12)
    assert worst.max() <= high <= low * (1.0 + 1e-8)
    assert certificate.condition_at.listed == 1 + worst.argmax()
    assert "2 listed poses" in str(certificate)


SMALL = nd.Region(box=(3.0, 4.0, 2.0), tilt=0.01)


def test_only_the_certificate_of_the_same_machine_is_gone_on_with():
    _, _, made = proved(SMALL, time_limit=0.5)
    asked, other = study(SMALL), nd.Configuration.neutral([VARIABLES["zp"]], [1.05 * VARIABLES["zs"]])
    geometry = asked.problem().geometry(list(VARIABLES.values()))
    with pytest.raises(ValueError, match="resume: got a certificate of another machine"):
        certify(asked, geometry, other, 150.0, resume=made)
    with pytest.raises(ValueError, match="resume: got a certificate of another machine"):
        certify(asked, geometry, nd.Configuration.neutral([360.0], [260.0]), 151.0, resume=made)
    again = MachineCertificate.from_dict(made.to_dict())
    assert proved(SMALL, resume=again, time_limit=0.5)[2].condition[1] <= made.condition[1]


def test_limits_of_the_condition_number_count():
    kappa = proved(SMALL, {}, gap=0.02)[2].condition
    for limit, answer in ((0.9 * kappa[0], "violated"), (1.01 * kappa[1], "proved")):
        asked = study(SMALL)
        objective = nd.Objective(region=SMALL, condition_limit=limit, neutral_condition_limit=2.0 * kappa[1])
        asked = replace(asked, objective=objective)
        geometry = asked.problem().geometry(list(VARIABLES.values()))
        neutral = nd.Configuration.neutral([VARIABLES["zp"]], [VARIABLES["zs"]])
        made = certify(asked, geometry, neutral, 150.0, gap=0.02)
        answers = {one.name: one.answer for one in made.limits}
        assert answers["condition_limit"] == answer
        assert answers["condition_limit at neutral"] == "proved"
        assert made.proved == all(one == "proved" for one in answers.values())


def test_a_certificate_of_a_wider_gap_goes_on_below_its_bound():
    geometry, neutral, wide = proved(SMALL, gap=0.5)
    assert not wide.left_count
    narrow = certify(study(SMALL), geometry, neutral, 150.0, gap=0.02, resume=wide)
    assert narrow.condition[1] <= narrow.condition[0] * 1.02 * (1.0 + 1e-9)
    assert not narrow.left_count


class Pressed(Exception):
    """What a user's function raises."""


@pytest.mark.parametrize("error", [KeyboardInterrupt, Pressed])
def test_ctrl_c_while_a_state_is_kept_ends_with_the_certificate_and_other_errors_are_raised(monkeypatch, error):
    sliced = partial(_core.ConditionSettings, slice_seconds=0.01, least_seconds=0.01, keep_share=0.0)
    monkeypatch.setattr(_core, "ConditionSettings", sliced)
    kept = []

    def keep(made):
        kept.append(made)
        raise error

    if error is Pressed:
        with pytest.raises(Pressed):
            proved(SMALL, gap=1e-4, keep=keep)
    else:
        *_, made = proved(SMALL, gap=1e-4, keep=keep)
        assert made.interrupted
        assert made.left_count
        assert made.condition_boxes >= kept[0].condition_boxes
    assert len(kept) == 1


def test_an_interruption_at_the_neutral_pose_is_one(monkeypatch):
    search = _core.search_condition

    def interrupted(*given):
        state = search(*given)
        state.interrupted = True
        return state

    monkeypatch.setattr(_core, "search_condition", interrupted)
    limited = nd.Study(objective={"region": {"box": [0.01] * 3}, "neutral_condition_limit": 5.0})
    geometry = nd.Geometry.hexagonal(a1=0.0, a2=5.8, b1=2.9, b2=0.0)
    with pytest.raises(KeyboardInterrupt):
        certify(limited, geometry, nd.Configuration.neutral([4.0], [2.4]), 150.0)


def test_poses_beyond_the_doubles_are_undecided():
    region = nd.Objective(poses=(nd.Pose((1e99, 0.0, 0.0)),))
    asked = replace(study(None), objective=region, constraints={"leg_length": (None, 700.0)})
    geometry = asked.problem().geometry(list(VARIABLES.values()))
    far = np.array([[0.0, 0.0, 360.0], [1e99, 0.0, 360.0]])
    poses = nd.Configuration(far, np.repeat(np.eye(3)[None], 2, 0), far - [0.0, 0.0, 100.0])
    made = certify(asked, geometry, poses, 150.0, time_limit=0.1)
    assert "proved" not in {one.answer for one in made.limits}
    assert made.condition[1] == math.inf


def test_words_never_claim_more_than_is_proved():
    assert nd.Region(box=(49.99999999, 50.0, 0.1)).words == "a box of half edges 49.99999999, 50, 0.1"
    assert nd.Region(tilt=0.1).words == "the neutral position, tilts of at most 5.72957 degrees"
    assert nd.Region(tilt=math.radians(10.0)).words.endswith("of at most 10 degrees")
    rng = np.random.default_rng(3)
    for value in rng.uniform(0.1, 10.0, 300) * 10.0 ** rng.integers(-9, 9, 300):
        near = [float(f"{value:.5g}")]
        near += [math.nextafter(near[0], way) for way in (-math.inf, math.inf)]
        for x in (*near, *(-x for x in near)):
            for digits in (6, 9):
                down, up = (Fraction(outward(x, way, digits)) for way in (False, True))
                assert down <= Fraction(x) <= up
                assert up - down <= abs(Fraction(x)) * Fraction(2, 10 ** (digits - 1))
    assert outward(5e-324, False) == "4.94065e-324"


def test_every_number_of_a_region_is_part_of_the_machine():
    """Its text for people has six digits, and of long paths only their length."""
    c = nd.Configuration.neutral([3.9828, 3.9828], [2.4435, 2.4435])
    g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    way = [[0.01 * k, 0.0, 0.0] for k in range(30)]
    regions = [
        {"box": [0.1, 0.1, 0.1]},
        {"box": [0.1000001, 0.1, 0.1]},
        {"path": way},
        {"path": [*way[:-1], [0.3, 0, 0]]},
    ]
    digests = {machine_digest(nd.Study(objective={"region": region}), g, c, 1.0) for region in regions}
    assert len(digests) == 4


@pytest.mark.slow
def test_no_known_pose_is_worse_than_the_worst_met():
    """The condition number has a local maximum about each corner of a region, two of them equal in a minimax design."""
    for name in ("18_requirement", "20_tool"):
        result = nd.optimize(nd.Study.load(EXAMPLES / f"{name}.toml"), starts=4)
        assert result.best is not None
        certificate = result.certify(gap=0.3, time_limit=0.0)
        assert certificate.condition[0] >= result.best.objective * (1.0 - 1e-9)
        assert all(limit.answer != "undecided" for limit in certificate.limits)


def test_the_time_of_the_limits_is_not_taken_from_the_condition_number(monkeypatch):
    """Whenever a proof is gone on with they take as long again."""
    limits, settings, seconds, clock = _core.limits_over_poses, _core.ConditionSettings, [], [0.0]

    def slow(*arguments):
        clock[0] += 0.2
        return limits(*arguments)

    def noted(**given):
        seconds.append(given["seconds"])
        return settings(**given)

    monkeypatch.setattr(machine, "perf_counter", lambda: clock[0])
    monkeypatch.setattr(_core, "limits_over_poses", slow)
    monkeypatch.setattr(_core, "ConditionSettings", noted)
    geometry, home = nd.Geometry.hexagonal(a1=0.0, a2=5.8, b1=2.9, b2=0.0), nd.Configuration.neutral([4.0], [2.4])
    certify(nd.Study(objective={"region": {"box": [0.01] * 3}}), geometry, home, 1.0, time_limit=2.0)
    assert clock[0] > 0.0
    assert seconds[0] == 2.0
