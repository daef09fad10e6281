"""Limits of a study on the lengths of single legs."""

import ninedof as nd


def test_limits_of_legs_by_kind_and_unit():
    study = nd.Study(
        constraints={
            "leg_length": (1.0, 9.0),
            "upper_length": {"max": 2.0, "of": "zp"},
            "lower_length": [{"min": 1.5}, {"max": 2.5, "at": "neutral"}],
            "stroke_ratio": (None, 1.6),
            "radius_ratio": (None, 2.0),
        }
    )
    low, high = study.leg_limits(nd.Configuration.neutral(4.0, 2.0))
    assert low.tolist() == [1.0] * 6 + [1.5] * 3
    assert high.tolist() == [9.0] * 3 + [8.0] * 3 + [9.0] * 3
