"""Figures in space: legs and plates of the manipulator, one scale for all panels, ellipsoids with their semi-axes."""

import functools
from collections import Counter

import numpy as np
import pytest
from figure_table import SINGULAR, TILTED, G, made, velocities
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.patches import Arc, FancyArrowPatch
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

import ninedof as nd
from ninedof import plot
from ninedof.plot import style
from ninedof.plot.space.ellipsoid import VIEW
from ninedof.plot.space.mechanism import legs_of
from ninedof.robot.geometry import LEGS
from ninedof.robot.plates import distinct, outlines, points_of
from ninedof.support.placing import toward

SPREAD = np.array([0.0, 120.0, 240.0])
STANDING = nd.Configuration.neutral(zp=3.9828, zs=2.3745)
GEOMETRIES = {
    "coupled": G,
    "hexagonal": nd.Geometry.hexagonal(a1=2.0, a2=4.0, b1=2.2, b2=1.0),
    "inner joints": nd.Geometry.symmetric(
        base_external=(4.0, 0.0, 0.0),
        base_internal=(1.5, 0.2, 0.0),
        platform_external=(2.5, 1.0, 0.0),
        platform_internal=(1.0, 1.0, 0.0),
    ),
    "non-planar": nd.Geometry.symmetric(
        base_external=(5.0, 0.0, 0.0),
        base_internal=(3.0, 0.6, 0.8),
        platform_external=(2.5, 0.5, 0.0),
        platform_internal=(1.2, 1.2, -0.7),
    ),
}
CONFIGURATIONS = {"neutral": STANDING, "tilted": TILTED}


@functools.cache
def drawn(geometry, configuration="neutral", title="", **options):
    """Axes with a mechanism named above, drawn once for all tests: none changes them."""
    axes = Figure().add_subplot(projection="3d")
    plot.mechanism(plot.Robot(title, GEOMETRIES[geometry], CONFIGURATIONS[configuration]), ax=axes, **options)
    axes.figure.draw_without_rendering()
    return axes


def legs(axes):
    """Colour letter -> end points (3, 2, 3) of the legs on the axes."""
    letters = {colour.lower(): letter for letter, colour in style.LEG_COLOURS.items()}
    ends = {"l": [], "q": [], "r": []}
    for line in axes.lines:
        letter = letters.get(to_hex(line.get_color()))
        if letter and line.get_linewidth() > 1.0:  # thin ones lead from a name to its leg
            ends[letter].append(np.transpose(line.get_data_3d()))
    return {letter: np.array(each) for letter, each in ends.items()}


def joints_of_base(name):
    geometry = GEOMETRIES[name]
    return np.vstack([geometry.base_external, geometry.base_internal])


@pytest.mark.parametrize("configuration", CONFIGURATIONS)
@pytest.mark.parametrize("geometry", GEOMETRIES)
def test_nine_legs_of_the_right_length_and_colour(geometry, configuration):
    ends = legs(drawn(geometry, configuration))
    lengths = nd.leg_lengths(GEOMETRIES[geometry], CONFIGURATIONS[configuration])
    for letter, expected in zip("lqr", np.split(lengths, 3), strict=True):
        of_kind = np.linalg.norm(ends[letter][:, 1] - ends[letter][:, 0], axis=1)
        assert np.sort(of_kind) == pytest.approx(np.sort(expected))


@pytest.mark.parametrize(
    ("name", "corners", "joints"), [("coupled", [3], 6), ("hexagonal", [6], 12), ("inner joints", [3], 12)]
)
def test_flat_plates_are_one_polygon_each(name, corners, joints):
    axes = drawn(name)
    base, platform = (c for c in axes.collections if isinstance(c, Poly3DCollection))
    assert [len(face) for face in outlines(joints_of_base(name))] == corners
    assert to_hex(base.get_facecolor()[0]) == style.BASE.lower()
    assert to_hex(platform.get_facecolor()[0]) == style.PLATFORM.lower()
    dots = [line for line in axes.lines if line.get_marker() == "o" and len(line.get_data_3d()[0]) > 1]
    assert len(dots[0].get_data_3d()[0]) == joints  # coincident joints are drawn once


