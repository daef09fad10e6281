"""The figure of ellipsoids: scale, visibility, bad input, files."""

import numpy as np
import pytest
from matplotlib.patches import FancyArrowPatch
from sizes import size
from words import outside, overlaps

import ninedof as nd
from ninedof import plot
from ninedof.plot.ellipsoid import EYE, EllipsoidPanel, ellipsoids

G = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
TILTED = nd.Configuration(
    position=[0.5, -0.3, 4.1],
    rotation=[[0.8, 0.0, 0.6], [0.0, 1.0, 0.0], [-0.6, 0.0, 0.8]],
    internal_point=[0.3, 0.2, 1.3],
)
SINGULAR = nd.Configuration(TILTED.position, TILTED.rotation, [0.3, 0.2, 0.0])


def panels(c):
    return [
        EllipsoidPanel("translation", *nd.velocity_ellipsoid(G, c), note="ṗ"),
        EllipsoidPanel("rotation", *nd.velocity_ellipsoid(G, c, "rotation"), note="l_c ω"),
        EllipsoidPanel("force", *nd.force_ellipsoid(G, c), note="F"),
    ]


FIGURES = {
    "two": lambda: ellipsoids(panels(TILTED)[:2]),
    "four": lambda: ellipsoids([*panels(TILTED), EllipsoidPanel("sphere", np.eye(3), np.ones(3))]),
    "singular": lambda: ellipsoids(panels(SINGULAR)),
    "free in every direction": lambda: ellipsoids([EllipsoidPanel("all", np.eye(3), [np.inf] * 3)]),
    "a disc, a needle and a point": lambda: ellipsoids(
        [EllipsoidPanel("d", np.eye(3), axes) for axes in ([2.0, 1.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 0.0])]
    ),
}


def tips(axes):
    return np.array([np.ravel(line.get_data_3d()) for line in axes.lines if line.get_marker() == "o"])


def test_semi_axes_have_their_length_and_face_the_viewer():
    shown = panels(TILTED)
    figure = ellipsoids(shown)
    for panel, axes in zip(shown, figure.axes[1:], strict=True):
        found = tips(axes)
        for tip, direction, length in zip(found, np.transpose(panel.directions), panel.semi_axes, strict=True):
            assert np.abs(tip @ direction) == pytest.approx(length)
            assert np.linalg.norm(tip) == pytest.approx(length)
            assert tip @ EYE >= 0.0


@pytest.mark.parametrize("c", [TILTED, SINGULAR], ids=["tilted", "singular"])
def test_principal_ellipses_are_on_the_ellipsoid_and_within_the_outline(c):
    (panel, *_) = panels(c)
    axes = ellipsoids([panel]).axes[1]
    body = np.asarray(panel.directions).T
    curves = [np.array(line.get_data_3d()) for line in axes.lines if len(line.get_data_3d()[0]) > 100]
    outline, *rings = curves[:7]
    for ring in rings[::2]:
        scaled = np.divide(body @ ring, panel.semi_axes[:, None])
        flat = np.isfinite(panel.semi_axes).all() or np.abs(body[0] @ ring).max() < 1e-12
        if flat:
            assert np.linalg.norm(scaled, axis=0) == pytest.approx(1.0)
    depth = np.abs(outline.T @ EYE).max()
    assert depth < 1e-12  # drawn in the plane of the picture, as orthographic axes allow
    if np.isfinite(panel.semi_axes).all():
        # The shadow of the ellipsoid: along each direction in the picture its support is that of the body.
        for d in np.linalg.qr(np.column_stack([EYE, np.eye(3)]))[0][:, 1:].T:
            support = np.linalg.norm(panel.semi_axes * (body @ d))
            assert (d @ outline).max() == pytest.approx(support, rel=1e-3)


def test_one_scale_for_all():
    figure = ellipsoids(panels(TILTED))
    first = figure.axes[0]
    for axes in figure.axes[1:]:
        assert (axes.get_xlim(), axes.get_ylim(), axes.get_zlim()) == (first.get_xlim(),) * 3
        assert axes.get_position().size == pytest.approx(first.get_position().size)
    largest = max(np.max(panel.semi_axes) for panel in panels(TILTED))
    assert first.get_xlim()[1] == pytest.approx(1.15 * largest)
    sphere = tips(first)
    assert np.linalg.norm(sphere, axis=1) == pytest.approx(1.0)


def test_texts_describe_the_panels():
    figure = ellipsoids(panels(SINGULAR), source="legs", source_note="all", mapping="map")
    words = [text.get_text() for text in figure.texts]
    assert {"legs", "all", "map", "translation", "rotation", "force", "ṗ", "F"} <= set(words)
    assert sum("∞" in word for word in words) == 2
    assert words[-2].endswith(" 0")
    assert [len([t for t in axes.texts if t.get_text() == "∞"]) for axes in figure.axes] == [0, 1, 1, 0]
    assert sum(isinstance(artist, FancyArrowPatch) for artist in figure.get_children()) == 1


@pytest.mark.parametrize("make", FIGURES.values(), ids=FIGURES)
def test_nothing_leaves_the_figure(make):
    figure = make()
    assert outside(figure) == []
    assert overlaps(figure) == []


@pytest.mark.parametrize("name", size(["singular"], FIGURES))  # arrows, words and bodies without an end
def test_files_are_the_same_twice(name, tmp_path):
    once, twice = (plot.save(FIGURES[name](), tmp_path / folder, "figure") for folder in "ab")
    for one, other in zip(once, twice, strict=True):
        assert one.read_bytes() == other.read_bytes()


@pytest.mark.parametrize(
    ("directions", "semi_axes"),
    [
        (np.eye(2), [1.0, 1.0]),
        (np.eye(6), np.ones(6)),
        (np.eye(3), [1.0, 1.0, np.nan]),
        (np.eye(3), [1.0, 1.0, -1.0]),
        (np.full((3, 3), np.nan), np.ones(3)),
    ],
)
def test_a_bad_ellipsoid_raises(directions, semi_axes):
    with pytest.raises(ValueError, match=r"^panels: got"):
        ellipsoids([EllipsoidPanel("bad", directions, semi_axes)])


@pytest.mark.parametrize("count", [0, 5])
def test_a_bad_number_of_panels_raises(count):
    with pytest.raises(ValueError, match=f"^panels: got {count}"):
        ellipsoids([EllipsoidPanel("one", np.eye(3), np.ones(3))] * count)
