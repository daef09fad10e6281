"""Units in figures: the length unit on every axis of lengths, degrees where the data are radians."""

import math

import numpy as np
import pytest
from matplotlib.text import Text

import ninedof as nd
from ninedof import plot
from ninedof.paper.figures import figure_6

G = nd.Geometry.hexagonal(a1=0.0, a2=581.24, b1=290.62, b2=0.0)
HOME = nd.Configuration.neutral(zp=398.28, zs=244.35)


def texts(figure):
    return {one.get_text() for one in figure.findobj(Text)} - {""}


def swept(over, index="condition_number", unit="mm"):
    return nd.sweep(G, HOME, over, index, characteristic_length=100.0, unit=unit)


def workspace(unit):
    low, high = [-100, -100, 350], [100, 100, 450]
    limits = {"criteria": {"leg_limits": (200.0, 480.0)}, "characteristic_length": 100.0, "unit": unit}
    found = nd.workspace(G, (low, high), **limits, tolerance=0.1, resolution=4)
    ball = (found.ball_centre[:2], found.ball_radius)
    return plot.workspace(found, [plot.Section(found.slice("z", 400.0, smooth=True), ball)])


def motion(unit):
    return plot.motion(nd.follow(G, nd.Trajectory.circle(HOME, radius=20.0, points=9, unit=unit), HOME))


CURVES = plot.DesignCurves(
    "one", [200.0, 250.0, 300.0], [4.1, 3.9, 4.2], [-0.1, 0.0, 0.1], [4.0, 3.9, 3.8], (250, 0, 3.9)
)
FIGURES = {
    "mechanisms": (lambda unit: plot.mechanisms([plot.Robot("one", G, HOME)], unit), {"x ({})", "y ({})", "z ({})"}),
    "curves": (lambda unit: plot.condition_curves([CURVES], unit), {"zs, height of O ({})"}),
    "motion": (motion, {"length ({})"}),
    "workspace": (workspace, {"x ({})", "y ({})", "z = 400 {}"}),
    "curve": (
        lambda unit: plot.sweep(swept({"x_p": (-9, 9, 3)}, "leg_lengths", unit)),
        {"x_p ({})", "leg lengths ({})"},
    ),
    "map": (
        lambda unit: plot.sweep(swept({"x_p": (-9, 9, 3), "z_s": (-9, 9, 3)}, unit=unit)),
        {"x_p ({})", "z_s ({})"},
    ),
}


@pytest.mark.parametrize("name", FIGURES)
def test_an_axis_of_lengths_has_the_unit(name):
    draw, labels = FIGURES[name]
    assert {label.format("mm") for label in labels} <= texts(draw("mm"))
    plain = texts(draw(""))
    assert {label.replace(" ({})", "").replace(" {}", "") for label in labels} <= plain
    assert not any("mm" in text for text in plain)


@pytest.mark.parametrize("name", ["theta_z", "theta_z_deg"])
def test_a_sweep_over_an_angle_is_drawn_in_degrees(name):
    turn = 30.0 if name.endswith("_deg") else math.radians(30.0)
    curve = plot.sweep(swept({name: (-turn, turn, 5)}))
    assert curve.axes[0].lines[0].get_xdata() == pytest.approx([-30.0, -15.0, 0.0, 15.0, 30.0])
    assert "theta_z (deg)" in texts(curve)
    drawn = plot.sweep(swept({"x_p": [0.0, 1.0], name: (-turn, turn, 5)}))
    assert drawn.axes[0].get_ylim() == pytest.approx((-37.5, 37.5))
    slices = plot.sweep(swept({name: [0.0, turn], "x_p": [0.0, 1.0], "z_s": [0.0, 1.0]}))
    assert {"theta_z = 0 deg", "theta_z = 30 deg"} <= texts(slices)


def test_fig_6_turns_in_degrees():
    found = nd.sweep_figure("6", points=5)
    turned = figure_6(found).axes[1]
    assert turned.get_xlabel() == "platform turned (deg)"
    assert turned.lines[0].get_xdata() == pytest.approx(np.degrees(found["displacement"]))
