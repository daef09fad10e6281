"""Figures of curves: the condition number about a design, at poses and along a motion; the convergence of starts."""

import math
from dataclasses import replace

import numpy as np
import pytest
from figure_table import BOTH, COMPARED, DOWN, LONG, POSES, G, curves, followed, made, region
from matplotlib.collections import LineCollection
from matplotlib.colors import to_hex

import ninedof as nd
from ninedof import plot
from ninedof.plot import style

STUCK = [8.0, 5.0, 3.5, 3.5]


def assert_can_be_drawn(figure):
    """Every warning is an error, and no part is empty: what a file needs, at a third of its price."""
    figure.draw_without_rendering()
    assert np.isfinite(figure.get_tightbbox().get_points()).all()


def test_condition_curves_mark_points_and_crossings():
    figure = plot.condition_curves([curves(**COMPARED), curves()], unit="m")
    along_zs, along_theta, magnified = figure.axes
    assert along_zs.get_xlabel() == "zs, height of O (m)"
    own = [line for line in along_zs.lines if line.get_marker() in style.MARKS]
    assert [(line.get_xdata()[0], line.get_ydata()[0]) for line in own] == [(2.3745, 3.9110)] * 2
    assert list(magnified.get_xticks()) == [2.3745, 2.5110]
    assert list(magnified.get_yticks()) == [3.9110]
    assert "least 3.9071 at 2.4435" in [text.get_text() for text in magnified.texts]
    (tangent,) = [line for line in along_theta.lines if line.get_color() == style.INK]
    (x0, x1), (y0, y1) = tangent.get_data()
    assert (y1 - y0) / np.radians(x1 - x0) == pytest.approx(COMPARED["slope"])
    assert np.interp(0.0, [x0, x1], [y0, y1]) == pytest.approx(3.9110)
    assert any("not 0 as eq. (7)" in text.get_text() for text in along_theta.texts)
    assert len(plot.condition_curves([curves()]).axes) == 2


def test_curves_over_poses_have_the_neutral_one_beside_and_a_ground_where_a_limit_is_violated():
    figure = made("objective over poses")
    words = [text.get_text() for text in figure.legends[0].get_texts()]
    assert words == ["published: 3.9110", "at the neutral pose", "a limit is violated at one of these poses"]
    for axes, ends in zip(figure.axes, ((1.5, 1.5 + 2.0 * 169 / 399), (-20.0 + 0.5 * 51, 20.0)), strict=True):
        (ground,) = [one for one in axes.collections if to_hex(one.get_facecolor()[0]) == style.GRID.lower()]
        spans = ground.get_paths()[0].vertices[:, 0]
        assert [spans.min(), spans.max()] == pytest.approx(ends, abs=1e-9)
    (dashed,) = [line for line in figure.axes[0].lines if line.get_color() == style.MUTED]
    assert set(dashed.get_ydata()) == {3.8}
    assert [axes.get_title(loc="left") for axes in figure.axes] == ["along zs", "along theta_z"]


def test_the_legend_of_a_long_question_lies_in_the_figure():
    name = "worst condition number over the 20 poses that ruled the region"
    zs, theta, k = np.array([1.5, 2.0, 2.5]), np.array([-0.1, 0.0, 0.1]), [4.1, 4.0, 4.1]
    violated = [True, False, False], [True, False, False]
    design = plot.DesignCurves(name, zs, k, theta, k, (2.0, 0.0, 4.0), violated=violated, neutral=(k, k))
    figure = plot.condition_curves([design])
    figure.draw_without_rendering()
    box = figure.legends[0].get_window_extent()
    assert 0.0 <= box.x0 < box.x1 <= figure.bbox.width
    assert 0.0 <= box.y0 < box.y1 < figure.axes[0].xaxis.label.get_window_extent().y0


def test_a_design_that_limits_leave_no_room_is_said_to_be_allowed():
    zs, theta = np.array([2.0, 2.4, 2.400001, 3.0]), np.array([-0.1, 0.0, 0.1])
    violated = [True, False, True, True], [False, False, True]
    design = plot.DesignCurves("it", zs, 4.0 + zs, theta, 6.4 + theta, (2.4, 0.0, 6.4), violated=violated)
    titles = [axes.get_title(loc="left") for axes in plot.condition_curves([design]).axes]
    assert titles == ["along zs", "along theta_z"]
    close = np.array([2.399999, *zs[1:]])
    titles = [axes.get_title(loc="left") for axes in plot.condition_curves([replace(design, zs=close)]).axes]
    assert titles == ["along zs: kept at the mark alone", "along theta_z"]


