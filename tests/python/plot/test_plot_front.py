"""Figures of fronts and of poses: points, marks, legends, layout."""

import functools
import math
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib.colors import to_hex
from matplotlib.patches import Polygon
from sizes import size
from words import outside, overlaps

import ninedof as nd
from ninedof import plot
from ninedof.plot import style
from ninedof.plot.front import Sketch, front
from ninedof.plot.pose_conditions import PoseConditions, poses


def row(limit, status, objective=None, price=None, dominated=False):
    return {"limit": limit, "status": status, "objective": objective, "price": price, "dominated": dominated}


ROWS = [
    row(1.0, "infeasible"),
    row(1.2, "infeasible"),
    row(1.3, "optimal", 6.0, 3.0),
    row(1.5, "optimal", 4.0, 1.5),
    row(1.8, "stopped", 3.6),
    row(2.0, "optimal", 3.4, 0.2),
    row(3.0, "optimal", 3.4, 0.0, dominated=True),
    row(3.5, "unbounded"),
]
PLATES = [
    Sketch(3.0, nd.Geometry.hexagonal(0.0, 6.0, 3.0, 0.0), 0.2),
    Sketch(1.3, nd.Geometry.hexagonal(2.0, 4.0, 2.2, 1.0)),
]
BOTH = [PoseConditions("a", [4.0, 4.2, 4.1, 4.3]), PoseConditions("b", [3.8, 5.1, 4.4, 7.0])]
LONG = "x +50, y +50, z +50, rotated "
POSES = ["neutral", "x + 0.1 zp", "x - 0.1 zp", "tilted by 10 degrees"]

FIGURES = {
    "front": lambda: front(ROWS, "leg_ratio", "worst condition number over 27 poses"),
    "front with plates": lambda: front(ROWS, "height", unit="m", sketches=PLATES),
    "one point": lambda: front([row(2.0, "optimal", 3.7, 0.1)], "radius_ratio"),
    "no design": lambda: front([row(0.5, "infeasible"), row(0.9, "infeasible")], "leg_ratio"),
    "wide": lambda: front([row(10.0**k, "optimal", 9.0 - k, 0.1) for k in range(-2, 4)], "footprint", unit="mm"),
    "poses": lambda: poses(
        [PoseConditions("a", [4.0, 4.2, 4.1, 4.3]), PoseConditions("b", [3.8, 5.1, 4.4, 7.0])], POSES
    ),
    "singular pose": lambda: poses([PoseConditions("a", [4.0, math.inf, 900.0])]),
    "one pose": lambda: poses([PoseConditions("a", [4.0])]),
    "long names": lambda: poses(
        [PoseConditions("a", [4.0, 4.2, 4.1])], [f"{LONG}{k}" for k in (1, 2, 3)], note="in mm"
    ),
    "many names": lambda: poses([PoseConditions("a", np.arange(3.0, 53.0))], [f"pose {k}" for k in range(1, 51)]),
    "all singular": lambda: poses([PoseConditions("a", [math.inf] * 3)]),
    "many poses": lambda: poses([PoseConditions(n, 4 + np.arange(125) % 7) for n in "abcd"]),
}


@functools.cache
def drawn(name):
    """The figure, made and drawn once for the tests that do not change it."""
    figure = FIGURES[name]()
    figure.draw_without_rendering()
    return figure


def marks(axes, marker):
    """Points drawn with a marker, as (x, y, face colour)."""
    found = [line for line in axes.lines if line.get_marker() == marker]
    points = [(*point, to_hex(line.get_markerfacecolor())) for line in found for point in line.get_xydata().tolist()]
    return sorted(points)


# --- Fronts -----------------------------------------------------------------------------------------------------------


def test_every_limit_is_marked_by_its_status():
    upper = drawn("front").axes[0]
    dot, alarm = style.SERIES[0].lower(), style.ALARM.lower()
    assert marks(upper, "o") == [(1.3, 6.0, dot), (1.5, 4.0, dot), (2.0, 3.4, dot), (3.0, 3.4, "#ffffff")]
    assert marks(upper, "D") == [(1.8, 3.6, alarm)]
    bottom = upper.get_ylim()[0]
    assert marks(upper, "X") == [(1.0, bottom, alarm), (1.2, bottom, alarm)]
    assert marks(upper, "v") == [(3.5, bottom, alarm)]
    words = [text.get_text() for text in upper.get_legend().get_texts()]
    assert words == ["optimal", "no better than a tighter limit", "found, not an optimum", "no design", "unbounded"]


def test_the_line_joins_what_was_found():
    upper = drawn("front").axes[0]
    (line,) = [line for line in upper.lines if line.get_linestyle() == "-" and len(line.get_xdata()) > 1]
    assert line.get_xdata().tolist() == [1.3, 1.5, 1.8, 2.0, 3.0]


def test_infeasible_limits_have_a_grey_background():
    for axes in drawn("front").axes:
        (ground,) = [patch for patch in axes.patches if to_hex(patch.get_facecolor()) == style.GRID.lower()]
        left, right = ground.get_extents().transformed(axes.transData.inverted()).intervalx
        assert left <= 1.0
        assert right == pytest.approx(1.2)
    assert not drawn("one point").axes[0].patches


