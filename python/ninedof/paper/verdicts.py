"""Every number of the paper beside ours: `verdicts` and their table."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import NamedTuple

import numpy as np

from ninedof.conditioning.conditioning import condition_number
from ninedof.optimize.candidate import best_of
from ninedof.paper.published import (
    B1,
    KAPPA,
    LIMIT,
    STUDIES,
    ZP,
    displacement_slopes,
    kappa_at,
    published_geometry,
    published_zs,
    solved,
)
from ninedof.robot.configuration import Configuration
from ninedof.tables import Table, columns, grouped

TWIST = 0.05  # rad, towards a lower condition number


class Verdict(NamedTuple):
    """One number or claim of the paper beside ours."""

    where: str
    printed: str
    ours: str
    verdict: str


def verdicts(threads: int | None = None) -> tuple[Verdict, ...]:
    """Return every number of the paper beside ours, with a verdict each."""
    results = {name: solved(name, threads) for name in STUDIES}
    kappa = {name: best_of(result).condition_number for name, result in results.items()}
    below, above, best_zs = published_zs()
    same_class = best_of(results["base at most twice the platform"])
    best = same_class.variables
    least = kappa["base at most twice the platform"]
    slopes = displacement_slopes(best_zs)
    moving = {name: value for name, value in slopes.items() if abs(value) > 1e-6}
    twisted = float(condition_number(published_geometry(), Configuration.neutral(ZP, best_zs, TWIST)))
    turn = float(np.degrees(TWIST))
    open_study = results["eqs. (8)-(9) alone"]
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
            f"{', '.join(_slope(n, v) for n, v in moving.items())}; k = {twisted:.4f} at {turn:+.3g} degrees",
            f"holds in {len(slopes) - len(moving)}, not in {', '.join(moving)}" if moving else "holds",
        ),
        (
            "eqs. (8)-(9)",
            "a minimum exists",
            f"{open_study.status}: falling as {', '.join(open_study.causes)} grow, "
            f"{kappa['eqs. (8)-(9) alone']:.4f} so far",
            "no minimum without a bound on size" if open_study.status == "unbounded" else "not refuted",
        ),
        (
            "eq. (39a)",
            "a1 = 0.0000",
            f"a1 = {best['a1']:.4f}",
            "reproduced: coupled joints are best" if coupled else "not reproduced",
        ),
        (
            "eq. (39b)",
            "b1 = 5.8124",
            f"base side {best['a2']:.4f}",
            "a base side, and not the best in its class" if abs(best["a2"] - B1) > 5e-5 else "reproduced",
        ),
        (
            "eq. (39c)",
            "zp = 3.9828",
            f"zp = {best['zp']:.4f}",
            "not the best height; a2, b2 and zs are missing" if abs(best["zp"] - ZP) > 5e-5 else "reproduced",
        ),
        (
            "eqs. (37)-(39)",
            "a the base, b the platform",
            f"k >= {kappa['as printed']:.4f} with these values",
            "impossible as printed: a and b are swapped" if kappa["as printed"] > KAPPA else "possible",
        ),
        (
            "eq. (40)",
            "k = 3.9110",
            f"3.9110 at zs = {below:.4f} and {above:.4f}; {kappa_at(best_zs):.4f} at {best_zs:.4f}",
            "reproduced with base side 5.8124, platform side 2.9062" if crossing else "not reproduced",
        ),
        (
            "eq. (40)",
            "the optimum",
            f"{kappa['same base and height']:.4f} same base and height, {kappa['base no larger']:.4f} base no larger, "
            f"{least:.6f} base at most twice the platform",
            "not an optimum in any of these classes" if beaten else "an optimum in one of these classes",
        ),
        (
            "eq. (41)",
            "a1 = 0, b1 = 2.9 m at l_c = 0.5",
            f"{0.5 * B1:.4f} m",
            "consistent with eq. (39), rounded" if abs(0.5 * B1 - 2.9) < 0.05 else "inconsistent",
        ),
        (
            "sec. 5",
            "flight simulators: fixed base twice the mobile one, 2 a2 = b1",
            f"limits reached at {least:.6f}: {', '.join(same_class.active)}",
            "right as a limit, with a the platform; a larger base would be better still"
            if LIMIT.label in same_class.active
            else "the limit does not bind",
        ),
        (
            "sec. 5",
            "one side much shorter, near the triangle, is best",
            f"a1 = {best['a1']:.4f}, b2 = {best['b2']:.4f}",
            "confirmed: the triangle itself" if coupled else "not confirmed",
        ),
        (
            "sec. 4",
            "Q = 1 at the optimum",
            f"{kappa['the same, theta_z free']:.6f} with theta_z free",
            "a twist gains a little" if kappa["the same, theta_z free"] < least - 1e-6 else "confirmed",
        ),
    ]
    return tuple(Verdict(*row) for row in rows)


def _slope(name: str, value: float) -> str:
    """Return a derivative in words; that along an angle is a degree's."""
    if name.startswith("theta"):
        return f"dk/d{name} = {np.radians(value):+.4f} a degree"
    return f"dk/d{name} = {value:+.4f}"


def verdicts_table(rows: Iterable[Mapping[str, str]]) -> Table:
    """Return every number of the paper beside ours."""
    names = Verdict._fields
    lines = grouped(([row[name] for name in names] for row in rows), 1)
    return Table("The paper's numbers and ours, lengths in units of l_c", columns(*names), list(lines))
