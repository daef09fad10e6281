"""The characteristic length that makes the Jacobian homogeneous."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.robot.configuration import Configuration, Flat, operands
from ninedof.robot.designs import takes_designs
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import choice, did_you_mean, finite, shown
from ninedof.support.arrays import Floats, as_floats

KINDS = ("optimal", "natural", "mean_leg", "platform_radius")


@takes_designs
def characteristic_length(geometry: Geometry, configuration: Configuration, kind: str = "optimal") -> Any:
    """Return the length that makes the Jacobian homogeneous, computed from the robot.

    Parameters
    ----------
    geometry : Geometry, Result or Design
    configuration : Configuration
        Shape (...).
    kind : {"optimal", "natural", "mean_leg", "platform_radius"}
        "optimal" minimizes the condition number, which is quasi-convex in the length: the sign change of its slope is
        the minimum. "natural" gives rotation and translation the same weight in the leg rates: the Frobenius norms of
        the angular and the translational columns of M are equal. An isotropic design is isotropic with this length.
        "mean_leg" is the mean of the nine leg lengths, "platform_radius" the largest distance of a platform joint from
        the platform origin.

    Returns
    -------
    float or numpy.ndarray, shape (...)
        In the length unit of the input. "optimal" and "natural" are NaN at a singular configuration.

    """
    flat = _core.characteristic_length(*operands(geometry, configuration), choice("kind", kind, KINDS), 0)
    return flat.reshape(configuration.shape)[()]


def resolve_length(geometry: Geometry, configuration: Configuration, length: ArrayLike | str) -> Floats:
    """Return a characteristic length as a flat array of one value, or one value per configuration."""
    if isinstance(length, str):
        kind = choice("characteristic_length", length, KINDS)
        lengths = np.reshape(characteristic_length(geometry, configuration, kind), -1)
        # Singular and missing poses have no such length: their results are infinite or NaN with any length.
        return np.where(np.isnan(lengths), 1.0, lengths)
    lengths, shape = as_floats("characteristic_length", length, ()), configuration.shape
    if lengths.size == 1:
        return lengths.reshape(-1)
    try:
        return np.ascontiguousarray(np.broadcast_to(lengths, shape)).reshape(-1)
    except ValueError:
        got = f"got shape {lengths.shape}, expected one that broadcasts to {shape}"
        raise ValueError(f"characteristic_length: {got}") from None


def operands_and_length(
    geometry: Geometry, configuration: Configuration, length: ArrayLike | str
) -> tuple[Geometry, Configuration | Flat, Floats]:
    """Return the operands of the core with the characteristic length as `resolve_length` gives it."""
    return *operands(geometry, configuration), resolve_length(geometry, configuration, length)


def length_argument(length: Any) -> float | str:
    """Return one characteristic length: a finite number above 0, or the name of a kind."""
    if isinstance(length, str) and length not in KINDS:
        expected = f"one of {', '.join(KINDS)}, or a number: its unit is the length unit of the study or design"
        raise ValueError(
            f"characteristic_length: got {shown(length)}, expected {expected}{did_you_mean(length, KINDS)}"
        )
    if isinstance(length, str):
        return length
    value = finite("characteristic_length", length)
    if not value > 0.0:
        raise ValueError(f"characteristic_length: got {shown(length)}, expected a number above 0")
    return value


def length_at(geometry: Geometry, configuration: Configuration, length: float | str) -> float:
    """Return one characteristic length as a number: that of a kind at a single pose, NaN where it has none there."""
    number = length_argument(length)
    return float(characteristic_length(geometry, configuration, number)) if isinstance(number, str) else number