def test_a_map_of_a_region_says_what_it_is_over_and_has_one_scale():
    figure, asked = made("region"), region()
    left, right = figure.axes[:2]
    assert left.get_title(loc="left") == "worst condition number\nover all heights and tilts"
    assert right.get_title(loc="left") == "least margin of the limits at a pose\nover all heights and tilts"
    for axes in (left, right):
        assert (axes.get_xlabel(), axes.get_ylabel()) == ("x (mm)", "y (mm)")
        assert axes.get_aspect() == 1.0
    words = [text.get_text() for text in figure.legends[0].get_texts()]
    assert words == [f"region of the study, worst {asked.worst:.4f}", "poses that ruled", "neutral pose"]
    outline, ruled = (line.get_xydata() for line in left.lines[:2])
    assert np.ptp(outline, axis=0) == pytest.approx([80.0, 60.0])
    assert len(ruled) == len(asked.ruled)
    assert made("region of turns").axes[0].get_xlabel() == "tilt about x (deg)"


def test_a_map_of_a_region_draws_no_noise_as_structure():
    """Margins that are the same to rounding have one colour, the lowest where they are 0."""
    asked = region()
    noise = 1e-9 * np.random.default_rng(1).uniform(-1.0, 1.0, asked.margin.shape)
    for level, low in ((0.0, 0.0), (0.43621, 43.0), (-0.1234, -13.0)):
        alike = replace(asked, margin=level + noise, compared={"stroke_ratio": 0.0002, "stroke": math.nan})
        figure = plot.region_map(alike)
        (filled,) = [one for one in figure.axes[1].collections if one.get_array() is not None and one.filled]
        assert sum(len(path.vertices) > 0 for path in filled.get_paths()) == 1
        assert filled.levels[[0, -1]] == pytest.approx([low, low + 1.0])
        says = f"{100.0 * level:.4g}"  # one colour says little: the words beside it say the values
        assert figure.axes[-1].get_ylabel() == f"least margin (%), {says} to {says}"
        assert figure.legends[0].get_title().get_text() == (
            "least margin without limits that compare poses: stroke ratio (0.02 % over the region), stroke"
        )


@pytest.mark.parametrize(
    ("along_zs", "point"), [([math.inf, 4.0, 5.0], 4.0), ([math.inf] * 3, math.inf), ([4.0] * 3, 4.0)]
)
def test_singular_parts_leave_a_gap(along_zs, point):
    design = plot.DesignCurves("d", [1.0, 2.0, 3.0], along_zs, [-0.1, 0.1], [4.5, math.inf], (2.0, 0.0, point))
    figure = plot.condition_curves([design])
    assert not np.any(np.isinf(figure.axes[0].lines[0].get_ydata()))
    assert all(np.all(np.isfinite(axes.get_ylim())) for axes in figure.axes)
    assert_can_be_drawn(figure)


def test_axes_show_the_low_part_of_the_curves():
    zs = np.linspace(0.1, 3.9, 200)
    kappa = nd.condition_number(G, nd.Configuration.neutral(3.9828, zs))
    theta = np.radians(np.linspace(-59.0, 59.0, 200))
    along = nd.condition_number(G, nd.Configuration.neutral(3.9828, 2.3745, theta))
    figure = plot.condition_curves([plot.DesignCurves("d", zs, kappa, theta, along, (2.3745, 0.0, 3.911))])
    left, right = figure.axes
    assert left.get_ylim()[1] < 1.5 * kappa.min()
    assert 1.0 < left.get_xlim()[0] < 2.3745 < left.get_xlim()[1] < 3.6
    assert -35 < right.get_xlim()[0] < 0 < right.get_xlim()[1] < 45


# --- Convergence ------------------------------------------------------------------------------------------------------


def test_convergence_marks_runs_that_do_not_converge():
    share, minimax, plain = plot.convergence([DOWN, DOWN], [DOWN, STUCK], best=3.0).axes
    assert (minimax.get_title(loc="left"), plain.get_title(loc="left")) == (
        "minimax SQP: 2 of 2 starts arrive",
        "plain SQP: 1 of 2 starts arrive",
    )
    there, stuck, median = (c for c in plain.collections if isinstance(c, LineCollection))
    assert [len(c.get_segments()) for c in (there, stuck, median)] == [1, 1, 1]
    (line,) = stuck.get_segments()
    corners = dict.fromkeys(map(tuple, line.tolist()))
    assert list(corners) == [(1, 5), (2, 5), (2, 2), (3, 2), (3, 0.5), (4, 0.5)]
    assert to_hex(stuck.get_color()[0]) == style.ALARM.lower()
    labels = [text.get_text() for text in plain.get_legend().get_texts()]
    assert labels == ["one start", "median", "stuck above 10⁻⁶"]
    assert [text.get_text() for text in minimax.get_legend().get_texts()] == ["one start", "median"]
    assert share.lines[0].get_ydata().tolist() == [0, 0, 0, 0, 1]
    assert share.lines[1].get_ydata().tolist() == [0, 0, 0, 0, 0.5]
    assert minimax.get_yscale() == "log"