def test_prices_are_stems():
    lower = drawn("front").axes[1]
    heights = {float(s[1][0]): float(s[1][1]) for c in lower.collections for s in c.get_segments()}
    assert heights == {1.3: 3.0, 1.5: 1.5, 2.0: 0.2, 3.0: 0.0}
    assert lower.get_xlabel() == "largest leg ratio allowed"
    assert lower.get_xlim() == drawn("front").axes[0].get_xlim()


def test_wide_ranges_are_logarithmic_and_carry_the_unit():
    upper, lower = drawn("wide").axes
    assert upper.get_xscale() == "log"
    assert lower.get_xlabel() == "largest footprint allowed (mm)"
    assert drawn("front").axes[0].get_xscale() == "linear"


def test_plates_are_drawn_in_the_order_of_their_limits():
    figure = drawn("front with plates")
    first, second = figure.axes[2:]
    assert [axes.get_title() for axes in (first, second)] == ["at 1.3 m", "at 3 m"]
    for axes in (first, second):
        reach = max(np.abs(p.get_xy()).max() for p in axes.patches if isinstance(p, Polygon))
        assert reach < axes.get_xlim()[1] < 1.2 * reach
    corners = [len(p.get_xy()) - 1 for axes in (first, second) for p in axes.patches if isinstance(p, Polygon)]
    assert corners == [6, 6, 3, 3]
    base, platform = (p.get_xy()[:-1] for p in second.patches)
    assert np.linalg.norm(base, axis=1) == pytest.approx([6.0 / math.sqrt(3.0)] * 3)
    assert np.linalg.norm(platform, axis=1) == pytest.approx([3.0 / math.sqrt(3.0)] * 3)


# --- Poses ------------------------------------------------------------------------------------------------------------


def test_every_pose_is_drawn():
    axes = drawn("poses").axes[0]
    first, second = ([y for _, y, _ in marks(axes, marker)] for marker in style.MARKS[:2])
    assert first == [4.0, 4.2, 4.1, 4.3]
    assert second == [3.8, 5.1, 4.4, 7.0]
    assert [label.get_text() for label in axes.get_xticklabels()] == POSES
    lines = [line.get_ydata()[0] for line in axes.lines if line.get_linestyle() == "--" or line.is_dashed()]
    assert sorted(lines) == [4.3, 7.0]
    words = [text.get_text() for text in axes.figure.legends[0].get_texts()]
    assert words == ["a: worst 4.3", "b: worst 7"]


def listed(figure):
    return [text.get_text() for text in figure.texts]


def test_long_names_are_listed_by_number():
    axes = drawn("long names").axes[0]
    assert [label.get_text() for label in axes.get_xticklabels()] == ["1", "2", "3"]
    assert listed(axes.figure) == ["in mm", *(f"{k}: {LONG}{k}" for k in (1, 2, 3))]


def test_the_worst_of_many_poses_are_listed():
    assert listed(drawn("many names")) == [f"{k}: pose {k}" for k in range(42, 51)]


def test_singular_poses_are_at_the_upper_edge():
    axes = drawn("singular pose").axes[0]
    top = axes.get_ylim()[1]
    assert [(x, y) for x, y, _ in marks(axes, "^")] == [(1.0, top), (2.0, top)]
    assert axes.figure.legends[0].get_texts()[0].get_text() == "a: singular at some"


# --- All --------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", FIGURES)
def test_no_words_on_words_and_nothing_outside(name):
    assert overlaps(drawn(name)) == []
    assert outside(drawn(name)) == []


@pytest.mark.parametrize("name", size(["front with plates", "singular pose", "many poses"], FIGURES))
def test_files_are_whole_and_reproducible(name, tmp_path):
    """Of figures with marks of every kind: a file costs several drawings."""
    first = plot.save(drawn(name), tmp_path / "a", "figure")
    second = plot.save(FIGURES[name](), tmp_path / "b", "figure")
    for one, other in zip(first, second, strict=True):
        assert one.read_bytes() == other.read_bytes()
    assert ElementTree.parse(first[1]).getroot().tag.endswith("svg")


def test_bad_input_is_named():
    with pytest.raises(ValueError, match=r"^rows: got 1 without a finite limit"):
        front([row(math.inf, "infeasible")], "leg_ratio")
    with pytest.raises(ValueError, match=r"^sketches: got 6, expected at most 5"):
        front(ROWS, "leg_ratio", sketches=PLATES * 3)
    with pytest.raises(ValueError, match=r"^designs: got 0, expected 1 to 4"):
        poses([])
    with pytest.raises(ValueError, match=r"^designs: got conditions of shapes \[\(2,\), \(3,\)\]"):
        poses([PoseConditions("a", [1.0, 2.0]), PoseConditions("b", [1.0, 2.0, 3.0])])
    with pytest.raises(ValueError, match=r"^names: got 1, expected 2, one a pose"):
        poses([PoseConditions("a", [1.0, 2.0])], ["neutral"])
