"""A front: the best objective against a limit, its prices, and the limits without a design."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from textwrap import fill
from typing import Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from ninedof.plot import style
from ninedof.plot.arguments import SMALLEST, number, things
from ninedof.plot.plates import outlines
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import choice, flag, instance, items, text
from ninedof.support.arrays import Floats
from ninedof.support.units import amount


class Sketch(NamedTuple):
    """A design of the front, for a drawing from above."""

    limit: float
    geometry: Geometry
    theta_z: float = 0.0
    """Twist of its platform, radians."""


# Joints are told apart by shape too; where two coincide the smaller lies on the larger.
JOINTS: tuple[tuple[str, str, dict[str, Any]], ...] = (
    ("base, external", style.EXTERNAL, {"marker": "o", "ms": 6.5, "mec": "white", "mew": 0.5, "ls": ""}),
    ("base, internal", style.LOWER, {"marker": "s", "ms": 3.8, "mec": "white", "mew": 0.5, "ls": ""}),
    ("platform, external", style.EXTERNAL, {"marker": "o", "ms": 6.5, "mfc": "white", "mew": 1.1, "ls": ""}),
    ("platform, internal", style.UPPER, {"marker": "D", "ms": 3.2, "mec": "white", "mew": 0.4, "ls": ""}),
)

COLUMNS = ("limit", "status", "objective", "price", "dominated")
MOST_SKETCHES = 5
MOST_LETTERS = 72  # of a line of the title
MARKS = {"optimal": "o", "stopped": "D"}
NONE = {"infeasible": ("X", "no design"), "unbounded": ("v", "unbounded"), "stopped": ("P", "nothing found")}


def front(
    rows: Sequence[Mapping[str, Any]],
    against: str,
    objective: str = "condition number",
    unit: str = "",
    sketches: Sequence[Sketch] = (),
) -> Figure:
    """Return a figure of a front.

    Top: the objective at each limit; limits without a design are crosses on a grey background. Below: the price of each
    limit, and the plates of a few designs from above.

    Parameters
    ----------
    rows : sequence of mappings
        The rows of `ninedof.pareto.Front.table`: limit, status, objective, price, dominated.
    against : str
        Name of the limit; of "base_cone_deg" the limits are in degrees.
    objective : str
        Name of the objective.
    unit : str
        Of the limit, as `ninedof.Front.unit`. Limits in "rad" are drawn in degrees.
    sketches : sequence of Sketch
        At most five designs.

    Raises
    ------
    ValueError
        If there are no rows, or none with a finite limit.

    Examples
    --------
    >>> from ninedof import plot
    >>> from ninedof.plot.front import front
    >>> rows = [
    ...     {"limit": 1.5, "status": "optimal", "objective": 3.94, "price": 0.2, "dominated": False},
    ...     {"limit": 2.0, "status": "optimal", "objective": 3.76, "price": 0.1, "dominated": False},
    ... ]
    >>> figure = front(rows, "radius_ratio")

    """
    rows = _rows(rows)
    for name, words in (("against", against), ("objective", objective), ("unit", unit)):
        text(name, words)
    sketches = things("sketches", sketches, Sketch, MOST_SKETCHES, least=0)
    for k, sketch in enumerate(sketches):
        number(f"sketches[{k}].limit", sketch.limit)
        instance(f"sketches[{k}].geometry", sketch.geometry, Geometry)
        number(f"sketches[{k}].theta_z", sketch.theta_z)
    if "_deg" in against:
        against, unit = against.replace("_deg", ""), "deg"
    shown = [row for row in rows if math.isfinite(row["limit"])]
    if unit == "rad":
        shown, unit = [{**row, "limit": math.degrees(row["limit"])} for row in shown], "deg"
        sketches = [sketch._replace(limit=math.degrees(sketch.limit)) for sketch in sketches]
    if not shown:
        raise ValueError(f"rows: got {len(rows)} without a finite limit, expected at least one")
    with style.settings():
        figure = style.new_figure(style.TWO_COLUMNS, 6.1 if sketches else 4.3)
        share = 1.8 / 6.1 if sketches else 0.0
        upper = figure.add_axes((0.09, share + 0.44 * (1 - share), 0.895, 0.475 * (1 - share)))
        lower = figure.add_axes((0.09, share + 0.115 * (1 - share), 0.895, 0.225 * (1 - share)), sharex=upper)
        name = style.with_unit(f"largest {against.replace('_', ' ')} allowed", unit)
        _objective(upper, shown, objective)
        _prices(lower, shown, name)
        _limits(upper, shown)
        if sketches:
            _sketches(figure, upper, sketches, share, unit)
        _legend(figure, upper, shown)
    return figure


def _rows(rows: Any) -> list[Mapping[str, Any]]:
    """Return the rows, each with what is drawn of it."""
    out = []
    for k, row in enumerate(items("rows", rows, "the rows of a front")):
        where = f"rows[{k}]"
        if missing := [key for key in COLUMNS if key not in instance(where, row, Mapping)]:  # type: ignore[type-abstract]
            raise ValueError(f"{where}: got a row without {', '.join(missing)}, expected {', '.join(COLUMNS)}")
        number(f"{where}.limit", row["limit"], infinite=True)
        for key in ("objective", "price"):
            if row[key] is not None:
                number(f"{where}.{key}", row[key])
        text(f"{where}.status", row["status"])
        if row["objective"] is None:
            choice(f"{where}.status", row["status"], NONE)
        flag(f"{where}.dominated", row["dominated"])
        out.append(row)
    return out


def _objective(axes: Any, rows: Sequence[Mapping[str, Any]], objective: str) -> None:
    found = [row for row in rows if row["objective"] is not None]
    x, y = (np.array([row[key] for row in found], dtype=np.float64) for key in ("limit", "objective"))
    axes.plot(x, y, color=style.SERIES[0], zorder=2)
    for row in found:
        colour = style.ALARM if row["status"] != "optimal" else style.SERIES[0]
        face = "white" if row["dominated"] else colour
        mark = MARKS.get(row["status"], "D")
        axes.plot(row["limit"], row["objective"], mark, ms=5, mfc=face, mec=colour, mew=1.1, zorder=4)
    axes.set_title(fill(f"{objective}: the least for each limit", MOST_LETTERS))
    axes.set_ylabel(fill(objective, 34) if len(objective) < 70 else "objective")
    if len(y):
        room = 0.08 * max(float(np.ptp(y)), 0.02 * float(y.max()))
        axes.set_ylim(float(y.min()) - room, float(y.max()) + 1.6 * room)
    axes.tick_params(labelbottom=False)


def _prices(axes: Any, rows: Sequence[Mapping[str, Any]], name: str) -> None:
    priced = [(row["limit"], row["price"]) for row in rows if row["price"] is not None]
    if priced:
        x, y = np.array(priced, dtype=np.float64).T
        axes.vlines(x, 0.0, y, color=style.SERIES[2], lw=1.6)
        axes.plot(x, y, "o", ms=4, color=style.SERIES[2], mec="white", mew=0.8, zorder=3, clip_on=False)
        axes.set_ylim(0.0, 1.25 * max(float(y.max()), 1e-3))
    else:
        axes.set_yticks([])
    axes.set_title("price: what a limit 1 % looser gains", size=style.TEXT_SIZE)
    axes.set(xlabel=name, ylabel="gain (%)")


def _limits(axes: Any, rows: Sequence[Mapping[str, Any]]) -> None:
    """Set the axis of limits, logarithmic for a wide range, and mark limits without a design."""
    limits = np.array([row["limit"] for row in rows], dtype=np.float64)
    low, high = float(limits.min()), float(limits.max())
    if high > 4.0 * low > SMALLEST:
        margin = (high / low) ** 0.035
        view = (low / margin, high * margin)
        axes.set_xscale("log")
        style.one_two_five(axes.xaxis)
    else:
        margin = max(0.035 * max(high - low, 0.1 * abs(high)), 1e-9)  # a denormal limit has a place too
        view = (low - margin, high + margin)
    axes.set_xlim(view)
    first = min((row["limit"] for row in rows if row["objective"] is not None), default=None)
    infeasible = [row["limit"] for row in rows if row["status"] == "infeasible"]
    bottom = axes.get_ylim()[0]
    for row in rows:
        if row["objective"] is None:
            mark = NONE[row["status"]][0]
            axes.plot(row["limit"], bottom, mark, ms=8, color=style.ALARM, mec="white", clip_on=False, zorder=6)
    if infeasible and (first is None or max(infeasible) < first):
        for each in axes.figure.axes:
            each.axvspan(view[0], max(infeasible), color=style.GRID, lw=0, zorder=0)


def _legend(figure: Figure, axes: Any, rows: Sequence[Mapping[str, Any]]) -> None:
    """Add a legend of the marks in the figure."""
    plain: dict[str, Any] = {"ls": "", "ms": 5, "mew": 1.1}
    keys = []
    if any(row["status"] == "optimal" and not row["dominated"] for row in rows):
        keys.append(style.key(style.SERIES[0], marker="o", label="optimal", **plain))
    if any(row["dominated"] for row in rows):
        label = "no better than a tighter limit"
        keys.append(style.key(style.SERIES[0], marker="o", mfc="white", label=label, **plain))
    if any(row["status"] != "optimal" and row["objective"] is not None for row in rows):
        keys.append(style.key(style.ALARM, marker="D", label="found, not an optimum", **plain))
    for status, (mark, words) in NONE.items():
        if any(row["status"] == status and row["objective"] is None for row in rows):
            keys.append(style.key(style.ALARM, marker=mark, label=words, ls="", ms=8, mec="white", mew=0.8))
    axes.legend(handles=keys, loc="upper right")


def _sketches(figure: Figure, upper: Any, sketches: Sequence[Sketch], share: float, unit: str) -> None:
    """Draw plates from above in one row, in the order of their limits."""
    ordered = sorted(sketches, key=lambda sketch: sketch.limit)
    width = 0.895 / len(ordered)
    words = "plates from above, each at its own scale, base dark, platform light; joints:"
    figure.text(0.09, share - 0.02, words, size=style.SMALL_SIZE)
    keys = [style.key(colour, label=words, **mark) for words, colour, mark in JOINTS]
    figure.legend(handles=keys, loc="upper left", bbox_to_anchor=(0.085, share - 0.02), ncols=4, columnspacing=1.0)
    for k, sketch in enumerate(ordered):
        reach = float(np.abs(_joints(sketch)[:, :2]).max())
        axes = figure.add_axes((0.09 + k * width, 0.005, width, share - 0.095))
        axes.set(xlim=(-1.12 * reach, 1.12 * reach), ylim=(-1.12 * reach, 1.12 * reach), aspect="equal")
        axes.set_axis_off()
        axes.set_title(
            f"at {amount(f'{sketch.limit:.4g}', unit)}", size=style.SMALL_SIZE, loc="center", pad=2, weight="normal"
        )
        joints = _joints(sketch)
        for body, colour, alpha in ((joints[:6], style.BASE, 0.88), (joints[6:], style.PLATFORM, 0.62)):
            flat = np.column_stack([body[:, :2], np.zeros(6)])
            for outline in outlines(flat):
                axes.add_patch(Polygon(outline[:, :2], fc=colour, ec=style.INK, lw=0.8, alpha=alpha))
        for (_, colour, mark), three in zip(JOINTS, np.split(joints, 4), strict=True):
            axes.plot(*three[:, :2].T, color=colour, **mark)


def _joints(sketch: Sketch) -> Floats:
    """Return base joints, then platform joints turned by the twist, shape (12, 3)."""
    g, cosine, sine = sketch.geometry, math.cos(sketch.theta_z), math.sin(sketch.theta_z)
    turn = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
    platform = np.vstack([g.platform_external, g.platform_internal]) @ turn.T
    return np.vstack([g.base_external, g.base_internal, platform])
