"""The controls beside the scene, which submit a change of the state and follow it, and small tables of HTML there."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping, Sequence
from html import escape
from typing import Any

from ninedof.plot.style import LEG_COLOURS
from ninedof.robot.geometry import LEGS
from ninedof.sheet.rows import LimitRow
from ninedof.support.margins import margin_words
from ninedof.support.units import kind_unit, with_unit
from ninedof.viewer.numbers import Numbers

QUIET = 0.4  # seconds after the user moved a slider in which it is not written back
STEPS = 500  # of a slider, at least


class Slider:
    """A slider of one number, kept equal to the state without a fight with the hand that moves it.

    Its step is a power of ten that divides the range into `STEPS` steps or more.
    """

    def __init__(
        self, gui: Any, label: str, ends: Sequence[float], value: float, moved: Callable[[float], None], hint: str
    ) -> None:
        low, high = ends
        digits = -math.floor(math.log10((high - low) / STEPS))
        self._step, self._digits, self._touched = 10.0**-digits, max(0, digits), -math.inf
        self._low, self._high = self._step * math.floor(low / self._step), self._step * math.ceil(high / self._step)
        self.handle = gui.add_slider(label, self._low, self._high, self._step, self._within(value), hint=hint)

        def on_update(event: Any) -> None:
            if event.client_id is not None:
                self._touched = time.monotonic()
                moved(float(self.handle.value))

        self.handle.on_update(on_update)

    def show(self, value: float, settled: bool = False) -> None:
        """Write a value of the state; while the user moves the slider only when all has `settled`."""
        within = self._within(value)
        if (settled or time.monotonic() - self._touched >= QUIET) and within != self.handle.value:
            self.handle.value = within

    def _within(self, value: float) -> float:
        """Return a value as the slider can show it: within its ends, on a step, -43.4 and not -43.400...01."""
        return round(round(min(max(value, self._low), self._high) / self._step) * self._step, self._digits)


class Panel:
    """The controls of a `Viewer`."""

    def __init__(self, viewer: Any, gui: Any) -> None:
        self.viewer, self.gui, self.state, self.unit = viewer, gui, viewer.state, viewer.state.machine.unit
        self.widgets: dict[str, Any] = {}
        """Of viser, by label."""
        self.followers: list[Callable[[bool], None]] = []
        """Called after each change of the state with whether all has settled."""
        self.coordinates: list[float] = self.state.coordinates
        self.numbers: Numbers
        """Of the state."""

    def refresh(self, numbers: Numbers, settled: bool) -> None:
        """Set the controls to the state."""
        self.numbers, self.coordinates = numbers, self.state.coordinates
        for follow in self.followers:
            follow(settled)

    def follow(self, handle: Any, name: str, read: Callable[[], Any]) -> None:
        """Keep a property of a control equal to what is read of the state."""

        def write(_: bool) -> None:
            if getattr(handle, name) != (value := read()):
                setattr(handle, name, value)

        self.followers.append(write)

    def text(self, name: str, read: Callable[[], str]) -> None:
        """Add a text that follows the state."""
        self.widgets[name] = self.gui.add_html("")
        self.follow(self.widgets[name], "content", read)

    def slider(
        self, label: str, ends: Sequence[float], read: Callable[[], float], write: Callable[[float], None], hint: str
    ) -> None:
        """Add a slider that changes the state and follows it."""
        slider = Slider(self.gui, label, ends, read(), lambda x: self.viewer.submit(label, lambda: write(x)), hint)
        self.followers.append(lambda settled: slider.show(read(), settled))
        self.widgets[label] = slider.handle

    def button(self, label: str, icon: str, change: Callable[[], object], hint: str | None = None) -> Any:
        """Add a button that changes the state."""
        handle = self.gui.add_button(label, icon=icon, hint=hint)
        handle.on_click(lambda _: self.viewer.submit(label, change))
        return handle

    def choice(self, label: str, options: Sequence[str], write: Callable[[Any], None], hint: str | None = None) -> Any:
        """Add a choice of words that changes the state when the user makes it, not when the program does."""
        return self._input(label, self.gui.add_dropdown(label, list(options), hint=hint), write)

    def check(self, label: str, value: bool, write: Callable[[Any], None]) -> None:
        """Add a box to tick."""
        self._input(label, self.gui.add_checkbox(label, value), write)

    def _input(self, label: str, handle: Any, write: Callable[[Any], None]) -> Any:
        def on_update(event: Any) -> None:
            if event.client_id is not None:
                value = handle.value
                self.viewer.submit(label, lambda: write(value))

        self.widgets[label] = handle
        handle.on_update(on_update)
        return handle


# --- Tables of HTML; their colours follow the theme of the page -------------------------------------------------------

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
