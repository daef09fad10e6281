"""Numbers and limits as small tables of HTML. Their colours follow the theme of the page."""

from __future__ import annotations

import math
from html import escape

from ninedof.plot.style import LEG_COLOURS
from ninedof.robot.leg_names import LEGS
from ninedof.support.margins import margin_words
from ninedof.support.units import amount
from ninedof.viewer.numbers import DETERMINANTS, Limit, Numbers

RED = "#E0202F"
_WRAP = (
    '<div style="font-size:0.82em;line-height:1.45;padding:0.1em 0.9em 0.5em 0.9em;font-variant-numeric:tabular-nums">'
)
_FAINT = "opacity:0.62"
_TABLE = '<table style="width:100%;border-collapse:collapse">'


def words_html(text: str) -> str:
    """Return a sentence as it is: what looks like HTML or Markdown in the name of a file stays text."""
    return f'{_WRAP}<span style="overflow-wrap:anywhere">{escape(text)}</span></div>' if text else ""


def numbers_html(found: Numbers, unit: str, note: str) -> str:
    """Return condition number, singular values, determinants and legs."""
    kappa = number(found.condition_number, 5)
    lines = [
        _WRAP,
        '<div style="display:flex;justify-content:space-between;align-items:baseline">',
        f'<span style="{_FAINT}">condition number</span>',
        f'<span id="ninedof-condition-number" style="font-size:1.75em;font-weight:650">{kappa}</span></div>',
        _singular_values(found),
        _determinants(found),
        _legs(found, unit),
    ]
    if note:
        lines.append(f'<div id="ninedof-note" style="color:{RED};font-weight:600">{escape(note)}</div>')
    return "".join(lines) + "</div>"


def limits_html(found: Numbers, unit: str) -> str:
    """Return a row for each limit: what is limited, its value, the limit and the margin; those passed in red."""
    if not found.limits:
        return f'{_WRAP}<span style="{_FAINT}">A design file has no limits; a run has those of its study.</span></div>'
    head = "".join(f'<th style="text-align:{at};font-weight:500;{_FAINT}">{name}</th>' for name, at in _COLUMNS)
    rows = "".join(_limit(one, unit) for one in found.limits)
    return f"{_WRAP}{_TABLE}<tr>{head}</tr>{rows}</table></div>"


_COLUMNS = (("limit", "left"), ("here", "right"), ("", "right"), ("margin", "right"))


def number(value: float, digits: int = 4) -> str:
    """Return a number with so many digits, "∞" where it is infinite."""
    if math.isinf(value):
        return "∞" if value > 0.0 else "-∞"
    if math.isnan(value):
        return "-"
    size = math.floor(math.log10(abs(value))) if value else 0
    if -4 < size < 7:
        return f"{value:.{max(0, digits - 1 - max(size, 0))}f}"
    return f"{value:.{digits - 1}e}"


def _singular_values(found: Numbers) -> str:
    most = float(found.singular_values[0])
    bars = []
    for k, value in enumerate(found.singular_values.tolist()):
        share = 100.0 * value / most if math.isfinite(most) and most > 0.0 else 0.0
        bars.append(
            f'<div style="flex:1;text-align:center"><div style="height:26px;display:flex;align-items:flex-end">'
            f'<div style="width:100%;height:{share:.1f}%;background:#566370;border-radius:2px 2px 0 0"></div></div>'
            f'<span id="ninedof-sigma-{k + 1}">{number(value, 3)}</span></div>'
        )
    return f'<div style="{_FAINT}">singular values</div><div style="display:flex;gap:4px">{"".join(bars)}</div>'


def _determinants(found: Numbers) -> str:
    parts = [
        f'<span><span style="{_FAINT}">{name}</span> {value:+.4f}</span>'
        for name, value in zip(DETERMINANTS, found.determinants, strict=True)
    ]
    return f'<div style="display:flex;justify-content:space-between;margin:0.45em 0">{"".join(parts)}</div>'


def _legs(found: Numbers, unit: str) -> str:
    rows = []
    for i in range(3):
        cells = []
        for k in (i, i + 3, i + 6):
            name = LEGS[k]
            red = f"color:{RED};font-weight:650;" if found.legs_out[k] else ""
            head = f'<span style="color:{LEG_COLOURS[name[0]]};font-weight:700">{name}</span>'
            length = f'<span id="ninedof-leg-{name}">{number(float(found.leg_lengths[k]), 5)}</span>'
            beside = _beside(float(found.leg_margins[k]))
            text = f'<span style="white-space:nowrap">{head} {length}</span>{beside}'
            cells.append(f'<td style="{red}vertical-align:top">{text}</td>')
        rows.append(f"<tr>{''.join(cells)}</tr>")
    title = amount("leg lengths", f"({unit})" if unit else "")
    return f'<div style="{_FAINT}">{title}</div>{_TABLE}{"".join(rows)}</table>'


def _beside(margin: float) -> str:
    """Return the margin of a leg, which goes below its length in a narrow window."""
    if margin == math.inf:
        return ""
    return f' <span style="{_FAINT};white-space:nowrap;font-size:0.85em">{margin_words(margin, "length")}</span>'


def _limit(one: Limit, unit: str) -> str:
    red = f"color:{RED};font-weight:650;" if one.passed else ""
    of = {"length": f" {unit}" if unit else "", "angle": "°"}.get(one.unit, "")
    sign = {"min": "≥ ", "max": "≤ "}.get(one.side, "")
    here = number(one.value) + of if one.side else ""
    end = f"{sign}{number(one.limit)}{of}" if one.side else "of the design"
    name = escape(one.name.replace("_", " "))
    cells = (f"<td>{name}</td>", *(f'<td style="text-align:right">{text}</td>' for text in (here, end)))
    margin = margin_words(one.margin, one.unit)
    return f'<tr style="{red}">{"".join(cells)}<td style="text-align:right">{margin}</td></tr>'
