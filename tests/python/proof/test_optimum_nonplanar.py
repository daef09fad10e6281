"""prove_optimum of the family "symmetric_nonplanar" at the neutral pose."""

import signal
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from forged import sealed_tree, spelled, tree_parts, verdict_of

import ninedof as nd
from ninedof.proof.optimum_steps import ways_of

STUDY = nd.Study.load(Path(__file__).parents[3] / "examples" / "09_near_isotropic.toml")
BEST = 1.4020429319  # what it prints
GAP = 0.2


@pytest.fixture(scope="module")
def proof():
    return nd.prove_optimum(STUDY, BEST, gap=GAP)


@pytest.mark.slow
def test_the_optimum_of_the_example_has_a_bound(proof):
    assert proof.complete
    assert proof.lower_bound == BEST * (1.0 - GAP)
    assert proof.left_out == ("joint_spacing", "leg_clearance")
    assert nd.OptimumProof.from_dict(proof.to_dict()) == proof
    assert replace(nd.prove_optimum(STUDY, BEST, gap=GAP, threads=1), seconds=0.0) == replace(proof, seconds=0.0)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(12))
def test_nothing_is_proved_above_a_design_that_is_known(seed, tmp_path):
    """Ranges and limits about a design; in other units, with O on any side of its internal joints."""
    rng = np.random.default_rng(seed)
    length = float(10.0 ** rng.uniform(-2.0, 3.0))
    below, above = rng.uniform(0.0, 1.0, 2)
    x = {
        "base_external_radius": rng.uniform(1.0, 5.0),
        "base_internal_radius": rng.uniform(0.2, 3.0),
        "platform_external_radius": rng.uniform(0.8, 3.0),
        "platform_internal_radius": rng.uniform(0.2, 3.0),
        "zp": rng.uniform(0.5, 4.0),
        "base_external_height": rng.uniform(-2.0, 2.0),
        "platform_external_height": rng.uniform(-2.0, 2.0),
    }
    x["zs"] = x["zp"] * rng.uniform(0.1, 0.9)
    drop = x["zp"] - x["zs"]
    x["base_internal_height"] = x["zs"] + rng.uniform(0.1, 2.0) * (1.0 if below < 0.3 else -1.0)
    x["platform_internal_height"] = -drop + rng.uniform(0.1, 2.0) * (-1.0 if above < 0.3 else 1.0)
    angles = {name: float(rng.uniform(-3.0, 3.0)) for name in ("base_internal_angle", "platform_internal_angle")}
    angles["platform_external_angle"] = float(rng.uniform(0.2, 1.2))  # left out of the proof
    low, high = rng.uniform(0.0, 0.05, 2)
    variables = {
        name: (value * length - low * abs(value) * length, value * length + high * abs(value) * length)
        for name, value in x.items()
    }
    free = replace(STUDY, variables=variables | angles, constraints={}, characteristic_length=length)
    design = {name: float(value * length) for name, value in x.items()}
    kappa = free.evaluate(design).condition_number
    turn = angles["platform_external_angle"]
    foot = np.array([x["base_external_radius"], 0.0, x["base_external_height"]])
    head = x["platform_external_radius"] * np.array([np.cos(turn), np.sin(turn), 0.0])
    head[2] = x["zp"] + x["platform_external_height"]
    legs = (
        np.linalg.norm(head - foot),
        np.hypot(x["platform_internal_radius"], x["platform_internal_height"] + drop),
        np.hypot(x["base_internal_radius"], x["zs"] - x["base_internal_height"]),
    )
    limits = {
        "zs_fraction": (0.999 * x["zs"] / x["zp"], 1.001 * x["zs"] / x["zp"]),
        "leg_ratio": (None, float(1.001 * max(legs) / min(legs))),
        "leg_length": (float(0.999 * min(legs) * length), float(1.001 * max(legs) * length)),
        "external_length": {"max": float(1.001 * legs[0] / x["zp"]), "of": "zp"},
    }
    study = replace(free, constraints=limits)
    proof = nd.prove_optimum(study, kappa * 1.0001, gap=0.0, time_limit=1.0)
    assert not proof.complete
    assert proof.lower_bound <= kappa
    assert proof.better is None or proof.better < kappa * 1.0001
    assert not proof.certificate or verdict_of(proof.certificate, tmp_path).proved


@pytest.mark.slow
def test_the_certificate_is_replayed(proof, tmp_path):
    found = verdict_of(proof.certificate, tmp_path)
    assert found.proved, found.words
    assert found.words.startswith("no design of this study has a condition number below 1.1216343455")
    assert "joint_height from 0 to 0.3 of radius" in found.study
    assert "without the limit leg_clearance" in found.study
    assert found.recut < 0.1 * found.boxes
    assert len(proof.certificate) < 16 * proof.boxes
    lines, tree = tree_parts(proof.certificate)
    assert sealed_tree(lines, tree) == proof.certificate


def study_of(lines):
    """The study of a head, at its best in the searched ranges."""
    words = [line.split(" ") for line in lines]
    value = float.fromhex
    ends = {w[1]: (value(w[2]), value(w[3])) for w in words if w[0] == "variable"}
    limits = {}
    for w in words:
        if w[0] != "limit":
            continue
        limit = {"min": value(w[2])} if value(w[2]) > 0.0 else {}
        limit |= {"max": value(w[3])} if np.isfinite(value(w[3])) else {}
        limits[w[1]] = limit | ({"of": w[4]} if len(w) > 4 else {})
    length = value(next(w[1] for w in words if w[0] == "characteristic_length"))
    target = value(next(w[1] for w in words if w[0] == "target"))
    variables = {name: (low, high) if low < high else low for name, (low, high) in ends.items()}
    return nd.Study("symmetric_nonplanar", variables, limits, characteristic_length=length, starts=8), target


