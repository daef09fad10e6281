"""Bounds of optima over poses, held against designs drawn at random and evaluated in numpy, and hidden better ones."""

import itertools
import math
import signal
from dataclasses import replace
from functools import partial
from pathlib import Path
from time import perf_counter

import numpy as np
import pytest
from limit_oracle import limits_of, margins, robot_of
from region_oracle import index_at, random_poses
from robots import NONPLANAR

import ninedof as nd
from ninedof.design.domains.region_poses import posed
from ninedof.optimize.pieces import Pieces
from ninedof.proof.optimum import prove
from ninedof.proof.optimum_proof import OptimumProof
from ninedof.proof.optimum_steps import at_home, ways_of
from ninedof.support.kept.store import Store

SIZES = {"a1": 0.0, "a2": (2.0, 10.0), "b1": (1.0, 5.0), "b2": 0.0, "zp": 5.0, "zs": 3.0}
LIMITS = {"base_cone": {"max_deg": 55, "axis": (0, 0, 1)}, "stroke_ratio": (None, 1.5)}
REGION = nd.Study(variables=SIZES, constraints=LIMITS, objective={"region": {"ball": 0.4, "tilt": 0.1}}, starts=8)
STUDIES = {
    "region": REGION,
    "tool, held": replace(
        REGION,
        tool={"position": (0.1, 0.0, -0.5)},
        objective={"region": {"box": (0.3, 0.2, 0.2), "yaw": 0.1, "internal_point": "held"}},
    ),
    "poses": replace(REGION, objective={"poses": [{"position": (0.2, 0.0, 0.1)}, {"rotation": (0.1, 0.0, 0.05)}]}),
    "non-planar": nd.Study(
        "symmetric_nonplanar",
        variables=NONPLANAR | {"base_internal_radius": 2.0},
        constraints={"leg_ratio": (None, 2.6)},
        starts=8,
    ),
}


@pytest.fixture(scope="module", params=list(STUDIES))
def result(request):
    return nd.optimize(STUDIES[request.param], certify=True)


def corners(region):
    """The poses at the corners of a box with yaws, which are hardly drawn; none of other regions."""
    ends = [(-size, size) for size in (*(region.box or ()), region.yaw)]
    held = region.internal_point == "held"
    return [
        nd.Pose((x, y, z), (0.0, 0.0, yaw), (0.0, 0.0, 0.0) if held else (x, y, z), region.unit)
        for x, y, z, yaw in (itertools.product(*ends) if region.box else ())
    ]


def worst_index(study, variables, count, rng):
    """The worst condition number and the least margin of a design at poses drawn at random."""
    region = study.objective.region
    there = study if region is None else posed(study, (*random_poses(region, count, rng), *corners(region)))
    robot = robot_of(there, variables)
    least = min((margins(limit, robot).min() for limit in limits_of(there)), default=math.inf)
    return index_at(there, robot).max(), least


@pytest.mark.slow
def test_the_best_design_is_within_the_gap(result):
    proof = result.proof
    assert proof.complete
    assert proof.left_out == ()
    assert result.condition_number * (1.0 - 1e-3) == pytest.approx(proof.lower_bound, rel=1e-12)
    assert proof.gap(result.condition_number) == pytest.approx(1e-3, rel=1e-6)
    assert proof.lower_bound < result.condition_number
    assert nd.OptimumProof.from_dict(proof.to_dict()) == proof


@pytest.mark.slow
def test_no_design_drawn_at_random_that_keeps_the_limits_is_below_the_bound(result):
    rng, study, kept = np.random.default_rng(1), result.study, 0
    free = {name: ends for name, ends in study.variables.items() if isinstance(ends, tuple)}
    for n in range(300):
        near = 0.03 if n % 2 else 1.0  # half of them near the best design
        x = {}
        for name, (low, high) in free.items():
            middle, half = (result.variables[name], near * (high - low)) if n % 2 else (0.5 * (low + high), high - low)
            x[name] = float(np.clip(middle + 0.5 * half * rng.uniform(-1.0, 1.0), low, high))
        index, least = worst_index(study, dict(result.variables) | x, 300, rng)
        kept += least > 0.0
        # The worst pose is hardly drawn: of an index, and of a limit that is only just kept.
        assert least <= 0.003 or index >= 0.998 * result.lower_bound, x
    assert kept > 20


