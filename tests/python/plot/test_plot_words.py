"""Every figure of the package: no two texts intersect, nothing leaves the page, axes are named."""

import functools
import math

import numpy as np
import pytest
from matplotlib.text import Text
from sizes import size
from words import outside, overlaps, unnamed

import ninedof as nd
from ninedof import plot
from ninedof.plot import style

G = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
APART = nd.Geometry.hexagonal(a1=1.5, a2=4.5, b1=2.2, b2=0.8)
HOME = nd.Configuration.neutral(zp=3.9828, zs=2.4435)
AWAY = HOME.moved(np.array([0.1, 0.12, 0.0, 0.9, 0.3, 0.0, -0.4, 0.0, -0.2]))
TIME = np.linspace(0.0, 1.0, 40)
LENGTHS = 3.0 + 0.1 * np.sin(TIME[:, None] + np.arange(9))
DOWN, LATER = [math.inf, 10.0, 4.0, 4.0, 3.0], [8.0, 5.0, 3.5, 3.2, 3.1, 3.0]
FLAT = nd.Geometry.hexagonal(a1=0.0, a2=44.0, b1=2.0, b2=0.0)
EDGES = np.array([[-1, -1, 3], [1, -1, 3], [1, 1, 3], [-1, 1, 3], [-1, -1, 3]], dtype=float)


def row(limit, status="optimal", objective=None, price=None):
    return {"limit": limit, "status": status, "objective": objective, "price": price, "dominated": False}


ROWS = [row(1.0, "infeasible"), *(row(x, objective=6.0 / x, price=1.0 / x) for x in (1.3, 1.5, 2.0, 3.0))]


@functools.cache
def found():
    return nd.workspace(G, ([-4, -4, 0], [4, 4, 8]), criteria={"leg_limits": (1.5, 6.5)}, tolerance=0.05, home=HOME)


def workspace():
    space = found()
    sections = [
        plot.Section(space.slice("y", 0.0, smooth=True), home=(0.0, 3.98)),
        plot.Section(space.slice("z", 4.0, smooth=True), ((0.0, 0.0), 1.0), ((-1.0, -1.0), (1.0, 1.0)), EDGES[:, :2]),
    ]
    return plot.workspace(sections, space.limit_names, space.limits(), space.percentiles, space.levels, "m")


def curves(level):
    zs, theta = np.linspace(1.5, 3.5, 100), np.radians(np.linspace(-20.0, 20.0, 41))
    compared = {"slope": -0.52, "level": 3.911, "crossings": (2.3745, 2.511), "least": (2.4435, 3.9071)}
    return plot.DesignCurves(
        "published",
        zs,
        nd.condition_number(G, nd.Configuration.neutral(3.9828, zs)),
        theta,
        nd.condition_number(G, nd.Configuration.neutral(3.9828, 2.3745, theta)),
        point=(2.3745, 0.0, 3.9110),
        **(compared if level else {}),
    )


def sweep(index="condition_number", **over):
    return plot.sweep(nd.sweep(G, HOME, over, index, unit="mm"))


