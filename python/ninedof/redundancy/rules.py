"""The rules for O when the platform moves: one name for each, the same in every command, file and argument."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from ninedof.support.units import amount

WORDS = {
    "carried": "carried as a point of the platform",
    "shifted": "shifted with p",
    "held": "held in the base",
    "best": "placed at its best",
}
"""The words after "O is"."""
RULES = tuple(WORDS)

MEANING = {
    "carried": "Qᵀ (s - p) stays as at the neutral pose",
    "shifted": "s - p stays as at the neutral pose, in base axes",
    "held": "s stays as at the neutral pose",
    "best": "anew at every pose",
}

STUDY_RULES = ("shifted", "held", "best")
"""Those that a study takes."""


def where_o(rule: Any, unit: str = "") -> str:
    """Return what follows "O is" for a rule, a fraction, a point of the platform {"platform": [x, y, z]} or a point."""
    if isinstance(rule, str):
        return WORDS.get(rule, rule)
    if isinstance(rule, int | float):
        return f"at {rule:.4g} of the way from the lower to the upper internal joints"
    if isinstance(rule, Mapping):
        return f"{WORDS['carried']}, at {amount(point_words(rule['platform']), unit)} of its frame"
    return f"{WORDS['held']}, at {amount(point_words(rule), unit)}"


def point_words(values: Iterable[float]) -> str:
    """Return a point in brackets."""
    return "(" + ", ".join(f"{value + 0.0:.6g}" for value in values) + ")"
