"""Direct position analysis: every configuration that has given leg lengths."""

from __future__ import annotations

from enum import StrEnum
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ninedof import _core
from ninedof.robot.configuration import Configuration, require_geometry
from ninedof.robot.geometry import Geometry
from ninedof.support.arrays import Floats, as_floats, thread_argument

CHUNK = 4096  # rows per call of the core: Ctrl-C is checked between chunks, and the modes of a chunk fit into memory

OBSTACLES = {
    "lower_legs": "no point has the distances r1 r2 r3 from the base's joints: the lower internal legs do not meet",
    "upper_legs": "no point has the distances q1 q2 q3 from the platform's joints: the upper internal legs do not meet",
    "external_leg_1": "the external leg l1 is too long or too short for the position of O that the internal legs give",
    "external_leg_2": "the external leg l2 is too long or too short for the position of O that the internal legs give",
    "external_leg_3": "the external leg l3 is too long or too short for the position of O that the internal legs give",
    "external_legs": "no rotation of the platform fits the external legs l1 l2 l3 together",
}


class PositionStatus(StrEnum):
    """The solutions for nine leg lengths."""

    FOUND = "found"
    """Finitely many modes, all simple: each changes smoothly with the lengths."""
    TANGENT = "tangent"
    """Finitely many modes, two of which meet within rounding in a singular configuration, known to half the digits."""
    INFEASIBLE = "infeasible"
    """No configuration has these lengths, or, if not `certain`, none was found; `reason` names the legs."""
    SELF_MOTION = "self_motion"
    """The robot can move with these lengths locked, within rounding: infinitely many modes, which are not listed."""
    NO_DATA = "no_data"
    """The row of lengths has NaN."""


class AssemblyModes(Configuration):
    """The assembly modes of one set of lengths, a stack of shape (count,), or of many, shape (..., most).

    With many sets of lengths the modes come first along the last axis, followed by NaN.
    """

    __slots__ = ("_base_side", "_certain", "_count", "_platform_side", "_reason", "_separation", "_status")
    _base_side: NDArray[np.int64]
    _certain: Any
    _count: Any
    _platform_side: NDArray[np.int64]
    _reason: Any
    _separation: Floats
    _status: Any

    @property
    def status(self) -> Any:
        """A PositionStatus, or an array of them, shape (...)."""
        return self._status

    @property
    def reason(self) -> Any:
        """Why there is no mode; empty if there is one. A string, or an array of shape (...)."""
        return self._reason

    @property
    def count(self) -> Any:
        """Number of modes, 0 to 32. An integer, or an array of shape (...)."""
        return self._count

    @property
    def certain(self) -> Any:
        """Whether the count is confirmed. A bool, or an array of shape (...).

        A count of zero included. True if every root of the eliminant was isolated and became a separate mode, or if the
        null-space method found simple solutions only. False near a double solution, where two modes may be one or none,
        and where the scales of the robot and its lengths are too different to decide.
        """
        return self._certain

    @property
    def separation(self) -> Floats:
        """Separation of each mode from the nearest other one, shape of the stack; 0 if singular, at most sqrt(3).

        Smallest singular value of the rows (Q w_i) x d_i, d_i and w_i being unit vectors from O to the external joints.
        """
        return self._separation

    @property
    def base_side(self) -> NDArray[np.int64]:
        """Side of O relative to the plane of the base's internal joints: 1 along (c2 - c1) x (c3 - c1), -1, 0 in it."""
        return self._base_side

    @property
    def platform_side(self) -> NDArray[np.int64]:
        """The same for the platform's internal joints, in the platform frame."""
        return self._platform_side

    def __repr__(self) -> str:
        """Show the number of modes, or the reason for having none."""
        if len(self.shape) != 1:
            return f"<AssemblyModes of shape {self.shape}>"
        return f"<{self.count} assembly modes: {self.status}{', ' + self.reason if self.reason else ''}>"


