"""prove_optimum, certificates, `optimize(certify=True)`, `ninedof optimize --certify`, `ninedof check`."""

import dataclasses
import json
import math
import signal
import zlib
from fractions import Fraction
from importlib import import_module

import certificate_in_balls as balls
import numpy as np
import pytest
from forged import sealed_tree, tree_parts, verdict_of
from sizes import LONG

import ninedof as nd
from ninedof.proof.optimum import prove
from ninedof.proof.optimum_proof import FILE, OptimumProof
from ninedof.report.proof import of_result as report_proof

BEST = 3.7626590785960471961  # by a solution of the optimality conditions in 50 digits
PAPER = nd.Study.paper()


@pytest.fixture(scope="module")
def proved():
    return nd.optimize(PAPER, starts=8, certify=True)


@pytest.mark.slow
def test_the_papers_problem_is_proved_to_twelve_digits(proved):
    proof = proved.proof
    assert proof.complete
    assert proof.open == 0
    assert BEST * (1.0 - 1.1e-12) < proved.lower_bound < BEST
    assert proof.gap(proved.condition_number) < 1.1e-12
    assert proof.words == "Proved: no machine of this class has a condition number below 3.76265907859."
    assert proof.left_out == ()
    bound = nd.applicable_bounds(proved)[0]
    assert (bound.name, bound.proved) == ("certificate", True)


def test_the_words_never_round_up():
    proof = OptimumProof(2.0 - 1e-15, 2.0, False, 1, 1, 0.1)
    assert proof.words.endswith("below 1.99999999999.")
    assert OptimumProof(2.0**70, 2.0**70, True, 1, 0, 0.1).words.endswith("below 1180591620717411303424.")
    assert OptimumProof(3.0, 3.0, True, 1, 0, 0.1, left_out=("stroke",)).words == (
        "Proved: no machine of this class has a condition number below 3. The proof does without stroke: with them it "
        "holds all the more."
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    ("change", "best", "gap"),
    [
        ({"constraints": {"radius_ratio": (None, 1.2)}}, 4.0916506638403645, 1e-9),
        ({"constraints": {"radius_ratio": (None, 2.0), "leg_ratio": (None, 2.0)}}, 3.8574528079169568, 1e-6),
        ({"constraints": {"radius_ratio": (None, 2.0)}, "characteristic_length": 2.0}, BEST, 1e-3),
        pytest.param(
            {"constraints": {"radius_ratio": (None, 2.0)}, "variables": {"theta_z": (-10.0, 10.0)}},
            3.749827,
            1e-6,
            marks=pytest.mark.skipif(not LONG, reason="ten seconds: NINEDOF_LONG=1"),
        ),
    ],
)
def test_other_studies_are_proved(change, best, gap):
    study = nd.Study(**({"variables": dict(PAPER.variables)} | change))
    proof = nd.prove_optimum(study, best, gap=gap)
    assert proof.complete
    assert proof.lower_bound == best * (1.0 - gap)


@pytest.mark.parametrize("seed", range(200 if LONG else 8))
def test_nothing_is_proved_above_a_design_that_is_known(seed):
    """With the target above the condition number of some allowed design, the search must not come to its end."""
    rng = np.random.default_rng(seed)
    ratio, top = rng.uniform(1.1, 6.0), 10.0 ** rng.uniform(0.3, 2.0)
    length = 10.0 ** rng.uniform(-1.0, 1.0)
    limits = {"radius_ratio": (None, ratio), "zs_fraction": sorted(rng.uniform(0.05, 0.95, 2))}
    variables = dict.fromkeys(("a1", "a2", "b1", "b2"), (0.0, top)) | {
        "zp": (0.01 * top, top),
        "zs": (0.001 * top, top),
        "theta_z": (-1.0, 1.0) if seed % 2 else 0.0,
    }
    study = nd.Study(variables=variables, constraints=limits, characteristic_length=length)
    best = math.inf
    for _ in range(400):
        u, phi = rng.uniform(0.05, 0.5) * top, rng.uniform(0.0, 1.0, 2)
        r = u * rng.uniform(0.2, ratio)
        x = dict(
            zip(("a1", "a2", "b1", "b2"), (r * phi[0], r * (1 - phi[0]), u * phi[1], u * (1 - phi[1])), strict=True)
        )
        x["zp"] = rng.uniform(0.05, 1.0) * top
        x["zs"] = x["zp"] * rng.uniform(*limits["zs_fraction"])
        x["theta_z"] = rng.uniform(-1.0, 1.0) if seed % 2 else 0.0
        point = study.evaluate(x)
        if all(margin >= 0.0 for margin in point.margins.values()):
            best = min(best, point.condition_number)
    assert math.isfinite(best)
    proof = nd.prove_optimum(study, best * 1.001, gap=0.0, time_limit=0.3)
    assert not proof.complete
    assert proof.lower_bound <= best
    assert proof.better is None or proof.better < best * 1.001


