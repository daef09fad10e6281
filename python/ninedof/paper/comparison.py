"""The published optimum beside ours: `compare`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ninedof.conditioning.conditioning import condition_number, singular_values
from ninedof.design.study import Study
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.optimize.optimize import optimize
from ninedof.optimize.result import Result
from ninedof.paper.published import (
    KAPPA,
    PLATES,
    PLATFORM_SIDE,
    ZP,
    published_geometry,
    published_variables,
    published_zs,
    solved,
)
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.progress import Progress


@dataclass(frozen=True)
class Row:
    """One design of the comparison."""

    title: str
    variables: dict[str, float]
    condition_number: float
    legs: tuple[float, float, float]
    """l, q, r: by symmetry the three of a kind are equal."""
    radius_ratio: float
    """Base / platform circumradius."""
    gain: float
    """Per cent by which the condition number is below the published 3.9110."""
    active: tuple[str, ...]
    geometry: Geometry
    configuration: Configuration


@dataclass(frozen=True)
class Comparison:
    """The published optimum beside ours, all lengths in units of l_c."""

    reproduced: Row
    """Base side 5.8124, platform side half of it, zs where k = 3.9110."""
    crossings: tuple[float, float]
    """Both such zs."""
    best_zs: Row
    """The same plates and height at the best zs."""
    same_base_and_height: Row | None
    same_class: Row | None
    """Base at most twice the platform: the answer to the paper's problem."""
    as_printed: float
    """The least condition number eq. (39) allows if a is the base, as eqs. (37)-(38) have it."""
    result: Result
    """Behind `same_class`."""
    why: str
    """Why the published point is not a minimum."""

    def rows(self) -> tuple[Row, ...]:
        """Return the designs found, from the published to the best."""
        found = (self.reproduced, self.best_zs, self.same_base_and_height, self.same_class)
        return tuple(row for row in found if row is not None)


def compare(
    starts: int | None = None,
    seed: int | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    **others: Any,
) -> Comparison:
    """Solve the paper's design problem and put the answers beside the published one.

    Parameters as in `optimize`; all but `threads` are those of the largest of the studies.
    """
    below, above, best_zs = published_zs()
    printed = solved("as printed", threads)
    same = solved("same base and height", threads)
    result = optimize(Study.paper(), starts=starts, seed=seed, threads=threads, progress=progress, **others)
    return Comparison(
        reproduced=_published("published, read so that it gives 3.9110", below),
        crossings=(below, above),
        best_zs=_published("the same at the best zs", best_zs),
        same_base_and_height=_found("best with the same base and height", same),
        same_class=_found("best with the base at most twice the platform", result),
        as_printed=printed.condition_number or float("inf"),
        result=result,
        why=_why(best_zs, same),
    )


def _published(title: str, zs: float) -> Row:
    return _row(title, published_variables(zs) | {"theta_z": 0.0}, ("a1", "b2", "radius_ratio"))


def _found(title: str, result: Result) -> Row | None:
    return _row(title, result.best.variables, result.best.active) if result.best else None


def _row(title: str, variables: dict[str, float], active: tuple[str, ...]) -> Row:
    geometry = Geometry.hexagonal(**{name: variables[name] for name in PLATES})
    configuration = Configuration.neutral(variables["zp"], variables["zs"], variables["theta_z"])
    kappa = float(condition_number(geometry, configuration))
    l, _, _, q, _, _, r, _, _ = leg_lengths(geometry, configuration).tolist()
    margin = Study.paper().evaluate(variables).margins["radius_ratio"]  # 1 - ratio / 2
    ratio = 2.0 * (1.0 - margin)
    gain = 100.0 * (1.0 - kappa / KAPPA)
    return Row(title, variables, kappa, (l, q, r), float(ratio), gain, active, geometry, configuration)


def _why(best_zs: float, same: Result) -> str:
    slope = Study.paper().evaluate(published_variables(best_zs)).gradient["zp"]
    smaller = (
        f", and a platform of side {same.best.variables['b1']:.4f} instead of {PLATFORM_SIDE:.4f} on the same base "
        f"at the same height gives {same.best.condition_number:.4f}"
        if same.best
        else ""
    )
    sigma = np.unique(singular_values(published_geometry(), Configuration.neutral(ZP, best_zs)).round(6))
    ends = f"{sigma[0]:.3f} and {sigma[1]:.3f} below, {sigma[-2]:.3f} and {sigma[-1]:.3f} above"
    return (
        f"The published point is not a minimum: at zs = {best_zs:.4f} raising the platform changes the condition "
        f"number by {slope:+.3f} per l_c{smaller}. "
        f"Nor is it a kink, where a descent could jam: the singular values of J' are apart there ({ends})."
    )
