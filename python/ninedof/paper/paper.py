"""The paper's numbers, read with care, and what we get.

Galfo and Sinatra print a1 = 0.0000, b1 = 5.8124, zp = 3.9828 (eq. 39) and k = 3.9110 (eq. 40), all in units of l_c.
Values of a2, b2 and zs are missing. Eqs. (37)-(38) name the base sides a and the platform sides b; section 5 has "the
fixed base twice the size of the mobile base, i.e. 2 a2 = b1", the other way round. Only the second reading reproduces
the number.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ninedof.conditioning.conditioning import condition_number, singular_values
from ninedof.design.study import Study
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.optimize.optimize import optimize
from ninedof.optimize.result import Result
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.progress import Progress

__all__ = ["Comparison", "Row", "Verdict", "compare", "verdicts"]

A1, B1, ZP, KAPPA = 0.0, 5.8124, 3.9828, 3.9110
BASE_SIDE, PLATFORM_SIDE = B1, B1 / 2  # the reading that reproduces eq. (40)


def published_geometry() -> Geometry:
    """Return the published plates: coupled triangles, base side 5.8124, platform side half of it."""
    return Geometry.hexagonal(a1=A1, a2=BASE_SIDE, b1=PLATFORM_SIDE, b2=0.0)


def published_variables() -> dict[str, float]:
    """Return the published design at its best zs."""
    sides = {"a1": A1, "a2": BASE_SIDE, "b1": PLATFORM_SIDE, "b2": 0.0}
    return {**sides, "zp": ZP, "zs": published_zs()[2]}


def published_zs() -> tuple[float, float, float]:
    """Return the heights of O at which the published design has k = 3.9110, below and above the best, and the best."""
    found = _solved("published plates and height").best
    assert found is not None, "one free variable, no constraint: always solvable"
    best = found.variables["zs"]
    return _crossing(best, best - 0.5), _crossing(best, best + 0.5), best


def _solved(name: str, threads: int | None = None) -> Result:
    """Solve one of the studies; an interruption goes on to the caller, since half an answer proves nothing here."""
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


STUDIES: dict[str, Callable[[], Study]] = {
    # eq. (39) with the names of eqs. (37)-(38)
    "as printed": lambda: Study(variables={"a1": A1, "b1": B1, "zp": ZP}),
    "published plates and height": lambda: Study(
        variables={"a1": A1, "a2": BASE_SIDE, "b1": PLATFORM_SIDE, "b2": 0.0, "zp": ZP}
    ),
    "same base and height": lambda: Study(variables={"a1": 0.0, "a2": BASE_SIDE, "zp": ZP}),
    "base no larger": lambda: Study(variables={"a1": (0.0, BASE_SIDE), "a2": (0.0, BASE_SIDE)}),
    "base at most twice the platform": Study.paper,
    "the same, theta_z free": lambda: Study(
        variables={"theta_z": (-np.pi, np.pi)}, constraints={"radius_ratio": (None, 2.0)}
    ),
    "eqs. (8)-(9) alone": lambda: Study(
        variables={name: (0.0, float("inf")) for name in ("a1", "a2", "b1", "b2", "zp", "zs")}
    ),
}


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
    starts: int | None = None, seed: int | None = None, threads: int | None = None, progress: Progress | None = None
) -> Comparison:
    """Solve the paper's design problem and put the answers beside the published one.

    Parameters as in `optimize`; `starts`, `seed` and `progress` are those of the largest of the studies.
    """
    below, above, best_zs = published_zs()
    printed = _solved("as printed", threads)
    same = _solved("same base and height", threads)
    result = optimize(Study.paper(), starts=starts, seed=seed, threads=threads, progress=progress)
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
    variables = {"a1": A1, "a2": BASE_SIDE, "b1": PLATFORM_SIDE, "b2": 0.0, "zp": ZP, "zs": zs, "theta_z": 0.0}
    return _row(title, variables, ("a1", "b2", "radius_ratio"))


def _found(title: str, result: Result) -> Row | None:
    return _row(title, result.best.variables, result.best.active) if result.best else None


def _row(title: str, variables: dict[str, float], active: tuple[str, ...]) -> Row:
    geometry = Geometry.hexagonal(**{name: variables[name] for name in ("a1", "a2", "b1", "b2")})
    configuration = Configuration.neutral(variables["zp"], variables["zs"], variables["theta_z"])
    kappa = float(condition_number(geometry, configuration))
    l, _, _, q, _, _, r, _, _ = leg_lengths(geometry, configuration).tolist()
    ratio = 2.0 * np.exp(
        -Study.paper().evaluate(variables).margins["radius_ratio"]
    )  # a margin is the log of what is left
    gain = 100.0 * (1.0 - kappa / KAPPA)
    return Row(title, variables, kappa, (l, q, r), float(ratio), gain, active, geometry, configuration)


def _why(best_zs: float, same: Result) -> str:
    here = {"a1": A1, "a2": BASE_SIDE, "b1": PLATFORM_SIDE, "b2": 0.0, "zp": ZP, "zs": best_zs}
    slope = Study.paper().evaluate(here).gradient["zp"]
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


@dataclass(frozen=True)
class Verdict:
    """One number or claim of the paper beside ours."""

    where: str
    printed: str
    ours: str
    verdict: str


def verdicts(threads: int | None = None) -> tuple[Verdict, ...]:
    """Return every number of the paper beside ours, with a verdict each."""
    found = {name: _solved(name, threads) for name in STUDIES}
    kappa = {name: r.condition_number if r.condition_number is not None else np.inf for name, r in found.items()}
    below, above, best_zs = published_zs()
    same_class = found["base at most twice the platform"]
    best = same_class.variables or dict.fromkeys(("a1", "a2", "b1", "b2", "zp"), np.nan)
    least = kappa["base at most twice the platform"]
    slopes = displacement_slopes(best_zs)
    moving = {name: value for name, value in slopes.items() if abs(value) > 1e-6}
    twisted = float(condition_number(published_geometry(), Configuration.neutral(ZP, best_zs, 0.05)))
    open_study = found["eqs. (8)-(9) alone"]
    coupled = best["a1"] == best["b2"] == 0.0
    crossing = max(abs(kappa_at(zs) - KAPPA) for zs in (below, above)) < 5e-5
    beaten = max(kappa["same base and height"], kappa["base no larger"], least) < KAPPA - 5e-5
    rows = [
        ("sec. 2", "k is less than 3.9110", f"{kappa_at(below):.4f} at zs = {below:.4f}", "eq. (40) has it equal"),
        ("eq. (3)", "J diag(1/l, 1/l, 1/l, 1, 1, 1)", "diag(l, l, l, 1, 1, 1) J", "scales the wrong side for eq. (1)"),
        ("eq. (5)", "J^T J = sigma 1", "J J^T = sigma 1", "J^T J is 9x9 of rank 6; and no design is isotropic"),
        (
            "eq. (7)",
            "dk = 0 in seven displacements",
            ", ".join(f"dk/d{n} = {v:+.4f}" for n, v in moving.items()) + f"; k = {twisted:.4f} at +0.05 rad",
            f"holds in {len(slopes) - len(moving)}, not in {', '.join(moving)}" if moving else "holds",
        ),
        (
            "eqs. (8)-(9)",
            "a minimum exists",
            f"{open_study.status}: falling as {', '.join(open_study.causes)} grow, "
            f"{kappa['eqs. (8)-(9) alone']:.4f} so far",
            _verdict(open_study.status == "unbounded", "no minimum without a bound on size", "not refuted"),
        ),
        (
            "eq. (39a)",
            "a1 = 0.0000",
            f"a1 = {best['a1']:.4f}",
            _verdict(coupled, "reproduced: coupled joints are best", "not reproduced"),
        ),
        (
            "eq. (39b)",
            "b1 = 5.8124",
            f"base side {best['a2']:.4f}",
            _verdict(abs(best["a2"] - B1) > 5e-5, "a base side, and not the best in its class", "reproduced"),
        ),
        (
            "eq. (39c)",
            "zp = 3.9828",
            f"zp = {best['zp']:.4f}",
            _verdict(abs(best["zp"] - ZP) > 5e-5, "not the best height; a2, b2 and zs are missing", "reproduced"),
        ),
        (
            "eqs. (37)-(39)",
            "a the base, b the platform",
            f"k >= {kappa['as printed']:.4f} with these values",
            _verdict(kappa["as printed"] > KAPPA, "impossible as printed: a and b are swapped", "possible"),
        ),
        (
            "eq. (40)",
            "k = 3.9110",
            f"3.9110 at zs = {below:.4f} and {above:.4f}; {kappa_at(best_zs):.4f} at {best_zs:.4f}",
            _verdict(crossing, "reproduced with base side 5.8124, platform side 2.9062", "not reproduced"),
        ),
        (
            "eq. (40)",
            "the optimum",
            f"{kappa['same base and height']:.4f} same base and height, {kappa['base no larger']:.4f} base no larger, "
            f"{least:.6f} base at most twice the platform",
            _verdict(beaten, "not an optimum in any of these classes", "an optimum in one of these classes"),
        ),
        (
            "eq. (41)",
            "a1 = 0, b1 = 2.9 m at l_c = 0.5",
            f"{0.5 * B1:.4f} m",
            _verdict(abs(0.5 * B1 - 2.9) < 0.05, "consistent with eq. (39), rounded", "inconsistent"),
        ),
        (
            "sec. 5",
            "flight simulators: fixed base twice the mobile one, 2 a2 = b1",
            f"limits reached at {least:.6f}: {', '.join(same_class.active or ())}",
            _verdict(
                "radius_ratio" in (same_class.active or ()),
                "right as a limit, with a the platform; a larger base would be better still",
                "the limit does not bind",
            ),
        ),
        (
            "sec. 5",
            "one side much shorter, near the triangle, is best",
            f"a1 = {best['a1']:.4f}, b2 = {best['b2']:.4f}",
            _verdict(coupled, "confirmed: the triangle itself", "not confirmed"),
        ),
        (
            "sec. 4",
            "Q = 1 at the optimum",
            f"{kappa['the same, theta_z free']:.6f} with theta_z free",
            _verdict(kappa["the same, theta_z free"] < least - 1e-6, "a twist gains a little", "confirmed"),
        ),
    ]
    return tuple(Verdict(*row) for row in rows)


def _verdict(holds: bool, yes: str, no: str) -> str:
    return yes if holds else no


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
