"""Singularities: the determinants, the weakest mechanism and the uncontrolled motions."""

from __future__ import annotations

from enum import StrEnum
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.robot.configuration import Configuration, operands, single
from ninedof.robot.designs import takes_designs
from ninedof.robot.geometry import Geometry
from ninedof.support.arrays import Floats, as_number, checked_out, thread_argument
from ninedof.support.text import short_repr


class Mechanism(StrEnum):
    """A way in which nine locked legs can fail to hold the robot."""

    NONE = ""
    """Nothing, or a configuration without data."""
    N = "n"
    """The planes (O, A_i, B_i) of the external legs share a line through O; the platform turns about it."""
    B = "b"
    """O is in the plane of the lower internal joints; it can leave the plane, and the platform moves with it."""
    C = "c"
    """O is in the plane of the upper internal joints; the platform can move while O is at rest."""


@short_repr
class SingularityMargins(NamedTuple):
    """Signed determinants, each in [-1, 1]: zero at a singularity, the same in any length unit."""

    det_n: Any
    """Of the rows d^_i x w^_i, unit vectors from O to the joints of external leg i; shape (...)."""
    det_b: Any
    """Of the unit vectors of the lower internal legs, base joint to O; shape (...)."""
    det_c: Any
    """Of the unit vectors of the upper internal legs, platform joint to O; shape (...)."""


@short_repr
class Singularity(NamedTuple):
    """The weakest mechanism of a configuration; leading dimensions are those of the configuration."""

    margins: SingularityMargins
    """Signed determinants of the three mechanisms."""
    smallest: Floats
    """Smallest singular values of the same three matrices in the order n, b, c, shape (..., 3)."""
    mechanism: Any
    """The `Mechanism` whose smallest singular value is least; for a stack an array of their values."""
    omega: Floats
    """Turn of the platform in its uncontrolled motion, rad, base frame, shape (..., 3)."""
    pdot: Floats
    """Displacement of the platform origin in it, length, shape (..., 3)."""
    sdot: Floats
    """Displacement of the internal point in it, length, shape (..., 3)."""


@takes_designs
def singularity_margins(
    geometry: Geometry, configuration: Configuration, threads: int | None = None, out: Floats | None = None
) -> SingularityMargins:
    """Return the signed, length-free determinants whose zeros are the singularities.

    det H = -det N' det C det B / l_c^3, N' with rows w_i x e_i: each factor is an independent singularity and changes
    sign across it. The three determinants are those of rows without unit, as defined below. Their size
    measures how different the directions of the legs are, not the distance to a singularity; for that see `singularity`
    and `distance_to_singularity`. Theory of position and velocity, section 5.

    Parameters
    ----------
    geometry : Geometry, Result or Design
    configuration : Configuration
        Shape (...).
    threads : int, optional
        Number of threads; one per processor by default. The result does not depend on it.
    out : numpy.ndarray, shape (..., 3), optional
        Array for the result: float64, C-contiguous, aligned. The result is a view of it.

    Returns
    -------
    SingularityMargins
        det_n, det_b, det_c in [-1, 1], each a float or of shape (...), of the rows d^_i x w^_i (N), e^_i (B) and
        e~_i (C). det_n is also the Jacobian determinant of the rotation problem with unit vectors;
        det N' = det_n |d_1||w_1||d_2||w_2||d_3||w_3| / (l1 l2 l3).
        A leg of zero length, and a joint of an external leg at O, make their determinant 0.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> margins = nd.singularity_margins(g, nd.Configuration.neutral(3.9828, [0.0, 2.4432]))
    >>> margins.det_b.round(4)
    array([ 0.    , -0.9994])

    """
    poses = operands(geometry, configuration)
    checked_out(out, (*configuration.shape, 3))
    flat = _core.singularity_margins(*poses, thread_argument(threads), out)
    return _margins(flat.reshape(-1, 3), configuration.shape)


@takes_designs
def singularity(geometry: Geometry, configuration: Configuration, threads: int | None = None) -> Singularity:
    """Return the weakest mechanism, and the motion that locked legs resist least. Parameters as in `leg_lengths`.

    Returns
    -------
    Singularity
        The mechanism is the one of least singular value; if several are singular to rounding (1.4e-14), the first of n,
        c, b, so that the motion exists. The motion changes the lengths of its own legs only: n of the external ones
        (sdot = 0, the platform turns about a line through O), c of the upper (sdot = 0), b of the lower (sdot normal to
        their plane). At a singular configuration it changes no length. Its size is that of a turn by one radian,

            |omega|^2 + (|v_O|^2 + |sdot|^2) / L^2 = 1,    v_O = pdot + omega x (s - p),

        L the root mean square distance of the six platform joints from O: the same motion in any length unit, its sign
        arbitrary. It is NaN where a leg of zero length is the cause: that leg locks its two ends together.

    See Also
    --------
    uncontrolled_motions : all of them, when more than one mechanism is lost.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> weakest = nd.singularity(g, nd.Configuration.neutral(3.9828, 0.0))
    >>> weakest.mechanism
    <Mechanism.B: 'b'>
    >>> bool(abs(weakest.sdot[2]) > 1.0)
    True

    """
    flat, shape = _core.singularity(*operands(geometry, configuration), thread_argument(threads)), configuration.shape
    smallest, omega, pdot, sdot = (flat[:, k : k + 3].reshape(*shape, 3) for k in (3, 7, 10, 13))
    return Singularity(_margins(flat[:, :3], shape), smallest, mechanisms_of(flat[:, 6], shape), omega, pdot, sdot)


@takes_designs
def uncontrolled_motions(geometry: Geometry, configuration: Configuration, tolerance: float = 1e-9) -> Floats:
    """Return every independent motion that changes no leg length.

    Parameters
    ----------
    geometry : Geometry, Result or Design
    configuration : Configuration
        One configuration.
    tolerance : float
        Largest leg rate of such a motion, over L. The 9x9 matrix of leg rates H acts on (L omega, v_O, sdot), as in
        `singularity`; its singular values are about 0.1 to 2 in a good configuration and a few 1e-16 in a singular one.

    Returns
    -------
    numpy.ndarray, shape (k, 9)
        Rows (omega, pdot, sdot), base frame, by ascending singular value; no rows at a regular configuration. A small
        multiple of a row is a tangent for `Configuration.moved`; leg lengths change in second order. Rows are
        orthonormal in the measure of `singularity`. A leg of zero length holds its two ends together.

    Raises
    ------
    ValueError
        If a stack is given, the configuration has NaN, or the tolerance is not finite and positive.

    Examples
    --------
    Both plates and O in one plane:

    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> nd.uncontrolled_motions(g, nd.Configuration([0, 0, 0], internal_point=[0.1, 0, 0])).shape
    (4, 9)

    """
    return _core.uncontrolled_motions(*single(geometry, configuration), as_number("tolerance", tolerance))


def _margins(flat: Floats, shape: tuple[int, ...]) -> SingularityMargins:
    return SingularityMargins(*(flat[:, k].reshape(shape)[()] for k in range(3)))


def mechanisms_of(codes: ArrayLike, shape: tuple[int, ...] = ()) -> Any:
    """Return the mechanisms of the core's codes: one, or an array of their values."""
    values = np.array(list(Mechanism), dtype="U1")[np.asarray(codes, dtype=int)].reshape(shape)  # in the core's order
    return values if shape else Mechanism(str(values))
