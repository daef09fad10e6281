"""Every figure of the package: no two texts intersect, nothing leaves the page, axes are named, files are whole."""

import inspect
from xml.etree import ElementTree

import numpy as np
import pytest
from figure_table import (
    EDGES,
    FIGURES,
    HOME,
    QUICK,
    G,
    certified,
    curves,
    followed,
    found,
    front,
    made,
    region,
    row,
    sections,
    velocities,
)
from matplotlib.axes import Axes
from matplotlib.figure import Figure, SubFigure
from matplotlib.text import Text
from sizes import size
from words import outside, overlaps, unnamed

import ninedof as nd
from ninedof import plot
from ninedof.paper import figures as paper
from ninedof.plot import style
from ninedof.sweep import SweepResult


@pytest.fixture(scope="module", autouse=True)
def _figures_are_let_go():
    """All together hold 300 MB, and a worker lives on."""
    yield
    made.cache_clear()


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("name", size(QUICK, FIGURES))
def test_no_two_texts_intersect_and_axes_have_names(name):
    figure = made(name)
    with style.settings():
        assert overlaps(figure) == []
        assert unnamed(figure) == []
        assert outside(figure) == []
    assert figure.get_size_inches()[0] <= style.TWO_COLUMNS + 1e-9  # a width of print


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("name", size(QUICK, FIGURES))
def test_formulas_are_our_own_symbols_alone(name):
    """Everything else is plain text, in which a "$" of a name is a dollar; ticks of logarithmic axes too."""
    with style.settings():
        texts = [text for text in made(name).findobj(Text) if text.get_visible() and text.get_text()]
    assert texts
    for text in texts:
        own = text.get_parse_math() and text.get_text().startswith("$")
        assert own or "$" not in text.get_text(), text
        assert own or not text.get_parse_math() or name.startswith("figure"), text


def test_texts_that_intersect_are_found():
    figure = style.new_figure(3.0, 3.0)
    figure.text(0.3, 0.5, "one word", rotation=45.0)
    figure.text(0.35, 0.55, "another", rotation=45.0)
    figure.text(0.5, 0.3, "apart, though the upright boxes meet", rotation=45.0, size=5)
    assert overlaps(figure) == [("one word", "another")]


# --- Where they are drawn ---------------------------------------------------------------------------------------------

FUNCTIONS = [getattr(plot, name) for name in plot.__all__ if name[0].islower() and name != "save"]
FUNCTIONS += [getattr(paper, name) for name in paper.__all__ if name != "all_figures"]


@pytest.mark.parametrize("function", FUNCTIONS, ids=lambda function: function.__name__)
def test_every_figure_takes_axes_or_a_figure_and_at_most_seven_arguments(function):
    names = list(inspect.signature(function).parameters)
    assert names[-1] == "figure" or "ax" in names
    assert len(names) <= 7


def designs():
    at = {"a1": 0.0, "b2": 0.0, "zp": 4.9752, "zs": 3.1681}
    return nd.admissible(nd.Study.paper(), ("a2", "b1"), at=at, time_limit=0.1)