def test_a_solid_plate_is_closed_and_a_flat_one_runs_around():
    faces = outlines(joints_of_base("non-planar"))
    edges = Counter()
    for face in faces:
        corners = [tuple(np.round(corner, 9) + 0.0) for corner in face]
        edges.update(frozenset(pair) for pair in zip(corners, [*corners[1:], corners[0]], strict=True))
    assert set(edges.values()) == {2}  # every edge belongs to two faces
    assert len(distinct(joints_of_base("non-planar"))) - len(edges) + len(faces) == 2  # Euler
    (face,) = outlines(joints_of_base("hexagonal"))
    turns = np.diff(np.unwrap(np.arctan2(face[:, 1], face[:, 0])))
    assert np.all(turns > 0) or np.all(turns < 0)
    assert abs(turns.sum()) < 2 * np.pi


@pytest.mark.parametrize("geometry", GEOMETRIES)
def test_equal_aspect_and_nothing_outside(geometry):
    axes = drawn(geometry, "tilted")
    low, high = np.transpose([axes.get_xlim(), axes.get_ylim(), axes.get_zlim()])
    scale = axes._box_aspect / (high - low)
    assert scale == pytest.approx(scale[0])
    points = np.concatenate([ends.reshape(-1, 3) for ends in legs(axes).values()])
    assert np.all(points >= low - 1e-12)
    assert np.all(points <= high + 1e-12)


def test_panels_share_one_scale():
    small = nd.Geometry.hexagonal(a1=0.0, a2=1.5, b1=0.8, b2=0.0)
    after = plot.Robot("after", small, nd.Configuration.neutral(1.2, 0.7), 5.0, note="a note")
    figure = plot.mechanisms([plot.Robot("before", G, STANDING, 3.9110), after])
    left, right = figure.axes
    assert left.get_position().size == pytest.approx(right.get_position().size)
    for limits in ("get_xlim", "get_ylim", "get_zlim"):
        assert getattr(left, limits)() == getattr(right, limits)()
    assert left._box_aspect == pytest.approx(right._box_aspect)
    words = [text.get_text() for text in figure.texts]
    assert {"before", "after", "condition number 3.9110", "condition number 5.0000", "a note"} <= set(words)
    assert len(figure.legends[0].get_texts()) == 6


FLAT_ONE = plot.Robot("", nd.Geometry.hexagonal(0.0, 44.0, 2.0, 0.0), nd.Configuration.neutral(16.0, 15.0))


@pytest.mark.parametrize("robot", [*(plot.Robot("", g, TILTED) for g in GEOMETRIES.values()), FLAT_ONE])
def test_every_leg_is_named_on_light_ground_and_o_is_no_second_ring(robot):
    axes = Figure().add_subplot(projection="3d")
    plot.mechanism(robot, ax=axes)
    names = {text.get_text(): text for text in axes.texts}
    assert {*LEGS, "O"} <= set(names)
    for leg in LEGS:
        assert to_hex(names[leg].get_bbox_patch().get_facecolor()) == "#ffffff"  # a plate below may be dark
    marks = [one for one in axes.lines if one.get_marker() not in ("", "None", None)]
    (point,) = [
        one for one in marks if np.ravel(one.get_data_3d()) == pytest.approx(robot.configuration.internal_point)
    ]
    assert point.get_marker() == "D"
    assert to_hex(point.get_markerfacecolor()) == style.INK.lower()


