"""Figures: their contents and scale; files are complete and reproducible."""

import functools
import math
from collections import Counter
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib.collections import LineCollection
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d.art3d import Poly3DCollection
from sizes import size

import ninedof as nd
from ninedof import plot
from ninedof.plot import style
from ninedof.plot.plates import distinct, outlines

PUBLISHED = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
STANDING = nd.Configuration.neutral(zp=3.9828, zs=2.3745)

GEOMETRIES = {
    "coupled": PUBLISHED,
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

TILTED = nd.Configuration(
    position=[0.6, -0.3, 4.2],
    rotation=[[0.8, 0.0, 0.6], [0.0, 1.0, 0.0], [-0.6, 0.0, 0.8]],
    internal_point=[0.3, 0.2, 2.2],
)


CONFIGURATIONS = {"neutral": STANDING, "tilted": TILTED}


@functools.cache
def drawn(geometry, configuration, **options):
    """Axes with a mechanism named above, drawn once for all tests: none changes them."""
    axes = Figure().add_subplot(projection="3d")
    plot.draw_mechanism(axes, GEOMETRIES[geometry], CONFIGURATIONS[configuration], **options)
    axes.figure.draw_without_rendering()
    return axes


def legs(axes):
    """Colour letter -> end points (3, 2, 3) of the legs found on the axes."""
    letters = {colour.lower(): letter for letter, colour in style.LEG_COLOURS.items()}
    found = {"l": [], "q": [], "r": []}
    for line in axes.lines:
        colour = to_hex(line.get_color())
        if colour in letters:
            found[letters[colour]].append(np.transpose(line.get_data_3d()))
    return {letter: np.array(ends) for letter, ends in found.items()}


def assert_can_be_drawn(figure):
    """Every warning is an error, and no part is empty: what a file needs, at a third of its price."""
    figure.draw_without_rendering()
    assert np.isfinite(figure.get_tightbbox().get_points()).all()


def curves(**options):
    zs, theta = np.linspace(1.5, 3.5, 400), np.radians(np.linspace(-20.0, 20.0, 81))
    return plot.DesignCurves(
        "published",
        zs,
        nd.condition_number(PUBLISHED, nd.Configuration.neutral(3.9828, zs)),
        theta,
        nd.condition_number(PUBLISHED, nd.Configuration.neutral(3.9828, 2.3745, theta)),
        point=(2.3745, 0.0, 3.9110),
        **options,
    )


COMPARED = {"slope": -0.52, "level": 3.9110, "crossings": (2.3745, 2.5110), "least": (2.4435, 3.9071)}
DOWN = [math.inf, 10.0, 4.0, 4.0, 3.0]
STUCK = [8.0, 5.0, 3.5, 3.5]

FIGURES = {
    "mechanisms": lambda: plot.mechanisms([plot.Mechanism("published", PUBLISHED, STANDING, 3.9110)]),
    "condition_curves": lambda: plot.condition_curves([curves(**COMPARED)]),
    "convergence": lambda: plot.convergence([DOWN, DOWN], [DOWN, STUCK], best=3.0),
}


# --- The mechanism ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("configuration", CONFIGURATIONS)
@pytest.mark.parametrize("geometry", GEOMETRIES)
def test_nine_legs_of_the_right_length_and_colour(geometry, configuration):
    found = legs(drawn(geometry, configuration))
    assert {letter: len(ends) for letter, ends in found.items()} == {"l": 3, "q": 3, "r": 3}
    lengths = nd.leg_lengths(GEOMETRIES[geometry], CONFIGURATIONS[configuration])
    for letter, expected in zip("lqr", np.split(lengths, 3), strict=True):
        ends = found[letter]
        assert np.sort(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)) == pytest.approx(np.sort(expected))


@pytest.mark.parametrize(
    ("name", "base_corners", "joints"),
    [("coupled", [3], 6), ("hexagonal", [6], 12), ("inner joints", [3], 12)],
)
def test_flat_plates_are_one_polygon_each(name, base_corners, joints):
    axes = drawn(name, "neutral")
    base, platform = (c for c in axes.collections if isinstance(c, Poly3DCollection))
    assert [len(face) for face in outlines(joints_of_base(name))] == base_corners
    assert to_hex(base.get_facecolor()[0]) == style.BASE.lower()
    assert to_hex(platform.get_facecolor()[0]) == style.PLATFORM.lower()
    dots = [line for line in axes.lines if line.get_marker() == "o" and len(line.get_data_3d()[0]) > 1]
    assert len(dots[0].get_data_3d()[0]) == joints  # coincident joints are drawn once


def joints_of_base(name):
    geometry = GEOMETRIES[name]
    return np.vstack([geometry.base_external, geometry.base_internal])


def test_solid_plate_is_closed():
    faces = outlines(joints_of_base("non-planar"))
    edges = Counter()
    for face in faces:
        corners = [tuple(np.round(corner, 9) + 0.0) for corner in face]
        edges.update(frozenset(pair) for pair in zip(corners, [*corners[1:], corners[0]], strict=True))
    assert set(edges.values()) == {2}  # every edge belongs to two faces
    assert len(distinct(joints_of_base("non-planar"))) - len(edges) + len(faces) == 2  # Euler


def test_outline_of_a_hexagon_runs_around_it():
    (face,) = outlines(joints_of_base("hexagonal"))
    angles = np.unwrap(np.arctan2(face[:, 1], face[:, 0]))
    assert np.all(np.diff(angles) > 0) or np.all(np.diff(angles) < 0)
    assert abs(angles[-1] - angles[0]) < 2 * np.pi


