"""The characteristic length that makes the Jacobian homogeneous."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.robot.configuration import Configuration, operands
from ninedof.robot.geometry import Geometry
from ninedof.support.arrays import Floats, as_floats

__all__ = ["characteristic_length"]

KINDS = ("optimal", "natural", "mean_leg", "platform_radius")


def characteristic_length(geometry: Geometry, configuration: Configuration, kind: str = "optimal") -> Any:
    """Return the length that makes the Jacobian homogeneous, chosen from the robot itself.

    Parameters
    ----------
    geometry : Geometry
    configuration : Configuration
        Shape (...).
    kind : {"optimal", "natural", "mean_leg", "platform_radius"}
        "optimal" makes the condition number least: it is quasi-convex in the length, so that the one change of sign of
        its slope is that length. "natural" makes rotation and translation weigh the same in the leg rates, the
        Frobenius norms of the two halves of M being equal; at an isotropic design it is the length that shows the
        isotropy. "mean_leg" is the mean of the nine legs; "platform_radius" the largest distance of a platform joint
        from the platform origin.

    Returns
    -------
    float or numpy.ndarray, shape (...)
        In the length unit of the input. "optimal" and "natural" are NaN at a singular configuration.

    """
    if not isinstance(kind, str):
        raise ValueError(f"kind: got {kind!r}, expected one of {', '.join(KINDS)}")
    flat = _core.characteristic_length(*operands(geometry, configuration), kind, 0)
    return flat.reshape(configuration.shape)[()]


def resolve_length(geometry: Geometry, configuration: Configuration, length: ArrayLike | str) -> Floats:
    """Return a characteristic length as a flat array of one value, or of one for each configuration."""
    operands(geometry, configuration)
    if isinstance(length, str):
        found = np.reshape(characteristic_length(geometry, configuration, length), -1)
        # No length helps a singular pose, and none is known for a missing one: any will show them as such.
        return np.where(np.isnan(found), 1.0, found)
    value = as_floats("characteristic_length", length, ())
    if value.size == 1:
        return value.reshape(-1)
    try:
        return np.ascontiguousarray(np.broadcast_to(value, configuration.shape)).reshape(-1)
    except ValueError:
        raise ValueError(
            f"characteristic_length: got shape {value.shape}, expected one that broadcasts to {configuration.shape}"
        ) from None