def test_no_name_is_nearer_to_another_leg_of_its_colour():
    """Joints in pairs: q3 stood beside q2."""
    geometry, c = nd.Geometry.hexagonal(a1=0.0, a2=850.0, b1=293.0, b2=0.0), nd.Configuration.neutral(483.0, 319.0)
    legs = {name: VIEW.seen(np.stack(ends)) for name, *ends in legs_of(points_of(geometry, c))}
    axes = plot.mechanisms([plot.Robot("", geometry, c)]).axes[0]
    names = {text.get_text(): VIEW.seen(np.array(text.get_position_3d())) for text in axes.texts}
    share = np.linspace(0.0, 1.0, 201)[:, None]
    for name in LEGS:
        alike = {other: ends for other, ends in legs.items() if other[0] == name[0]}
        away = {n: np.linalg.norm(a + share * (b - a) - names[name], axis=1).min() for n, (a, b) in alike.items()}
        assert min(away, key=away.__getitem__) == name


# --- The drawing ------------------------------------------------------------------------------------------------------


def cylinder_machine():
    """A machine in inches with joints apart and a tool beside the axis."""
    names = ("base_external", "base_internal", "platform_external", "platform_internal")
    radii, angles = (24.0, 13.9712, 4.7201, 5.5381), (0.0, -168.6636, -72.5753, 123.4541)
    turns = [np.radians(start - 120.0 * np.arange(3)) for start in angles]
    g = nd.Geometry(
        **{
            name: radius * np.column_stack([np.cos(turn), np.sin(turn), np.zeros(3)])
            for name, radius, turn in zip(names, radii, turns, strict=True)
        }
    )
    tool = nd.Tool(position=(0.5, 0.0, -3.0))
    return *tool.robot(g, nd.Configuration.neutral(15.0209, 8.7622)), "in", tool


def joints_near_o():
    """q2 was under q3, "qq3"."""
    radii = {"base_external_radius": 476.095, "base_internal_radius": 500.0, "base_internal_angle": -3.03654}
    radii |= {"platform_external_radius": 220.0, "platform_external_angle": 0.873511, "zp": 700.0, "zs": 619.951}
    radii |= {"platform_internal_radius": 64.9328, "platform_internal_angle": -2.663182}
    point = nd.Study(family="symmetric", constraints={}).evaluate(radii)
    return point.geometry, point.configuration, "mm", None


def hexagon(a2, b1, zp, zs):
    return nd.Geometry.hexagonal(0.0, a2, b1, 0.0), nd.Configuration.neutral(zp, zs), "mm", None


@pytest.mark.parametrize(
    "machine",
    [
        hexagon(850.0, 292.9081, 483.347, 319.3246),
        hexagon(850.0, 227.9324, 373.7127, 257.029),
        cylinder_machine(),
        joints_near_o(),
    ],
    ids=["requirement", "actuators", "a tool", "joints near O"],
)
def test_names_in_the_front_view_cover_no_other_name_and_no_tool(machine):
    figure = plot.drawing(*machine)
    front = figure.axes[2]
    figure.canvas.draw()
    boxes = {text.get_text(): text.get_window_extent() for text in front.texts if text.get_text()}
    names = [name for name in boxes if len(name) <= 4]
    assert set(LEGS) | {"O"} <= set(names)
    over = [(a, b) for k, a in enumerate(names) for b in names[:k] if boxes[a].overlaps(boxes[b])]
    assert not over
    for mark in [line for line in front.lines if line.get_marker() == "v"]:
        at = front.transData.transform(mark.get_xydata()[0])
        assert not [name for name in names if boxes[name].contains(*at)]


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("geometry", ["coupled", "hexagonal", "inner joints"])
def test_the_drawing_has_every_dimension_of_the_plates_and_the_heights(geometry):
    g = GEOMETRIES[geometry]
    base, platform, front = plot.drawing(g, STANDING, "mm").axes
    words = [{text.get_text() for text in axes.texts} for axes in (base, platform, front)]
    for (external, internal), sides, here in zip(
        ((g.base_external, g.base_internal), (g.platform_external, g.platform_internal)),
        (("a1", "a2"), ("b1", "b2")),
        words,
        strict=False,
    ):
        for triple in (external, internal):
            assert f"R {np.linalg.norm(triple[0, :2]):.5g} mm" in here
        lengths = np.linalg.norm(external[0] - internal[0]), np.linalg.norm(external[0] - internal[2])
        named = {f"{name} = {length:.5g} mm" for name, length in zip(sides, lengths, strict=True) if length > 1e-9}
        assert (named <= here) is (geometry != "inner joints")
        first, second = sorted(
            np.unique(np.degrees(np.arctan2(*np.vstack([external, internal]).T[1::-1])).round(6) % 360.0)
        )[:2]
        assert {f"{angle:.4g}°" for angle in (first, second - first) if angle > 1e-6} <= here
        assert {"E1", "E2", "E3", "I1", "I2", "I3"} <= set(" ".join(here).split())
    assert {"zp = 3.9828 mm", "zs = 2.3745 mm", "O", *LEGS} <= words[2]
    for axes in (base, platform, front):
        assert axes.get_aspect() == 1.0
    for text in front.texts:  # beside the middle of its arrow
        name, _, value = text.get_text().partition(" = ")
        if name in ("zs", "zp"):
            x, z = text.get_position()
            assert z == pytest.approx(0.5 * float(value.split()[0]), rel=1e-4)
            assert min(abs(x - arrow.xy[0]) for arrow in front.texts if not arrow.get_text()) < 0.06 * np.ptp(
                front.get_xlim()
            )