ON_AXES = {
    "poses": lambda ax: plot.poses({"a": [4.0, 4.2]}, ax=ax),
    "figure_7": lambda ax: paper.figure_7(nd.sweep_figure("7", points=3), ax),
    "mechanism": lambda ax: plot.mechanism(plot.Robot("a", G, HOME), ax=ax),
    "workspace_body": lambda ax: plot.workspace_body(found().surface(20_000), lines=[EDGES], ax=ax),
    "figure_1": lambda ax: paper.figure_1(G, HOME, ax),
}
IN_FIGURES = {
    "mechanisms": lambda figure: plot.mechanisms([plot.Robot("a", G, HOME)], figure=figure),
    "front": lambda figure: plot.front(front([row(2.0, "optimal", 3.7, 0.1)]), figure=figure),
    "condition_curves": lambda figure: plot.condition_curves([curves()], figure=figure),
    "sweep": lambda figure: plot.sweep(nd.sweep(G, HOME, {"x_p": (-1.0, 1.0, 5)}, "leg_lengths"), figure=figure),
    "motion": lambda figure: plot.motion(followed(), figure=figure),
    "convergence": lambda figure: plot.convergence([[3.0]], [[3.0]], 3.0, figure=figure),
    "ellipsoids": lambda figure: plot.ellipsoids({"a": (np.eye(3), np.ones(3))}, figure=figure),
    "figure_5": lambda figure: paper.figure_5(G, figure=figure),
    "figure_2": lambda figure: paper.figure_2(G, HOME, figure=figure),
    "figure_3": lambda figure: paper.figure_3(G, HOME, figure=figure),
    "figure_4": lambda figure: paper.figure_4(*velocities(HOME).values(), figure=figure),
    "figure_6": lambda figure: paper.figure_6(nd.sweep_figure("6", points=5), figure=figure),
    "compare": lambda figure: plot.compare(nd.compare(nd.Design(G, HOME), nd.Design(G, HOME)), figure=figure),
    "drawing": lambda figure: plot.drawing(G, HOME, figure=figure),
    "region_map": lambda figure: plot.region_map(region(), figure=figure),
    "atlas": lambda figure: plot.atlas(nd.atlas(1_000), (2.0, 3.762659), figure=figure),
    "workspace": lambda figure: plot.workspace(found(), sections(), figure=figure),
    "certified_workspace": lambda figure: plot.certified_workspace(certified(), figure=figure),
    "admissible": lambda figure: plot.admissible(designs(), figure=figure),
}


def test_every_figure_is_drawn_on_axes_or_in_a_figure_given():
    assert {function.__name__ for function in FUNCTIONS} == {*ON_AXES, *IN_FIGURES}


@pytest.mark.parametrize("name", ON_AXES)
def test_axes_that_are_given_are_drawn_on_and_the_others_left_alone(name):
    space = {} if name in ("poses", "figure_7") else {"projection": "3d"}
    figure = Figure(figsize=(7.0, 3.5))
    left, right = (figure.add_subplot(1, 2, k, **space) for k in (1, 2))
    before = left.get_position().bounds
    assert ON_AXES[name](left) is figure
    assert figure.axes == [left, right]
    assert left.has_data()
    assert not right.has_data()
    assert left.get_position().bounds == before
    figure.draw_without_rendering()


@pytest.mark.parametrize("name", IN_FIGURES)
def test_a_part_of_a_figure_is_drawn_in(name):
    whole = Figure(figsize=(14.0, 6.0))
    left, right = whole.subfigures(1, 2)
    assert isinstance(left, SubFigure)
    assert IN_FIGURES[name](right) is right
    whole.draw_without_rendering()
    assert right.findobj(Axes)  # in parts of it too
    assert not left.findobj(Axes)
    seen = right.get_tightbbox()  # inches
    assert seen.x0 * whole.dpi >= right.bbox.x0 - 1.0


EYE = np.eye(3)
BAD = [
    (lambda: plot.condition_curves([]), "designs: got 0"),
    (lambda: plot.convergence([], [[3.0]], best=3.0), "minimax SQP: got 0"),
    (lambda: plot.motion(followed(), {"cone": [0.1]}), "margins.cone: got shape"),
    (lambda: plot.poses({}), "designs: got 0, expected 1 to 4"),
    (
        lambda: plot.poses({"a": [1.0, 2.0], "b": [1.0, 2.0, 3.0]}),
        r"designs: got conditions of shapes \[\(2,\), \(3,\)\]",
    ),
    (lambda: plot.poses({"a": [1.0, 2.0]}, ["neutral"]), "names: got 1, expected 2, one a pose"),
    (lambda: plot.front(front([row(np.inf, "infeasible")])), "front: got 1 limits, none of them finite"),
    (
        lambda: plot.mechanisms([plot.Robot("", G, nd.Configuration.neutral(4.0, [2.0, 2.5]))]),
        "configuration: got a stack",
    ),
    (lambda: plot.mechanisms([]), "robots: got 0"),
    *((lambda n=n: plot.ellipsoids({str(k): (EYE, EYE[0]) for k in range(n)}), f"panels: got {n}") for n in (0, 5)),
    (lambda: plot.ellipsoids({"bad": (np.eye(2), [1.0, 1.0])}), "panels: got"),
    *((lambda x=x: plot.ellipsoids({"bad": (EYE, [1.0, 1.0, x])}), "panels: got") for x in (np.nan, -1.0)),
    *((lambda n=n: plot.workspace(found(), sections()[:1] * n), f"sections: got {n}, expected 1 to 3") for n in (0, 4)),
    (lambda: plot.certified_workspace([]), "sections: got 0, expected 1 to 3"),
    (lambda: plot.sweep(swept("its name"), "kappa"), "name: got 'kappa', expected one of its name"),
]