@pytest.mark.slow
def test_where_a_better_design_is_hidden_only_less_than_it_is_proved():
    best = nd.optimize(REGION).condition_number
    proof = nd.prove_optimum(REGION, 1.1 * best, time_limit=3.0)
    assert not proof.complete
    assert 1.0 < proof.lower_bound < best
    study = STUDIES["poses"]  # at a few poses the better design itself is proved
    best = nd.optimize(study).condition_number
    proof = nd.prove_optimum(study, 1.1 * best, time_limit=60.0)
    assert best < proof.better < 1.1 * best
    assert proof.lower_bound < best


PAPER = nd.Study.paper()
PLATES = replace(PAPER, variables=dict(PAPER.variables) | {"a1": 0.0, "b2": 0.0})


@pytest.mark.parametrize("study", [STUDIES["poses"], PLATES], ids=["poses", "paper"])
def test_a_design_that_is_better_by_1e_10_is_not_overlooked(study):
    """Less than it is proved, and more is not: the claimed bound lies 9e-11 above the best design."""
    best = nd.optimize(study).condition_number
    proof = nd.prove_optimum(study, best * (1.0 + 1e-10), gap=1e-11, time_limit=60.0)
    assert not proof.complete
    assert proof.lower_bound <= best
    assert proof.better is None or best <= proof.better < best * (1.0 + 1e-10)
    proof = nd.prove_optimum(study, best * (1.0 - 1e-10), gap=1e-11, time_limit=60.0)
    assert proof.complete
    assert best * (1.0 - 1.2e-10) < proof.lower_bound < best


@pytest.mark.slow
def test_all_limits_count():
    """Without one of them there is a better design: the bound of both is above it."""
    free = replace(REGION, constraints={})
    assert nd.optimize(free).condition_number < 0.99 * nd.optimize(REGION, certify=True).lower_bound


def test_without_time_nothing_is_proved():
    proof = nd.prove_optimum(REGION, 4.0, time_limit=1e-9)
    assert (proof.lower_bound, proof.complete, proof.better) == (1.0, False, None)
    assert proof.open > 0


SIX = replace(REGION, variables={**SIZES, "a1": (0.0, 6.0), "b2": (0.0, 3.0), "zp": (3.0, 7.0), "zs": (1.0, 5.0)})


def test_why_boxes_of_designs_take_the_place_of_a_class_is_said():
    """Where zp and an internal radius begin at 0 the class has no domain."""
    sizes = {"base_external_radius": 4.0, "base_internal_radius": (0.0, 4.0), "base_internal_angle": 0.7, "zs": 2.0}
    sizes |= {"platform_external_radius": 2.0, "platform_external_angle": 0.9, "platform_internal_radius": 1.8}
    study = nd.Study("symmetric", sizes | {"platform_internal_angle": -0.4, "zp": (0.0, 6.0)}, characteristic_length=1)
    proof = nd.prove_optimum(study, 3.0, gap=0.5, time_limit=0.0)
    assert "The class has no proof here (zp: got [0, 6], expected a positive lower bound" in proof.words
    assert OptimumProof.from_dict(proof.to_dict()).words == proof.words
    higher = replace(study, variables=dict(study.variables) | {"zp": (0.1, 6.0)})
    assert "no proof here" not in nd.prove_optimum(higher, 3.0, gap=0.5, time_limit=0.0).words


@pytest.mark.slow
def test_the_neutral_pose_proves_wide_gaps_of_six_free_variables(tmp_path):
    best = nd.optimize(SIX).condition_number
    proof = nd.prove_optimum(SIX, best, gap=0.4)
    assert proof.complete
    assert proof.lower_bound == pytest.approx(0.6 * best, rel=1e-12)
    assert proof.boxes < 200_000
    assert proof.where == "over the region"
    assert set(proof.left_out) == set(LIMITS)
    assert nd.check_certificate(proof.save(tmp_path / "optimum.certificate")).proved
    rng = np.random.default_rng(2)
    free = {name: ends for name, ends in SIX.variables.items() if isinstance(ends, tuple)}
    for _ in range(1000):
        x = {name: float(rng.uniform(*ends)) for name, ends in free.items()}
        if x["zs"] < x["zp"]:
            assert worst_index(SIX, {"theta_z": 0.0} | x, 1, rng)[0] >= proof.lower_bound, x


