"""The controls beside the scene: each submits a change of the state, and follows the state."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from typing import Any

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
