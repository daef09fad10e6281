"""Lower bounds of the condition number at the neutral pose.

Some are proved, some are the best values of long searches; each says which. They hold for every
characteristic length l_c, since all lengths in them are measured in l_c.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ninedof.conditioning.conditioning import axis_singular_values
from ninedof.optimize.candidate import best_of
from ninedof.optimize.result import Result
from ninedof.proof.bounds import leg_length_bounds
from ninedof.proof.machine_record import outward
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import instance
from ninedof.support.text import short_repr

CERTIFICATE = "certificate"
"""Name of the bound that `Result.proof` has."""

HEXAGONAL_LIMIT = 2.5358420229115416
"""Infimum over the plates of eqs. (37)-(38) with 0 < zs < zp and no twist: the base grows without end."""

HEXAGONAL_TWIST_LIMIT = 2.5311101749895220
"""The same with the twist theta_z free."""


LEAST_RHO = 0.51
"""|s - p| / l_c from which `kappa_star` bounds every design found. Below about 0.5025 designs with two threefold
singular values do better than its sub-family."""


@short_repr
@dataclass(frozen=True)
class LowerBound:
    """A lower bound of the condition number at the neutral pose, or, of a certificate, over the poses of a study."""

    name: str
    value: float
    proved: bool
    """Whether it is proved; otherwise no search has found a smaller value."""
    sentence: str


def kappa_star(rho: float) -> float:
    """Return the least condition number of a C3 design on its axis for a given distance of O from the platform.

    The square root of the smallest root K >= 1 of

        2 K^4 - (87 q + 47) K^3 + (264 + 33 q - 27 q^2) K^2 + (144 + 132 q + 27 q^2 - q^3) K + q^2 (q + 3),  q = rho^2.

    It is the exact minimum of a sub-family (equal steepness of both internal triples, horizontal external legs). No
    search over all C3 designs has come under it from rho = 0.505 on; below, designs outside the sub-family do: 2.28641
    against 2.28642 at rho = 0.5, 2.6978 against 2.7790 at 0.25.

    Parameters
    ----------
    rho : float
        |s - p| / l_c, at least 0; infinity allowed.

    Returns
    -------
    float
        From sqrt(12) at rho = 0, falling to 1 at infinity like 1 + 3 / (2 rho^2).

    Raises
    ------
    ValueError
        If rho is negative or not a number.

    Examples
    --------
    >>> from ninedof.optimize.bounds import kappa_star
    >>> round(kappa_star(1.5396), 6)
    1.411798

    """
    if not rho >= 0.0:
        raise ValueError(f"rho: got {rho!r}, expected a number of at least 0")
    if rho > 1e6:  # 1 + 3 / (2 rho^2), and rho^6 is too large for what follows
        return 1.0 + 1.5 / rho**2
    if rho < 1e-6:  # K = 12 becomes a double root, which no eigenvalue solver gives to more than half its digits
        return math.sqrt(12.0) - math.sqrt(10.0) * rho
    # Written in d = K - 1, with a constant term of one sign: nothing cancels where K comes close to 1.
    q = rho * rho
    exact = (
        2.0,
        -39.0 - 87.0 * q,
        135.0 - 228.0 * q - 27.0 * q**2,
        539.0 - 63.0 * q - 27.0 * q**2 - q**3,
        363.0 + 78.0 * q + 3.0 * q**2,
    )
    coefficients = np.array(exact) / max(1.0, q**3)
    roots = np.roots(coefficients)
    d = float(min(root.real for root in roots if root.real > 0.0 and abs(root.imag) <= 1e-6 * abs(root)))
    for _ in range(4):  # Newton's method takes out what the eigenvalue solver leaves
        d -= float(np.polyval(coefficients, d) / np.polyval(np.polyder(coefficients), d))
    return math.sqrt(1.0 + d)


def planar_leg_ratio_bound(ratio: float) -> float:
    """Return the least condition number of planar C3 designs with 0 < zs < zp whose legs differ by a factor at most.

    c + sqrt(1 + c^2) with c = 2 sqrt(2) / ratio: the axial block alone forces it. Attained with zs = zp / 2 where no
    other limit is in the way.

    Parameters
    ----------
    ratio : float
        Longest leg / shortest leg, at least 1.

    Raises
    ------
    ValueError
        If the ratio is under 1 or not a number.

    Examples
    --------
    >>> from ninedof.optimize.bounds import planar_leg_ratio_bound
    >>> round(planar_leg_ratio_bound(3.0), 10)
    2.3171775835

    """
    if not ratio >= 1.0:
        raise ValueError(f"ratio: got {ratio!r}, expected a number of at least 1")
    c = 2.0 * math.sqrt(2.0) / ratio
    return c + math.sqrt(1.0 + c * c)


def applicable_bounds(result: Result) -> list[LowerBound]:
    """Return every lower bound that holds for the design of a result, the largest first.

    Parameters
    ----------
    result : Result
        One with a design.

    Returns
    -------
    list of LowerBound
        Of the condition number at the neutral pose; the one that a certificate proves is of the worst over all poses of
        the study. The bounds of symmetric designs are left out where the design has no three-fold symmetry, and those
        that are not proved and lie below `Result.lower_bound`.

    Raises
    ------
    ValueError
        If the result holds no design.

    """
    best = best_of(instance("result", result, Result))
    bounds = [
        LowerBound(
            "isotropy", 1.0, True, "no design is isotropic: the condition number stays above 1 at every finite size"
        )
    ]
    if result.proof is not None:
        sentence = result.proof.words.removeprefix("Proved: ").removesuffix(".")
        bounds.append(LowerBound(CERTIFICATE, result.proof.lower_bound, True, sentence))
    if result.study.family == "hexagonal" and not result.study.tool:
        bounds.append(_hexagonal(result.study.variables["theta_z"]))
    if _is_symmetric(best.geometry, best.configuration):
        bounds.extend(_symmetric(best.geometry, best.configuration, best.characteristic_length))
    least = result.lower_bound or 0.0
    return sorted((b for b in bounds if b.proved or b.value > least), key=lambda bound: -bound.value)


def _hexagonal(theta_z: float | tuple[float, float]) -> LowerBound:
    if theta_z == 0.0:
        value, which = HEXAGONAL_LIMIT, "hexagonal plates without twist"
    else:
        value, which = HEXAGONAL_TWIST_LIMIT, "hexagonal plates with any twist"
    return LowerBound("hexagonal", value, False, f"no design with {which} has been found under {_digits(value)}")


SLACK = 1e-15  # more than a quotient, or the bound, is rounded by


def _symmetric(g: Geometry, c: Configuration, length: float) -> list[LowerBound]:
    zp, zs = float(c.position[2]), float(c.internal_point[2])
    out = []
    rho = abs(zs - zp) / length
    if rho >= LEAST_RHO:
        star = kappa_star(rho)
        sentence = f"no design with this |s - p| has been found under {_digits(star)}, three-fold symmetric or not"
        out.append(LowerBound("distance of O", star, False, sentence))
    joints = np.vstack([g.base_external, g.base_internal, g.platform_external, g.platform_internal])
    planar = float(np.abs(joints[:, 2]).max()) <= 1e-12 * float(np.abs(joints).max())
    if planar and 0.0 < zs < zp:
        shortest, longest = leg_length_bounds(g, c)
        ratio = max(float(longest.max() / shortest.min()), 1.0) * (1.0 + SLACK)
        value = planar_leg_ratio_bound(ratio) * (1.0 - SLACK)
        legs = outward(ratio, up=False, digits=4)  # legs within less stay above more
        sentence = (
            f"no three-fold symmetric design with flat plates and legs within {legs} : 1 can be under {_digits(value)}"
        )
        out.append(LowerBound("leg ratio", value, True, sentence))
    return out


def _is_symmetric(g: Geometry, c: Configuration) -> bool:
    """Whether the closed form on the symmetry axis accepts the design: it raises for all others."""
    try:
        axis_singular_values(g, c)
    except ValueError:
        return False
    return True


def _digits(value: float) -> str:
    """Round down: the printed number is a bound as well."""
    return f"{math.floor(value * 1e6) / 1e6:.6f}"