@pytest.mark.slow(sanitized=True)
def test_the_drawing_has_the_heights_of_joints_off_the_plane_of_their_plate():
    heights = np.array([-0.4, 0.0, 0.25])
    raised = G.base_internal + np.array([0.0, 0.0, -0.4]), G.platform_internal + np.outer(heights, [0.0, 0.0, 1.0])
    g = nd.Geometry(G.base_external, raised[0], G.platform_external, raised[1])
    tool = nd.Tool((0.2, 0.0, -1.0), (0.0, 0.3, 0.5))
    for design, more in (((g, STANDING), ()), (tool.robot(g, STANDING), (tool,))):  # on the plate as it is made
        base, platform, _ = (
            {text.get_text() for text in axes.texts} for axes in plot.drawing(*design, "mm", *more).axes
        )
        assert "E1 to E3 at z = 0 mm\nI1 to I3 at z = -0.4 mm" in base
        assert "E1 to E3 at z = 0 mm\nI1 to I3 at z = -0.4, 0, 0.25 mm" in platform
    assert not any(" at z" in text.get_text() for axes in plot.drawing(G, STANDING, "mm").axes for text in axes.texts)


@pytest.mark.slow(sanitized=True)
def test_the_angles_of_a_small_circle_are_beside_their_arcs():
    """The plate of a designer: joints at 50.05 deg on a circle of 220, at 87.42 deg on one of 64.931."""
    outer, inner = (
        radius * np.column_stack([np.cos(at), np.sin(at), 0.0 * at])
        for radius, at in ((220.0, np.radians(50.05 + SPREAD)), (64.931, np.radians(87.42 + SPREAD)))
    )
    axes = plot.drawing(nd.Geometry(2.0 * outer, 5.0 * inner, outer, inner), nd.Configuration.neutral(700, 500)).axes[1]
    places = {text.get_text(): np.array(text.get_position()) for text in axes.texts}
    arcs = [one for one in axes.patches if isinstance(one, Arc)]
    lines = [0.5 * arc.width * toward(np.radians(np.linspace(arc.theta1, arc.theta2, 50))) for arc in arcs]
    for words, own in (("50.05°", 0), ("37.37°", 1)):
        away = [np.linalg.norm(line - places[words], axis=1).min() for line in lines]
        assert np.argmin(away) == own
        assert min(np.linalg.norm(places[words] - places[axis]) for axis in "xy") > 0.3 * 220.0


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("heights", [(483.35, 319.32), (580.0, 362.0)])
def test_the_name_of_a_leg_stands_beside_it_whatever_it_covers(heights):
    """Where legs cross, free places are beyond others: a name there is read as that of the other leg."""
    g = nd.Geometry.hexagonal(a1=0.0, a2=850.0, b1=292.91, b2=0.0)
    front = plot.drawing(g, nd.Configuration.neutral(*heights), "mm").axes[2]
    places = {text.get_text(): text.get_position() for text in front.texts}
    points = {line.get_color(): [] for line in front.lines}
    for line in front.lines:
        points[line.get_color()].append(line.get_xydata())
    reach = 0.04 * np.ptp(front.get_xlim())
    for name in LEGS:
        legs = points[style.LEG_COLOURS[name[0]]]
        along = [leg[0] + np.linspace(0.0, 1.0, 99)[:, None] * (leg[-1] - leg[0]) for leg in legs]
        assert min(np.linalg.norm(line - places[name], axis=1).min() for line in along) < reach


