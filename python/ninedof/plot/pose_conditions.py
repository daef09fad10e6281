"""The condition number at each pose of one or more designs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator
from numpy.typing import ArrayLike

from ninedof.plot import style
from ninedof.plot.arguments import numbers, texts, things
from ninedof.support.arguments import text
from ninedof.support.arrays import Floats, as_floats
from ninedof.support.printable import escaped

MOST_NAMED = 40  # poses with names; for more poses the axis has a few numbers
LONGEST = 24  # letters of a name on the axis; longer ones are a list below it, by number
WORST_NAMED = 9  # of more poses than MOST_NAMED, those in the list
LETTER, LINE = 0.056, 0.135  # inches, of the list
LEAST_SPAN = 0.2  # of the least value, shown by the axis
WORST: Any = (0, (5, 3))


@dataclass(frozen=True, eq=False)
class PoseConditions:
    """One design at a list of poses."""

    name: str
    conditions: ArrayLike
    """Condition number at each pose, shape (n,); infinite where singular."""

    def __post_init__(self) -> None:
        """Check the fields."""
        text("name", self.name)
        numbers("conditions", as_floats("conditions", self.conditions, ()).reshape(-1), None, gaps=True)


def poses(
    designs: Sequence[PoseConditions], names: Sequence[str] = (), index: str = "condition number", note: str = ""
) -> Figure:
    """Return a figure of the condition number at each pose: a mark for each design, its worst value as a dashed line.

    There are no bars, as the axis does not begin at zero; it shows at least a fifth of the least value, so that small
    differences look small. Long names are listed below the axis by number; of more than 40 poses those of the worst.

    Parameters
    ----------
    designs : sequence of PoseConditions
        One to four, all at the same poses.
    names : sequence of str
        Names of the poses; their numbers by default.
    index : str
        Name of the index.
    note : str
        Words above that list, such as the unit.

    Raises
    ------
    ValueError
        If there are no designs, too many, or their numbers of poses differ.

    Examples
    --------
    >>> from ninedof.plot.pose_conditions import PoseConditions, poses
    >>> designs = [PoseConditions("robust", [4.1, 4.3, 4.2]), PoseConditions("neutral only", [3.8, 4.9, 4.4])]
    >>> figure = poses(designs, names=["neutral", "x + 0.1", "x - 0.1"])

    """
    things("designs", designs, PoseConditions, len(style.SERIES))
    texts("names", names)
    text("index", index)
    text("note", note)
    values = [np.atleast_1d(np.asarray(design.conditions, dtype=np.float64)) for design in designs]
    count = len(values[0])
    if any(v.shape != (count,) for v in values) or not count:
        raise ValueError(f"designs: got conditions of shapes {[v.shape for v in values]}, expected one shape (n,)")
    if len(names) not in (0, count):
        raise ValueError(f"names: got {len(names)}, expected {count}, one a pose")
    names = [escaped(name) for name in names]  # those of ticks are written while they are drawn
    longest = max((len(name) for name in names), default=0)
    listed = _listed(values, names) if longest > LONGEST or count > MOST_NAMED else []
    if listed:
        names, longest = [], 0
    with style.settings():
        single = count <= 12 and not listed
        width = style.ONE_COLUMN if single else style.TWO_COLUMNS
        above = 0.1 + 0.155 * len(designs) if single else 0.1 + 0.155 * -(-len(designs) // 2)  # inches, for the key
        columns = _columns(listed, width)
        list_height = LINE * (len(columns[0]) + bool(note)) + 0.1 if columns else 0.0
        below = max(0.4, 0.12 + 0.052 * longest) + list_height  # for slanted names
        height = 1.9 + above + below
        figure = style.new_figure(width, height)
        left = 0.5 / width + (0.02 * longest / width if slanted(names, count) else 0.0)
        axes = figure.add_axes((left, below / height, 1.0 - left - 0.1 / width, 1.9 / height))
        _write(figure, columns, note, left, list_height / height)
        axes.set_ylabel(index)
        _scale(axes, values)
        for k, (colour, v) in enumerate(zip(style.SERIES, values, strict=False)):
            _one(axes, v, colour, k, len(values))
        _names(axes, names, count)
        keys = [
            style.key(colour, marker=style.MARKS[k], ms=5, lw=0.8, ls=WORST, mec="white", label=_label(design.name, v))
            for k, (colour, design, v) in enumerate(zip(style.SERIES, designs, values, strict=False))
        ]
        options: dict[str, Any] = {"loc": "upper left", "ncols": 1 if single else 2, "handlelength": 3.0}
        figure.legend(handles=keys, bbox_to_anchor=(left, 1.0), borderpad=0.2, **options)
    return figure


def _listed(values: Sequence[Floats], names: Sequence[str]) -> list[str]:
    """Return the lines of the list: all poses, or the worst of many in the order of their numbers."""
    shown = range(len(names))
    if len(names) > MOST_NAMED:
        worst = np.argsort(-np.max(values, axis=0), kind="stable")[:WORST_NAMED]
        shown = sorted(worst.tolist())  # type: ignore[assignment]
    return [f"{k + 1}: {names[k]}" for k in shown]


def _columns(lines: Sequence[str], width: float) -> list[list[str]]:
    """Return the list in as many columns as there is room for, the first the longest."""
    if not lines:
        return []
    count = max(1, int((width - 0.5) / (LETTER * (2 + max(map(len, lines))))))
    rows = -(-len(lines) // count)
    return [list(lines[k : k + rows]) for k in range(0, len(lines), rows)]


def _write(figure: Figure, columns: Sequence[Sequence[str]], note: str, left: float, top: float) -> None:
    """Write the list below the axes, line by line."""
    line = LINE / float(figure.get_size_inches()[1])
    first = top - 0.4 * line
    if columns and note:
        figure.text(left, first, note, size=style.SMALL_SIZE, color=style.MUTED, va="top")
        first -= line
    for k, lines in enumerate(columns):
        at = left + k * (1.0 - left) / len(columns)
        for row, words in enumerate(lines):
            figure.text(at, first - row * line, words, size=style.SMALL_SIZE, va="top")


def _label(name: str, values: Floats) -> str:
    worst = float(values.max())
    text = "singular at some" if not np.isfinite(worst) else f"worst {worst:.4g}"
    return f"{name}: {text}" if len(values) > 1 else f"{name}: {worst:.4g}"


def _scale(axes: Any, values: Sequence[Floats]) -> None:
    """Show the finite values up to style.RANGE times the least, on a logarithmic axis if they span a factor of 3."""
    every = np.concatenate(values)
    finite = every[np.isfinite(every)]
    low = float(finite.min()) if len(finite) else 1.0
    high = min(float(finite.max()) if len(finite) else 2.0, style.RANGE * low)
    if high > 3.0 * low:
        axes.set_yscale("log")
        style.one_two_five(axes.yaxis)
        axes.set_ylim(low / 1.15, high * 1.15)
    else:
        middle, half = 0.5 * (low + high), 0.5 * max(1.2 * (high - low), LEAST_SPAN * low)
        axes.set_ylim(middle - half, middle + half)


def _one(axes: Any, values: Floats, colour: str, k: int, count: int) -> None:
    """Draw one design: its values beside those of the others, its worst value as a line."""
    x = np.arange(len(values)) + (k - 0.5 * (count - 1)) * min(0.16, 0.5 / count)
    top = axes.get_ylim()[1]
    seen = np.minimum(values, top)
    off = ~(values <= top)
    size = 5.0 if len(values) <= MOST_NAMED else 3.0
    axes.plot(x[~off], seen[~off], style.MARKS[k], ms=size, color=colour, mec="white", mew=0.6, zorder=4)
    if off.any():
        beyond: dict[str, Any] = {"marker": "^", "ls": "", "ms": size + 3, "color": colour, "clip_on": False}
        axes.plot(x[off], seen[off], **beyond, zorder=5)
    worst = float(values.max())
    if worst <= top and len(values) > 1:
        axes.axhline(worst, color=colour, lw=0.8, ls=WORST, zorder=1)


def slanted(names: Sequence[str], count: int) -> bool:
    """Return whether names stand at an angle."""
    return 0 < len(names) == count <= MOST_NAMED and (max(len(name) for name in names) > 6 or count > 12)


def _names(axes: Any, names: Sequence[str], count: int) -> None:
    axes.set_xlim(-0.7, count - 0.3)
    if count > MOST_NAMED:
        step = 10 ** int(np.log10(count / 5)) * max(1, round(count / (10 * 10 ** int(np.log10(count / 5)))))
        shown = list(range(step - 1, count, step))
        axes.set_xticks(shown, [str(k + 1) for k in shown])
        axes.set_xlabel("number of the pose")
        return
    axes.xaxis.set_major_locator(FixedLocator(list(range(count))))
    labels = list(names) or [str(k + 1) for k in range(count)]
    angle = slanted(names, count)
    axes.set_xticklabels(labels, rotation=50 if angle else 0, ha="right" if angle else "center")
    if angle:
        for label in axes.get_xticklabels():
            label.set_rotation_mode("anchor")
    if not names:
        axes.set_xlabel("number of the pose")
