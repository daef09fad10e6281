"""A front: the best objective against a limit, its prices, and the limits without a design."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from textwrap import fill
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon

from ninedof.plot import style
from ninedof.robot.plates import outlines
from ninedof.support.arrays import Floats
from ninedof.support.units import amount

if TYPE_CHECKING:
    from ninedof.optimize.candidate import Candidate
    from ninedof.optimize.pareto import Front

Row = Mapping[str, Any]

# Joints are told apart by shape too; where two coincide the smaller lies on the larger.
JOINTS = {
    "base, external": {"color": style.EXTERNAL, "marker": "o", "ms": 6.5, "mec": "white", "mew": 0.5, "ls": ""},
    "base, internal": {"color": style.LOWER, "marker": "s", "ms": 3.8, "mec": "white", "mew": 0.5, "ls": ""},
    "platform, external": {"color": style.EXTERNAL, "marker": "o", "ms": 6.5, "mfc": "white", "mew": 1.1, "ls": ""},
    "platform, internal": {"color": style.UPPER, "marker": "D", "ms": 3.2, "mec": "white", "mew": 0.4, "ls": ""},
}
MOST_LETTERS = 72  # of a line of the title
MARKS = {  # marks of a limit with a design
    "optimal": {"color": style.SERIES[0], "marker": "o"},
    "no better than a tighter limit": {"color": style.SERIES[0], "marker": "o", "mfc": "white"},
    "found, not an optimum": {"color": style.ALARM, "marker": "D"},
}
NONE = {"infeasible": ("X", "no design"), "unbounded": ("v", "unbounded"), "stopped": ("P", "nothing found")}


def front(front: Front, sketches: int = 4, figure: Figure | None = None) -> Figure:
    """Return a figure of a front.

    Top: the objective at each limit; limits without a design are crosses on a grey background. Below: the price of each
    limit, and the plates of a few designs from above, all at one scale. A design that is the mirror image of one like
    its neighbour is drawn mirrored, and its title says so. Limits on angles are drawn in degrees.

    Parameters
    ----------
    front : Front
    sketches : int
        Number of designs whose plates are drawn, from the tightest limit to the loosest; at most five.
    figure : matplotlib.figure.Figure or SubFigure, optional
        To draw in; a new one by default.

    Raises
    ------
    ValueError
        If no limit of the front is finite.

    Examples
    --------
    >>> import ninedof as nd
    >>> figure = nd.plot.front(nd.pareto(nd.Study.paper(), "radius_ratio", values=[1.5, 2.0, 3.0]))

    """
    radians = front.unit == "rad"
    scale, unit = (180.0 / math.pi, "deg") if radians else (1.0, front.unit)
    rows = [{**row, "limit": scale * row["limit"]} for row in front.table() if math.isfinite(row["limit"])]
    if not rows:
        raise ValueError(f"front: got {len(front.limits)} limits, none of them finite, expected at least one")
    designs = _designs(front, min(sketches, 5))
    with style.page(figure, style.TWO_COLUMNS, 6.1 if designs else 4.3) as figure:
        share = 1.8 / 6.1 if designs else 0.0
        upper = figure.add_axes((0.09, share + 0.44 * (1 - share), 0.895, 0.475 * (1 - share)))
        lower = figure.add_axes((0.09, share + 0.115 * (1 - share), 0.895, 0.225 * (1 - share)), sharex=upper)
        _objective(upper, rows, front)
        _prices(lower, rows, front.of_tolerances)
        lower.set_xlabel(style.with_unit(_axis_words(front), unit))
        _limits((upper, lower), rows)
        if designs:
            titles = [f"at {amount(f'{scale * front.limits[k]:.4g}', unit)}" for k in designs]
            _sketches(figure, titles, _alike([_joints(one) for one in designs.values()]), front.study.unit, share)
    return figure


def _designs(front: Front, most: int) -> dict[int, Candidate]:
    """Return a few designs by the number of their limit, from the tightest to the loosest."""
    good = {
        k: result.best for k, result in enumerate(front.results) if result.best and not math.isnan(front.objectives[k])
    }
    picked, numbers = np.linspace(0, len(good) - 1, min(most, len(good))), list(good)
    return {numbers[round(k)]: good[numbers[round(k)]] for k in picked}


def _axis_words(front: Front) -> str:
    built = front.study.tolerances
    if not front.of_tolerances:
        return f"largest {front.limit_name.replace('_', ' ')} allowed"
    if not built or built.joints == built.legs:
        return "tolerance of joints and legs"
    small, large = sorted(("joints", "legs"), key=lambda name: getattr(built, name))
    return f"tolerance of {large}, that of {small} {getattr(built, small) / getattr(built, large):.3g} times it"


def _objective(axes: Any, rows: Sequence[Row], front: Front) -> None:
    objective, of_tolerances = front.study.words, front.of_tolerances
    solved_rows = [row for row in rows if row["objective"] is not None]
    x, y = (np.array([row[key] for row in solved_rows]) for key in ("limit", "objective"))
    axes.plot(x, y, color=style.SERIES[0], zorder=2)
    used = set()
    for row in solved_rows:
        kind = list(MARKS)[2 if row["status"] != "optimal" else int(row["dominated"])]
        mark = MARKS[kind] | {"mfc": "white"} if row["dominated"] else MARKS[kind]
        axes.plot(row["limit"], row["objective"], **mark, ms=5, mew=1.1, zorder=4)
        used |= {kind} | ({list(MARKS)[1]} if row["dominated"] else set())
    axes.set_title(fill(f"{objective}: the least for each {'tolerance' if of_tolerances else 'limit'}", MOST_LETTERS))
    axes.set_ylabel(fill(objective if len(objective) < 70 else objective.split(" over ")[0], 34))
    if len(y):
        room = 0.08 * max(np.ptp(y), 0.02 * y.max())
        axes.set_ylim(y.min() - room, y.max() + 1.6 * room)
    else:
        axes.set(ylim=(0.0, 1.0), yticks=[])
    bottom = axes.get_ylim()[0]
    axes.tick_params(labelbottom=False)
    labels = {kind: kind.replace("tighter limit", "larger tolerance") if of_tolerances else kind for kind in MARKS}
    keys = [style.key(**MARKS[kind], ls="", ms=5, mew=1.1, label=labels[kind]) for kind in MARKS if kind in used]
    for status, (marker, words) in NONE.items():
        without = [row["limit"] for row in rows if row["objective"] is None and row["status"] == status]
        cross = {"color": style.ALARM, "marker": marker, "ls": "", "ms": 8, "mec": "white"}
        for limit in without:
            axes.plot(limit, bottom, **cross, clip_on=False, zorder=6)
        keys += [style.key(**cross, mew=0.8, label=words)] * bool(without)
    axes.legend(handles=keys, loc="upper left" if of_tolerances else "upper right")  # where the front is low


def _prices(axes: Any, rows: Sequence[Row], is_tolerance: bool) -> None:
    priced = [(row["limit"], row["price"]) for row in rows if row["price"] is not None]
    if priced:
        x, y = np.array(priced).T
        axes.vlines(x, 0.0, y, color=style.SERIES[2], lw=1.6)
        axes.plot(x, y, "o", ms=4, color=style.SERIES[2], mec="white", mew=0.8, zorder=3, clip_on=False)
        axes.set_ylim(0.0, 1.25 * max(y.max(), 1e-5))
    else:
        axes.set_yticks([])
    relaxed = "a tolerance 1 % smaller" if is_tolerance else "a limit 1 % looser"
    axes.set_title(f"price: what {relaxed} gains, to first order", size=style.TEXT_SIZE)
    axes.set_ylabel("price (%)")


def _limits(panels: Sequence[Any], rows: Sequence[Row]) -> None:
    """Set the axis of limits, logarithmic for a wide range, with a grey background where no design exists."""
    limits = [row["limit"] for row in rows]
    low, high = min(limits), max(limits)
    if high > 4.0 * low > 0.0:
        margin = (high / low) ** 0.035
        view = (low / margin, high * margin)
        panels[0].set_xscale("log")
        style.one_two_five(panels[0].xaxis)
    else:
        margin = 0.035 * max(high - low, 0.1 * abs(high))
        view = (low - margin, high + margin)
    panels[0].set_xlim(view)
    with_design = [row["limit"] for row in rows if row["objective"] is not None]
    without = [row["limit"] for row in rows if row["status"] == "infeasible"]
    if without and max(without) < min(with_design, default=math.inf):
        ground = view[0], max(without)
    elif without and min(without) > max(with_design):  # of tolerances
        ground = min(without), view[1]
    else:
        return
    for axes in panels:
        axes.axvspan(*ground, color=style.GRID, lw=0, zorder=0)


def _sketches(
    figure: Any, titles: Sequence[str], designs: Sequence[tuple[Floats, bool]], unit: str, share: float
) -> None:
    """Draw plates from above in a row at one scale, with its bar; a design: joints and whether they are mirrored."""
    width = 0.895 / len(designs)
    words = "plates from above at one scale, base dark, platform light; joints:"
    figure.text(0.09, share - 0.02, words, size=style.SMALL_SIZE)
    keys = [style.key(**mark, label=kind) for kind, mark in JOINTS.items()]
    figure.legend(handles=keys, loc="upper left", bbox_to_anchor=(0.085, share - 0.02), ncols=4, columnspacing=1.0)
    reach = 1.12 * max(np.abs(joints).max() for joints, _ in designs)
    for k, (title, (joints, mirrored)) in enumerate(zip(titles, designs, strict=True)):
        axes = figure.add_axes((0.09 + k * width, 0.005, width, share - 0.095))
        axes.set(xlim=(-reach, reach), ylim=(-reach, reach), aspect="equal")
        axes.set_axis_off()
        axes.set_title(title + ", mirrored" * mirrored, size=style.SMALL_SIZE, loc="center", pad=2, weight="normal")
        for body, colour, alpha in ((joints[:6], style.BASE, 0.88), (joints[6:], style.PLATFORM, 0.62)):
            for outline in outlines(np.column_stack([body, np.zeros(6)])):
                axes.add_patch(Polygon(outline[:, :2], fc=colour, ec=style.INK, lw=0.8, alpha=alpha))
        for mark, three in zip(JOINTS.values(), np.split(joints, 4), strict=True):
            axes.plot(*three.T, **mark)
    bar = style.round_to(0.5 * reach, 25.0 * 0.5 * reach)
    right, y = 0.985, share - 0.014
    across, up = style.inches(figure)
    long = bar / (2.0 * reach) * min(width * across, (share - 0.095) * up) / across
    line = Line2D([right - long, right], [y, y], color=style.INK, lw=1.2, marker="|", ms=4, label="scale")
    figure.add_artist(line)
    words = amount(f"{bar:g}", unit)
    figure.text(right - long - 0.008, y, words, size=style.SMALL_SIZE, ha="right", va="center")


def _alike(designs: Sequence[Floats]) -> list[tuple[Floats, bool]]:
    """Return joints (12, 2), mirrored in x or y where that is closer to the design before, and whether they are."""
    out: list[tuple[Floats, bool]] = []
    for joints in designs:
        images = [joints * [1.0, 1.0], joints * [1.0, -1.0], joints * [-1.0, 1.0]]
        apart = [_apart(image, out[-1][0]) if out else 0.0 for image in images]
        best = int(np.argmin(apart))
        clear = apart[best] < 0.5 * apart[0]
        out.append((images[best if clear else 0], clear))
    return out


def _apart(a: Floats, b: Floats) -> float:
    """Return how far the four triples of two designs are apart, each joint from the nearest of the other design."""
    pairs = zip(np.split(a / np.abs(a).max(), 4), np.split(b / np.abs(b).max(), 4), strict=True)
    gaps = [np.linalg.norm(one[:, None] - other, axis=-1) for one, other in pairs]
    return float(sum(gap.min(axis=0).sum() + gap.min(axis=1).sum() for gap in gaps))


def _joints(design: Candidate) -> Floats:
    """Return base joints, then platform joints turned by the twist, from above: shape (12, 2)."""
    g, turn = design.geometry, design.configuration.rotation
    platform = np.vstack([g.platform_external, g.platform_internal]) @ turn.T
    return np.vstack([g.base_external, g.base_internal, platform])[:, :2]
