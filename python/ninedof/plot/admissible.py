"""Sets of admissible designs: planes of two variables with what is proved inside, what is outside by which limit."""

from __future__ import annotations

from itertools import combinations, cycle
from textwrap import fill
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.patches import Patch, PathPatch
from matplotlib.path import Path

from ninedof.plot import style
from ninedof.plot.workspace import KINDS
from ninedof.support.arrays import Floats

if TYPE_CHECKING:
    from ninedof.proof.admissible.result import AdmissibleSet

INSIDE, UNDECIDED = "#A9CCE3", "#B8BFC6"
# Of limits that have no colour elsewhere; none is near blue.
OTHERS = ("#E69F00", "#F0E442", "#882255", "#009E73", "#999933")
# The colours are near each other in grey print: what is proved inside and what is undecided differ in lines too.
LINES: dict[int, Any] = {
    0: {"hatch": "///", "edgecolor": "white", "lw": 0.0},
    2: {"hatch": "xxxxxx", "edgecolor": style.MUTED, "lw": 0.0},
}
"""Of states by their number."""
PALE = 0.55  # of a limit's colour that is left: outside is ground, not figure
LETTER = 0.056  # inches, of the smallest words
MARK = style.HOME | {"marker": "D", "ms": 5.0, "clip_on": False}


def admissible(designs: AdmissibleSet, figure: Figure | None = None) -> Figure:
    """Return a figure of a set of admissible designs: a plane for every two of its variables, through the design.

    Inside, with light lines, and outside, in the colour of the limit that all designs of a box break, are proved; what
    is crossed is undecided. Lines of the worst condition number are sampled, proved nowhere. Angles are in degrees.

    Parameters
    ----------
    designs : AdmissibleSet
        As `ninedof.admissible` returns it; of two to four variables.
    figure : matplotlib.figure.Figure or SubFigure, optional
        To draw in, with a constrained layout; a new one by default.

    Raises
    ------
    ValueError
        For a set of one variable.

    Examples
    --------
    >>> import ninedof as nd
    >>> study = nd.Study(variables={"a1": 0.0, "a2": (2.0, 10.0), "b1": (1.0, 5.0), "b2": 0.0})
    >>> designs = nd.admissible(study, ("a2", "b1"), at={"zp": 4.9752, "zs": 3.1681}, condition_number=3.911)
    >>> figure = nd.plot.admissible(designs)

    """
    count = len(designs.vary)
    if count < 2:
        raise ValueError(f"designs: got a set of {designs.vary[0]} alone, expected two to four variables")
    planes = list(combinations(range(count), 2))
    columns = min(len(planes), 3)
    rows = -(-len(planes) // columns)
    wide = style.ONE_COLUMN + 0.9 if columns == 1 else style.TWO_COLUMNS
    colours = _colours(designs)
    words = fill(designs.of.held, round(wide / LETTER), break_on_hyphens=False)
    with style.page(figure, wide, 2.6 * rows + 0.6 + 0.1 * (words.count("\n") + 1), layout="constrained") as figure:
        axes: Any = figure.subplots(rows, columns, squeeze=False).reshape(-1)
        lines = False
        for panel, (i, j) in zip(axes, planes, strict=False):
            _plane(panel, designs, i, j, colours)
            lines |= _iso_lines(panel, designs, i, j)
        for panel in axes[len(planes) :]:
            panel.set_axis_off()
        keys: list[Any] = [Patch(facecolor=INSIDE, label="every limit kept, proved", **LINES[0])]
        keys += [Patch(color=colours[name], label=f"outside: {name.replace('_', ' ')}") for name in designs.excluded]
        keys += [Patch(facecolor=UNDECIDED, label="undecided", **LINES[2]), style.key(**MARK, label="design")]
        keys += [style.key(style.INK, lw=0.8, label="worst condition number, sampled")] if lines else []
        figure.suptitle(words, fontsize=style.SMALL_SIZE, color=style.MUTED)
        figure.legend(handles=keys, loc="outside lower center", ncols=2 if columns == 1 else 4)
    return figure


def _colours(designs: AdmissibleSet) -> dict[str, Any]:
    """Return the pale colour of each limit that excludes something."""
    others = cycle(OTHERS)
    out = {}
    for name in designs.excluded:
        kind = "det" if name == "no singularity" else name.partition(" at ")[0].removeprefix("condition_number")
        kind = next((key for key in KINDS if len(key) > 1 and kind.startswith(key)), "")
        strong = np.array(to_rgb(KINDS[kind][1] if kind else next(others)))
        out[name] = tuple(PALE * strong + (1.0 - PALE))
    return out


def _plane(axes: Any, designs: AdmissibleSet, i: int, j: int, colours: dict[str, Any]) -> None:
    """Fill the pieces that the plane through the design meets."""
    names = designs.vary
    here = np.array([designs.of.at[name] for name in names])
    others = [k for k in range(len(names)) if k not in (i, j)]
    ends = np.array(designs.of.ranges)
    high_end = designs.high[:, others] == ends[others, 1]  # the last pieces have their upper ends
    there = (designs.low[:, others] <= here[others]) & ((here[others] < designs.high[:, others]) | high_end)
    met = there.all(axis=1)
    low, high = (_shown(designs, end[met][:, [i, j]], i, j) for end in (designs.low, designs.high))
    faces = [
        INSIDE if state == 0 else UNDECIDED if state == 2 else colours[designs.demands[demand][0]]
        for state, demand in zip(designs.state[met].tolist(), designs.demand[met].tolist(), strict=True)
    ]
    boxes = style.corners(low, high)
    axes.add_collection(
        PolyCollection(list(boxes), facecolors=faces, edgecolors=faces, linewidths=0.2, rasterized=True)
    )
    for state, lines in LINES.items():
        area = Path.make_compound_path_from_polys(boxes[designs.state[met] == state])
        axes.add_patch(PathPatch(area, facecolor="none", **lines, rasterized=True))
    limits = _shown(designs, ends[[i, j]].T, i, j)
    axes.set(xlim=limits[:, 0], ylim=limits[:, 1])
    labels = [style.with_unit(names[k], designs.study.unit_of(names[k])) for k in (i, j)]
    axes.set(xlabel=labels[0], ylabel=labels[1])
    axes.grid(visible=False)
    axes.plot(*_shown(designs, here[[i, j]][None], i, j)[0], **MARK)
    if others:
        axes.set_title(
            designs.of.values([names[k] for k in others]).replace(", ", ",\n"), size=style.SMALL_SIZE, weight="normal"
        )


def _shown(designs: AdmissibleSet, values: Floats, i: int, j: int) -> Floats:
    """Return values of two variables as they are shown: angles in degrees."""
    turned = [designs.vary[k] in designs.study.angles for k in (i, j)]
    return np.where(turned, np.degrees(values), values)


def _iso_lines(axes: Any, designs: AdmissibleSet, i: int, j: int) -> bool:
    """Draw lines of the worst condition number over a sample of poses; return whether it could be computed."""
    sampled = designs.of.sampled_condition(i, j)
    if sampled is None or not np.isfinite(sampled[2]).any():
        return False
    x, y, worst = sampled
    low, high = style.finite_range(worst)
    shown = _shown(designs, np.column_stack([x, y]), i, j)
    levels = style.round_levels(low, min(high, 3.0 * low), 7)
    drawn = style.condition_lines(axes, shown[:, 0], shown[:, 1], worst, levels, colors=style.INK, linewidths=0.7)
    if drawn is None:
        return False
    axes.clabel(drawn, fontsize=style.SMALL_SIZE - 1, fmt=lambda inverse: f"{1.0 / inverse:g}")
    return True
