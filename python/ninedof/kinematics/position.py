"""Direct position analysis: every configuration that has given leg lengths, and the one that a known one becomes."""

from __future__ import annotations

from enum import StrEnum
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.kinematics.certificate import certificate_of, column, each, with_gaps
from ninedof.robot.configuration import Configuration, broadcast_flat, operands
from ninedof.robot.designs import takes_designs
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import flag, instance
from ninedof.support.arrays import Floats, as_floats, thread_argument

CHUNK = 4096  # rows per call of the core: Ctrl-C is checked between chunks, and the modes of a chunk fit into memory

TOO_FAR = "the external leg l{} is too long or too short for the position of O that the internal legs give"
OBSTACLES = {
    "lower_legs": "no point has the distances r1 r2 r3 from the base's joints: the lower internal legs do not meet",
    "upper_legs": "no point has the distances q1 q2 q3 from the platform's joints: the upper internal legs do not meet",
    "external_legs": "no rotation of the platform fits the external legs l1 l2 l3 together",
} | {f"external_leg_{i}": TOO_FAR.format(i) for i in (1, 2, 3)}


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


class _Value(property):
    """A value of `Solutions`, under the name that it has there."""

    def __init__(self, doc: str) -> None:
        super().__init__(lambda solutions: solutions._values[self._name], doc=doc)

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name


class Solutions(Configuration):
    """Configurations that have given leg lengths, with values by name."""

    __slots__ = ("_values",)
    _values: dict[str, Any]

    @classmethod
    def _with(cls, shape: tuple[int, ...], poses: Floats, **values: Any) -> Self:
        """Build a stack of a shape from rows of fifteen numbers: p, Q and s."""
        out = cls._shaped(shape, poses[:, :3], poses[:, 3:12], poses[:, 12:15])
        out._values = values
        return out


class AssemblyModes(Solutions):
    """The assembly modes of one set of lengths, a stack of shape (count,), or of many, shape (..., most).

    With many sets of lengths the modes come first along the last axis, followed by NaN.
    """

    __slots__ = ()

    status = _Value("A PositionStatus, or an array of them, shape (...).")
    reason = _Value("Why there is no mode; empty if there is one. A string, or an array of shape (...).")
    count = _Value("Number of modes, 0 to 32. An integer, or an array of shape (...).")
    certain = _Value(
        """Whether the count is confirmed. A bool, or an array of shape (...).

        A count of zero included. True if every root of the eliminant was isolated and became a separate mode, or if the
        null-space method found simple solutions only. False near a double solution, where two modes may be one or none,
        and where the scales of the robot and its lengths are too different to decide.
        """
    )
    certificate = _Value("A ModesCertificate if it was asked for, None otherwise.")
    separation = _Value(
        """Separation of each mode from the nearest other one, shape of the stack; 0 if singular, at most sqrt(3).

        Smallest singular value of the rows (Q w_i) x d_i, d_i and w_i being unit vectors from O to the external joints.
        """
    )
    base_side = _Value(
        "Side of O relative to the plane of the base's internal joints: 1 along (c2 - c1) x (c3 - c1), -1, 0 in it."
    )
    platform_side = _Value("The same for the platform's internal joints, in the platform frame.")

    def __repr__(self) -> str:
        """Show the number of modes, or the reason for having none."""
        if len(self.shape) != 1:
            return f"<AssemblyModes of shape {self.shape}>"
        proof = self.certificate
        proved = "" if proof is None else ", proved" if proof.complete else f", {proof.proved} proved"
        return f"<{self.count} assembly modes: {self.status}{proved}{', ' + self.reason if self.reason else ''}>"