def forward_position(geometry: Geometry, leg_lengths: ArrayLike, threads: int | None = None) -> AssemblyModes:
    """Return every configuration that has the given leg lengths: all real assembly modes, up to 32.

    The lower internal legs leave two points for O in the base frame, the upper ones two in the platform frame. For each
    of the four combinations up to eight rotations fit the external legs. They are found by eliminating one angle, which
    leaves a polynomial of degree eight. Each root is polished on SO(3) until all nine lengths hold, and the number of
    modes is compared with the number of roots. If they differ, a null-space method solves the branch again. If base and
    platform are planar, half the modes are mirror images of the other half.

    Parameters
    ----------
    geometry : Geometry
    leg_lengths : array_like, shape (..., 9)
        l1 l2 l3 q1 q2 q3 r1 r2 r3, the order of eq. (35b), >= 0, in the length unit of the geometry.
    threads : int, optional
        Number of threads; one per processor by default. The result does not depend on it.

    Returns
    -------
    AssemblyModes
        A stack of configurations of shape (count,), with `status`, `reason`, `separation` and the sides of O. For many
        rows, shape (..., most): `count` modes first, then NaN. The order is that of the branches. Lengths
        with no configuration, or with infinitely many, give an empty stack and the corresponding status.

    Raises
    ------
    ValueError
        If a length is negative or infinite, or all nine are zero. NaN is invalid in a single row; in a stack it
        marks a row without data.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> lengths = nd.leg_lengths(g, nd.Configuration.neutral(3.9828, 2.4432))
    >>> modes = nd.forward_position(g, lengths)
    >>> modes
    <32 assembly modes: found>
    >>> bool(abs(nd.leg_lengths(g, modes) - lengths).max() < 1e-14 * lengths.max())
    True
    >>> nd.forward_position(g, lengths * [1, 1, 1, 1, 1, 1, 0.5, 0.5, 0.5]).status
    <PositionStatus.INFEASIBLE: 'infeasible'>

    """
    require_geometry(geometry)
    lengths = as_floats("leg_lengths", leg_lengths, (9,))
    if lengths.ndim == 1 and np.isnan(lengths).any():
        raise ValueError("leg_lengths: got NaN, expected nine finite lengths >= 0")
    rows = np.ascontiguousarray(lengths.reshape(-1, 9))
    workers = thread_argument(threads)
    chunks = [
        _core.forward_position(geometry, rows[k : k + CHUNK], workers) for k in range(0, max(1, len(rows)), CHUNK)
    ]
    counts, certain, flat, separation, sides = (np.concatenate([c[k] for c in chunks]) for k in (0, 3, 4, 5, 6))
    status = [PositionStatus(word or "no_data") for c in chunks for word in c[1]]
    reason = [OBSTACLES.get(word, "") for c in chunks for word in c[2]]
    shape, most = lengths.shape[:-1], int(counts.max(initial=0))
    places = np.flatnonzero(np.arange(most) < counts[:, None])  # of the modes of all rows in a padded stack

    def padded(values: NDArray[Any], width: int, fill: float) -> NDArray[Any]:
        out = np.full((len(counts) * most, width), fill, dtype=values.dtype)
        out[places] = values.reshape(-1, width)
        return out

    full, poses = (*shape, most), padded(flat, 15, np.nan)
    modes = AssemblyModes._shaped(full, poses[:, :3], poses[:, 3:12], poses[:, 12:])
    modes._base_side, modes._platform_side = (x.reshape(full) for x in padded(sides.astype(np.int64), 2, 0).T)
    modes._separation = padded(separation, 1, np.nan).reshape(full)
    modes._certain, modes._count = certain.astype(bool).reshape(shape)[()], counts.astype(np.int64).reshape(shape)[()]
    modes._reason = np.array(reason, dtype=object).reshape(shape)[()]
    modes._status = np.array(status, dtype=object).reshape(shape)[()]
    if shape == ():
        modes._certain, modes._count = bool(modes._certain), int(modes._count)
    return modes
