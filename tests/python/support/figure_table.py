"""One table of figures, a call for each kind of thing that they show, and what tests ask of all of them."""

import functools
import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np

import ninedof as nd
from ninedof import plot
from ninedof.paper import figures as paper
from ninedof.plot import style
from ninedof.support.placing import toward
from ninedof.workspace import WorkspaceSlice

G = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
APART = nd.Geometry.hexagonal(a1=1.5, a2=4.5, b1=2.2, b2=0.8)
FLAT = nd.Geometry.hexagonal(a1=0.0, a2=44.0, b1=2.0, b2=0.0)
HOME = nd.Configuration.neutral(zp=3.9828, zs=2.4435)
AWAY = HOME.moved(np.array([0.1, 0.12, 0.0, 0.9, 0.3, 0.0, -0.4, 0.0, -0.2]))
TILTED = nd.Configuration(
    position=[0.5, -0.3, 4.1],
    rotation=[[0.8, 0.0, 0.6], [0.0, 1.0, 0.0], [-0.6, 0.0, 0.8]],
    internal_point=[0.3, 0.2, 1.3],
)
SINGULAR = nd.Configuration(TILTED.position, TILTED.rotation, [0.3, 0.2, 0.0])
EDGES = np.array([[-1, -1, 3], [1, -1, 3], [1, 1, 3], [-1, 1, 3], [-1, -1, 3]], dtype=float)
TIME = np.linspace(0.0, 1.0, 40)
LENGTHS = 3.0 + 0.1 * np.sin(TIME[:, None] + np.arange(9))
DOWN, LATER = [math.inf, 10.0, 4.0, 4.0, 3.0], [8.0, 5.0, 3.5, 3.2, 3.1, 3.0]
COMPARED = {"slope": -0.52, "level": 3.911, "crossings": (2.3745, 2.511), "least": (2.4435, 3.9071)}
OVER_POSES = {"neutral": (np.full(400, 3.8), np.full(81, 3.9)), "violated": (np.arange(400) < 170, np.arange(81) > 50)}
TURNS = {"over": "", "outline": np.array([[-60.0, -60.0], [60.0, -60.0], [60.0, 60.0], [-60.0, -60.0]]) / 600.0}
LONG = "x +50, y +50, z +50, rotated "
NOTE = "with O held, in one orientation, not over the region of the study"
POSES = ["neutral", "x + 0.1 zp", "x - 0.1 zp", "tilted by 10 degrees"]
BOTH = {"a": [4.0, 4.2, 4.1, 4.3], "b": [3.8, 5.1, 4.4, 7.0]}


def row(limit, status="optimal", objective=None, price=None, dominated=False):
    return {"limit": limit, "status": status, "objective": objective, "price": price, "dominated": dominated}


ROWS = [
    row(1.0, "infeasible"),
    row(1.2, "infeasible"),
    row(1.3, "optimal", 6.0, 3.0),
    row(1.5, "optimal", 4.0, 1.5),
    row(1.8, "stopped", 3.6),
    row(2.0, "optimal", 3.4, 0.2),
    row(3.0, "optimal", 3.4, 0.0, dominated=True),
    row(3.5, "unbounded"),
]


def front(rows, name="leg_ratio", unit="", words="condition number", tolerances=None):
    """What a figure reads of a front with these rows."""
    designs = [(APART, 0.0), (nd.Geometry.hexagonal(0.0, 6.0, 3.0, 0.0), 0.2)]
    best = [SimpleNamespace(geometry=g, configuration=nd.Configuration.neutral(4.0, 2.0, t)) for g, t in designs]
    return SimpleNamespace(
        table=lambda: rows,
        limit_name=name,
        of_tolerances=name == "tolerance",
        unit=unit,
        study=SimpleNamespace(words=words, unit="" if unit == "rad" else unit, tolerances=tolerances),
        limits=[one["limit"] for one in rows],
        objectives=[math.nan if one["objective"] is None else one["objective"] for one in rows],
        results=[SimpleNamespace(best=best[k > 3]) for k in range(len(rows))],
    )


