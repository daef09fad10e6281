"""The largest tolerances of joints and legs with which a proof of a machine succeeds."""

from __future__ import annotations

from collections.abc import Callable

from ninedof.design.duty import Tolerances, tolerances_like

FIRST, LEAST, MOST = 1e-4, 1e-6, 0.05  # of the machine's height
STEP, HALVINGS = 4.0, 5


def largest_tolerance(proved: Callable[[Tolerances], bool], shape: Tolerances, height: float) -> Tolerances:
    """Return the largest tolerances that are proved, to 5 %; none at all where not even the least ones are.

    They have the ratio of `shape`, and are looked for from a millionth to a twentieth of the machine's height. A
    KeyboardInterrupt has the largest ones proved so far.
    """

    def of(size: float) -> Tolerances:
        return tolerances_like(shape, size * height)

    low, high = 0.0, FIRST
    try:
        while high <= MOST and proved(of(high)):
            low, high = high, STEP * high
        while low == 0.0 and high >= LEAST:
            if proved(of(high / STEP)):
                low = high / STEP
            else:
                high /= STEP
        if low == 0.0:
            return Tolerances()
        for _ in range(HALVINGS):
            middle = (low * high) ** 0.5
            low, high = (middle, high) if proved(of(middle)) else (low, middle)
    except KeyboardInterrupt:
        raise KeyboardInterrupt(of(low) if low > 0.0 else Tolerances()) from None
    return of(low)
