"""The figure of a workspace: one scale of round bands for all sections, arrows beyond it, limits told apart."""

import math
from dataclasses import replace

import numpy as np
import pytest
from figure_table import made, section, space
from matplotlib import colormaps
from matplotlib.colors import to_hex, to_rgb

import ninedof as nd
from ninedof import plot
from ninedof.plot import style
from ninedof.plot.workspace import KINDS, OTHER, kind_of


@pytest.mark.parametrize(
    ("worst", "top", "words"),
    [(np.inf, 7.0, ", without a bound"), (723.0, 7.0, ", 723 at most"), (7.5, 7.5, ""), (6.0, 7.0, "")],
)
def test_sections_share_round_bands_and_an_arrow_says_what_is_beyond(worst, top, words):
    rng = np.random.default_rng(1)
    near, far = rng.uniform(3.0, 4.0, (8, 8)), rng.uniform(5.0, 7.0, (8, 8))
    far[3, 3] = worst
    percentiles = np.append(np.linspace(3.0, 7.0, 100), max(worst, 7.0))
    figure = plot.workspace(space(percentiles), [section(near), section(far)])
    bands = [next(c for c in axes.collections if hasattr(c, "levels")) for axes in figure.axes[:2]]
    for drawn in bands:
        assert drawn.levels.tolist() == pytest.approx(np.arange(3.0, top + 0.1, 0.5))
        assert drawn.extend == ("max" if words else "neither")
    (bar,) = [axes for axes in figure.axes if axes.get_ylabel().startswith("condition number")]
    assert bar.get_ylabel() == "condition number" + words
    figure.draw_without_rendering()


LOWER = "condition number within it"


def test_bounds_are_drawn_in_the_style_of_their_limits():
    found = space(names=["l1 low", "q2 high"], shares={"q2 high": 1.0})
    figure = plot.workspace(found, [section(np.full((8, 8), 4.0), 1)])
    colours = {to_hex(line.get_color()) for line in figure.axes[0].lines}
    assert colours == {"#ffffff", style.UPPER.lower()}
    (legend,) = figure.legends
    assert [text.get_text() for text in legend.get_texts()] == ["upper internal legs"]
    assert len({str(KINDS[kind][2]) for kind in "lqr"}) == 3  # kinds differ without colours


def test_no_two_kinds_of_bounds_are_alike_in_black_and_white():
    dashes = [str(look[2]) for name, look in KINDS.items() if name != "box"] + [str(OTHER[1])]  # box or region
    assert len(set(dashes)) == len(dashes)
    outline = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 0.0]])
    drawn = replace(section(np.full((8, 8), 4.0), 1), region=outline)
    (legend,) = plot.workspace(space(names=["l1 low"]), [drawn]).legends
    (line,) = [line for line in legend.get_lines() if line.get_label() == "region of the study"]
    assert line.is_dashed()  # the boundary of the estimate is not


def test_the_legend_names_no_limit_that_the_boundary_does_not_meet():
    drawn = section(np.full((8, 8), 4.0), 1)
    drawn.plane.state[3, 3], drawn.plane.limit[3, 3] = 1, 0  # a cell that no line passes
    (legend,) = plot.workspace(space(names=["l1 low", "q2 high"]), [drawn]).legends
    assert [text.get_text() for text in legend.get_texts()] == ["upper internal legs"]


@pytest.mark.parametrize("kind", ["box", "region"])
def test_what_ends_a_workspace_is_seen_on_every_colour_of_the_condition_number(kind):
    ground = colormaps[style.CONDITION](np.linspace(0.0, 1.0, 64))[:, :3]
    assert np.linalg.norm(ground - to_rgb(KINDS[kind][1]), axis=1).min() > 0.1


def test_limits_of_one_kind_of_legs_have_the_colour_of_all():
    names = ("upper_force q1", "lower_rate r2", "base_cone_external l1", "det N", "q3 high")
    assert [kind_of(name) for name in names] == ["force", "rate", "base_cone", "det", "q"]


def test_a_limit_that_the_figures_do_not_know_has_a_look_and_its_own_name():
    """A new row of the table of limits needs no line of the figures."""
    found = space(names=["l1 low", "apex_distance O"], shares={"apex_distance O": 1.0})
    figure = plot.workspace(found, [section(np.full((8, 8), 4.0), 1)])
    assert {to_hex(line.get_color()) for line in figure.axes[0].lines} == {"#ffffff", OTHER[0].lower()}
    assert OTHER[0] not in {colour for _, colour, _ in KINDS.values()}
    (legend,) = figure.legends
    assert [text.get_text() for text in legend.get_texts()] == ["apex distance"]


def test_a_workspace_of_orientations_is_drawn_in_degrees():
    found = nd.workspace(
        nd.Geometry.hexagonal(a1=0.0, a2=581.24, b1=290.62, b2=0.0),
        archetype="orientation",
        position=[0.0, 0.0, 398.28],
        region={"angle": 0.5},
        criteria={"leg_limits": (200.0, 520.0)},
        tolerance=0.2,
        resolution=4,
    )
    assert found.of_angles
    section = plot.Section(found.slice("w_z", 0.2, smooth=True), ((0.0, 0.0), 0.1), ((-0.1, -0.1), (0.1, 0.1)))
    axes = plot.workspace(found, [section]).axes[0]
    assert (axes.get_xlabel(), axes.get_ylabel(), axes.get_title(loc="left")) == (
        "w_x (deg)",
        "w_y (deg)",
        "w_z = 11.46 deg",
    )
    assert math.degrees(0.3) < axes.get_xlim()[1] < math.degrees(0.6)
    circle, box = axes.patches[-2:]
    assert circle.radius == pytest.approx(math.degrees(0.1))
    assert box.get_width() == pytest.approx(math.degrees(0.2))


@pytest.mark.parametrize(
    ("low", "high", "levels"),
    [
        (3.05, 3.69, np.arange(3.0, 3.71, 0.1)),
        (4.2, 126.0, [3, 5, 7, 10, 15, 20, 30, 50, 70, 100, 150]),
        (4.0, 4.0, [4.0, 4.0]),
    ],
)
def test_levels_are_round_and_hold_the_range(low, high, levels):
    found = style.round_levels(low, high)
    if low < high:
        assert found.tolist() == pytest.approx(list(levels))
    assert found[0] <= low
    assert found[-1] >= high
    assert np.all(np.diff(found) > 0.0)


@pytest.mark.parametrize(
    ("value", "span", "round_one"), [(0.00014, 2.0, 0.0), (5.344, 1.0, 5.34), (308.1, 309.0, 310.0)]
)
def test_planes_are_at_round_values(value, span, round_one):
    assert style.round_to(value, span) == round_one


def test_the_lower_panels_are_for_a_designer():
    figure = made("workspace")
    below = [axes for axes in figure.axes if axes.get_title(loc="left") in ("what ends the workspace", LOWER)]
    assert len(below) == 2
    names = [text.get_text() for text in below[0].get_yticklabels()]
    assert "l1 at its longest" in names
    assert not any(name.endswith((" high", " low")) for name in names)
    assert not [axes for axes in figure.axes if "error" in axes.get_title(loc="left")]