FIGURES = {
    "mechanism": lambda: plot.mechanisms([plot.Mechanism("optimum", APART, HOME, 3.9, "a note", [EDGES])], "mm"),
    "mechanisms": lambda: plot.mechanisms([plot.Mechanism("a", G, HOME, 3.9), plot.Mechanism("b", APART, AWAY)], "l_c"),
    "a small platform": lambda: plot.mechanisms([plot.Mechanism("a", FLAT, nd.Configuration.neutral(16.0, 15.0))]),
    "condition": lambda: plot.condition_curves([curves(True), curves(False)], "mm"),
    "poses": lambda: plot.poses([plot.PoseConditions("a", [4.0, 4.2]), plot.PoseConditions("b", [3.8, 5.1])]),
    "named poses": lambda: plot.poses([plot.PoseConditions("a", range(2, 11))], [f"x +{k}, y -0.3" for k in range(9)]),
    "convergence": lambda: plot.convergence([DOWN, DOWN], [DOWN, LATER], best=3.0),
    "front": lambda: plot.front(ROWS, "leg_ratio", sketches=[plot.Sketch(1.3, G), plot.Sketch(2.0, APART)]),
    "curve": lambda: sweep(x_p=(-1, 1, 21)),
    "legs": lambda: sweep("leg_lengths", x_p=(-1, 1, 21)),
    "map": lambda: sweep(x_p=(-1, 1, 9), y_p=(-1, 1, 9)),
    "maps": lambda: sweep(z_p=(-1, 1, 5), x_p=(-1, 1, 9), y_p=(-1, 1, 9)),
    "atlas": lambda: plot.atlas(nd.atlas(5_000), (2.0, 3.762659)),
    "workspace": workspace,
    "body": lambda: plot.workspace_body(found().surface(20_000), home=HOME.position, lines=[EDGES], unit="m"),
    "motion": lambda: plot.motion(TIME, LENGTHS, LENGTHS[:, 0], (np.zeros(9), np.full(9, 3.05)), "mm"),
    "margins": lambda: plot.motion(TIME, LENGTHS, LENGTHS[:, 0], margins={"leg_length": 0.3 - TIME, "cone": TIME}),
    "figure 1": lambda: plot.figure_1(G, AWAY, "l_c"),
    "figure 1, joints apart": lambda: plot.figure_1(APART, AWAY, "l_c"),
    "figure 2": lambda: plot.figure_2(G, HOME, "l_c"),
    "figure 3": lambda: plot.figure_3(APART, HOME, "l_c"),
    "figure 4": lambda: plot.figure_4(nd.velocity_ellipsoid(G, HOME), nd.velocity_ellipsoid(G, HOME, "rotation")),
    "figure 5": lambda: plot.figure_5(APART, "l_c"),
    "figure 5, joints coupled": lambda: plot.figure_5(G, "l_c"),
    "figure 6": lambda: plot.figure_6(nd.sweep_figure("6", points=21)),
    "figure 7": lambda: plot.figure_7(nd.sweep_figure("7", points=3)),
}


@functools.cache
def made(name):
    """Made once for all tests: none changes it but to draw it."""
    return FIGURES[name]()


SLOW = ("maps", "margins", "atlas", "figure 2", "figure 4", "figure 5, joints coupled", "figure 1, joints apart")


@pytest.mark.parametrize("name", size([name for name in FIGURES if name not in SLOW], FIGURES))
def test_no_two_texts_intersect_and_axes_have_names(name):
    figure = made(name)
    with style.settings():
        assert overlaps(figure) == []
        assert unnamed(figure) == []
        assert outside(figure) == []


@pytest.mark.parametrize("name", size([name for name in FIGURES if name not in SLOW], FIGURES))
def test_formulas_are_our_own_symbols_alone(name):
    """Everything else is plain text, in which a "$" of a name is a dollar; ticks of logarithmic axes too."""
    with style.settings():
        texts = [text for text in made(name).findobj(Text) if text.get_visible() and text.get_text()]
    assert texts
    for text in texts:
        own = text.get_parse_math() and text.get_text().startswith("$")
        assert own or "$" not in text.get_text(), text
        assert own or not text.get_parse_math() or name.startswith("figure"), text


@pytest.mark.parametrize("name", size([name for name in FIGURES if name not in SLOW], FIGURES))
def test_figures_have_a_width_of_print(name):
    assert made(name).get_size_inches()[0] <= style.TWO_COLUMNS + 1e-9


def test_texts_that_intersect_are_found():
    figure = style.new_figure(3.0, 3.0)
    figure.text(0.3, 0.5, "one word", rotation=45.0)
    figure.text(0.35, 0.55, "another", rotation=45.0)
    figure.text(0.5, 0.3, "apart, though the upright boxes meet", rotation=45.0, size=5)
    assert overlaps(figure) == [("one word", "another")]
