"""The published design, read with care, and the studies that it is compared with.

Galfo and Sinatra print a1 = 0.0000, b1 = 5.8124, zp = 3.9828 (eq. 39) and k = 3.9110 (eq. 40), all in units of l_c.
Values of a2, b2 and zs are missing. Eqs. (37)-(38) name the base sides a and the platform sides b; section 5 has "the
fixed base twice the size of the mobile base, i.e. 2 a2 = b1", the other way round. Only the second reading reproduces
the number.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np

from ninedof.conditioning.conditioning import condition_number
from ninedof.conditioning.hexagonal import HEXAGONAL
from ninedof.design.study import Study
from ninedof.optimize.candidate import best_of
from ninedof.optimize.optimize import optimize
from ninedof.optimize.result import Result
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry

A1, B1, ZP, KAPPA = 0.0, 5.8124, 3.9828, 3.9110
BASE_SIDE, PLATFORM_SIDE = B1, B1 / 2  # the reading that reproduces eq. (40)
PLATES = {"a1": A1, "a2": BASE_SIDE, "b1": PLATFORM_SIDE, "b2": 0.0}
(LIMIT,) = Study.paper().limits  # of the size of the base

FIGURES = {
    "figure_1": "Fig. 1, the architecture",
    "figure_2": "Fig. 2, the first prototype",
    "figure_3": "Fig. 3, the second prototype",
    "figure_4": "Fig. 4, the ellipsoids",
    "figure_5": "Fig. 5, the plates",
    "figure_6": "Fig. 6, condition number against displacement",
    "figure_7": "Fig. 7, condition number against the ratio of sides",
}

STUDIES: dict[str, Callable[[], Study]] = {
    # eq. (39) with the names of eqs. (37)-(38)
    "as printed": lambda: Study(variables={"a1": A1, "b1": B1, "zp": ZP}),
    "published plates and height": lambda: Study(variables=PLATES | {"zp": ZP}),
    "same base and height": lambda: Study(variables={"a1": 0.0, "a2": BASE_SIDE, "zp": ZP}),
    "base no larger": lambda: Study(variables={"a1": (0.0, BASE_SIDE), "a2": (0.0, BASE_SIDE)}),
    "base at most twice the platform": Study.paper,
    "the same, theta_z free": lambda: replace(Study.paper(), variables={"theta_z": (-np.pi, np.pi)}),
    "eqs. (8)-(9) alone": lambda: Study(variables=dict.fromkeys(HEXAGONAL, (0.0, np.inf))),
}


def published_geometry() -> Geometry:
    """Return the published plates: coupled triangles, base side 5.8124, platform side half of it."""
    return Geometry.hexagonal(**PLATES)


def published_variables(zs: float | None = None) -> dict[str, float]:
    """Return the published design; by default at its best zs."""
    return PLATES | {"zp": ZP, "zs": published_zs()[2] if zs is None else zs}


@cache
def published_zs() -> tuple[float, float, float]:
    """Return the heights of O at which the published design has k = 3.9110, below and above the best, and the best."""
    best = best_of(solved("published plates and height")).variables["zs"]
    return _crossing(best, best - 0.5), _crossing(best, best + 0.5), best


def solved(name: str, threads: int | None = None) -> Result:
    """Solve one of the studies; an interrupted one raises KeyboardInterrupt, since half an answer proves nothing."""
    result = optimize(STUDIES[name](), threads=threads)
    if result.interrupted:
        raise KeyboardInterrupt
    return result


def kappa_at(zs: float) -> float:
    """Return the condition number of the published plates and height with O at a given height."""
    return float(condition_number(published_geometry(), Configuration.neutral(ZP, zs)))


def _crossing(inside: float, outside: float) -> float:
    """Bisect for k = 3.9110 between a point below it and one above."""
    for _ in range(60):
        middle = 0.5 * (inside + outside)
        if kappa_at(middle) < KAPPA:
            inside = middle
        else:
            outside = middle
    return 0.5 * (inside + outside)


def displacement_slopes(zs: float) -> dict[str, float]:
    """Return the derivatives of eq. (7) at the published design: central differences, per length or radian."""
    step = 1e-5
    home = Configuration.neutral(ZP, zs)
    # Tangent order of Configuration.moved: omega, dp, ds.
    directions = {"x_p": 3, "y_p": 4, "x_s": 6, "y_s": 7, "theta_x": 0, "theta_y": 1, "theta_z": 2}
    tangents = step * np.eye(9)[list(directions.values())]
    geometry = published_geometry()
    rise = condition_number(geometry, home.moved(tangents)) - condition_number(geometry, home.moved(-tangents))
    return dict(zip(directions, (rise / (2.0 * step)).tolist(), strict=True))
