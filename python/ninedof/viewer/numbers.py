"""Everything a viewer shows about one configuration: numbers and limits, and small tables of HTML of them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape

import numpy as np

from ninedof.conditioning.conditioning import condition_number, singular_values
from ninedof.design.limit_numbers import CONES, SPREADS
from ninedof.design.limits import OF_LENGTHS, ROWS, kind_of, split_label
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.plot.style import LEG_COLOURS
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import LEGS
from ninedof.sheet.path_limits import PoseLimit, limits_at_poses, worst_of
from ninedof.sheet.rows import LimitRow
from ninedof.singularity.singularity import SingularityMargins, singularity_margins
from ninedof.support.arrays import Floats
from ninedof.support.margins import is_violated, margin_of, margin_words
from ninedof.support.units import kind_unit, with_unit
from ninedof.viewer.machine import Variant

RANGE = "leg_range"
"""Name of a limit of a leg that the region of the study makes."""


@dataclass(frozen=True, eq=False)
class Numbers:
    """The numbers of a configuration."""

    condition_number: float
    """Of J'; infinite where singular."""
    singular_values: Floats
    """Of J', descending, shape (6,)."""
    leg_lengths: Floats
    """Shape (9,): l1 l2 l3 q1 q2 q3 r1 r2 r3."""
    leg_margins: Floats
    """The least margin of each leg over its limits of length, shape (9,); infinite without one."""
    determinants: SingularityMargins
    limits: tuple[LimitRow, ...]
    """Every limit of the study at its worst leg, with the name of that leg: "base_cone l1". Of a limit of the design
    the margin alone is known: its side is "", limit and value are NaN."""
    cones_passed: frozenset[tuple[str, int]]
    """("base" or "platform", leg 0 to 8) of joints turned beyond their cone."""

    @property
    def legs_out(self) -> tuple[bool, ...]:
        """Whether each leg is beyond a limit of its length."""
        return tuple(is_violated(margin) for margin in self.leg_margins)


def numbers_of(variant: Variant, c: Configuration) -> Numbers:
    """Return the numbers of a single configuration."""
    g = variant.geometry
    limits = limits_at(variant, c)
    legs, cones = np.full(9, math.inf), set()
    for one in limits:
        margin = float(one.margin[0])
        if one.part in LEGS and (one.name in OF_LENGTHS or one.name in SPREADS or one.name == RANGE):
            legs[LEGS.index(one.part)] = min(legs[LEGS.index(one.part)], margin)
        elif one.name in CONES and is_violated(margin):
            cones.add((ROWS[one.name].body, LEGS.index(one.part)))
    return Numbers(
        condition_number=float(condition_number(g, c, variant.length)),
        singular_values=np.asarray(singular_values(g, c, variant.length)),
        leg_lengths=np.asarray(leg_lengths(g, c)),
        leg_margins=legs,
        determinants=singularity_margins(g, c),
        limits=(*_worst(limits), *_of_design(variant, limits)),
        cones_passed=frozenset(cones),
    )


def limits_at(variant: Variant, c: Configuration) -> list[PoseLimit]:
    """Return every limit of a single configuration, its arrays of shape (1,): of the study, and the ranges of legs."""
    limits, g = list[PoseLimit](), variant.geometry
    c = Configuration(c.position[None], c.rotation[None], c.internal_point[None])
    if variant.study is not None:
        limits = limits_at_poses(variant.study, g, c, variant.home, variant.length, variant.study_lengths)
    lengths = leg_lengths(g, c)
    limited = {(one.part, one.side): one.limit for one in limits if one.name in OF_LENGTHS}
    for k, leg in enumerate(LEGS):
        for side, end in (("min", variant.leg_low[k]), ("max", variant.leg_high[k])):
            own = limited.get((leg, side))  # of the study; the range that the region leaves may be narrower
            if 0.0 < end < math.inf and (own is None or not math.isclose(own, end)):
                margin = margin_of("length", side, end, lengths[:, k])
                limits.append(PoseLimit(RANGE, leg, side, end, lengths[:, k], margin))
    return limits


def _worst(limits: Sequence[PoseLimit]) -> Iterator[LimitRow]:
    for one, _ in worst_of(limits):
        value, margin = float(one.value[0]), float(one.margin[0])
        yield LimitRow(one.label, one.side, float(one.limit), value, margin, one.part, _kind(one.name))


def _of_design(variant: Variant, limits: Sequence[PoseLimit]) -> list[LimitRow]:
    of_pose = {one.name for one in limits}
    return [
        LimitRow(name, "", math.nan, math.nan, margin, "", _kind(name))
        for name, margin in (variant.margins or {}).items()
        if name not in of_pose and not name.startswith("condition")
    ]


def _kind(label: str) -> str:
    name = split_label(label)[0]
    return "length" if name == RANGE else kind_of(name)


# --- Tables; their colours follow the theme of the page ---------------------------------------------------------------

RED = "#E0202F"
_FAINT = "opacity:0.62"
_TABLE = '<table style="width:100%;border-collapse:collapse">'
_COLUMNS = (("limit", "left"), ("here", "right"), ("", "right"), ("margin", "right"))


def words_html(text: str) -> str:
    """Return a sentence as it is: what looks like HTML or Markdown in the name of a file stays text."""
    return _wrapped(f'<span style="overflow-wrap:anywhere">{escape(text)}</span>') if text else ""


