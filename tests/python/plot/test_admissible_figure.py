"""The figure of a set of admissible designs: its words are in the page, its colours are told apart."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.colors import to_rgb

import ninedof as nd
from ninedof import plot
from ninedof.plot.admissible import INSIDE, OTHERS, PALE
from ninedof.plot.workspace import KINDS

RADII = ("base_external_radius", "platform_internal_radius")
STUDY = nd.Study(
    "symmetric",
    variables={
        "base_external_radius": (100.0, 500.0),
        "base_internal_radius": 308.58123,
        "platform_external_radius": (80.0, 220.0),
        "platform_internal_radius": (60.0, 200.0),
        "base_internal_angle": -1.23456,
        "platform_external_angle": 0.98765,
        "platform_internal_angle": -0.65432,
        "zp": (300.0, 600.0),
        "zs": (50.0, 550.0),
    },
    constraints={"stroke_ratio": (None, 1.5)},
    objective={"region": {"box": (30.0, 30.0, 30.0)}},
    characteristic_length=100.0,
    unit="mm",
)
HOME = {"base_external_radius": 450.0, "platform_external_radius": 187.336, "platform_internal_radius": 87.336}
HOME |= {"zp": 512.345, "zs": 312.345}


@pytest.mark.parametrize("vary", [RADII, (*RADII, "zp"), (*RADII, "zp", "zs")])
def test_all_words_are_in_the_page(vary):
    found = nd.admissible(STUDY, vary, at=HOME, resolution=0.5, time_limit=0.2)
    figure = plot.admissible(found)
    figure.draw_without_rendering()
    width, height = figure.get_size_inches() * figure.dpi
    words = [figure._suptitle, *(axes.title for axes in figure.axes), *(axes._left_title for axes in figure.axes)]
    assert figure._suptitle.get_text().replace("\n", " ") == found.of.held
    for text in words:
        if text.get_text():
            box = text.get_window_extent()
            assert -1.0 <= box.x0 < box.x1 <= width + 1.0
            assert box.y1 <= height + 1.0
    rows = [text.get_window_extent() for text in words[1:] if text.get_text()]
    for k, one in enumerate(rows):
        assert not any(one.overlaps(other) for other in rows[k + 1 :])


@pytest.mark.parametrize("colour", [*OTHERS, *(KINDS[name][1] for name in KINDS if len(name) > 1 and name != "box")])
def test_outside_is_not_the_colour_of_inside(colour):
    pale = PALE * np.array(to_rgb(colour)) + 1.0 - PALE
    assert np.linalg.norm(pale - to_rgb(INSIDE)) > 0.18


def test_lines_near_a_singularity_are_smooth_and_none_is_where_o_is_above_the_platform():
    """With zs at zp the condition number has no bound: its lines were those of the grid, in pieces and with hooks."""
    heights = {"zp": (300.0, 700.0), "zs": (50.0, 650.0)}
    study = nd.Study(
        variables={"a1": 0.0, "a2": 850.0, "b1": 292.9, "b2": 0.0, **heights},
        constraints={"radius_ratio": (None, 5.0)},
        objective={"region": {"box": (60.0, 60.0, 40.0), "tilt_deg": 10.0}},
        characteristic_length=150.0,
        unit="mm",
    )
    found = nd.admissible(study, ("zp", "zs"), at={"zp": 483.0, "zs": 319.0}, resolution=0.5, time_limit=0.2)
    axes = plot.admissible(found).axes[0]
    (lines,) = [one for one in axes.collections if hasattr(one, "levels")]
    paths = [part for path in lines.get_paths() for part in path.to_polygons(closed_only=False)]
    assert len(paths) > len(lines.levels)  # a label parts its line
    for part in paths:
        assert (part[:, 1] < part[:, 0]).all()
        along = np.diff(part, axis=0)
        along /= np.linalg.norm(along, axis=1)[:, None]
        near = (part[:, 0] - part[:, 1] < 60.0).all()
        assert not near or (np.sum(along[1:] * along[:-1], axis=1) > 0.8).all()


def test_inside_outside_and_undecided_differ_in_black_and_white():
    """Pale blue, orange and grey have nearly one grey: inside and undecided have lines, of two kinds."""
    hexagons = nd.Study(variables={"a1": 0.0, "a2": (2.0, 10.0), "b1": (1.0, 5.0), "b2": 0.0})
    at = {"zp": 4.9752, "zs": 3.1681}
    found = nd.admissible(hexagons, ("a2", "b1"), at=at, condition_number=5.0, resolution=0.1)
    figure = plot.admissible(found)
    inside, undecided = figure.axes[0].patches
    (legend,) = figure.legends
    keys = [(one.get_label(), one.get_hatch()) for one in legend.get_patches()]
    assert keys[0] == ("every limit kept, proved", inside.get_hatch())
    assert keys[-1] == ("undecided", undecided.get_hatch())
    assert [hatch for _, hatch in keys[1:-1]] == [None] * len(found.excluded)
    assert len({inside.get_hatch(), undecided.get_hatch(), None}) == 3
    assert set(found.state.tolist()) == {0, 1, 2}
    centres = 0.5 * (found.low + found.high)
    for state, area in ((0, inside), (2, undecided)):
        assert (area.get_path().contains_points(centres) == (found.state == state)).all()


def test_a_set_without_a_state_is_drawn():
    found = nd.admissible(STUDY, RADII, at=HOME, resolution=0.5, time_limit=0.2)
    nothing = replace(found, state=np.ones_like(found.state), demand=np.zeros_like(found.demand))
    assert all(len(area.get_path()) == 0 for area in plot.admissible(nothing).axes[0].patches)