@pytest.mark.parametrize("run", [[math.inf], [math.inf, math.inf], [3.0], [2.9999999]])
def test_convergence_takes_degenerate_runs(run):
    assert_can_be_drawn(plot.convergence([run], [run], best=3.0))


@pytest.mark.parametrize(
    ("value", "text"), [(1e-6, "10⁻⁶"), (100.0, "10²"), (1.0, "10⁰"), (0.003, "0.003"), (0.0, "0"), (math.inf, "inf")]
)
def test_powers_of_ten(value, text):
    assert style.power_of_ten(value) == text


# --- Poses ------------------------------------------------------------------------------------------------------------


def marks(axes, marker):
    return sorted(point for line in axes.lines if line.get_marker() == marker for point in line.get_xydata().tolist())


def listed(axes):
    return [text.get_text() for text in axes.texts]


def test_every_pose_is_drawn():
    (axes,) = made("poses").axes
    assert [[y for _, y in marks(axes, marker)] for marker in style.MARKS[:2]] == list(BOTH.values())
    assert [label.get_text() for label in axes.get_xticklabels()] == POSES
    assert sorted(line.get_ydata()[0] for line in axes.lines if line.is_dashed()) == [4.3, 7.0]
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["a: worst 4.3", "b: worst 7"]


def test_long_names_are_listed_by_number_and_those_of_the_worst_of_many():
    (axes,) = made("long names").axes
    assert [label.get_text() for label in axes.get_xticklabels()] == ["1", "2", "3"]
    assert listed(axes) == ["in mm", *(f"{k}: {LONG}{k}" for k in (1, 2, 3))]
    assert listed(made("many names").axes[0]) == [f"{k}: pose {k}" for k in range(42, 51)]


def test_singular_poses_are_at_the_upper_edge():
    (axes,) = made("singular pose").axes
    top = axes.get_ylim()[1]
    assert marks(axes, "^") == [[1.0, top], [2.0, top]]
    assert axes.get_legend().get_texts()[0].get_text() == "a: singular at some"


# --- Motion -----------------------------------------------------------------------------------------------------------

TIME = np.linspace(0.0, 2.0, 5001)
LENGTHS = 3.0 + 0.1 * np.sin(TIME[:, None] + np.arange(9))


def test_rows_of_legs_and_the_condition_number():
    figure = plot.motion(followed(4.0 + np.cos(TIME), LENGTHS, TIME, high=3.05, unit="mm"))
    assert [axes.get_title(loc="left") for axes in figure.axes] == [
        *("external legs", "upper internal legs", "lower internal legs"),
        *[""] * 4,
    ]
    assert figure.axes[3].get_ylabel() == "rate (mm/s)"
    assert figure.axes[6].get_ylabel() == "condition number"
    for k, axes in enumerate(figure.axes[:3]):
        legs = [line for line in axes.get_lines() if len(line.get_xdata()) > 2]
        assert len(legs) == 3
        assert legs[0].get_ydata()[-1] == LENGTHS[-1, 3 * k]
        assert len(legs[0].get_xdata()) <= 4001
    assert figure.axes[0].get_ylabel() == "length (mm)"
    pushed = plot.motion(followed(4.0 + np.cos(TIME), LENGTHS, TIME, unit="mm", forces=50.0 * LENGTHS - 140.0))
    assert [axes.get_ylabel() for axes in pushed.axes[6:9]] == ["force (N)"] * 3
    assert pushed.axes[7].get_lines()[0].get_ydata()[-1] == 50.0 * LENGTHS[-1, 3] - 140.0


def test_the_legend_of_many_limits_is_above_their_margins():
    motion = followed(4.0 + np.cos(TIME), LENGTHS, TIME, unit="mm")
    figure = plot.motion(motion, {f"limit {k}": np.full(len(TIME), 1.0 - 0.01 * k) for k in range(14)})
    figure.draw_without_rendering()
    axes = figure.axes[-1]
    assert axes.get_legend().get_window_extent().y0 > axes.transData.transform((0.0, 100.0))[1]


@pytest.mark.parametrize(("unit", "words"), [("mm", "time (s)"), ("", "time (in the unit of the path)")])
def test_the_axis_of_time_says_its_unit(unit, words):
    motion = followed(4.0 + np.cos(TIME), LENGTHS, TIME, unit=unit)
    figure = plot.motion(motion, {"cone": 0.1 + TIME})
    assert {axes.get_xlabel() for axes in figure.axes} == {words}


def test_a_singular_pose_and_one_leg_at_rest():
    kappa = 4.0 + np.cos(TIME)
    kappa[100] = np.inf
    kappa[401] = 1e6  # a narrow peak is not left out
    figure = plot.motion(followed(kappa, np.full((5001, 9), 2.0), TIME))
    assert figure.axes[6].get_yscale() == "log"
    assert_can_be_drawn(figure)