@pytest.mark.parametrize(("draw", "words"), BAD, ids=[words for _, words in BAD])
def test_what_cannot_be_drawn_is_named(draw, words):
    with pytest.raises(ValueError, match=f"^{words}"):
        draw()


# --- Files ------------------------------------------------------------------------------------------------------------


FILES = ["mechanisms", "condition", "front with plates", "singular pose", "singular ellipsoids", "motion", "workspace"]


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("name", size(FILES, FIGURES))
def test_files_are_whole_and_reproducible(name, tmp_path):
    first = plot.save(FIGURES[name](), tmp_path / "a", "figure")
    second = plot.save(FIGURES[name](), tmp_path / "b", "figure")
    assert sorted(path.name for path in (tmp_path / "a").iterdir()) == ["figure.pdf", "figure.png", "figure.svg"]
    for one, other in zip(first, second, strict=True):
        assert one.read_bytes() == other.read_bytes()
    png, svg, pdf = (path.read_bytes() for path in first)
    assert png.startswith(b"\x89PNG")
    assert ElementTree.fromstring(svg).tag.endswith("svg")
    assert b"<dc:date>" not in svg
    assert pdf.startswith(b"%PDF-")
    assert b"/Type3" not in pdf.replace(b" ", b"")


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
    with pytest.raises(ValueError, match=r"^stem: got 'a/b', expected a file name"):
        plot.save(Figure(), tmp_path, "a/b")


def test_matplotlib_settings_are_restored():
    import matplotlib

    before = dict(matplotlib.rcParams)
    FIGURES["condition"]()
    assert dict(matplotlib.rcParams) == before


# --- Names that come from files ---------------------------------------------------------------------------------------

NAME = "$\\frac{$ </text>--><script>ran=1</script>]]>&amp;&#0;\x1b]0;evil\x07\x00\x9b half \ud800\ufffe\u202e"
X = np.linspace(0.0, 1.0, 5)


def swept(name):
    swept = nd.sweep(G, HOME, {"x_p": (-1.0, 1.0, 5)})
    values = swept.arrays["condition_number"]
    return SweepResult({name: values}, {name: ("x_p",)}, swept.coords, {}, swept.attributes)


NAMED = {
    "mechanisms": lambda: plot.mechanisms([plot.Robot(NAME, G, HOME, 3.9, NAME)]),
    "poses": lambda: plot.poses({NAME: 1.0 + X}, [NAME] * 5, NAME, NAME),
    "sweep": lambda: plot.sweep(swept(NAME)),
    "front": lambda: plot.front(front([row(2.0, "optimal", 3.0, 1.0)], NAME, words=NAME), sketches=0),
}


@pytest.mark.slow(sanitized=True)
@pytest.mark.filterwarnings("ignore:Glyph:UserWarning", "ignore:The label:UserWarning")
@pytest.mark.parametrize("kind", NAMED)
def test_a_name_is_drawn_as_it_stands_and_the_files_are_whole(tmp_path, kind):
    png, svg, pdf = plot.save(NAMED[kind](), tmp_path, "figure")
    root = ElementTree.fromstring(svg.read_bytes())
    assert not {item.tag.rpartition("}")[2] for item in root.iter()} & {"script", "a", "foreignObject", "iframe"}
    targets = [value for item in root.iter() for key, value in item.attrib.items() if key.endswith("href")]
    assert all(target.startswith(("#", "data:image/png")) for target in targets)
    assert png.read_bytes().startswith(b"\x89PNG")
    assert pdf.read_bytes().rstrip().endswith(b"%%EOF")
