"""The figure of a motion along a trajectory."""

import numpy as np
import pytest

from ninedof import plot

TIME = np.linspace(0.0, 2.0, 5001)
LENGTHS = 3.0 + 0.1 * np.sin(TIME[:, None] + np.arange(9))
KAPPA = 4.0 + np.cos(TIME)


def test_three_panels_of_legs_and_one_of_the_condition_number():
    figure = plot.motion(TIME, LENGTHS, KAPPA, (np.zeros(9), np.full(9, 3.05)), unit="mm")
    assert [axes.get_title(loc="left") for axes in figure.axes] == [
        *("external legs", "upper internal legs", "lower internal legs"),
        "",
    ]
    assert figure.axes[3].get_ylabel() == "condition number"
    for k, axes in enumerate(figure.axes[:3]):
        curves = [line for line in axes.get_lines() if len(line.get_xdata()) > 2]
        assert len(curves) == 3
        assert curves[0].get_ydata()[-1] == LENGTHS[-1, 3 * k]
        assert len(curves[0].get_xdata()) <= 4001
    assert figure.axes[0].get_ylabel() == "length (mm)"


@pytest.mark.parametrize(("unit", "words"), [("mm", "time (s)"), ("", "time (in the unit of the path)")])
def test_the_axis_of_time_says_its_unit(unit, words):
    figure = plot.motion(TIME, LENGTHS, KAPPA, unit=unit, margins={"cone": 0.1 + TIME})
    assert {axes.get_xlabel() for axes in figure.axes} == {words}


def test_a_singular_pose_and_one_leg_at_rest(tmp_path):
    kappa = KAPPA.copy()
    kappa[100] = np.inf
    kappa[401] = 1e6  # a narrow peak is not left out
    figure = plot.motion(TIME, np.full((5001, 9), 2.0), kappa)
    assert figure.axes[3].get_yscale() == "log"
    assert len(plot.save(figure, tmp_path, "motion")) == 3


def test_wrong_shapes():
    with pytest.raises(ValueError, match="got shape"):
        plot.motion(TIME, LENGTHS[:, :8], KAPPA)