ACCURACY = [  # the tightest first: the largest tolerance
    row(2.0, "infeasible"),
    *(row(0.5 * k, "optimal", 4.0 + 0.2 * k, 1e-4 * k, dominated=k == 1) for k in (3, 2, 1, 0)),
]


def followed(kappa=None, lengths=LENGTHS, time=TIME, high=np.inf, unit="", forces=None):
    """What a figure reads of a motion."""
    return SimpleNamespace(
        time=time,
        leg_lengths=lengths,
        leg_rates=np.gradient(lengths, time, axis=0),
        leg_forces=forces,
        load_count=0 if forces is None else forces.size // lengths.size,
        force_unit="N" if unit else "",
        condition_number=lengths[:, 0] if kappa is None else kappa,
        limits=(np.zeros(9), np.full(9, high)),
        unit=unit,
    )


@functools.cache
def found():
    return nd.workspace(G, ([-4, -4, 0], [4, 4, 8]), criteria={"leg_limits": (1.5, 6.5)}, tolerance=0.05, home=HOME)


@functools.cache
def proved():
    return nd.certified_workspace(G, ([-4, -4, 2], [4, 4, 6]), criteria={"leg_limits": (1.5, 6.5)}, gap=0.3)


def sections():
    return [
        plot.Section(found().slice("y", 0.0, smooth=True), home=(0.0, 3.98)),
        plot.Section(found().slice("z", 4.0, smooth=True), ((0.0, 0.0), 1.0), ((-1.0, -1.0), (1.0, 1.0)), EDGES[:, :2]),
    ]


def certified():
    marks = {"home": (0.0, 3.98), "estimate": found().slice("y", 0.0, smooth=True)}
    return [plot.Section(proved().section("y", 0.0, 60), **marks), plot.Section(proved().section("z", 4.0, 60))]


def section(kappa, limit=-1):
    """A section of a raster of condition numbers, all but its rim allowed."""
    ticks = np.linspace(0.0, 1.0, kappa.shape[0])
    state, limits = np.full(kappa.shape, 2, dtype=np.uint8), np.full(kappa.shape, limit, dtype=np.int16)
    share = np.ones(kappa.shape)
    share[[0, -1]] = share[:, [0, -1]] = 0.0
    state[share == 0.0] = 1
    return plot.Section(WorkspaceSlice(("x", "z"), ("y", 0.0), ticks, ticks, state, limits, kappa, share))


def space(percentiles=(), names=(), shares=None):
    """What a figure reads of a map."""
    return SimpleNamespace(
        limit_names=names,
        of_angles=False,
        unit="",
        percentiles=np.array(percentiles, dtype=float),
        limits=lambda: shares or {},
    )


def curves(**compared):
    zs, theta = np.linspace(1.5, 3.5, 400), np.radians(np.linspace(-20.0, 20.0, 81))
    along_zs = nd.condition_number(G, nd.Configuration.neutral(3.9828, zs))
    along_theta = nd.condition_number(G, nd.Configuration.neutral(3.9828, 2.3745, theta))
    return plot.DesignCurves("published", zs, along_zs, theta, along_theta, point=(2.3745, 0.0, 3.9110), **compared)


@functools.cache
def region():
    wanted = {"box": [40.0, 30.0, 20.0], "tilt_deg": 5.0}
    free = {"a1": 0.0, "a2": 600.0, "b1": 300.0, "b2": 0.0, "zp": (300.0, 700.0), "zs": (50.0, 650.0)}
    limits = {"base_cone": {"max_deg": 50.0}}
    study = nd.Study(variables=free, constraints=limits, objective={"region": wanted}, unit="mm")
    return nd.region_map(nd.optimize(replace(study, characteristic_length=100.0), starts=2))