@pytest.mark.slow
def test_what_is_proved_of_a_changed_head_is_true(proof, tmp_path):
    """A number of the head, sealed anew: what counts as proved is held against an optimization of the new study."""
    lines, tree = tree_parts(proof.certificate)
    rng, counts = np.random.default_rng(8), {True: 0, False: 0}
    numbers = [(n, k) for n, line in enumerate(lines) for k, w in enumerate(line.split(" ")) if "0x" in w]
    for n, k in (numbers[i] for i in rng.integers(len(numbers), size=30)):
        words = lines[n].split(" ")
        words[k] = spelled(float.fromhex(words[k]) * float(np.exp(rng.normal(0.0, 0.4))))
        changed = [*lines[:n], " ".join(words), *lines[n + 1 :]]
        found = verdict_of(sealed_tree(changed, tree), tmp_path)
        counts[found.proved] += 1
        if found.proved:
            study, target = study_of(changed)
            best = nd.optimize(study)
            assert not best.candidates or best.condition_number >= target, changed[n]
    assert min(counts.values()) > 2


@pytest.fixture(scope="module")
def far():
    """The certificate of a bound far below the best design: a moment."""
    return nd.prove_optimum(STUDY, 1.05, gap=0.0).certificate


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("zp 0x", "zz 0x", "variable zp is missing"),
        ("limit joint_height 0x0p+0 0x1.3333333333333p-2 radius", "limit joint_height 0x0p+0 0x1p-2 zp", "no unit"),
        ("limit joint_height 0x0p+0 0x1.3333333333333p-2 radius", "limit joint_height 0x0p+0 0x1p-2 m", "has no unit"),
        ("limit leg_ratio", "limit hope", "knows no limit hope"),
        ("target 0x1.0cccccccccccdp+0", "target 0x1.f4p+10", "target is not from 1 to 1000"),
    ],
)
def test_a_head_that_the_theory_does_not_reach_is_refused(far, old, new, words, tmp_path):
    lines, tree = tree_parts(far)
    assert verdict_of(sealed_tree(lines, tree), tmp_path).proved
    changed = "\n".join(lines).replace(old, new).split("\n")
    assert changed != lines
    found = verdict_of(sealed_tree(changed, tree), tmp_path)
    assert not found.proved
    assert words in found.words


def test_the_last_bound_in_time_has_a_file(tmp_path):
    proof = nd.prove_optimum(STUDY, BEST, gap=1e-7, time_limit=0.5)
    assert not proof.complete
    if proof.certificate:
        assert verdict_of(proof.certificate, tmp_path).proved
        assert (b"target " + spelled(proof.lower_bound).encode() + b"\n") in proof.certificate
    assert bool(proof.certificate) == (proof.lower_bound > 1.0)


def test_flat_triples_are_planar():
    flat = dict.fromkeys((name for name in STUDY.variables if name.endswith("_height")), 0.0)
    study = replace(STUDY, variables=dict(STUDY.variables) | flat, constraints={"radius_ratio": (None, 2.0)})
    proof = nd.prove_optimum(study, 2.0, gap=0.4, time_limit=200.0)
    assert proof.complete
    assert proof.certificate.startswith(b"ninedof certificate 1")
    assert b"family symmetric\n" in proof.certificate


def test_sizes_may_begin_at_0(proof):
    """No design is lost, and the best one is the same: the bound neither falls nor comes above it."""
    sizes = {name: (0.0, high) for name, (low, high) in STUDY.variables.items() if low > 0.0 and "radius" in name}
    sizes |= {"zp": (0.0, STUDY.variables["zp"][1])}
    assert len(sizes) == 5
    wider = replace(STUDY, variables=dict(STUDY.variables) | sizes)
    found = nd.prove_optimum(wider, BEST, gap=GAP)
    assert found.complete
    assert found.lower_bound == proof.lower_bound
    assert nd.prove_optimum(wider, 1.01 * BEST, gap=0.0, time_limit=0.2).lower_bound < BEST


def test_time_and_ctrl_c_leave_what_is_proved():
    assert not nd.prove_optimum(STUDY, BEST, time_limit=1e-9).complete
    proof = nd.prove_optimum(STUDY, BEST, gap=0.05, progress=lambda *_: signal.raise_signal(signal.SIGINT))
    assert proof.interrupted
    assert not proof.complete
    assert proof.lower_bound == 1.0


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"characteristic_length": "optimal"}, "characteristic_length"),
        ({"characteristic_length": (0.5, 2.0)}, "characteristic_length"),
        ({"variables": dict(STUDY.variables) | {"base_internal_radius": (0.0, np.inf)}}, "base_internal_radius"),
        ({"objective": {"index": "speed"}}, "objective"),
    ],
)
def test_what_the_theory_does_not_reach_is_refused(change, words):
    with pytest.raises(ValueError, match=words):
        ways_of(replace(STUDY, **change))


def test_what_is_left_out_is_named():
    study = replace(STUDY, variables=dict(STUDY.variables) | {"platform_external_angle": (0.0, 1.0)})
    assert ways_of(study).left_out == ("platform_external_angle", "joint_spacing", "leg_clearance")
    study = replace(STUDY, constraints={"leg_ratio": (1.5, 2.5), "footprint": (1.0, 4.0), "height": (1.0, 3.0)})
    assert ways_of(study).left_out == ("leg_ratio.min", "footprint.min")
