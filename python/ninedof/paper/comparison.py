"""The published optimum beside ours: `compare`, its table and the remarks below."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ninedof.conditioning.conditioning import condition_number, singular_values
from ninedof.design.study import Study
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.optimize.candidate import Candidate, best_of
from ninedof.optimize.optimize import optimize
from ninedof.optimize.result import Result
from ninedof.paper import published
from ninedof.paper.published import KAPPA, LIMIT, published_geometry, published_variables, published_zs, solved
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.running import Progress
from ninedof.tables import Line, Table, columns

TITLES = {
    "published, read so that it gives 3.9110": "published\nreproduced",
    "best with the same base and height": "same base\nand height",
    "best with the base at most twice the platform": "base at most\n2 x platform",
}
PRINTED = {  # the names of the rows, and what the paper prints
    "base a1, a2": "0, -",
    "platform b1, b2": "5.8124, -",
    "base / platform": "-",
    "height zp": f"{published.ZP:.4f}",
    "height of O, zs": "-",
    "external legs l": "-",
    "upper internal q": "-",
    "lower internal r": "-",
    "condition number": f"{KAPPA:.4f}",
    "below 3.9110 by": "-",
    "limits reached": "-",
}


@dataclass(frozen=True)
class PaperRow:
    """One design of the comparison."""

    title: str
    variables: dict[str, float]
    condition_number: float
    leg_lengths: dict[str, float]
    """l, q, r: by symmetry the three of a kind are equal."""
    radius_ratio: float
    """Base / platform circumradius."""
    gain_percent: float
    """By which the condition number is below the published 3.9110."""
    active: tuple[str, ...]
    geometry: Geometry
    configuration: Configuration

    def to_dict(self) -> dict[str, Any]:
        """Return plain values, without the robot."""
        return {name: value for name, value in vars(self).items() if name not in ("geometry", "configuration")}


@dataclass(frozen=True)
class PaperComparison:
    """The published optimum beside ours, all lengths in units of l_c."""

    reproduced: PaperRow
    """Base side 5.8124, platform side half of it, zs where k = 3.9110."""
    crossings: tuple[float, float]
    """Both such zs."""
    best_zs: PaperRow
    """The same plates and height at the best zs."""
    same_base_and_height: PaperRow
    same_class: PaperRow | None
    """Base at most twice the platform: the answer to the paper's problem."""
    as_printed: float
    """The least condition number eq. (39) allows if a is the base, as eqs. (37)-(38) have it."""
    result: Result
    """Behind `same_class`."""
    why: str
    """Why the published point is not a minimum."""

    def rows(self) -> tuple[PaperRow, ...]:
        """Return the designs that there are, from the published to the best."""
        published = (self.reproduced, self.best_zs, self.same_base_and_height)
        return published if self.same_class is None else (*published, self.same_class)

    def to_dict(self) -> dict[str, Any]:
        """Return the comparison as plain values."""
        values = {"a1": published.A1, "b1": published.B1, "zp": published.ZP, "condition_number": KAPPA}
        return {
            "published": values,
            "as_printed": self.as_printed,
            "why": self.why,
            "designs": [row.to_dict() for row in self.rows()],
            "optimization": self.result.to_dict(),
        }


def compare(
    starts: int | None = None,
    seed: int | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    **others: Any,
) -> PaperComparison:
    """Solve the paper's design problem and put the answers beside the published one.

    Parameters as in `optimize`; all but `threads` are those of the largest of the studies.
    """
    below, above, best_zs = published_zs()
    printed, same = (best_of(solved(name, threads)) for name in ("as printed", "same base and height"))
    result = optimize(Study.paper(), starts=starts, seed=seed, threads=threads, progress=progress, **others)
    best = result.best
    return PaperComparison(
        reproduced=_published_row("published, read so that it gives 3.9110", below),
        crossings=(below, above),
        best_zs=_published_row("the same at the best zs", best_zs),
        same_base_and_height=_row("best with the same base and height", same.variables, same.active),
        same_class=_row("best with the base at most twice the platform", best.variables, best.active) if best else None,
        as_printed=printed.condition_number,
        result=result,
        why=_why(best_zs, same),
    )