def tilts():
    """A disc of tilts along a path: two lines of title, a line more in the legend, panels as wide as they get."""
    one, disc = region(), np.radians(5.0) * toward(np.linspace(0.0, 2.0 * np.pi, 41))
    sides = {"horizontal": one.horizontal * np.radians(5.0) / 40.0, "vertical": one.vertical * np.radians(5.0) / 30.0}
    words = {"axes": ("tilt about x", "tilt about y"), "over": "the path", "compared": {"stroke_ratio": 0.1602}}
    return replace(one, **words, outline=disc, ruled=disc[:1], **sides)


def sweep(index="condition_number", **over):
    return plot.sweep(nd.sweep(G, HOME, over, index, unit="mm"))


def velocities(c, names=("velocity\nṗ", "rotation\nl_c ω")):
    parts = ("translation", "rotation")
    return dict(zip(names, (nd.velocity_ellipsoid(G, c, part) for part in parts), strict=True))


def solids(*semi_axes):
    return {f"{k}": (np.eye(3), half) for k, half in enumerate(semi_axes)}


TOOL, TOOL_ABOVE = nd.Tool((0.0, 0.0, -1.0)), nd.Tool((-0.7, 0.2, 0.9), (0.3, 0.0, 0.1))
FIGURES = {
    "one mechanism": lambda: plot.mechanism(plot.Robot("a title", APART, AWAY), "mm"),
    "mechanism": lambda: plot.mechanisms([plot.Robot("optimum", APART, HOME, 3.9, "a note", [EDGES])], "mm"),
    "mechanisms": lambda: plot.mechanisms([plot.Robot("a", G, HOME, 3.9), plot.Robot("b", APART, AWAY)], "l_c"),
    "a small platform": lambda: plot.mechanisms([plot.Robot("a", FLAT, nd.Configuration.neutral(16.0, 15.0))]),
    "compare": lambda: plot.compare(nd.compare(nd.Design(G, HOME), nd.Design(APART, AWAY))),
    "drawing": lambda: plot.drawing(G, HOME, "mm"),
    "drawing, joints apart": lambda: plot.drawing(APART, AWAY, "m"),
    "drawing, a tool": lambda: plot.drawing(*TOOL.robot(G, HOME), "mm", TOOL),
    "drawing, a tool above": lambda: plot.drawing(*TOOL_ABOVE.robot(APART, AWAY), "m", TOOL_ABOVE),
    "condition": lambda: plot.condition_curves([curves(**COMPARED), curves()], "mm"),
    "objective over poses": lambda: plot.condition_curves([curves(**OVER_POSES)], "mm"),
    "region": lambda: plot.region_map(region()),
    "region without limits": lambda: plot.region_map(replace(region(), margin=None)),
    "region of turns": lambda: plot.region_map(replace(region(), axes=("tilt about x", "tilt about y"), **TURNS)),
    "region of tilts": lambda: plot.region_map(tilts()),
    "poses": lambda: plot.poses(BOTH, POSES),
    "named poses": lambda: plot.poses({"a": range(2, 11)}, [f"x +{k}, y -0.3" for k in range(9)]),
    "singular pose": lambda: plot.poses({"a": [4.0, math.inf, 900.0]}),
    "one pose": lambda: plot.poses({"a": [4.0]}),
    "long names": lambda: plot.poses({"a": [4.0, 4.2, 4.1]}, [f"{LONG}{k}" for k in (1, 2, 3)], note="in mm"),
    "many names": lambda: plot.poses({"a": np.arange(3.0, 53.0)}, [f"pose {k}" for k in range(1, 51)]),
    "all singular": lambda: plot.poses({"a": [math.inf] * 3}),
    "many poses": lambda: plot.poses({n: 4 + np.arange(125) % 7 for n in "abcd"}),
    "convergence": lambda: plot.convergence([DOWN, DOWN], [DOWN, LATER], best=3.0),
    "front": lambda: plot.front(front(ROWS, words="worst condition number over 27 poses"), sketches=0),
    "front with plates": lambda: plot.front(front(ROWS, "height", "m"), sketches=2),
    "front, one point": lambda: plot.front(front([row(2.0, "optimal", 3.7, 0.1)], "radius_ratio"), sketches=0),
    "front, no design": lambda: plot.front(front([row(0.5, "infeasible"), row(0.9, "infeasible")])),
    "wide front": lambda: plot.front(
        front([row(10.0**k, "optimal", 9.0 - k, 0.1) for k in range(-2, 4)], "footprint", "mm"), sketches=0
    ),
    "front of tolerances": lambda: plot.front(front(ACCURACY, "tolerance", "mm", tolerances=nd.Tolerances(0.2, 0.1))),
    "curve": lambda: sweep(x_p=(-1, 1, 21)),
    "legs": lambda: sweep("leg_lengths", x_p=(-1, 1, 21)),
    "map": lambda: sweep(x_p=(-1, 1, 9), y_p=(-1, 1, 9)),
    "curve with a note": lambda: plot.sweep(nd.sweep(G, HOME, {"x_p": (-1, 1, 21)}), note=NOTE),
    "map with a note": lambda: plot.sweep(nd.sweep(G, HOME, {"x_p": (-1, 1, 9), "y_p": (-1, 1, 9)}), note=NOTE),
    "maps": lambda: sweep(z_p=(-1, 1, 5), x_p=(-1, 1, 9), y_p=(-1, 1, 9)),
    "atlas": lambda: plot.atlas(nd.atlas(5_000), (2.0, 3.762659)),
    "workspace": lambda: plot.workspace(found(), sections()),
    "certified": lambda: plot.certified_workspace(certified(), "m"),
    "body": lambda: plot.workspace_body(found().surface(20_000), home=HOME.position, lines=[EDGES], unit="m"),
    "motion": lambda: plot.motion(followed(high=3.05, unit="mm")),
    "motion with forces": lambda: plot.motion(followed(unit="mm", forces=30.0 * LENGTHS - 90.0)),
    "motion with loads": lambda: plot.motion(followed(unit="mm", forces=np.stack([LENGTHS, 50.0 - 9.0 * LENGTHS]))),
    "margins": lambda: plot.motion(followed(), {"leg_length": 0.3 - TIME, "cone": TIME}),
    "two ellipsoids": lambda: plot.ellipsoids(velocities(TILTED)),
    "four ellipsoids": lambda: plot.ellipsoids(
        velocities(TILTED) | {"force": nd.force_ellipsoid(G, TILTED), "sphere": (np.eye(3), np.ones(3))}
    ),
    "singular ellipsoids": lambda: plot.ellipsoids(velocities(SINGULAR)),
    "free in every direction": lambda: plot.ellipsoids(solids([np.inf] * 3)),
    "a disc, a needle and a point": lambda: plot.ellipsoids(solids([2.0, 1.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 0.0])),
    "figure 1": lambda: paper.figure_1(G, AWAY),
    "figure 1, joints apart": lambda: paper.figure_1(APART, AWAY),
    "figure 2": lambda: paper.figure_2(G, HOME, "l_c"),
    "figure 3": lambda: paper.figure_3(APART, HOME, "l_c"),
    "figure 4": lambda: paper.figure_4(*velocities(HOME).values()),
    "figure 5": lambda: paper.figure_5(APART, "l_c"),
    "figure 5, joints coupled": lambda: paper.figure_5(G, "l_c"),
    "figure 6": lambda: paper.figure_6(nd.sweep_figure("6", points=21)),
    "figure 7": lambda: paper.figure_7(nd.sweep_figure("7", points=3)),
}
SLOW = ("maps", "margins", "atlas", "figure 2", "figure 5, joints coupled", "figure 1, joints apart", "four ellipsoids")
QUICK = [name for name in FIGURES if name not in SLOW]


@functools.cache
def made(name):
    """Made once for all tests: none changes it but to draw it."""
    figure = FIGURES[name]()
    with style.settings():
        figure.draw_without_rendering()
    return figure
