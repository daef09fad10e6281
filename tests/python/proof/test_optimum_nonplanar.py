"""prove_optimum of the family "symmetric_nonplanar" at the neutral pose."""

import signal
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import ninedof as nd
from ninedof.proof.optimum_steps import ways_of

STUDY = nd.Study.load(Path(__file__).parents[3] / "examples" / "09_near_isotropic.toml")
BEST = 1.4020429319  # what it prints
GAP = 0.2


@pytest.fixture(scope="module")
def proof():
    return nd.prove_optimum(STUDY, BEST, gap=GAP)


@pytest.mark.slow(sanitized=True)
def test_the_optimum_of_the_example_has_a_bound(proof):
    assert proof.complete
    assert proof.lower_bound == BEST * (1.0 - GAP)
    assert proof.left_out == ("joint_spacing", "leg_clearance")
    assert proof.certificate == b""
    assert nd.OptimumProof.from_dict(proof.to_dict()) == proof
    assert replace(nd.prove_optimum(STUDY, BEST, gap=GAP, threads=1), seconds=0.0) == replace(proof, seconds=0.0)


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("seed", range(12))
def test_nothing_is_proved_above_a_design_that_is_known(seed):
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


def test_designs_drawn_at_random_are_not_below_the_bound(proof):
    """Near the best design, with the limits of the study kept: none is below what is proved."""
    best = nd.optimize(STUDY, starts=16).variables
    rng, kept = np.random.default_rng(3), 0
    for n in range(600):
        x = {}
        for name, ends in STUDY.variables.items():
            low, high = ends
            size = (0.02, 0.3, 2.0)[n % 3] * min(high - low, 2.0)
            x[name] = float(np.clip(best[name] + size * rng.uniform(-1.0, 1.0), low, high)) if np.isfinite(low) else 0.3
        point = STUDY.evaluate(x)
        inside = all(m >= 0.0 for name, m in point.margins.items() if name not in ("joint_spacing", "leg_clearance"))
        kept += inside
        assert not inside or point.condition_number >= proof.lower_bound
    assert kept > 5


def test_flat_triples_are_planar():
    flat = dict.fromkeys((name for name in STUDY.variables if name.endswith("_height")), 0.0)
    study = replace(STUDY, variables=dict(STUDY.variables) | flat, constraints={"radius_ratio": (None, 2.0)})
    proof = nd.prove_optimum(study, 2.0, gap=0.4, time_limit=20.0)
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
    assert nd.prove_optimum(wider, 1.01 * BEST, gap=0.0, time_limit=2.0).lower_bound < BEST


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
    assert ways_of(study).left_out == ("leg_ratio.min", "footprint")