@pytest.mark.slow(sanitized=True)
def test_the_drawing_has_the_twist_and_the_tool_on_the_plates_as_they_are_made():
    turned, tool = nd.Configuration.neutral(3.9828, 2.3745, 0.3), nd.Tool((0.2, 0.0, -1.0), (0.0, 0.0, 0.5))
    without = plot.drawing(G, turned, "mm").axes
    with_tool = plot.drawing(*tool.robot(G, turned), "mm", tool).axes
    words = [[{text.get_text() for text in axes.texts} for axes in figure] for figure in (without, with_tool)]
    assert "theta_z = 17.189°\neach view at its own scale" in words[0][2]
    assert words[1][:2] == words[0][:2]
    of_tool = "tool at (0.2, 0, -1) mm\ntool turned (0, 0, 28.648)°"
    assert f"theta_z = 17.189°\n{of_tool}\neach view at its own scale" in words[1][2]
    assert {"zp = 3.9828 mm", "tool"} <= words[1][2]
    (mark,) = [line for line in with_tool[2].lines if line.get_marker() == "v"]
    at = turned.position + turned.rotation @ np.array(tool.position)
    assert np.ravel(mark.get_data()) == pytest.approx(at[[0, 2]])


def test_the_mechanism_shows_the_tool():
    tool = nd.Tool((0.2, 0.0, -1.0), (0.0, 0.3, 0.5))
    g, c = tool.robot(G, STANDING)
    figure = plot.mechanism(plot.Robot("", g, c, tool=tool))
    (line,) = [one for one in figure.axes[0].lines if one.get_marker() == "v"]
    assert np.transpose(line.get_data_3d()) == pytest.approx(np.array([STANDING.position, c.position]))
    assert "tool" in [text.get_text() for text in figure.legends[0].get_texts()]
    without = plot.mechanism(plot.Robot("", G, STANDING))
    assert "tool" not in [text.get_text() for text in without.legends[0].get_texts()]


# --- The body of a workspace ------------------------------------------------------------------------------------------


def test_what_sticks_out_of_the_body_is_drawn_in_another_way():
    limits = ([3.0] * 3 + [0.0] * 6, [6.0] * 3 + [99.0] * 6)
    body = nd.workspace(G, ([-2, -2, 2], [2, 2, 6]), criteria={"leg_limits": limits}, home=STANDING)
    lines = [np.array([[x, y, 4.0], [x + 4.0, y, 4.0]]) for x in (-2.5, 0.1) for y in (-0.3, 0.4)]
    axes = plot.workspace_body(body.surface(20_000), lines=lines).axes[0]
    drawn_lines = {colour: [] for colour in (style.INK, style.ALARM)}
    for line in axes.lines:
        drawn_lines[line.get_color()].append(np.transpose(line.get_data_3d()))
    for colour, inside in ((style.INK, True), (style.ALARM, False)):
        middles = np.concatenate([0.5 * (part[1:] + part[:-1]) for part in drawn_lines[colour]])
        assert len(middles) > 20
        at = nd.leg_lengths(G, nd.Configuration(middles, np.eye(3), middles - [0, 0, 1.6]))[:, :3]
        keeps = ((at > 3.0) & (at < 6.0)).all(axis=1) & (np.abs(middles[:, :2]) < 2.0).all(axis=1)
        assert np.mean(keeps == inside) > 0.97  # but for the coarseness of the surface
    words = [text.get_text() for text in axes.figure.legends[0].get_texts()]
    assert words == ["workspace", "region, inside", "region, outside"]