@pytest.mark.parametrize("geometry", GEOMETRIES)
def test_equal_aspect_and_nothing_outside(geometry):
    axes = drawn(geometry, "tilted")
    spans = np.array([np.ptp(axes.get_xlim()), np.ptp(axes.get_ylim()), np.ptp(axes.get_zlim())])
    scale = axes._box_aspect / spans
    assert scale == pytest.approx(scale[0])
    points = np.concatenate([ends.reshape(-1, 3) for ends in legs(axes).values()])
    low, high = np.transpose([axes.get_xlim(), axes.get_ylim(), axes.get_zlim()])
    assert np.all(points >= low - 1e-12)
    assert np.all(points <= high + 1e-12)


def test_panels_share_one_scale():
    small = nd.Geometry.hexagonal(a1=0.0, a2=1.5, b1=0.8, b2=0.0)
    figure = plot.mechanisms(
        [
            plot.Mechanism("before", PUBLISHED, STANDING, 3.9110),
            plot.Mechanism("after", small, nd.Configuration.neutral(1.2, 0.7), 5.0, note="a note"),
        ]
    )
    left, right = figure.axes
    assert left.get_position().size == pytest.approx(right.get_position().size)
    for limits in ("get_xlim", "get_ylim", "get_zlim"):
        assert getattr(left, limits)() == getattr(right, limits)()
    assert left._box_aspect == pytest.approx(right._box_aspect)
    words = [text.get_text() for text in figure.texts]
    assert {"before", "after", "condition number 3.9110", "condition number 5.0000", "a note"} <= set(words)
    assert len(figure.legends[0].get_texts()) == 6


def test_labels_carry_the_unit():
    axes = drawn("coupled", "neutral", title="a title", unit="mm")
    assert (axes.get_xlabel(), axes.get_ylabel(), axes.get_title()) == ("x (mm)", "y (mm)", "a title")
    assert {"z (mm)", "O"} <= {text.get_text() for text in axes.texts}
    assert drawn("coupled", "neutral").get_xlabel() == "x"
    assert drawn("coupled", "neutral", legend=False).get_legend() is None


def test_bad_input_is_named():
    with pytest.raises(ValueError, match=r"^configuration: got a stack of shape \(2,\)"):
        plot.draw_mechanism(Figure().add_subplot(projection="3d"), PUBLISHED, nd.Configuration.neutral(4.0, [2.0, 2.5]))
    with pytest.raises(ValueError, match=r"^panels: got 0"):
        plot.mechanisms([])
    with pytest.raises(ValueError, match=r"^designs: got 0"):
        plot.condition_curves([])
    with pytest.raises(ValueError, match=r"^minimax: got no runs"):
        plot.convergence([], [DOWN], best=3.0)


# --- Curves -----------------------------------------------------------------------------------------------------------


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


def test_condition_curves_without_a_level_have_two_panels():
    assert len(plot.condition_curves([curves()]).axes) == 2


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
    kappa = nd.condition_number(PUBLISHED, nd.Configuration.neutral(3.9828, zs))
    theta = np.radians(np.linspace(-59.0, 59.0, 200))
    along = nd.condition_number(PUBLISHED, nd.Configuration.neutral(3.9828, 2.3745, theta))
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


# --- Files ------------------------------------------------------------------------------------------------------------


@functools.cache
def figure_of(make):
    """The figure, made once for the tests that do not change it."""
    return make()


@pytest.mark.parametrize("name", size(["mechanisms", "condition_curves"], FIGURES))
def test_files_are_whole_and_reproducible(name, tmp_path):
    make = FIGURES[name]
    first, second = plot.save(figure_of(make), tmp_path / "a", "figure"), plot.save(make(), tmp_path / "b", "figure")
    assert [path.name for path in first] == ["figure.png", "figure.svg", "figure.pdf"]
    assert sorted(path.name for path in (tmp_path / "a").iterdir()) == ["figure.pdf", "figure.png", "figure.svg"]
    for one, other in zip(first, second, strict=True):
        assert one.read_bytes() == other.read_bytes()
    assert first[0].read_bytes().startswith(b"\x89PNG")
    assert ElementTree.parse(first[1]).getroot().tag.endswith("svg")
    assert b"<dc:date>" not in first[1].read_bytes()
    assert first[2].read_bytes().startswith(b"%PDF-")
    assert b"/Type3" not in first[2].read_bytes().replace(b" ", b"")


def test_files_are_those_of_matplotlib(tmp_path):
    """Drawn once for each file, where `Figure.savefig` draws twice; images in them have the same resolution."""
    figure = Figure(figsize=(2.0, 2.0))
    figure.add_subplot().pcolormesh(np.arange(16.0).reshape(4, 4), rasterized=True)
    paths = plot.save(figure, tmp_path, "figure")
    assert figure.dpi == Figure().dpi
    for path, entries in zip(paths, ({}, {"Date": None}, {"CreationDate": None}), strict=True):
        with style.settings():
            figure.savefig(tmp_path / f"own{path.suffix}", dpi=style.DPI, metadata=entries)
        assert path.read_bytes() == (tmp_path / f"own{path.suffix}").read_bytes()


def test_failed_save_leaves_no_file(tmp_path):
    class Broken(Figure):
        def draw(self, renderer):
            raise OSError("no space left on device")

    (tmp_path / "figure.png").write_bytes(b"the old one")
    with pytest.raises(OSError, match="no space"):
        plot.save(Broken(), tmp_path, "figure")
    assert [path.read_bytes() for path in tmp_path.iterdir()] == [b"the old one"]


def test_matplotlib_settings_are_restored():
    import matplotlib

    before = dict(matplotlib.rcParams)
    FIGURES["condition_curves"]()
    assert dict(matplotlib.rcParams) == before
