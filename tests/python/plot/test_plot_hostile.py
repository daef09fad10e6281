"""Names in figures come from files: they are drawn as they stand, and no character of them breaks a file."""

from xml.etree import ElementTree

import numpy as np
import pytest

import ninedof as nd
from ninedof import plot
from ninedof.sweep import SweepResult

G = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
HOME = nd.Configuration.neutral(zp=3.9828, zs=2.4435)
NAME = "$\\frac{$ </text>--><script>ran=1</script>]]>&amp;&#0;\x1b]0;evil\x07\x00\x9b half \ud800\ufffe\u202e"


X = np.linspace(0.0, 1.0, 5)


def swept(name):
    made = nd.sweep(G, HOME, {"x_p": (-1.0, 1.0, 5)})
    values = made.arrays["condition_number"]
    return SweepResult({name: values}, {name: ("x_p",)}, made.coords, {}, made.attributes)


def row(limit, objective):
    return {"limit": limit, "status": "optimal", "objective": objective, "price": 1.0, "dominated": False}


FIGURES = {
    "mechanisms": lambda name: plot.mechanisms([plot.Mechanism(name, G, HOME, 3.9, name)]),
    "poses": lambda name: plot.poses([plot.PoseConditions(name, 1.0 + X)], [name] * 5, name, name),
    "ellipsoids": lambda name: plot.ellipsoids([plot.EllipsoidPanel(name, np.eye(3), [3, 2, 1], name)], name, name),
    "condition": lambda name: plot.condition_curves([plot.DesignCurves(name, X, 4.0 + X, X, 4.0 + X, (0.5, 0.5, 4.5))]),
    "motion": lambda name: plot.motion(X, np.ones((5, 9)) + X[:, None], 1.0 + X, margins={name: X - 0.5}),
    "sweep": lambda name: plot.sweep(swept(name)),
    "front": lambda name: plot.front([row(2.0, 3.0), row(3.0, 2.5)], name, name),
}


@pytest.mark.filterwarnings("ignore:Glyph:UserWarning", "ignore:The label:UserWarning")
@pytest.mark.parametrize("kind", FIGURES)
def test_a_name_is_drawn_as_it_stands_and_the_files_are_whole(tmp_path, kind):
    png, svg, pdf = plot.save(FIGURES[kind](NAME), tmp_path, "figure")
    root = ElementTree.fromstring(svg.read_bytes())
    assert not {item.tag.rpartition("}")[2] for item in root.iter()} & {"script", "a", "foreignObject", "iframe"}
    targets = [value for item in root.iter() for key, value in item.attrib.items() if key.endswith("href")]
    assert all(target.startswith(("#", "data:image/png")) for target in targets)
    assert png.read_bytes().startswith(b"\x89PNG")
    assert pdf.read_bytes().rstrip().endswith(b"%%EOF")