def test_a_symmetric_study_has_a_bound_at_any_time():
    study = nd.Study("symmetric", constraints={"radius_ratio": (None, 2.0), "leg_ratio": (None, 3.0)})
    proof = nd.prove_optimum(study, 2.3430924, time_limit=0.3)
    assert not proof.complete
    assert 1.0 < proof.lower_bound < 2.3430924
    assert proof.gap(2.3430924) == 1.0 - proof.lower_bound / 2.3430924
    assert proof.certificate == b""
    with pytest.raises(ValueError, match="did not come to its end"):
        proof.save("nowhere")


@pytest.mark.slow
def test_records_keep_the_proof_and_the_certificate(proved, tmp_path):
    path = nd.save(proved, tmp_path / "run")
    again = nd.load(path)
    assert again.proof == dataclasses.replace(proved.proof, certificate=b"")
    assert again.lower_bound == proved.lower_bound
    folder = tmp_path / "run"
    record = json.loads((folder / "record.json").read_text())
    assert FILE in record["files"]
    assert (folder / FILE).read_bytes() == proved.proof.certificate


@pytest.mark.slow
def test_the_command_proves_and_checks(run, tmp_path):
    study = tmp_path / "study.toml"
    study.write_text(
        "[constraints]\nradius_ratio = { max = 1.2 }\nleg_clearance = { min = 0.01 }\n[solver]\nstarts = 4\n"
    )
    folder = tmp_path / "run"
    status, out, _ = run(f"optimize {study} --certify --no-figures --out {folder}")
    assert status == 0
    words = " ".join(out.split())
    assert "Proved: no machine of this class has a condition number below 4.09165066" in words
    assert "The proof does without leg_clearance" in words
    assert FILE in words


def test_a_small_certificate_is_checked(run, tmp_path):
    proof = nd.prove_optimum(PAPER, BEST, gap=0.3)
    path = proof.save(tmp_path / "small")
    verdict = nd.check_certificate(path)
    assert verdict.proved
    assert verdict.words.startswith("no design of this study has a condition number below 2.6338613550")
    status, words, _ = run(f"check {path}")
    assert status == 0
    assert "study of the certificate:\n  hexagonal designs with 0 < zs < zp" in words
    assert "  a1 from 0 to 60\n" in words
    assert "  radius_ratio from 0 to 2\n" in words
    assert "  lengths in the study's unit, which a certificate does not name\n" in words
    head, body = path.read_bytes().split(b"\n", 2)[:2], path.read_bytes().split(b"\n", 2)[2]
    assert head[1] == f"checksum {zlib.crc32(body):x}".encode()


def interrupt(*_):
    signal.raise_signal(signal.SIGINT)


def test_the_end_of_the_time_is_no_interruption():
    assert not nd.prove_optimum(PAPER, BEST, time_limit=1e-3).interrupted


