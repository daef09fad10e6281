"""Optima over poses and machines as files: replayed by the checker and, in balls, by another one; changed, refused."""

import numpy as np
import pytest
import set_in_balls
from forged import line_of, lines_of, sealed, spelled, verdict_of, with_word

import ninedof as nd

SIZES = {"a1": 0.0, "a2": (2.0, 10.0), "b1": (1.0, 5.0), "b2": 0.0, "zp": 5.0, "zs": 3.0, "theta_z": 0.0}
POSES = [{"position": (0.2, 0.0, 0.1)}, {"rotation": (0.1, 0.0, 0.05)}]


def over(*box):
    limits = {"stroke_ratio": (None, 1.5)}
    return nd.Study(variables=SIZES, constraints=limits, objective={"region": {"box": box}}, starts=4)


STUDY = over(0.2, 0.1, 0.1)


@pytest.fixture(scope="module")
def result():
    return nd.optimize(STUDY)


@pytest.fixture
def verdict(tmp_path):
    return lambda data: verdict_of(data, tmp_path)


@pytest.fixture(scope="module")
def optimum():
    """The proof by boxes of designs: in a wide region the class at the neutral pose does not reach the gap."""
    study = over(0.8, 0.6, 0.4)
    proof = nd.prove_optimum(study, nd.optimize(study).condition_number, gap=0.05)
    assert not proof.left_out
    return proof


@pytest.fixture(scope="module")
def machine(result, tmp_path_factory):
    path = tmp_path_factory.mktemp("machine") / "machine.certificate"
    return result.save_certificate(result.certify(gap=0.2), path).read_bytes()


@pytest.mark.slow(sanitized=True)
def test_an_optimum_over_a_region_is_replayed_by_both_checkers(optimum, verdict):
    found = verdict(optimum.certificate)
    assert found.proved
    assert found.words.startswith("no design of this study has a condition number below ")
    assert found.words.endswith(" over its region")
    said = float(found.words.split(" ")[-4])
    assert optimum.lower_bound * (1.0 - 1e-13) < said <= optimum.lower_bound
    assert set_in_balls.check(optimum.certificate) == "proved"


def test_the_last_gap_that_was_proved_has_a_file(result, verdict):
    proof = nd.prove_optimum(STUDY, 1.05 * result.condition_number, gap=1e-3, time_limit=10.0)
    assert not proof.complete  # there is a better design
    assert proof.lower_bound > 1.0
    assert verdict(proof.certificate).proved


def test_no_better_bound_is_proved_by_the_same_boxes(optimum, verdict):
    lines = lines_of(optimum.certificate)
    n = line_of(lines, "limit condition_number")
    forged = sealed(with_word(lines, n, 3, spelled(float.fromhex(lines[n].split(" ")[3]) * 1.1)))
    assert not verdict(forged).proved


def test_a_machine_is_replayed_by_both_checkers(machine, verdict):
    found = verdict(machine)
    assert found.proved
    assert found.words == "the machine keeps every limit at every pose of the region"
    assert set_in_balls.check(machine) == "proved"


@pytest.mark.parametrize(("name", "factor"), [("condition_number", 0.75)])
def test_a_machine_with_a_tighter_limit_is_refused(name, factor, machine, verdict):
    lines = lines_of(machine)
    n = line_of(lines, f"limit {name}")
    forged = sealed(with_word(lines, n, 3, spelled(float.fromhex(lines[n].split(" ")[3]) * factor)))
    found = verdict(forged)
    assert not found.proved
    assert f"breaks {name}" in found.words


def test_what_a_file_cannot_say_is_named(result, tmp_path):
    path = tmp_path / "machine.certificate"
    with pytest.raises(ValueError, match="tolerance: got"):
        result.save_certificate(result.certify(gap=0.5, tolerance=1e-3), path)
    with pytest.raises(ValueError, match="expected one in which every limit is proved"):
        result.save_certificate(result.certify(gap=0.5, condition_number=1.1), path)
    assert not path.exists()


@pytest.mark.slow(sanitized=True)
def test_digits_edited_at_random_are_refused_by_both_or_by_none_that_matters(verdict):
    """A digit of a number, sealed anew: where one checker proves the file, the other does."""
    study = nd.Study(variables=SIZES | {"b1": 3.0}, objective={"poses": POSES}, starts=4)
    best = nd.optimize(study).condition_number
    lines = lines_of(nd.prove_optimum(study, best, gap=0.1).certificate)
    rng, agreed = np.random.default_rng(5), {True: 0, False: 0}
    places = [(n, k) for n, line in enumerate(lines) for k, c in enumerate(line) if "0x" in line[:k] and c.isdigit()]
    for n, k in (places[i] for i in rng.choice(len(places), 40, replace=False)):
        digit = str((int(lines[n][k]) + int(rng.integers(1, 9))) % 10)
        forged = sealed([*lines[:n], lines[n][:k] + digit + lines[n][k + 1 :], *lines[n + 1 :]])
        ours = verdict(forged)
        theirs = set_in_balls.check(forged)
        if ours.proved:
            assert theirs == "proved", (lines[n], ours.words)
        agreed[ours.proved] += 1
    assert agreed[False] > 3
