"""LaTeX: tables of the joints, the neutral pose, the legs and the limits. They need booktabs alone."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np

from ninedof.export.model import JOINTS, LEGS, Format, Model, O, P
from ninedof.sheet.rows import LimitRow
from ninedof.support.margins import margin_words
from ninedof.support.units import amount, kind_unit, with_unit

HEAD = r"""% {title}: joints, neutral pose, legs and limits, written by ninedof.
% In the preamble: \usepackage{{booktabs}}. Each table is a tabular: put it in a table with a caption of yours.
"""
SYMBOLS = {
    "base_external": r"\mathbf{r}",
    "base_internal": r"\hat{\mathbf{r}}",
    "platform_external": r"\mathbf{u}",
    "platform_internal": r"\tilde{\mathbf{u}}",
}
"""The joints as in the paper, vectors bold: the letter r is a joint there and the length of a leg."""
SPECIAL = str.maketrans(
    {c: "\\" + c for c in "&%$#_{}"}
    | {"\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}"}
)
AXES = ("$x$", "$y$", "$z$")
DIGITS = 6  # of the largest number of a column


def text(model: Model) -> str:
    """Return the file."""
    tables = [_joints(model), _pose(model), _legs(model)]
    if model.sheet is not None and model.sheet.limits:
        tables.append(_limits(model.sheet.limits, model.unit, model.sheet.force_unit))
    return "\n".join([HEAD.format(title=model.name), *tables])


def escape(words: str) -> str:
    """Return words with the characters that LaTeX treats as commands written so that it prints them."""
    return words.translate(SPECIAL)


def _joints(model: Model) -> str:
    numbers = _columns([*model.own_frame.values()])
    rows = [[_joint_words(name), *row] for name, row in zip(JOINTS, numbers, strict=True)]
    return _tabular("Joints in the frame of their plate", "lrrr", [with_unit("joint", model.unit), *AXES], rows)


def _joint_words(name: str) -> str:
    return f"{name[:-2].replace('_', ' ')} {_symbol(name)}"


def _symbol(name: str) -> str:
    kind, _, number = name.rpartition("_")
    return f"${SYMBOLS[kind]}_{number}$" if kind else f"${name}$"


def _pose(model: Model) -> str:
    """Return p, O, the joints of the platform and the rotation; base joints are where the first table has them."""
    words = {P: r"platform origin $\mathbf{p}$", O: "internal point $O$"}
    words |= {name: _joint_words(name) for name in JOINTS if name.startswith("platform")}
    labels = [*words.values(), *(rf"row {i} of $\mathbf{{Q}}$" for i in (1, 2, 3))]
    numbers = [*_columns([model.base_frame[name] for name in words]), *_columns(list(model.configuration.rotation))]
    if tool := model.tool:
        labels += ["point of the tool, in the frame of the platform"]
        numbers += _columns([tool.position])
        labels += [rf"its ${axis}$ axis" for axis in "xyz"] * any(tool.rotation)
        numbers += _columns(list(tool.axes.T)) * any(tool.rotation)
    rows = [[label, *row] for label, row in zip(labels, numbers, strict=True)]
    return _tabular("Neutral pose in the base frame", "lrrr", [with_unit("point", model.unit), *AXES], rows, first=2)


def _legs(model: Model) -> str:
    heads, lengths = ["neutral"], [[float(x)] for x in model.neutral_lengths]
    if model.leg_ranges:
        heads += ["needs from", "needs to", "stroke"]
        lengths = [[x, a, b, b - a] for (x,), (a, b) in zip(lengths, model.leg_ranges, strict=True)]
    if model.permitted_ranges:
        heads += ["permitted from", "permitted to"]
        lengths = [[*row, *ends] for row, ends in zip(lengths, model.permitted_ranges, strict=True)]
    rows = [
        [f"${leg[0]}_{leg[1]}$", _symbol(a), _symbol(b), *row]
        for (leg, a, b), row in zip(LEGS, _columns(lengths), strict=True)
    ]
    heads = [with_unit("leg", model.unit), "from", "to", *heads]
    return _tabular("Legs: lengths", "lll" + "r" * (len(heads) - 3), heads, rows)


def _limits(limits: Sequence[LimitRow], unit: str, force_unit: str = "") -> str:
    rows, percent = [], r"\,\%"
    for one in limits:
        margin = f"${margin_words(one.margin, one.unit).replace(' %', percent)}$"
        sign = r"$\geq$" if one.side == "min" else r"$\leq$"
        rows.append(
            [escape(one.name), sign, *(_measure(one, x, unit, force_unit) for x in (one.limit, one.value)), margin]
        )
    return _tabular("Limits of the study", "lcrrr", ["limit", "", "allowed", "here", "margin"], rows, len(rows))


def _measure(row: LimitRow, value: float, unit: str, force_unit: str) -> str:
    if row.unit == "angle":
        return rf"${math.degrees(value):.2f}^\circ$"
    return amount(f"${value:.{DIGITS}g}$", kind_unit(row.unit, unit, force_unit))


def _columns(rows: Sequence[Iterable[float]]) -> list[list[str]]:
    """Return numbers of one kind with the same decimals, so that right-aligned columns align at the point."""
    table = np.array([list(row) for row in rows], dtype=float)
    largest = float(np.abs(table).max()) or 1.0
    decimals = min(max(DIGITS - 1 - math.floor(math.log10(largest)), 0), 9)
    return [[f"${x + 0.0:.{decimals}f}$" for x in np.round(row, decimals)] for row in table]


def _row(entries: Sequence[str]) -> str:
    return " & ".join(entries) + r" \\"


def _tabular(title: str, columns: str, heads: Sequence[str], rows: Sequence[Sequence[str]], first: int = 3) -> str:
    """Return a table, with space after the first rows and then after each three, but the last."""
    lines = [f"% {title}", rf"\begin{{tabular}}{{{columns}}}", r"\toprule", _row(heads), r"\midrule"]
    for count, row in enumerate(rows, start=1):
        lines += [_row(row), *[r"\addlinespace"] * (first <= count < len(rows) and (count - first) % 3 == 0)]
    return "\n".join([*lines, r"\bottomrule", r"\end{tabular}", ""])


FORMAT = Format("latex", ".tex", "LaTeX tables", text)
