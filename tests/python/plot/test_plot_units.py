"""Units in figures: the length unit on every axis of lengths, degrees where the data are radians."""

import math

import numpy as np
import pytest
from matplotlib.text import Text

import ninedof as nd
from ninedof import plot
from ninedof.plot.front import Sketch, front

G = nd.Geometry.hexagonal(a1=0.0, a2=581.24, b1=290.62, b2=0.0)
HOME = nd.Configuration.neutral(zp=398.28, zs=244.35)


def texts(figure):
    return {found.get_text() for found in figure.findobj(Text)} - {""}


def swept(over, index="condition_number", unit="mm"):
    return nd.sweep(G, HOME, over, index, characteristic_length=100.0, unit=unit)


def section(unit):
    found = nd.workspace(
        G,
        ([-100, -100, 350], [100, 100, 450]),
        criteria={"leg_limits": (200.0, 480.0)},
        characteristic_length=100.0,
        tolerance=0.1,
        resolution=4,
    )
    sections = [plot.Section(found.slice("z", 400.0, 16), (found.ball_centre[:2], found.ball_radius))]
    return plot.workspace(sections, found.limit_names, found.limits(), found.percentiles, found.levels, unit)


def motion(unit):
    found = nd.follow(G, nd.Trajectory.circle(HOME, radius=20.0, points=9), HOME, unit=unit)
    return plot.motion(found.time, found.leg_lengths, found.condition_number, found.limits, found.unit)


CURVES = plot.DesignCurves(
    "one", [200.0, 250.0, 300.0], [4.1, 3.9, 4.2], [-0.1, 0.0, 0.1], [4.0, 3.9, 3.8], (250, 0, 3.9)
)
ROWS = [
    {"limit": limit, "status": "optimal", "objective": 4.0 - limit, "price": 0.2, "dominated": False}
    for limit in (0.5, math.radians(38.05))
]
FIGURES = {
    "mechanisms": (
        lambda unit: plot.mechanisms([plot.Mechanism("one", G, HOME)], unit),
        {"x ({})", "y ({})", "z ({})"},
    ),
    "curves": (lambda unit: plot.condition_curves([CURVES], unit), {"zs, height of O ({})"}),
    "motion": (motion, {"length ({})"}),
    "workspace": (section, {"x ({})", "y ({})", "z = 400 {}"}),
    "curve": (
        lambda unit: plot.sweep(swept({"x_p": (-9, 9, 3)}, "leg_lengths", unit)),
        {"x_p ({})", "leg lengths ({})"},
    ),
    "map": (
        lambda unit: plot.sweep(swept({"x_p": (-9, 9, 3), "z_s": (-9, 9, 3)}, unit=unit)),
        {"x_p ({})", "z_s ({})"},
    ),
    "front": (lambda unit: front(ROWS, "height", unit=unit), {"largest height allowed ({})"}),
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
    turned = plot.figure_6(found).axes[1]
    assert turned.get_xlabel() == "platform turned (deg)"
    assert turned.lines[0].get_xdata() == pytest.approx(np.degrees(found["displacement"]))


@pytest.mark.parametrize(
    ("against", "unit", "scale"), [("base_cone", "rad", 1.0), ("base_cone_deg", "", math.degrees(1.0))]
)
def test_a_front_against_an_angle_is_drawn_in_degrees(against, unit, scale):
    rows = [row | {"limit": scale * row["limit"]} for row in ROWS]
    figure = front(rows, against, unit=unit, sketches=[Sketch(rows[1]["limit"], G)])
    assert {"largest base cone allowed (deg)", "at 38.05 deg"} <= texts(figure)
    assert figure.axes[0].lines[0].get_xdata() == pytest.approx([math.degrees(0.5), 38.05])


def test_a_workspace_of_orientations_is_drawn_in_degrees():
    found = nd.workspace(
        G,
        archetype="orientation",
        position=HOME.position,
        region={"angle": 0.5},
        criteria={"leg_limits": (200.0, 520.0)},
        tolerance=0.2,
        resolution=4,
    )
    assert found.of_angles
    section = plot.Section(found.slice("w_z", 0.2, smooth=True), ((0.0, 0.0), 0.1), ((-0.1, -0.1), (0.1, 0.1)))
    figure = plot.workspace([section], found.limit_names, found.limits(), found.percentiles, found.levels, "rad")
    assert {"w_x (deg)", "w_y (deg)", "w_z = 11.46 deg"} <= texts(figure)
    axes = next(axes for axes in figure.axes if axes.get_xlabel() == "w_x (deg)")
    assert math.degrees(0.3) < axes.get_xlim()[1] < math.degrees(0.6)
    circle, box = axes.patches[-2:]
    assert circle.radius == pytest.approx(math.degrees(0.1))
    assert box.get_width() == pytest.approx(math.degrees(0.2))
