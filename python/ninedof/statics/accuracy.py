"""Effect of errors of legs and joints on the pose: first-order bounds, and samples without linearization."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.robot.configuration import Configuration, Operands, operands, operands_with, single
from ninedof.robot.designs import takes_designs
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import choice, whole
from ninedof.support.arrays import Floats, all_finite, one_or_each, thread_argument
from ninedof.support.text import short_repr

DISTRIBUTIONS = ("uniform", "normal")
NORMAL = np.repeat([math.sqrt(1.0 / 3.0), math.sqrt(5.0) / 3.0], [9, 12])
"""Of legs and joints: uniform errors within such a share of the tolerances have the variances t^2/9 and rho^2/9."""
MOST_SAMPLES = 10_000_000  # 720 MB of errors


@short_repr
class ErrorBounds(NamedTuple):
    """First-order effect of errors; leading dimensions are those of the configuration and the tolerances."""

    components: Floats
    """Largest modulus of each of (rotation, displacement of p, displacement of O), base axes, shape (..., 9)."""
    rotation: Any
    """Largest rotation angle of the platform, rad, shape (...)."""
    position: Any
    """Largest displacement of p, shape (...)."""
    internal_point: Any
    """Largest displacement of O, shape (...)."""
    covariance: Floats
    """Covariance of (rotation, p, s) for independent errors, shape (..., 9, 9)."""


@takes_designs
def error_map(geometry: Geometry, configuration: Configuration) -> Floats:
    """Return the change of (rotation, p, s) per unit of error in the nine leg lengths: H^-1 of eqs. (24)-(26).

    An error d of a joint at the beginning of a leg (r_i, r^_i and u~_i) acts like a leg that is longer by the component
    of d along it, an error at its end (u_i) like a shorter leg. Directions are those of e, e~ and e^.
    Parameters as in `leg_lengths`.

    Returns
    -------
    numpy.ndarray, shape (..., 9, 9)
        Rows: rotation vector (rad/length), displacement of p, displacement of O, base axes. The first six are the
        Jacobian for l_c = 1. At a singular configuration the rows that the lengths do not determine are infinite: all
        nine if O lies in the plane of the lower joints, else the first six.

    """
    return _core.error_map(*operands(geometry, configuration), 0).reshape(*configuration.shape, 9, 9)


@takes_designs
def error_bounds(
    geometry: Geometry,
    configuration: Configuration,
    leg_errors: ArrayLike = 0.0,
    joint_errors: ArrayLike = 0.0,
    distribution: str = "uniform",
) -> ErrorBounds:
    """Return first-order bounds and the covariance of the motion of platform and O for errors within tolerances.

    An error d of a joint centre changes the effective length of its leg by the component of d along the leg. So a ball
    of radius rho adds exactly rho to the tolerance of that leg, and every set of errors is a point of a box of nine
    lengths. A linear map of a box has its largest value at a corner: `components` are sums of moduli, the three
    distances the maxima over all corners. All are attained, for different errors. The neglected terms are of second
    order in the tolerances; `error_samples` includes them.

    Parameters
    ----------
    geometry : Geometry, Result or Design
    configuration : Configuration
        Shape (...).
    leg_errors : float or array_like of shape (..., 9)
        Largest error of a leg, in both directions; the same for all, or in the order of `leg_lengths`. 0 by default.
    joint_errors : float or array_like of shape (..., 12)
        Largest distance of a joint centre from its nominal position; the same for all, or three for each triple in the
        order of `Geometry` (base external, base internal, platform external, platform internal). 0 by default. Errors
        of coincident joints are independent. The joint at O has no error: six legs meet in it exactly.
    distribution : {"uniform", "normal"}
        Of the errors behind the covariance, all independent. "uniform": anywhere within the tolerance alike, a leg in
        its interval, a joint in its ball. "normal": the tolerance is three standard deviations, of a leg and of a joint
        along each axis.

    Returns
    -------
    ErrorBounds
        Lengths in the unit of the input. The standard deviation of a component is the root of a diagonal entry of
        `covariance`. Of uniform errors a leg contributes the variance t^2/3 of its interval, a joint rho^2/5 along its
        leg; of normal ones t^2/9 and rho^2/9. Infinite if not determined at a singular configuration (in the
        covariance, NaN off the diagonal).

    Raises
    ------
    ValueError
        If a tolerance is negative, infinite or, but in a stack where it marks missing data, NaN.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=0.58124, b1=0.29062, b2=0.0)
    >>> c = nd.Configuration.neutral(0.39828, 0.24432)
    >>> bounds = nd.error_bounds(g, c, leg_errors=10e-6, joint_errors=20e-6)  # metres
    >>> print(f"{1e6 * bounds.position:.1f} um, {1e3 * bounds.rotation:.3f} mrad")
    152.5 um, 1.284 mrad

    """
    shape, flat, tolerances = _with_tolerances(geometry, configuration, leg_errors, joint_errors)
    out = _core.error_bounds(*flat, tolerances, 0).reshape(*shape, 93)
    if choice("distribution", distribution, DISTRIBUTIONS) == "normal":  # of uniform errors with the same variances
        out[..., 12:] = _core.error_bounds(*flat, tolerances * NORMAL, 0).reshape(*shape, 93)[..., 12:]
    rotation, position, internal_point = (out[..., k].copy()[()] for k in (9, 10, 11))
    covariance = out[..., 12:].reshape(*shape, 9, 9)
    return ErrorBounds(out[..., :9].copy(), rotation, position, internal_point, covariance.copy())


@takes_designs
def error_samples(
    geometry: Geometry,
    configuration: Configuration,
    leg_errors: ArrayLike = 0.0,
    joint_errors: ArrayLike = 0.0,
    samples: int = 10_000,
    seed: int = 0,
    threads: int | None = None,
) -> Floats:
    """Return the configurations that robots with random errors reach for an intended configuration: Monte Carlo.

    Each sample is a robot with joint errors in a ball and leg errors in an interval, all independent and uniform. It is
    set to the leg lengths of the intended configuration, and the configuration it reaches is computed without
    linearization.

    Parameters
    ----------
    geometry : Geometry, Result or Design
    configuration : Configuration
        The intended configuration, a single one.
    leg_errors : float or array_like of shape (9,)
    joint_errors : float or array_like of shape (12,)
        Tolerances as in `error_bounds`.
    samples : int
    seed : int
        The same seed gives the same samples, and the first samples of a longer run are those of a shorter one.
    threads : int, optional
        Number of threads; one per processor by default. The result does not depend on it.

    Returns
    -------
    numpy.ndarray, shape (samples, 9)
        Tangent (rotation vector, displacement of p, displacement of O) from the intended configuration to the one
        reached, base axes; `configuration.moved(tangent)` is the latter. A row is NaN if no configuration can be
        tracked from the intended one: errors too large, or a singular configuration.

    Raises
    ------
    ValueError
        If a tolerance is negative or not finite, or the configuration is a stack.

    Examples
    --------
    >>> import numpy as np
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=0.58124, b1=0.29062, b2=0.0)
    >>> c = nd.Configuration.neutral(0.39828, 0.24432)
    >>> off = nd.error_samples(g, c, leg_errors=10e-6, joint_errors=20e-6, samples=2000)
    >>> distance = np.linalg.norm(off[:, 3:6], axis=1)
    >>> print(f"95 % within {1e6 * np.quantile(distance, 0.95):.0f} um")
    95 % within 45 um

    """
    single(geometry, configuration)
    count, key = whole("samples", samples, 0, MOST_SAMPLES), whole("seed", seed, 0)
    shape, poses, tolerances = _with_tolerances(geometry, configuration, leg_errors, joint_errors)
    if shape:
        raise ValueError(f"leg_errors, joint_errors: got a stack of shape {shape}, expected those of one robot")
    return _core.error_samples(*poses, tolerances, count, key, thread_argument(threads))


def _with_tolerances(
    g: Geometry, c: Configuration, leg_errors: ArrayLike, joint_errors: ArrayLike
) -> tuple[tuple[int, ...], Operands, Floats]:
    legs, joints = one_or_each("leg_errors", leg_errors, 9), one_or_each("joint_errors", joint_errors, 12)
    for name, tolerances in (("leg_errors", legs), ("joint_errors", joints)):
        all_finite(name, tolerances, missing=tolerances.ndim > 1)
    return operands_with(g, c, leg_errors=(legs, 9), joint_errors=(joints, 12))
