"""The condition number at each pose of one or more designs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from ninedof.plot import style
from ninedof.support.arrays import Floats
from ninedof.support.text import escaped

MOST_NAMED = 40  # poses with names; for more poses the axis has a few numbers
LONGEST = 24  # letters of a name on the axis; longer ones are a list below it, by number
WORST_NAMED = 9  # of more poses than MOST_NAMED, those in the list
LETTER, LINE = 0.056, 0.135  # inches, of the list
LEAST_SPAN = 0.2  # of the least value, shown by the axis
TALL = 1.9  # inches, of the axes
WORST = (0, (5, 3))


def poses(
    designs: Mapping[str, ArrayLike],
    names: Sequence[str] = (),
    index: str = "condition number",
    note: str = "",
    ax: Any = None,
) -> Figure:
    """Return a figure of the condition number at each pose: a mark for each design, its worst value as a dashed line.

    There are no bars, as the axis does not begin at zero; it shows at least a fifth of the least value, so that small
    differences look small. Long names are listed below the axis by number; of more than 40 poses those of the worst.

    Parameters
    ----------
    designs : mapping of str to array_like of shape (n,)
        The condition number at each pose, infinite where singular, of one to four designs by name.
    names : sequence of str
        Names of the poses; their numbers by default.
    index : str
        Name of the index.
    note : str
        Words above that list, such as the unit.
    ax : matplotlib.axes.Axes, optional
        Axes to draw on, with room below them for names; those of a new figure by default.

    Raises
    ------
    ValueError
        If there are no designs, too many, or their numbers of poses differ.

    Examples
    --------
    >>> from ninedof import plot
    >>> designs = {"robust": [4.1, 4.3, 4.2], "neutral only": [3.8, 4.9, 4.4]}
    >>> figure = plot.poses(designs, names=["neutral", "x + 0.1", "x - 0.1"])

    """
    style.counted("designs", designs, len(style.SERIES))
    values = [np.atleast_1d(np.asarray(conditions, dtype=np.float64)) for conditions in designs.values()]
    count = values[0].size
    if any(v.shape != (count,) for v in values) or not count:
        raise ValueError(f"designs: got conditions of shapes {[v.shape for v in values]}, expected one shape (n,)")
    if len(names) not in (0, count):
        raise ValueError(f"names: got {len(names)}, expected {count}, one a pose")
    names = [escaped(name) for name in names]  # those of ticks are written while they are drawn
    longest = max(map(len, names), default=0)
    entries = _listed(values, names) if longest > LONGEST or count > MOST_NAMED else []
    if entries:
        names, longest = [], 0
    single = count <= 12 and not entries
    slanted = count <= MOST_NAMED and (longest > 6 or (longest > 0 and count > 12))
    width = style.ONE_COLUMN if single else style.TWO_COLUMNS
    columns = [] if not entries else _columns(entries, width)
    under = max(0.4, 0.12 + 0.052 * longest)  # inches, for slanted names
    below = under + (LINE * (len(columns[0]) + bool(note)) + 0.1 if columns else 0.0)
    height = TALL + below + 0.1 + 0.155 * (len(values) if single else -(-len(values) // 2))  # with the key
    left = 0.5 / width + (0.02 * longest / width if slanted else 0.0)
    place = (left, below / height, 1.0 - left - 0.1 / width, TALL / height)
    with style.panel(ax, width, height, place) as (figure, axes):
        axes.set_ylabel(index)
        _scale(axes, values)
        keys = []
        for k, (name, v) in enumerate(zip(designs, values, strict=True)):
            _one(axes, v, k, len(values))
            keys.append(
                style.key(
                    style.SERIES[k], marker=style.MARKS[k], ms=5, lw=0.8, ls=WORST, mec="white", label=_label(name, v)
                )
            )
        _names(axes, names, count, slanted)
        _write(axes, columns, note, under)
        axes.legend(
            handles=keys,
            loc="lower left",
            bbox_to_anchor=(0.0, 1.0),
            borderaxespad=0.7,
            ncols=1 if single else 2,
            handlelength=3.0,
            borderpad=0.2,
        )
    return figure


def _listed(values: Sequence[Floats], names: Sequence[str]) -> list[str]:
    """Return the lines of the list: all poses, or the worst of many in the order of their numbers."""
    numbers = list(range(len(names)))
    if len(names) > MOST_NAMED:
        numbers = sorted(np.argsort(-np.max(values, axis=0), kind="stable")[:WORST_NAMED].tolist())
    return [f"{k + 1}: {names[k]}" for k in numbers]


def _columns(lines: Sequence[str], width: float) -> list[Sequence[str]]:
    """Return the list in as many columns as there is room for, the first the longest."""
    count = max(1, int((width - 0.5) / (LETTER * (2 + max(map(len, lines))))))
    rows = -(-len(lines) // count)
    return [lines[k : k + rows] for k in range(0, len(lines), rows)]


def _write(axes: Any, columns: Sequence[Sequence[str]], note: str, below: float) -> None:
    heads = bool(columns and note)
    lines = [(0, 0, note, style.MUTED)] * heads
    lines += [(k, row + heads, words, style.INK) for k, each in enumerate(columns) for row, words in enumerate(each)]
    for k, row, words, colour in lines:
        at = (0.0, -72.0 * (below + (row + 0.4) * LINE))
        axes.annotate(
            words,
            (k / len(columns), 0.0),
            at,
            color=colour,
            va="top",
            annotation_clip=False,
            xycoords="axes fraction",
            textcoords="offset points",
            size=style.SMALL_SIZE,
        )


def _label(name: str, values: Floats) -> str:
    worst = values.max()
    if len(values) == 1:
        return f"{name}: {worst:.4g}"
    return f"{name}: worst {worst:.4g}" if np.isfinite(worst) else f"{name}: singular at some"


def _scale(axes: Any, values: Sequence[Floats]) -> None:
    """Show the finite values up to style.RANGE times the least, on a logarithmic axis if they span a factor of 3."""
    low, high = style.finite_range(np.concatenate(values), (1.0, 2.0))
    high = min(high, style.RANGE * low)
    if high > 3.0 * low:
        axes.set_yscale("log")
        style.one_two_five(axes.yaxis)
        axes.set_ylim(low / 1.15, high * 1.15)
    else:
        middle, half = 0.5 * (low + high), 0.5 * max(1.2 * (high - low), LEAST_SPAN * low)
        axes.set_ylim(middle - half, middle + half)


def _one(axes: Any, values: Floats, k: int, count: int) -> None:
    """Draw one design: its values beside those of the others, its worst value as a line."""
    x = np.arange(len(values)) + (k - 0.5 * (count - 1)) * min(0.16, 0.5 / count)
    top, colour = axes.get_ylim()[1], style.SERIES[k]
    off = ~(values <= top)
    size = 5.0 if len(values) <= MOST_NAMED else 3.0
    axes.plot(x[~off], values[~off], style.MARKS[k], ms=size, color=colour, mec="white", mew=0.6, zorder=4)
    if off.any():
        axes.plot(x[off], np.full(off.sum(), top), "^", ms=size + 3, color=colour, clip_on=False, zorder=5)
    elif len(values) > 1:
        axes.axhline(values.max(), color=colour, lw=0.8, ls=WORST, zorder=1)


def _names(axes: Any, names: Sequence[str], count: int, slanted: bool) -> None:
    axes.set_xlim(-0.7, count - 0.3)
    if not names:
        axes.set_xlabel("number of the pose")
    step = 1
    if count > MOST_NAMED:
        power = 10 ** int(np.log10(count / 5))
        step = power * max(1, round(count / (10 * power)))
    numbers = range(step - 1, count, step)
    turn = {"rotation": 50, "ha": "right", "rotation_mode": "anchor"} if slanted else {}
    axes.set_xticks(numbers, names or [str(k + 1) for k in numbers], **turn)
