"""The figure of a front: points, marks, legend, plates."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from figure_table import ACCURACY, front, made, row
from matplotlib.colors import to_hex
from matplotlib.patches import Polygon

import ninedof as nd
from ninedof import plot
from ninedof.plot import style


def marks(axes, marker):
    """Points drawn with a marker, as (x, y, face colour)."""
    lines = [line for line in axes.lines if line.get_marker() == marker]
    return sorted(
        (*point, to_hex(line.get_markerfacecolor())) for line in lines for point in line.get_xydata().tolist()
    )


def test_every_limit_is_marked_by_its_status():
    upper = made("front").axes[0]
    dot, alarm = style.SERIES[0].lower(), style.ALARM.lower()
    assert marks(upper, "o") == [(1.3, 6.0, dot), (1.5, 4.0, dot), (2.0, 3.4, dot), (3.0, 3.4, "#ffffff")]
    assert marks(upper, "D") == [(1.8, 3.6, alarm)]
    bottom = upper.get_ylim()[0]
    assert marks(upper, "X") == [(1.0, bottom, alarm), (1.2, bottom, alarm)]
    assert marks(upper, "v") == [(3.5, bottom, alarm)]
    words = [text.get_text() for text in upper.get_legend().get_texts()]
    assert words == ["optimal", "no better than a tighter limit", "found, not an optimum", "no design", "unbounded"]
    (line,) = [line for line in upper.lines if line.get_linestyle() == "-" and len(line.get_xdata()) > 1]
    assert line.get_xdata().tolist() == [1.3, 1.5, 1.8, 2.0, 3.0]


def test_infeasible_limits_have_a_grey_background():
    for axes in made("front").axes:
        (ground,) = [patch for patch in axes.patches if to_hex(patch.get_facecolor()) == style.GRID.lower()]
        left, right = ground.get_extents().transformed(axes.transData.inverted()).intervalx
        assert left <= 1.0
        assert right == pytest.approx(1.2)
    assert not made("front, one point").axes[0].patches


def test_prices_are_stems():
    upper, lower = made("front").axes
    heights = {float(s[1][0]): float(s[1][1]) for c in lower.collections for s in c.get_segments()}
    assert heights == {1.3: 3.0, 1.5: 1.5, 2.0: 0.2, 3.0: 0.0}
    assert lower.get_xlabel() == "largest leg ratio allowed"
    assert lower.get_xlim() == upper.get_xlim()


def test_wide_ranges_are_logarithmic_and_carry_the_unit():
    upper, lower = made("wide front").axes
    assert upper.get_xscale() == "log"
    assert lower.get_xlabel() == "largest footprint allowed (mm)"
    assert made("front").axes[0].get_xscale() == "linear"


def test_plates_are_drawn_in_the_order_of_their_limits():
    first, second = made("front with plates").axes[2:]
    assert [axes.get_title() for axes in (first, second)] == ["at 1.3 m", "at 3 m"]
    reach = max(np.abs(p.get_xy()).max() for axes in (first, second) for p in axes.patches if isinstance(p, Polygon))
    for axes in (first, second):  # one scale
        assert reach < axes.get_xlim()[1] < 1.2 * reach
        assert axes.get_xlim() == first.get_xlim()
        assert axes.get_position().size == pytest.approx(first.get_position().size)
    corners = [len(p.get_xy()) - 1 for axes in (first, second) for p in axes.patches if isinstance(p, Polygon)]
    assert corners == [6, 6, 3, 3]
    base, platform = (p.get_xy()[:-1] for p in second.patches)
    assert np.linalg.norm(base, axis=1) == pytest.approx([6.0 / math.sqrt(3.0)] * 3)
    assert np.linalg.norm(platform, axis=1) == pytest.approx([3.0 / math.sqrt(3.0)] * 3)


def test_a_bar_has_the_length_that_it_names():
    figure = made("front with plates")
    (bar,) = [one for one in figure.get_children() if one.get_label() == "scale"]
    (words,) = [text.get_text() for text in figure.texts if text.get_text().endswith(" m")]
    axes = figure.axes[-1]
    ends = axes.transData.inverted().transform(bar.get_transform().transform(bar.get_xydata()))
    assert np.ptp(ends[:, 0]) == pytest.approx(float(words.removesuffix(" m")), rel=1e-6)


def test_mirror_images_are_drawn_alike_and_named():
    rows = [row(k, "optimal", 4.0 - 0.1 * k, 0.1) for k in (1.0, 2.0)]
    sides = {"a1": 0.0, "a2": 6.0, "b1": 3.0, "b2": 0.0}
    twin = {"a1": 6.0, "a2": 0.0, "b1": 0.0, "b2": 3.0}  # the sides of one changed for those of the other
    for one, mirrored in ((twin, True), (sides, False)):
        seen = front(rows, "leg_ratio", "m", words="worst condition number over " + "a long region, " * 6)
        for result, design in zip(seen.results, (sides, one), strict=True):
            result.best = SimpleNamespace(
                geometry=nd.Geometry.hexagonal(**design), configuration=nd.Configuration.neutral(4.0, 2.0)
            )
        figure = plot.front(seen)
        first, second = figure.axes[2:]
        assert second.get_title() == "at 2 m" + ", mirrored" * mirrored
        for a, b in zip(first.patches, second.patches, strict=True):
            gaps = np.linalg.norm(a.get_xy()[:, None] - b.get_xy(), axis=-1)
            assert gaps.min(axis=0).max() == pytest.approx(0.0, abs=1e-9)
        assert figure.axes[0].get_ylabel() == "worst condition number"


def test_a_front_against_an_angle_is_drawn_in_degrees():
    rows = [row(limit, "optimal", 4.0 - limit, 0.2) for limit in (0.5, math.radians(38.05))]
    figure = plot.front(front(rows, "base_cone", "rad"))
    assert figure.axes[1].get_xlabel() == "largest base cone allowed (deg)"
    assert [axes.get_title() for axes in figure.axes[2:]] == ["at 28.65 deg", "at 38.05 deg"]
    assert figure.axes[0].lines[0].get_xdata() == pytest.approx([math.degrees(0.5), 38.05])


def test_a_front_of_tolerances_rises_to_where_no_design_is():
    upper, lower = made("front of tolerances").axes[:2]
    assert lower.get_xlabel() == "tolerance of joints, that of legs 0.5 times it (mm)"
    (ground,) = [patch for patch in upper.patches if to_hex(patch.get_facecolor()) == style.GRID.lower()]
    left, right = ground.get_extents().transformed(upper.transData.inverted()).intervalx
    assert left == pytest.approx(2.0)
    assert right >= upper.get_xlim()[1] * (1.0 - 1e-9)
    assert lower.get_ylim()[1] == pytest.approx(1.25 * 3e-4)
    assert "no better than a larger tolerance" in [text.get_text() for text in upper.get_legend().get_texts()]
    same = plot.front(front(ACCURACY, "tolerance", "mm", tolerances=nd.Tolerances()), sketches=0)
    assert same.axes[1].get_xlabel() == "tolerance of joints and legs (mm)"