def _published_row(title: str, zs: float) -> PaperRow:
    return _row(title, published_variables(zs) | {"theta_z": 0.0}, ("a1", "b2", LIMIT.label))


def _row(title: str, variables: Mapping[str, float], active: tuple[str, ...]) -> PaperRow:
    point = Study.paper().evaluate(variables)
    g, c = point.geometry, point.configuration
    kappa = float(condition_number(g, c))
    legs = dict(zip("lqr", leg_lengths(g, c)[[0, 3, 6]].tolist(), strict=True))
    ratio = LIMIT.high * (1.0 - point.margins[LIMIT.label])
    return PaperRow(title, dict(variables), kappa, legs, ratio, 100.0 * (1.0 - kappa / KAPPA), active, g, c)


def _why(best_zs: float, same: Candidate) -> str:
    slope = Study.paper().evaluate(published_variables(best_zs)).gradient["zp"]
    sigma = np.unique(singular_values(published_geometry(), Configuration.neutral(published.ZP, best_zs)).round(6))
    ends = f"{sigma[0]:.3f} and {sigma[1]:.3f} below, {sigma[-2]:.3f} and {sigma[-1]:.3f} above"
    return (
        f"The published point is not a minimum: at zs = {best_zs:.4f} raising the platform changes the condition "
        f"number by {slope:+.3f} per l_c, and a platform of side {same.variables['b1']:.4f} instead of "
        f"{published.PLATFORM_SIDE:.4f} on the same base at the same height gives {same.condition_number:.4f}. "
        f"Nor is it a kink, where a descent could jam: the singular values of J' are apart there ({ends})."
    )


def comparison_table(designs: Iterable[Mapping[str, Any]]) -> Table:
    """Return the published optimum beside ours, one design per column."""
    rows = [row for row in designs if row["title"] in TITLES]
    heads = ["published\nas printed", *(TITLES[row["title"]] for row in rows)]
    texts = zip(PRINTED.items(), *map(_texts, rows), strict=True)
    lines = [Line(label, [printed, *others]) for (label, printed), *others in texts]
    title = "The published optimum beside ours, lengths in units of l_c"
    return Table(title, columns("", *(f">{head}" for head in heads)), [*lines[:5], (), *lines[5:8], (), *lines[8:]])


def _texts(row: Mapping[str, Any]) -> list[str]:
    """Return the column of a design, a text for each name in PRINTED."""
    values, legs, gain = row["variables"], row["leg_lengths"], row["gain_percent"]
    active = [f"{name} = {_short(values[name])}" if name in values else name for name in row["active"]]
    return [
        f"{_short(values['a1'])}, {_short(values['a2'])}",
        f"{_short(values['b1'])}, {_short(values['b2'])}",
        f"{row['radius_ratio']:.4f}",
        f"{values['zp']:.4f}",
        f"{values['zs']:.4f}",
        *(f"{legs[leg]:.4f}" for leg in "lqr"),
        f"{row['condition_number']:.6f}",
        "-" if abs(gain) < 0.005 else f"{gain:.2f} %",
        "\n".join(active) or "nothing",
    ]


def _short(value: float) -> str:
    return "0" if value == 0.0 else f"{value:.4f}"


def comparison_words(c: PaperComparison) -> str:
    """Return the remarks below the table."""
    below, above = c.crossings
    return (
        f"Read with a as the base, as eqs. (37)-(38) have it, eq. (39) allows no condition number under "
        f"{c.as_printed:.4f}: a and b are swapped, and a2, b2, zs are missing. "
        f"With base side {published.BASE_SIDE:.4f} and platform side {published.PLATFORM_SIDE:.4f}, 3.9110 occurs at "
        f"zs = {below:.4f} and {above:.4f}; the least along zs is {c.best_zs.condition_number:.4f} at "
        f"{c.best_zs.variables['zs']:.4f}.\n\n{c.why}\n"
    )
