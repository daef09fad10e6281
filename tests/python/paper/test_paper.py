"""The paper's numbers: the figures of the theory notes, found again through the public names."""

import pytest

import ninedof as nd
from ninedof.paper import published
from ninedof.paper.comparison import compare
from ninedof.paper.verdicts import verdicts


@pytest.fixture(scope="module")
def comparison():
    return compare()


def test_published_number_is_reproduced(comparison):
    assert comparison.crossings == pytest.approx((2.3745, 2.5110), abs=5e-5)
    assert comparison.reproduced.condition_number == pytest.approx(3.9110, abs=1e-9)
    assert comparison.reproduced.radius_ratio == pytest.approx(2.0)
    assert comparison.best_zs.condition_number == pytest.approx(3.9070663452, abs=1e-9)


def test_better_designs(comparison):
    assert comparison.as_printed == pytest.approx(6.1902, abs=5e-5)
    assert comparison.same_base_and_height.condition_number == pytest.approx(3.7866, abs=5e-5)
    assert comparison.same_base_and_height.variables["b1"] == pytest.approx(2.3434, abs=5e-5)
    assert comparison.same_class.condition_number == pytest.approx(3.762659078596, rel=1e-11)
    gains = [row.gain_percent for row in comparison.rows()]
    assert gains == sorted(gains)


def test_rows_agree_with_the_general_path(comparison):
    for row in comparison.rows():
        assert row.condition_number == nd.condition_number(row.geometry, row.configuration)
        assert nd.leg_lengths(row.geometry, row.configuration)[[0, 3, 6]].tolist() == list(row.leg_lengths.values())


def test_why_says_it_in_two_sentences(comparison):
    assert comparison.why.count(". ") == 1, comparison.why
    assert "-0.305" in comparison.why
    assert "3.7866" in comparison.why


def test_eq_7_fails_in_the_twist_alone():
    slopes = published.displacement_slopes(published.published_zs()[2])
    assert abs(slopes.pop("theta_z") + 0.52) < 1e-3
    assert max(map(abs, slopes.values())) < 1e-6


def test_verdicts_hold_the_known_figures():
    text = " ".join(v.ours + " " + v.verdict for v in verdicts())
    for figure in ("3.7866", "3.5503", "3.762659", "3.749827", "6.1902", "3.8819", "2.9062", "unbounded"):
        assert figure in text