def test_an_interrupted_proof_ends_the_command_as_one(run, tmp_path, monkeypatch):
    """The design found stays, with what is proved of it."""
    cut_short = nd.prove_optimum(PAPER, BEST, progress=interrupt)
    assert OptimumProof.from_dict(cut_short.to_dict()) == cut_short
    monkeypatch.setattr(import_module("ninedof.optimize.optimize"), "prove", lambda *_, **__: cut_short)
    study = tmp_path / "study.toml"
    study.write_text("[constraints]\nradius_ratio = { max = 2.0 }\n[solver]\nstarts = 2\n")
    status, out, _ = run(f"optimize {study} --certify --no-figures --out {tmp_path / 'run'}")
    assert status == 130
    assert "the search was interrupted before" in " ".join(out.split())
    assert nd.load(tmp_path / "run").proof.interrupted
    assert not (tmp_path / "run" / FILE).exists()


def test_reading_a_certificate_is_reported_and_can_be_interrupted(tmp_path):
    path = nd.prove_optimum(PAPER, BEST, gap=0.3).save(tmp_path / "some")
    read = []
    assert nd.check_certificate(path, progress=lambda *report: read.append(report)).proved
    assert read
    assert sorted(read) == read
    assert all(0 < done <= total < path.stat().st_size for done, total, _ in read)
    with pytest.raises(KeyboardInterrupt):
        nd.check_certificate(path, progress=interrupt)
    with pytest.raises(ValueError, match="progress: got 3"):
        nd.check_certificate(path, progress=3)


@pytest.mark.skipif(not LONG, reason="ten seconds: NINEDOF_LONG=1")
def test_the_certificate_of_the_papers_problem_is_checked(proved, tmp_path):
    assert nd.check_certificate(proved.proof.save(tmp_path / "whole")).proved


@pytest.mark.slow
def test_the_report_no_longer_says_that_nothing_better_was_only_searched(proved):
    page = str(report_proof(proved, None))
    assert "Proved: no machine of this class has a condition number below 3.76265907859." in page
    assert "That no other design is better" not in page
    assert "hexagonal plates" not in page  # the weaker bound of long searches
    page = str(report_proof(dataclasses.replace(proved, proof=None), None))
    assert "That no other design is better" in page


def read_paper(path, most):
    """Target, first box and tree of a certificate of the paper's problem, zp as far as `most`."""
    words, tree = balls.parts(path)
    target = float.fromhex(next(value for key, value in (w[:2] for w in words if len(w) == 2) if key == "target"))
    u = (0.05 / (target * 60.0), 60.0)  # lemma 9, in doubles
    x = (u[0] / 60.0, 2.0)
    root = [u, x, (0.05 / 60.0, most / u[0]), None, (0.5 * x[0], math.tan(math.pi / 6.0)), x, (1.0, 1.0)]
    longest = math.hypot(1.0 + x[1], root[balls.ETA][1])
    t = (max(0.05 / most, x[0] / (target * longest)), 1.0 - 1.0 / (target * longest))
    root[balls.O] = (t[0] / (1.0 - t[0]), t[1] / (1.0 - t[1]))
    return target, root, tree