def test_the_file_of_a_bound_names_which_side_of_a_limit_it_leaves_out(tmp_path):
    study = replace(SIX, constraints={"leg_ratio": (1.05, None)})
    proof = nd.prove_optimum(study, 3.0, gap=0.5)
    assert proof.complete
    assert proof.left_out == ("leg_ratio.min",)
    assert nd.check_certificate(proof.save(tmp_path / "optimum.certificate")).proved


SEVEN = replace(SIX, variables={**SIX.variables, "theta_z": (0.0, 0.1)})


@pytest.mark.parametrize("poses", [REGION.objective.to_dict(), {"poses": [{}, {"position": (0.2, 0.0, 0.1)}]}])
def test_of_more_than_six_free_variables_the_neutral_pose_proves_what_it_can(poses, tmp_path):
    study = replace(SEVEN, objective=poses)
    proof = nd.prove_optimum(study, 4.0, gap=0.5)
    assert proof.complete
    assert proof.lower_bound == 2.0
    assert proof.left_out == ways_of(study).left_out == tuple(LIMITS)
    assert proof.where in ("over the region", "at its poses")
    assert nd.check_certificate(proof.save(tmp_path / "optimum.certificate")).proved


def test_non_planar_designs_count_at_the_neutral_pose_too():
    study = nd.Study("symmetric_nonplanar", objective={"poses": [{}, {"rotation": (0.1, 0.0, 0.0)}]})
    assert at_home(study) is not None


BESIDE = nd.Study(
    variables={"a1": 0.0, "a2": (0.0, 60.0), "b1": (0.0, 60.0), "b2": 0.0, "theta_z": 0.0},
    constraints={"radius_ratio": (None, 2.0), "leg_length": (None, 7.0)},
)


def test_a_limit_beside_those_of_the_class_does_not_stop_its_proof():
    proof = nd.prove_optimum(BESIDE, 3.7626590785960472)
    assert proof.complete
    assert proof.gap(3.7626590785960472) < 1.1e-12
    assert proof.left_out == ("leg_length",)


@pytest.mark.slow
def test_a_limit_that_the_class_leaves_out_counts_where_it_is_reached():
    limits = {"radius_ratio": (None, 2.0), "leg_length": (None, 4.5)}
    study = replace(BESIDE, variables=BESIDE.variables | {"a2": 6.0, "b1": (0.5, 10.0)}, constraints=limits)
    best = nd.optimize(study, starts=16).condition_number
    proof = nd.prove_optimum(study, best, gap=0.01)
    assert proof.complete
    assert proof.lower_bound > 4.2 > nd.optimize(BESIDE, starts=8).condition_number
    assert proof.left_out == ()


@pytest.mark.slow
def test_small_gaps_are_proved_one_after_the_other():
    """A general study that is a hexagon: boxes of designs, down to a billionth of its ranges."""
    hexagon = nd.Geometry.hexagonal(a1=0.0, a2=6.0, b1=3.0, b2=0.0)
    joints = {
        f"{name}_{k + 1}_{axis}": float(getattr(hexagon, name)[k][n])
        for name in ("base_external", "base_internal", "platform_external", "platform_internal")
        for k in range(3)
        for n, axis in enumerate("xyz")
    }
    study = nd.Study("general", variables=joints | {"zp": (0.05, 80.0), "zs": (0.05, 80.0), "theta_z": 0.0})
    best = nd.optimize(study, starts=8).condition_number
    proof = nd.prove_optimum(study, best, gap=1e-8)
    assert proof.complete
    assert proof.lower_bound == best * (1.0 - 1e-8)


class Interrupted:
    """A progress that sends SIGINT in the core where the nth bound is worked on."""

    def __init__(self, nth=math.inf):
        self.phases, self._nth = [], nth

    def phase(self, words):
        self.phases += [words] if words.startswith("proving that no design is below") else []

    def __call__(self, *_):
        if len(self.phases) == self._nth:
            signal.raise_signal(signal.SIGINT)


