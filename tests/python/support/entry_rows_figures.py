"""The table, fourth part: figures."""

import functools

import entry_things as it
import numpy as np
from entry_rows import row

import ninedof as nd
from ninedof import plot

X = np.linspace(0.0, 1.0, 5)
LINES = [np.array([[0.0, 0.0, 4.0], [1.0, 0.0, 4.0]])]
FRONT = {"limit": 2.0, "status": "optimal", "objective": 3.0, "price": 0.5, "dominated": False}


def of(name, few=4, **options):
    return row(f"plot.{name}", getattr(plot, name), few=few, **options)


@functools.cache
def figure_sweep(name):
    return nd.sweep_figure(name, points=5 if name == "6" else 3)


@functools.cache
def atlas():
    return nd.atlas(1000, seed=1)


def axes():
    from matplotlib.figure import Figure

    return Figure().add_subplot(projection="3d")


def mechanism():
    return plot.Mechanism("one", it.g(), it.c())


def section():
    return plot.Section(it.workspace().slice("z", 4.0, pixels=16, smooth=True), home=(0.0, 0.0))


def certified_panel():
    return plot.CertifiedPanel(it.certified().section("z", 4.0, pixels=16))


def curves(**others):
    return {
        "name": "one",
        "zs": X + 2.0,
        "along_zs": X + 4.0,
        "theta_z": X,
        "along_theta_z": X + 4.0,
        "point": (2.5, 0.5, 4.5),
        "slope": 1.0,
        "level": 4.5,
        "crossings": (2.25, 2.75),
        "least": (2.5, 4.25),
    }


PLANE = {"region": [[0.0, 0.0], [0.5, 0.5]], "home": [0.0, 0.0]}
TEXTS = {"unit": "mm"}

of("CertifiedPanel", loose=("region", "home"))(
    lambda: {"section": certified_panel().section, "estimate": section().plane, **PLANE},
)
of("DesignCurves", loose=tuple(curves()))(curves)
of("EllipsoidPanel", loose=("directions", "semi_axes"))(
    lambda: {"title": "one", "directions": np.eye(3), "semi_axes": np.arange(1.0, 4.0), "note": "v"}
)
of("Mechanism", loose=("lines", "condition_number"))(
    lambda: {
        "title": "one",
        "geometry": it.g(),
        "configuration": it.c(),
        "condition_number": 4.0,
        "note": "two",
        "lines": LINES,
    }
)
of("PoseConditions", loose=("conditions",))(lambda: {"name": "one", "conditions": X + 4.0})
of("Section", loose=("ball", "box", "region", "home"))(
    lambda: {
        "plane": section().plane,
        "ball": ((0.0, 0.0), 0.5),
        "box": ((-0.5, -0.5), (0.5, 0.5)),
        **PLANE,
    }
)
of("Sketch", loose=("limit", "theta_z"))(lambda: {"limit": 2.0, "geometry": it.g(), "theta_z": 0.25})
of("atlas")(lambda: {"result": atlas(), "optimum": (2.0, 3.75)})
of("certified_workspace")(lambda: {"panels": [certified_panel()], **TEXTS})
of("condition_curves")(lambda: {"designs": [plot.DesignCurves(**curves())], **TEXTS})
of("convergence")(lambda: {"minimax": [X + 4.0], "plain": [5.0 - X], "best": 4.0, "tolerance": 1e-6})
of("draw_mechanism", few=4)(
    lambda: {
        "axes3d": axes(),
        "geometry": it.g(),
        "configuration": it.c(),
        "title": "one",
        **TEXTS,
        "limits": (4.0, 0.0, 4.0),
        "legend": True,
        "lines": LINES,
        "numbers": True,
        "bare": False,
        "clear_of": LINES,
    }
)
of("ellipsoids")(
    lambda: {
        "panels": [plot.EllipsoidPanel("one", np.eye(3), np.arange(1.0, 4.0))],
        "source": "leg rates",
        "source_note": "two",
        "mapping": "J",
    }
)
of("figure_1")(lambda: {"geometry": it.g(), "configuration": it.c(), **TEXTS})
for name in ("figure_2", "figure_3"):
    of(name)(lambda: {"geometry": it.g(), "configuration": it.c(), **TEXTS})
ELLIPSOID = (np.eye(3), np.arange(1.0, 4.0))
of("figure_4")(lambda: {"translation": ELLIPSOID, "rotation": ELLIPSOID})
of("figure_5")(lambda: {"geometry": it.g(), **TEXTS})
of("figure_6")(lambda: {"result": figure_sweep("6"), **TEXTS})
of("figure_7")(lambda: {"result": figure_sweep("7")})
of("front")(
    lambda: {
        "rows": [FRONT, {**FRONT, "limit": 3.0, "objective": 2.5}],
        "against": "radius_ratio",
        "objective": "condition number",
        **TEXTS,
        "sketches": [plot.Sketch(2.0, it.g())],
    }
)
of("mechanisms")(lambda: {"panels": [mechanism()], **TEXTS})
of("motion", words={"time": ("leg_lengths",)})(
    lambda: {
        "time": X,
        "leg_lengths": np.ones((5, 9)) + X[:, None],
        "conditions": X + 4.0,
        "limits": (np.full(9, 0.5), np.full(9, 9.0)),
        **TEXTS,
        "margins": {"one": X - 0.5},
    }
)
of("poses")(
    lambda: {
        "designs": [plot.PoseConditions("one", X + 4.0)],
        "names": ["a", "b", "c", "d", "e"],
        "index": "condition number",
        "note": "mm",
    }
)
row(
    "plot.save",
    lambda **a: plot.save(**a),
    few=3,
    loose=("directory", "stem"),
)(lambda: {"figure": plot.mechanisms([mechanism()]), "directory": it.fresh(), "stem": "one"})
of("sweep")(lambda: {"result": it.swept(), "name": "condition_number"})
of("workspace")(
    lambda: {
        "sections": [section()],
        "limit_names": it.workspace().limit_names,
        "shares": {"l1": 0.5, "box": 0.5},
        "percentiles": np.linspace(1.0, 4.0, 101),
        "levels": [[8.0, 8.0, 1.0, 0.5], [64.0, 64.0, 1.0, 0.25]],
        **TEXTS,
    }
)
of("workspace_body")(
    lambda: {
        "surface": it.workspace().surface(),
        "coordinates": ("x", "y", "z"),
        "home": (0.0, 0.0, 4.0),
        "lines": LINES,
        **TEXTS,
    }
)