@takes_designs
def forward_position(
    geometry: Geometry, leg_lengths: ArrayLike, threads: int | None = None, certify: bool = False
) -> AssemblyModes:
    """Return every configuration that has the given leg lengths: all real assembly modes, up to 32.

    The lower internal legs leave two points for O in the base frame, the upper ones two in the platform frame. For each
    of the four combinations up to eight rotations fit the external legs. They are found by eliminating one angle, which
    leaves a polynomial of degree eight. Each root is polished on SO(3) until all nine lengths hold, and the number of
    modes is compared with the number of roots. If they differ, a null-space method solves the branch again. If base and
    platform are planar, half the modes are mirror images of the other half.

    Parameters
    ----------
    geometry : Geometry, Result or Design
    leg_lengths : array_like, shape (..., 9)
        l1 l2 l3 q1 q2 q3 r1 r2 r3, the order of eq. (35b), >= 0, in the length unit of the geometry.
    threads : int, optional
        Number of threads; one per processor by default. The result does not depend on it.
    certify : bool, optional
        Also prove how many modes there are and enclose each of them, in about half a millisecond: `certificate`. Modes
        that it proves and the list missed are added; once all is proved, the list holds the proved ones alone. A double
        mode stays undecided.

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
    >>> proof = nd.forward_position(g, lengths, certify=True).certificate
    >>> proof.complete, proof.proved, bool(proof.radius.max() < 1e-11)
    (True, 32, True)

    """
    instance("geometry", geometry, Geometry)
    lengths = as_floats("leg_lengths", leg_lengths, (9,))
    if lengths.ndim == 1 and np.isnan(lengths).any():
        raise ValueError("leg_lengths: got NaN, expected nine finite lengths >= 0")
    rows, workers = np.ascontiguousarray(lengths.reshape(-1, 9)), thread_argument(threads)
    chunks = [
        _core.forward_position(geometry, rows[k : k + CHUNK], flag("certify", certify), workers)
        for k in range(0, max(1, len(rows)), CHUNK)
    ]
    counts, flat, side = (column(chunks, name) for name in ("count", "configuration", "side"))
    status = np.array([PositionStatus(word or "no_data") for one in chunks for word in one.status], dtype=object)
    reason = np.array([OBSTACLES.get(word, "") for one in chunks for word in one.obstacle], dtype=object)
    shape = lengths.shape[:-1]
    full = (*shape, int(counts.max(initial=0)))
    base_side, platform_side = np.moveaxis(with_gaps(counts, side.astype(np.int64), 2, 0), -1, 0).reshape(2, *full)
    return AssemblyModes._with(
        full,
        with_gaps(counts, flat, 15, np.nan).reshape(-1, 15),
        status=each(shape, status),
        reason=each(shape, reason),
        count=each(shape, counts.astype(np.int64)),
        certain=each(shape, column(chunks, "certain").astype(bool)),
        separation=with_gaps(counts, column(chunks, "separation"), 1, np.nan).reshape(full),
        base_side=base_side,
        platform_side=platform_side,
        certificate=certificate_of(shape, counts, ~np.isnan(rows).any(axis=1), [one.certificate for one in chunks])
        if certify
        else None,
    )


class TrackStatus(StrEnum):
    """The end of a step."""

    TRACKED = "tracked"
    """Reached, and proved to be where the start's mode goes along the straight path of the lengths."""
    LOST = "lost"
    """The mode ends on the path: as far as rounding tells it meets another, or O reaches a plane of internal joints."""
    INFEASIBLE = "infeasible"
    """The internal legs do not meet, or an external leg is too long or too short for the position of O."""
    UNPROVED = "unproved"
    """Neither is known: too many steps, a plate too small to place O, or a step after one that was not tracked."""


class Tracked(Solutions):
    """Configurations reached, with their certificates; NaN where a mode was not reached."""

    __slots__ = ()

    status = _Value("A TrackStatus, or an array of them of the stack's shape.")
    certificate = _Value(
        """Kantorovich's number h = sqrt(3) beta eta of the end of the last step at its start, shape (...).

        For h <= 1/2 Newton's method is proved to converge, and to the only mode within `alone_within`. Above 1/2 the
        start is nearer than 0.385 times its `separation`, from where Newton's method converges too. In both cases
        bounds over the step prove that the mode reached is the continuous one.
        """
    )
    alone_within = _Value(
        "No second mode with O on these sides is nearer to the start of the last step, rad; NaN where h > 1/2."
    )
    separation = _Value("Separation of the mode from the nearest other one, as in AssemblyModes, shape (...).")
    steps = _Value("Number of steps into which the path was divided, shape (...).")
    reached = _Value(
        "Fraction of the path from the lengths of the start to the given ones, shape (...); 1 where tracked."
    )

    def __repr__(self) -> str:
        """Show a single configuration with its status, or the shape of a stack."""
        if self.shape:
            return f"<Tracked stack of shape {self.shape}>"
        return f"<{self.status}: {super().__repr__()}>"


@takes_designs
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
    geometry : Geometry, Result or Design
    leg_lengths : array_like
        Shape (..., 9), broadcast against `start`: one step each. With one dimension more than `start` has, shape
        (..., n, 9): a trajectory of n steps, each from the configuration of the one before.
    start : Configuration
        The known configuration, shape (...). The path of the lengths begins at its own lengths; those of the nearest
        rotation where its rotation is orthogonal to few digits.
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
    path = lengths.shape[len(start.shape) : -1][-1:]
    steps = path[0] if path else 1
    rows = lengths.reshape(*lengths.shape[: lengths.ndim - len(path) - 1], steps * 9)
    shape, home, rows = broadcast_flat(start, leg_lengths=(rows, steps * 9))
    flat, status = _core.track(geometry, rows.reshape(-1, 9), steps, home, thread_argument(threads))
    full = (*shape, *path)
    words = np.array([TrackStatus(word) for word in _core.track_statuses], dtype=object)[status]
    certificate, alone, separation, count, share = (column.reshape(full)[()] for column in flat[:, 15:].T)
    return Tracked._with(
        full,
        flat,
        status=words.reshape(full)[()],
        certificate=certificate,
        alone_within=alone,
        separation=separation,
        steps=count.astype(np.int64),
        reached=share,
    )
