"""The figure of a workspace: one scale of round bands for all sections, arrows beyond it, limits told apart."""

import numpy as np
import pytest
from matplotlib.colors import to_hex

from ninedof.plot import style
from ninedof.plot.section import KINDS
from ninedof.plot.workspace import Section, workspace
from ninedof.workspace import WorkspaceSlice


def section(kappa, limit=-1):
    ticks = np.linspace(0.0, 1.0, kappa.shape[0])
    state, limits = np.full(kappa.shape, 2, dtype=np.uint8), np.full(kappa.shape, limit, dtype=np.int16)
    share = np.ones(kappa.shape)
    share[[0, -1]] = share[:, [0, -1]] = 0.0
    state[share == 0.0] = 1
    return Section(WorkspaceSlice(("x", "z"), ("y", 0.0), ticks, ticks, state, limits, kappa, share))


@pytest.mark.parametrize(
    ("worst", "top", "words"),
    [(np.inf, 7.0, ", without a bound"), (723.0, 7.0, ", 723 at most"), (7.5, 7.5, ""), (6.0, 7.0, "")],
)
def test_sections_share_round_bands_and_an_arrow_says_what_is_beyond(worst, top, words):
    rng = np.random.default_rng(1)
    near, far = rng.uniform(3.0, 4.0, (8, 8)), rng.uniform(5.0, 7.0, (8, 8))
    far[3, 3] = worst
    percentiles = np.append(np.linspace(3.0, 7.0, 100), max(worst, 7.0))
    figure = workspace([section(near), section(far)], [], {}, percentiles, np.empty((0, 4)))
    bands = [next(c for c in axes.collections if hasattr(c, "levels")) for axes in figure.axes[:2]]
    for drawn in bands:
        assert drawn.levels.tolist() == pytest.approx(np.arange(3.0, top + 0.1, 0.5))
        assert drawn.extend == ("max" if words else "neither")
    (bar,) = [axes for axes in figure.axes if axes.get_ylabel().startswith("condition number")]
    assert bar.get_ylabel() == "condition number" + words
    figure.draw_without_rendering()


def test_bounds_are_drawn_in_the_style_of_their_limits():
    kappa = np.full((8, 8), 4.0)
    figure = workspace([section(kappa, 1)], ["l1 low", "q2 high"], {"q2 high": 1.0}, np.empty(0), np.empty((0, 4)))
    colours = {to_hex(line.get_color()) for line in figure.axes[0].lines}
    assert colours == {"#ffffff", style.UPPER.lower()}
    (legend,) = figure.legends
    assert [text.get_text() for text in legend.get_texts()] == ["upper internal legs"]


def test_kinds_of_limits_differ_without_colours():
    legs = [str(KINDS[kind][2]) for kind in "lqr"]
    assert len(set(legs)) == 3


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
