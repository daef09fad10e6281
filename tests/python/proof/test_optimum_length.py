"""Optima at the neutral pose with bounds that begin at 0, and with every kind of characteristic length."""

import math
from dataclasses import replace

import numpy as np
import pytest

import ninedof as nd
from ninedof.proof.optimum_steps import ways_of

PAPER = nd.Study.paper()
SMALLER = replace(PAPER, variables=dict(PAPER.variables) | {"a1": 0.0, "b2": 0.0})  # the same optimum, in less time
FLAT = dict.fromkeys(("base_internal_angle", "platform_internal_angle"), 0.0)
INTERNAL = {"base_internal_radius": (0.0, 2.0), "platform_internal_radius": (0.0, 2.0)}
PLATES = nd.Study(
    "symmetric",
    variables=FLAT
    | INTERNAL
    | {"base_external_radius": (3.8, 3.9), "platform_external_radius": (1.9, 2.0), "platform_external_angle": -0.25}
    | {"zp": (1.0, 1.1), "zs": (0.0, 1.1)},
)
STUDIES = {
    "zp from 0": replace(SMALLER, variables=dict(SMALLER.variables) | {"zp": (0.0, 80.0), "zs": (0.0, 80.0)}),
    "free": replace(SMALLER, characteristic_length=(0.5, 3.0)),
    "optimal": replace(SMALLER, characteristic_length="optimal"),
    "natural": replace(SMALLER, characteristic_length="natural"),
    "mean_leg": replace(SMALLER, characteristic_length="mean_leg"),
    "platform_radius": replace(SMALLER, characteristic_length="platform_radius"),
    "internal radii from 0": PLATES,
    "internal radii from 0, natural": replace(PLATES, characteristic_length="natural"),
    "internal radii from 0, mean_leg": replace(PLATES, characteristic_length="mean_leg"),
    "internal radii from 0, platform_radius": replace(PLATES, characteristic_length="platform_radius"),
}


@pytest.mark.parametrize("name", STUDIES)
def test_the_best_design_and_one_better_by_1e_10(name, tmp_path):
    """What lies below the best design is proved, and what lies above it is not."""
    study = STUDIES[name]
    best = nd.optimize(study, starts=16).condition_number
    proof = nd.prove_optimum(study, best, gap=1e-10 if study.family == "hexagonal" else 1e-4)
    assert proof.complete
    assert proof.left_out == ()
    found = nd.check_certificate(proof.save(tmp_path / "optimum.certificate"))
    assert found.proved, found.words
    assert float(found.words.split(" below ")[1]) == pytest.approx(proof.lower_bound, rel=1e-14)
    above = nd.prove_optimum(study, best * (1.0 + 1e-10), gap=0.0, time_limit=5.0)
    assert not above.complete
    assert above.lower_bound <= best


def test_the_paper_s_optimum_with_the_best_length_is_the_same():
    """Sizes are free: the length only sets their scale."""
    lengths = [(0.5, 3.0), (2.0, 2.0), "optimal"]
    best = [nd.optimize(replace(PAPER, characteristic_length=length), starts=16).condition_number for length in lengths]
    np.testing.assert_allclose(best, 3.7626590785960, rtol=1e-12)


def test_limits_that_only_designs_too_low_keep_are_a_proof(tmp_path):
    """All have zp up to 0.0002, which leaves no condition number below 4."""
    variables = dict(PAPER.variables) | {"zp": (0.0, 80.0), "zs": (0.0, 1e-4)}
    study = replace(PAPER, variables=variables, constraints={"zs_fraction": (0.5, None)})
    proof = nd.prove_optimum(study, 4.0, gap=0.0)
    assert proof.complete
    assert nd.check_certificate(proof.save(tmp_path / "optimum.certificate")).proved


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"variables": dict(PLATES.variables) | {"zp": (0.0, 1.1)}}, "or one of both radii of internal joints"),
        (
            {"variables": dict(PLATES.variables) | {"zp": (0.0, 1.1)}, "characteristic_length": "mean_leg"},
            "or a number as the characteristic length",
        ),
        (
            {
                "variables": dict(PLATES.variables) | {"platform_external_radius": (0.0, 2.0)},
                "characteristic_length": "optimal",
            },
            "a positive lower bound of the radii of platform joints, or a number",
        ),
        ({"variables": dict(PLATES.variables) | {"zp": (1.0, math.inf)}}, "a positive and finite upper bound"),
    ],
)
def test_what_has_no_reduction_is_refused(change, words):
    with pytest.raises(ValueError, match=words):
        ways_of(replace(PLATES, **change))


def test_the_checker_says_what_the_length_is(tmp_path):
    for name, words in (
        ("natural", 'characteristic length "natural"'),
        ("free", "characteristic length from 0.5 to 3"),
    ):
        proof = nd.prove_optimum(STUDIES[name], 2.0, gap=0.0)
        assert nd.check_certificate(proof.save(tmp_path / "c")).study[1] == words