# --- Ellipsoids -------------------------------------------------------------------------------------------------------


def tips(axes):
    return np.array([np.ravel(line.get_data_3d()) for line in axes.lines if line.get_marker() == "o"])


def test_semi_axes_have_their_length_and_face_the_viewer_at_one_scale():
    shapes = velocities(TILTED) | {"force": nd.force_ellipsoid(G, TILTED)}
    first, *others = plot.ellipsoids(shapes).axes
    for (directions, semi_axes), axes in zip(shapes.values(), others, strict=True):
        for tip, direction, length in zip(tips(axes), directions.T, semi_axes, strict=True):
            assert np.abs(tip @ direction) == pytest.approx(length)
            assert np.linalg.norm(tip) == pytest.approx(length)
            assert tip @ VIEW.eye >= 0.0
        assert (axes.get_xlim(), axes.get_ylim(), axes.get_zlim()) == (first.get_xlim(),) * 3
        assert axes.get_position().size == pytest.approx(first.get_position().size)
    assert first.get_xlim()[1] == pytest.approx(1.15 * max(np.max(semi_axes) for _, semi_axes in shapes.values()))
    assert np.linalg.norm(tips(first), axis=1) == pytest.approx(1.0)


@pytest.mark.parametrize("c", [TILTED, SINGULAR], ids=["tilted", "singular"])
def test_principal_ellipses_are_on_the_ellipsoid_and_within_the_outline(c):
    directions, semi_axes = nd.velocity_ellipsoid(G, c)
    axes = plot.ellipsoids({"one": (directions, semi_axes)}).axes[1]
    curves = [np.array(line.get_data_3d()) for line in axes.lines if len(line.get_data_3d()[0]) > 100]
    outline, *rings = curves[:7]
    finite = np.isfinite(semi_axes).all()
    for ring in rings[::2]:
        if finite or np.abs(directions.T[0] @ ring).max() < 1e-12:
            scaled = np.divide(directions.T @ ring, semi_axes[:, None])
            assert np.linalg.norm(scaled, axis=0) == pytest.approx(1.0)
    assert np.abs(outline.T @ VIEW.eye).max() < 1e-12  # in the plane of the picture, as orthographic axes allow
    if finite:
        # The shadow of the ellipsoid: along each direction in the picture its support is that of the body.
        for d in np.linalg.qr(np.column_stack([VIEW.eye, np.eye(3)]))[0][:, 1:].T:
            support = np.linalg.norm(semi_axes * (directions.T @ d))
            assert (d @ outline).max() == pytest.approx(support, rel=1e-3)


def test_texts_describe_the_panels():
    shapes = velocities(SINGULAR) | {"force\nF": nd.force_ellipsoid(G, SINGULAR)}
    figure = plot.ellipsoids(shapes, source="legs\nall", mapping="map")
    words = [text.get_text() for text in figure.texts]
    assert {"legs", "all", "map", "velocity", "rotation", "force", "ṗ", "F"} <= set(words)
    assert sum("∞" in word for word in words) == 2
    assert words[-2].endswith(" 0")
    assert [len([t for t in axes.texts if t.get_text() == "∞"]) for axes in figure.axes] == [0, 1, 1, 0]
    assert sum(isinstance(artist, FancyArrowPatch) for artist in made("figure 4").get_children()) == 1