def numbers_html(numbers: Numbers, unit: str, note: str) -> str:
    """Return condition number, singular values, determinants and legs."""
    kappa = number(numbers.condition_number, 5)
    return _wrapped(
        '<div style="display:flex;justify-content:space-between;align-items:baseline">',
        f'<span style="{_FAINT}">condition number</span>',
        f'<span id="ninedof-condition-number" style="font-size:1.75em;font-weight:650">{kappa}</span></div>',
        _singular_values(numbers),
        _determinants(numbers),
        _legs(numbers, unit),
        f'<div id="ninedof-note" style="color:{RED};font-weight:600">{escape(note)}</div>' if note else "",
    )


def legend_html(lines: Mapping[str, str]) -> str:
    """Return a key for lines in the scene, their colours by what they are; "" without lines."""
    line = "display:inline-block;width:1.6em;height:0;vertical-align:middle;border-top:3px solid"
    keys = (
        f'<span style="margin-right:1.2em"><span style="{line} {colour}"></span> {escape(words)}</span>'
        for words, colour in lines.items()
    )
    return _wrapped(f'<div style="overflow-wrap:anywhere">{"".join(keys)}</div>') if lines else ""


def limits_html(numbers: Numbers, unit: str, force_unit: str = "") -> str:
    """Return a row for each limit: its value, the limit and the margin; those violated in red."""
    if not numbers.limits:
        return _wrapped(f'<span style="{_FAINT}">A design file has no limits; a run has those of its study.</span>')
    head = "".join(f'<th style="text-align:{at};font-weight:500;{_FAINT}">{name}</th>' for name, at in _COLUMNS)
    return _wrapped(f"{_TABLE}<tr>{head}</tr>", *(_limit(row, unit, force_unit) for row in numbers.limits), "</table>")


def number(value: float, digits: int = 4) -> str:
    """Return a number with so many digits, "∞" where it is infinite."""
    if not math.isfinite(value):
        return "-" if math.isnan(value) else "∞" if value > 0.0 else "-∞"
    size = math.floor(math.log10(abs(value))) if value else 0
    if -4 < size < 7:
        return f"{value:.{max(0, digits - 1 - max(size, 0))}f}"
    return f"{value:.{digits - 1}e}"


def _wrapped(*parts: str) -> str:
    style = "font-size:0.82em;line-height:1.45;padding:0.1em 0.9em 0.5em 0.9em;font-variant-numeric:tabular-nums"
    return f'<div style="{style}">{"".join(parts)}</div>'


def _singular_values(numbers: Numbers) -> str:
    most = float(numbers.singular_values[0])
    bars = []
    for k, value in enumerate(numbers.singular_values.tolist(), start=1):
        share = 100.0 * value / most if math.isfinite(most) and most > 0.0 else 0.0
        bars.append(
            f'<div style="flex:1;text-align:center"><div style="height:26px;display:flex;align-items:flex-end">'
            f'<div style="width:100%;height:{share:.1f}%;background:#566370;border-radius:2px 2px 0 0"></div></div>'
            f'<span id="ninedof-sigma-{k}">{number(value, 3)}</span></div>'
        )
    return f'<div style="{_FAINT}">singular values</div><div style="display:flex;gap:4px">{"".join(bars)}</div>'


def _determinants(numbers: Numbers) -> str:
    parts = [
        f'<span><span style="{_FAINT}">det {name}</span> {value:+.4f}</span>'
        for name, value in zip("NBC", numbers.determinants, strict=True)
    ]
    return f'<div style="display:flex;justify-content:space-between;margin:0.45em 0">{"".join(parts)}</div>'


def _legs(numbers: Numbers, unit: str) -> str:
    rows = (f"<tr>{''.join(_leg(numbers, k) for k in (i, i + 3, i + 6))}</tr>" for i in range(3))
    limited = ", with the least margin of their limits" if (numbers.leg_margins < math.inf).any() else ""
    head = f"{with_unit('leg lengths', unit)}{limited}"
    return f'<div style="{_FAINT}">{head}</div>{_TABLE}{"".join(rows)}</table>'


def _leg(numbers: Numbers, k: int) -> str:
    """Return a leg, its length, and its margin, which goes below the length in a narrow window."""
    name, margin = LEGS[k], float(numbers.leg_margins[k])
    red = f"color:{RED};font-weight:650;" if numbers.legs_out[k] else ""
    head = f'<span style="color:{LEG_COLOURS[name[0]]};font-weight:700">{name}</span>'
    length = f'<span id="ninedof-leg-{name}">{number(float(numbers.leg_lengths[k]), 5)}</span>'
    beside = ""
    if margin < math.inf:
        words = margin_words(margin, "length")
        beside = f' <span style="{_FAINT};white-space:nowrap;font-size:0.85em">{words}</span>'
    return f'<td style="{red}vertical-align:top"><span style="white-space:nowrap">{head} {length}</span>{beside}</td>'


def _limit(row: LimitRow, unit: str, force_unit: str) -> str:
    red = f"color:{RED};font-weight:650;" if row.violated else ""
    name = kind_unit(row.unit, unit, force_unit)
    of = "°" if row.unit == "angle" else f" {name}" if name else ""
    here, end = "", "of the design"
    if row.side:
        value, limit = (number(math.degrees(x) if row.unit == "angle" else x) + of for x in (row.value, row.limit))
        here, end = value, f"{'≥' if row.side == 'min' else '≤'} {limit}"
    cells = (here, end, margin_words(row.margin, row.unit))
    numbers = "".join(f'<td style="white-space:nowrap;padding-left:0.5em;text-align:right">{x}</td>' for x in cells)
    return f'<tr style="{red}"><td>{escape(row.name.replace("_", " "))}</td>{numbers}</tr>'
