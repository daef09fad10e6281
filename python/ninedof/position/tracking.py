"""Direct position analysis for control: follows the assembly mode of a known configuration."""

from __future__ import annotations

from enum import StrEnum
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.robot.configuration import Configuration, broadcast_flat, operands
from ninedof.robot.geometry import Geometry
from ninedof.support.arrays import Floats, as_floats, thread_argument


class TrackStatus(StrEnum):
    """How a step ended."""

    TRACKED = "tracked"
    """Reached, and proved to be where the start's mode goes along the straight path of the lengths."""
    LOST = "lost"
    """The mode ends on the path: as far as rounding tells it meets another, or O reaches a plane of internal joints."""
    INFEASIBLE = "infeasible"
    """The internal legs do not meet, or an external leg is too long or too short for the position of O."""
    UNPROVED = "unproved"
    """Neither is known: too many steps, a plate too small to place O, or a step after one that was not tracked."""


class Tracked(Configuration):
    """Configurations reached, with their certificates; NaN where a mode was not reached."""

    __slots__ = ("_numbers", "_status")
    _numbers: Floats
    _status: Any

    @property
    def status(self) -> Any:
        """A TrackStatus, or an array of them of the stack's shape."""
        return self._status

    @property
    def certificate(self) -> Any:
        """Kantorovich's number h = sqrt(3) beta eta of the end of the last step at its start, shape (...).

        For h <= 1/2 Newton's method is proved to converge, and to the only mode within `alone_within`. Above 1/2 the
        start is nearer than 0.385 times its `separation`, from where Newton's method converges too. In both cases
        bounds over the step prove that the mode reached is the continuous one.
        """
        return self._numbers[..., 0][()]

    @property
    def alone_within(self) -> Any:
        """No second mode with O on these sides is nearer to the start of the last step, rad; NaN where h > 1/2."""
        return self._numbers[..., 1][()]

    @property
    def separation(self) -> Any:
        """Separation of the mode from the nearest other one, as in AssemblyModes, shape (...)."""
        return self._numbers[..., 2][()]

    @property
    def steps(self) -> Any:
        """Number of steps into which the path was divided, shape (...)."""
        return self._numbers[..., 3].astype(np.int64)[()]

    @property
    def reached(self) -> Any:
        """Fraction of the path from the lengths of the start to the given ones, shape (...); 1 where tracked."""
        return self._numbers[..., 4][()]

    def __repr__(self) -> str:
        """Show a single configuration with its status, or the shape of a stack."""
        if self.shape:
            return f"<Tracked stack of shape {self.shape}>"
        return f"<{self.status}: {super().__repr__()}>"


def track(geometry: Geometry, leg_lengths: ArrayLike, start: Configuration, threads: int | None = None) -> Tracked:
    """Return the assembly mode reached from `start` when the leg lengths change along a straight path.

    O stays on its side of the plane of the base's internal joints and of that of the platform's, and follows in closed
    form from three spheres. The rotation follows by Newton's method on SO(3). "tracked" is a proof: while the lengths
    go straight from those of the start to the given ones, no singularity is passed, and the mode returned is the one
    that the start's becomes. It uses Kantorovich's theorem with bounds over the whole step; where they are too wide the
    step is divided. At a singularity the mode can continue in two ways: it is "lost" there, and NaN is returned. Where
    neither could be proved, the status is "unproved".

    Parameters
    ----------
    geometry : Geometry
    leg_lengths : array_like
        Shape (..., 9), broadcast against `start`: one step each. With one dimension more than `start` has, shape
        (..., n, 9): a trajectory of n steps, each from the configuration of the one before.
    start : Configuration
        The known configuration, shape (...). The path of the lengths begins at its own lengths.
    threads : int, optional
        Number of threads; one per processor by default. The result does not depend on it.

    Returns
    -------
    Tracked
        Configurations of the shape of `leg_lengths` without its last dimension, with `status`, `certificate`,
        `alone_within`, `separation`, `steps` and `reached`. NaN from the first step on that is not
        tracked; the steps after it are not tried and "unproved", and so is a row of lengths with NaN.
        `forward_position` lists the modes for such lengths.

    Raises
    ------
    ValueError
        If a length is negative or infinite, or shapes do not fit.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> home = nd.Configuration.neutral(3.9828, 2.4432)
    >>> there = home.moved([0.02, 0.0, 0.01, 0.05, 0.0, 0.1, 0.0, 0.03, 0.05])
    >>> now = nd.track(g, nd.leg_lengths(g, there), home)
    >>> now.status, bool(now.certificate < 0.5), bool(abs(now.position - there.position).max() < 1e-13)
    (<TrackStatus.TRACKED: 'tracked'>, True, True)

    """
    operands(geometry, start, "start")
    lengths = as_floats("leg_lengths", leg_lengths, (9,))
    is_path = lengths.ndim - 1 > len(start.shape)
    path = lengths.shape[-2] if is_path else 1
    shape, home, (rows,) = broadcast_flat(start, leg_lengths=(lengths, 2 if is_path else 1))
    flat, status = _core.track(geometry, rows.reshape(-1, 9), path, home, thread_argument(threads))
    full = (*shape, path) if is_path else shape
    words = np.array([TrackStatus(word) for word in _core.track_statuses], dtype=object)[status]
    found = Tracked._shaped(full, flat[:, :3], flat[:, 3:12], flat[:, 12:15])
    found._numbers, found._status = flat[:, 15:].reshape(*full, 5), words.reshape(full)[()]
    return found
