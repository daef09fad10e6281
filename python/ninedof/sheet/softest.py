"""The least stiffness over directions."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.statics.statics import stiffness
from ninedof.support.arrays import Floats


def softest(g: Geometry, c: Configuration, leg_stiffness: ArrayLike) -> tuple[Floats, Floats]:
    """Return the least stiffness of a shift, the platform free to turn, and of a turn, free to shift, shape (n,)."""
    k = stiffness(g, c, leg_stiffness)
    shift = _least_of_block(k[:, 3:, 3:], k[:, :3, 3:], k[:, :3, :3])
    return shift, _least_of_block(k[:, :3, :3], k[:, 3:, :3], k[:, 3:, 3:])


def _least_of_block(kept: Floats, mixed: Floats, freed: Floats) -> Floats:
    """Return the least stiffness of one block where the other coordinates settle: of the Schur complement."""
    with np.errstate(over="ignore", invalid="ignore"):  # of stiffnesses near the smallest number
        settled = np.swapaxes(mixed, -1, -2) @ np.linalg.pinv(freed, rcond=1e-13, hermitian=True) @ mixed
    values = np.linalg.eigvalsh(kept - settled)
    return np.asarray(np.maximum(values[..., 0], 0.0))