@pytest.mark.slow
def test_a_proof_that_was_interrupted_goes_on_behind_what_it_has(tmp_path):
    study = replace(REGION, constraints={"stroke_ratio": (None, 1.5)})
    first, second = Interrupted(4), Interrupted()
    ended = nd.optimize(study, certify=True, out=tmp_path, progress=first)
    assert ended.interrupted
    assert ended.lower_bound > 1.0
    assert not ended.proof.complete
    whole = nd.optimize(study, certify=True, out=tmp_path, progress=second)
    assert whole.proof.complete
    assert whole.proof.certificate
    words = {f"proving that no design is below {target:.6g}" for target in (ended.lower_bound, whole.lower_bound)}
    assert first.phases[0] not in second.phases
    assert words - set(second.phases) == {f"proving that no design is below {ended.lower_bound:.6g}"}
    assert whole.lower_bound == nd.optimize(study, certify=True).lower_bound
    again = Interrupted()
    assert nd.optimize(study, certify=True, out=tmp_path, progress=again).proof == whole.proof
    assert not again.phases


def test_what_was_proved_earlier_is_kept_without_a_file_too():
    """The proof of non-planar designs has no certificate."""
    earlier = OptimumProof(2.5, 3.6, False, 10, 1, 1.0, left_out=("stroke_ratio",))
    proof = prove(SEVEN, 4.0, 0.1, 1e-9, 1, None, earlier)
    assert (proof.lower_bound, proof.left_out, proof.complete) == (2.5, ("stroke_ratio",), False)


def test_a_time_limit_ends_the_proof_too(tmp_path):
    """It goes on where another call has more time; a proof that the time did not end is returned as it is."""
    begin = perf_counter()
    result = nd.optimize(replace(SIX, starts=2), certify=True, time_limit=3.0)
    assert perf_counter() - begin < 60.0
    assert not result.proof.complete
    first = OptimumProof(2.0, 3.0, False, 10, 1, seconds=5.0, certificate=b"one")
    whole = replace(first, lower_bound=3.0, complete=True)
    seen = []

    def compute(earlier, proof):
        seen.append(earlier)
        return proof

    for proof in (first, first, whole, first):
        with Store(tmp_path / "run", {"kind": "some"}) as store:
            Pieces(store).proof(partial(compute, proof=proof), 5.0)
    assert seen == [None, first, first]
    assert seen[1].certificate == b"one"


@pytest.mark.parametrize(
    "change",
    [
        {"tool": {"position": (0.1, 0.0, -0.5)}},
        {"objective": {"region": {"path": [(0.1, 0.0, 0.0), (0.3, 0.0, 0.0)]}}, "constraints": {}},
        {"objective": {"poses": [{"position": (0.2, 0.0, 0.1)}]}},
    ],
    ids=["tool", "path", "poses"],
)
def test_elsewhere_the_neutral_pose_proves_nothing(change):
    """Of a tool, or where it need not be one of the poses."""
    assert at_home(replace(REGION, **change)) is None
    assert at_home(REGION) is not None


@pytest.mark.parametrize(
    ("study", "words"),
    [
        (replace(REGION, objective={"region": {"ball": 0.4, "internal_point": "best"}}), "internal_point"),
        (replace(REGION, objective={"region": {"ball": 0.4}, "aggregate": "mean_inverse"}), "objective"),
        (replace(REGION, objective={"region": {"ball": 0.4}, "index": "speed"}), "objective"),
        (replace(STUDIES["tool, held"], characteristic_length="optimal"), "characteristic_length"),
        (replace(SEVEN, tool={"position": (0.1, 0.0, -0.5)}), "variables: got 7"),
        (replace(STUDIES["poses"], constraints={"singularity_free": (0.01, None)}), "singularity_free"),
    ],
)
def test_what_has_no_proof_is_refused_before_the_work(study, words):
    for call in (ways_of, lambda one: nd.optimize(one, certify=True)):
        with pytest.raises(ValueError, match=words):
            call(study)


def test_a_length_that_depends_on_the_design_has_the_bound_of_the_neutral_pose():
    study = replace(REGION, characteristic_length="optimal")
    best = nd.optimize(study).condition_number
    proof = nd.prove_optimum(study, best, gap=0.5)
    assert proof.complete
    assert proof.where == "over the region"
    assert set(proof.left_out) == set(LIMITS)


@pytest.mark.slow
def test_the_machine_of_the_requirement_is_within_a_thousandth():
    study = nd.Study.load(Path(__file__).parents[3] / "examples" / "18_requirement.toml")
    proof = nd.prove_optimum(study, 4.023420)
    assert proof.complete
    assert proof.lower_bound == pytest.approx(4.0194, abs=1e-4)
