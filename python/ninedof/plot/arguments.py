"""Checks of what figures of sweeps are given: each raises ValueError naming the argument."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from ninedof.plot.style import counted
from ninedof.support.arguments import finite, instance
from ninedof.support.arrays import Floats, as_floats

if TYPE_CHECKING:
    from ninedof.sweep import SweepResult

T = TypeVar("T")


def numbers(name: str, value: Any, *shape: int | None, gaps: bool = False) -> Floats:
    """Return numbers of a shape, None for any length but 0; NaN and infinite ones only where `gaps` are drawn."""
    array = as_floats(name, value, ())
    fits = array.ndim == len(shape) and all(want in (None, n) for want, n in zip(shape, array.shape, strict=True))
    if not fits or not (gaps or np.isfinite(array).all()):
        raise ValueError(f"{name}: got shape {array.shape}, expected finite numbers of shape {shape}")
    return array


def number(name: str, value: Any, positive: bool = False) -> float:
    """Return a number that can be drawn."""
    return finite(name, value, 1e-100 if positive else -1e100, 1e100)


def things(name: str, value: Any, kind: type[T], most: int) -> Sequence[T]:
    """Return things of a class, so many as a figure has room for."""
    counted(name, value, most)
    return [instance(f"{name}[{k}]", thing, kind) for k, thing in enumerate(value)]


def swept(result: Any, names: Sequence[str], made_by: str) -> SweepResult:
    """Return a result that has what the figure shows."""
    missing = [name for name in names if name not in result.arrays and name not in result.coords]
    if missing:
        raise ValueError(f"result: got one without {', '.join(missing)}, expected the result of {made_by}")
    return result  # type: ignore[no-any-return]
