"""Checks of what figures are given: each raises ValueError naming the argument, what came and what was expected."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import finite, instance, items, pair, text
from ninedof.support.arguments import number as any_number
from ninedof.support.arrays import Floats, as_floats

if TYPE_CHECKING:
    from ninedof.sweep import SweepResult

SMALLEST, GREATEST = 1e-100, 1e100  # of what is drawn: axes form squares and ratios of their spans

T = TypeVar("T")


def numbers(name: str, value: Any, *shape: int | None, gaps: bool = False, positive: bool = False) -> Floats:
    """Return numbers of a shape, None for any length but 0; NaN and infinite ones only where `gaps` are drawn."""
    array = as_floats(name, value, ())
    fits = array.ndim == len(shape) and all(want in (None, n) for want, n in zip(shape, array.shape, strict=True))
    if not fits or not array.size:
        words = ", ".join("n" if n is None else str(n) for n in shape)
        raise ValueError(f"{name}: got shape {array.shape}, expected ({words}{',' * (len(shape) == 1)})")
    allowed = np.abs(array) <= GREATEST
    if positive:
        allowed &= array >= SMALLEST
    if gaps:
        allowed |= np.isnan(array) | np.isposinf(array)
    if not allowed.all():
        expected = f"numbers from {SMALLEST if positive else -GREATEST:g} to {GREATEST:g}"
        raise ValueError(f"{name}: got {array[~allowed][0]:g}, expected {expected}")
    return array


def number(name: str, value: Any, positive: bool = False, infinite: bool = False) -> float:
    """Return a number that can be drawn, or infinity where that has a place."""
    if infinite and math.isinf(found := any_number(name, value)):
        return found
    return finite(name, value, SMALLEST if positive else -GREATEST, GREATEST)


def lines(name: str, value: Any, *shape: int | None) -> list[Floats]:
    """Return arrays of points, each of the given shape."""
    expected = f"a list of arrays of points ({', '.join('n' if n is None else str(n) for n in shape)})"
    return [numbers(f"{name}[{k}]", line, *shape) for k, line in enumerate(items(name, value, expected))]


def runs(name: str, value: Any) -> list[Floats]:
    """Return at least one sequence of values, infinite or NaN where there is none."""
    found = items(name, value, "a list of arrays (n,)")
    if not found:
        raise ValueError(f"{name}: got no runs, expected at least one")
    return [
        numbers(f"{name}[{k}]", as_floats(f"{name}[{k}]", run, ()).reshape(-1), None, gaps=True)
        for k, run in enumerate(found)
    ]


def things(name: str, value: Any, kind: type[T], most: int | None = None, least: int = 1) -> Sequence[T]:
    """Return things of a class, so many as a figure has room for."""
    found = items(name, value, f"a list of {kind.__name__}")
    if len(found) < least or (most is not None and len(found) > most):
        expected = f"at least {least}" if most is None else f"at most {most}" if not least else f"{least} to {most}"
        raise ValueError(f"{name}: got {len(found)}, expected {expected}")
    return [instance(f"{name}[{k}]", thing, kind) for k, thing in enumerate(found)]


def texts(name: str, value: Any) -> tuple[str, ...]:
    """Return texts."""
    return tuple(text(f"{name}[{k}]", word) for k, word in enumerate(items(name, value, "a list of texts")))


def robot(geometry: Any, configuration: Any) -> None:
    """Raise unless these are a robot and one pose of it."""
    instance("geometry", geometry, Geometry)
    if instance("configuration", configuration, Configuration).shape != ():
        raise ValueError(f"configuration: got a stack of shape {configuration.shape}, expected a single one")
    for name, value in (("position", configuration.position), ("internal_point", configuration.internal_point)):
        numbers(f"configuration.{name}", value, 3)


def of_kind(name: str, value: Any, kind: str, *parts: str) -> Any:
    """Return an object of a class of a room below, told by its parts."""
    if isinstance(value, type) or not all(hasattr(value, part) for part in parts):
        raise ValueError(f"{name}: got {type(value).__name__}, expected a {kind}")
    return value


def section(name: str, value: Any, kind: str, *parts: str) -> None:
    """Raise unless this is a plane section of a workspace."""
    of_kind(name, value, kind, "axes", "plane", "horizontal", "vertical", "state", *parts)


def swept(result: Any, names: Sequence[str], made_by: str) -> SweepResult:
    """Return a result that has what the figure shows."""
    found: SweepResult = of_kind("result", result, "SweepResult", "arrays", "dims", "coords", "units")
    missing = [name for name in names if name not in found.arrays and name not in found.coords]
    if missing:
        raise ValueError(f"result: got one without {', '.join(missing)}, expected the result of {made_by}")
    return found


def sizes(name: str, value: Any) -> tuple[Floats, Floats]:
    """Return the axes of an ellipsoid in columns and its semi-axes, an infinite one included."""
    directions, semi_axes = pair(name, value, "directions (3, 3) and semi-axes (3,)")
    axes, half = as_floats(name, directions, ()), as_floats(name, semi_axes, ())
    if axes.shape != (3, 3) or half.shape != (3,):
        got = f"shapes {axes.shape} and {half.shape}"
        raise ValueError(f"{name}: got directions and semi-axes of {got}, expected (3, 3) and (3,)")
    if not (np.abs(axes) <= GREATEST).all() or not ((half <= GREATEST) | np.isposinf(half)).all() or (half < 0.0).any():
        raise ValueError(f"{name}: got semi-axes {half.tolist()}, expected numbers >= 0 with their directions")
    return axes, half