@pytest.mark.slow
def test_leaves_of_the_certificate_hold_in_balls_too(proved, tmp_path):
    """A third reader, in another language and arithmetic: of boxes nearest to the optimum and of others."""
    path = proved.proof.save(tmp_path / "whole")
    target, root, tree = read_paper(path, 80.0)
    assert target == proved.lower_bound
    leaves = [leaf for leaf in balls.leaves(root, tree) if leaf[1] == 18]
    sizes = [sum(math.log(high / low) for low, high in box[:5]) for box, *_ in leaves]
    rng = np.random.default_rng(1)
    count = 400 if LONG else 10
    by_size = np.argsort(sizes)  # the largest fifth takes the plain formulas of the balls many cuts
    others = rng.choice(by_size[: len(by_size) * 4 // 5], count, replace=False)
    chosen = {*by_size[:count].tolist(), *others.tolist()}
    # Cuts differ in the last digits, and so do the boxes.
    assert all(balls.closed(leaves[k][0][:5], target * (1.0 - 1e-12), leaves[k][2]) for k in sorted(chosen))
    small = leaves[int(np.argmin(sizes))]
    assert not balls.closed(small[0][:5], target * 1.01, small[2], depth=3)


LOW_BEST = 4.048039517543512  # of the paper's problem with zp up to 2.5


@pytest.fixture(scope="module")
def low():
    study = dataclasses.replace(PAPER, variables=dict(PAPER.variables) | {"zp": (0.05, 2.5)})
    return nd.prove_optimum(study, LOW_BEST, gap=1e-8)


@pytest.mark.slow
def test_leaves_with_a_weight_of_a_size_hold_in_balls_too(low, tmp_path):
    assert low.complete
    path = low.save(tmp_path / "low")
    assert nd.check_certificate(path).proved
    target, root, tree = read_paper(path, 2.5)
    leaves = [leaf for leaf in balls.leaves(root, tree) if leaf[1] == 19]
    assert any(limits[3] > 0.0 for *_, limits in leaves)
    small = sorted(leaves, key=lambda leaf: sum(math.log(high / low) for low, high in leaf[0][:5]))
    radius = (0.0, 60.0)
    bounds = [radius, (0.05, 2.5), (0.05, 80.0)]
    count = 200 if LONG else 10
    for box, _, weights, limits in small[:count] + small[count : len(small) // 2 : len(small) // count]:
        assert balls.closed(box[:5], target * (1.0 - 1e-12), weights, limits=limits, bounds=bounds)
    box, _, weights, limits = next(leaf for leaf in small if leaf[3][3] > 0.0)
    higher = [radius, (0.05, 2.6), (0.05, 80.0)]
    assert not balls.closed(box[:5], target, weights, depth=3, limits=limits, bounds=higher)
    assert not balls.closed(box[:5], target * 1.01, weights, depth=3, limits=limits, bounds=bounds)


# Plates so flat that a condition number below the target is excluded before any box is looked at.
FAR = {"a1": (3.0, 3.001), "a2": (0.0, 0.1), "b1": (3.0, 3.01), "b2": (0.0, 0.1), "theta_z": (0.0, 0.01)}
# The search finds designs of its domain of which no sides exist, far below the best design.
LOOSE = {"a1": (0.0, 3.0), "a2": (0.0, 0.01), "b1": (0.0, 3.0), "b2": (0.0, 0.01), "theta_z": (0.0, 0.01)}


def hexagons(sides):
    heights = {"zp": (1.0, 9.0), "zs": (0.05, 9.0)}
    return nd.Study(family="hexagonal", variables=sides | heights, constraints={}, characteristic_length=1.0)


def test_a_domain_without_designs_below_the_target_is_a_proof(tmp_path):
    proof = nd.prove_optimum(hexagons(FAR), 3.0, gap=0.0)
    assert (proof.complete, proof.lower_bound, proof.boxes) == (True, 3.0, 0)
    verdict = nd.check_certificate(proof.save(tmp_path / "empty"))
    assert (verdict.proved, verdict.words) == (True, "no design of this study has a condition number below 3")
    # The same tree for a target that designs reach.
    lines, tree = tree_parts((tmp_path / "empty").read_bytes())
    forged = [line.replace("target 0x1.8p+1", "target 0x1p+7") for line in lines]
    assert forged != lines
    assert not verdict_of(sealed_tree(forged, tree), tmp_path).proved


@pytest.mark.parametrize("sides", [FAR, LOOSE])
def test_a_proof_after_the_optimization_never_loses_its_result(sides):
    result = nd.optimize(hexagons(sides), starts=8, certify=True)
    assert 1.0 <= result.lower_bound <= result.condition_number


def test_the_words_of_the_checker_never_round_up(tmp_path):
    for target in (3.0246913578024692, 2.0 - 1e-15, 3.5):
        proof = nd.prove_optimum(
            hexagons({"a1": 0.0, "a2": 6.0, "b1": 3.0, "b2": 0.0, "theta_z": 0.0}), target, gap=0.0
        )
        verdict = nd.check_certificate(proof.save(tmp_path / "small"))
        assert verdict.proved
        bound = Fraction(verdict.words.rsplit(" ", 1)[1])
        assert Fraction(target) * (1 - Fraction(2, 10**14)) < bound <= Fraction(target)


def test_two_limits_of_one_kind_are_checked(tmp_path):
    limits = {"radius_ratio": (None, 2.0), "leg_ratio": [{"max": 2.0}, {"max": 1.8, "at": "neutral"}]}
    proof = nd.prove_optimum(dataclasses.replace(PAPER, constraints=limits), 2.0, gap=0.0)
    assert nd.check_certificate(proof.save(tmp_path / "two")).proved


def test_boxes_that_touch_the_bounds_at_a_corner_are_checked(tmp_path):
    # Products of geometric means meet the narrow bounds to rounding, where the search and the checker may differ.
    variables = {
        "base_external_radius": (3938.618814702605, 3938.6418147026047),
        "base_internal_radius": (5462.390091494856, 5485.390091494856),
        "base_internal_angle": -1.0590961864354336,
        "platform_external_radius": (500.0, 8000.0),
        "platform_external_angle": (-1.7891466847022524, -1.4691460500400428),
        "platform_internal_radius": (2522.908016806041, 3272.908016806041),
        "platform_internal_angle": (1.0701514757105077, 1.2583832474555643),
        "zp": (500.0, 6535.3690507547735),
        "zs": 3781.535996793496,
    }
    limits = {"radius_ratio": (None, 1.3849281319109614), "leg_ratio": (None, 2.4616297882496605)}
    study = nd.Study(family="symmetric", variables=variables, constraints=limits, characteristic_length=700.0)
    for target in (3.71559214862, 4.64449018577, 6.50228626008):
        proof = nd.prove_optimum(study, target, gap=0.0)
        assert proof.complete
        assert nd.check_certificate(proof.save(tmp_path / "touching")).proved


RADII = [f"{plate}_{joints}_radius" for plate in ("base", "platform") for joints in ("external", "internal")]


@pytest.mark.slow
def test_what_the_search_proves_of_symmetric_studies_is_checked(tmp_path):
    """Boxes are wide at such gaps: the ranges of the checker must not be wider than those of the search."""
    rng = np.random.default_rng(7)
    for _ in range(10):
        legs, radii, top = rng.uniform(1.6, 4.0), rng.uniform(1.2, 3.0), 10.0 ** rng.uniform(0.3, 1.3)
        sizes = dict.fromkeys(RADII, (0.05 * top, top)) | {"zp": (0.05 * top, 2.0 * top), "zs": (0.02 * top, 2.0 * top)}
        limits = {"radius_ratio": (None, radii), "leg_ratio": (None, legs)}
        study = nd.Study("symmetric", variables=sizes, constraints=limits)
        best = nd.optimize(study, starts=8).condition_number
        gap = next(gap for gap in (0.6, 0.5, 0.4) if best * (1.0 - gap) > 1.02)
        proof = nd.prove_optimum(study, best, gap=gap)
        assert proof.complete
        found = nd.check_certificate(proof.save(tmp_path / "some"))
        assert found.proved, (legs, radii, top, found.words)


def test_an_earlier_bound_that_is_higher_keeps_its_file():
    study = nd.Study.paper()
    earlier = nd.prove_optimum(study, 3.7626590785960, gap=0.2)
    wider = prove(study, 3.7626590785960, 0.5, None, 1, None, earlier)
    assert (wider.lower_bound, wider.certificate) == (earlier.lower_bound, earlier.certificate)
    narrower = prove(study, 3.7626590785960, 0.1, None, 1, None, earlier)
    assert narrower.lower_bound > earlier.lower_bound
    assert narrower.certificate != earlier.certificate
