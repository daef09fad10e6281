"""Sliders of one number each, kept equal to the model without a fight with the hand that moves them."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import Any

QUIET = 0.4  # seconds after the user moved a slider in which it is not written back
STEPS = 500  # of a slider, at least


def step_of(low: float, high: float) -> float:
    """Return a power of ten that divides a range into `STEPS` steps or more."""
    return float(10.0 ** math.floor(math.log10((high - low) / STEPS)))


class Slider:
    """One slider.

    Parameters
    ----------
    gui : viser.GuiApi
    label, hint : str
    low, high, value : float
    moved : callable
        Called with the new value when the user moves the slider, not when the program does.

    """

    def __init__(
        self, gui: Any, label: str, low: float, high: float, value: float, moved: Callable[[float], None], hint: str
    ) -> None:
        step = step_of(low, high)
        self._low, self._high = step * math.floor(low / step), step * math.ceil(high / step)
        self._step, self._touched = step, -math.inf
        within = self._within(value)
        self.handle = gui.add_slider(label, self._low, self._high, step, within, hint=hint)

        def on_update(event: Any) -> None:
            if event.client_id is not None:
                self._touched = time.monotonic()
                moved(float(self.handle.value))

        self.handle.on_update(on_update)

    def show(self, value: float, settled: bool = False) -> None:
        """Write a value of the model; while the user moves the slider only when all has `settled`."""
        if not settled and time.monotonic() - self._touched < QUIET:
            return
        within = self._within(value)
        if abs(within - float(self.handle.value)) >= 0.5 * self._step:
            self.handle.value = within

    def _within(self, value: float) -> float:
        """Return a value as the slider can show it: within its ends, on a step."""
        on_step = round(min(max(value, self._low), self._high) / self._step) * self._step
        return round(
            on_step, max(0, -math.floor(math.log10(self._step) + 0.5))
        )  # a power of ten: -43.4, not -43.400...01
