"""The table of the candidates of a study, and its shadow prices."""

from __future__ import annotations

from rich.table import Table
from rich.text import Text

from ninedof.cli.screen import bold
from ninedof.design.study import LENGTH
from ninedof.optimize.prices import price_words
from ninedof.optimize.result import Candidate, Result
from ninedof.optimize.result_html import MOST_FIXED, SHOWN
from ninedof.support.units import with_unit


def short(value: float) -> str:
    """Return a number with four decimals, and zero as "0"."""
    return "0" if value == 0.0 else f"{value:.4f}"


def result_table(result: Result) -> Table:
    """Return the table of the best candidates, one per column, best first."""
    shown = result.candidates[:SHOWN]
    table = Table(title=_count(len(result.candidates)), title_justify="left")
    table.add_column("", overflow="fold")
    for k in range(len(shown)):
        table.add_column("best" if k == 0 else f"no. {k + 1}", justify="right", overflow="fold")
    _add_indices(table, result, shown)
    study = result.study
    listed = [name for name, bound in study.variables.items() if isinstance(bound, tuple)]
    if len(study.variables) - len(listed) <= MOST_FIXED:
        listed = list(study.variables)
    for name in listed:
        values = (short(study.shown(name, c.variables[name])) for c in shown)
        table.add_row(with_unit(name, study.unit_of(name)), *values)
    if study.characteristic_length != 1.0:
        length = with_unit(LENGTH.replace("_", " "), study.unit)
        table.add_row(length, *(short(c.characteristic_length) for c in shown))
    table.add_section()
    table.add_row("limits reached", *(", ".join(c.active) or "nothing" for c in shown))
    table.add_row("starts that ended here", *(str(c.reached) for c in shown))
    table.add_row("stationarity", *(f"{c.optimality_residual:.1e}" for c in shown))
    table.add_row("violation", *(f"{c.constraint_violation:.1e}" for c in shown))
    return table


def proof_words(result: Result) -> Text:
    """Return what is proved of all designs of the study, and how near the best one is to it."""
    proof, best = result.proof, result.condition_number
    assert proof is not None
    assert best is not None
    gap = proof.gap(best)
    near = f"{100.0 * gap:.2g} % of that" if gap >= 1e-4 else f"{gap:.1e} of that, relatively"
    said = f"\nThe best design is within {near}"
    ended = "was interrupted" if proof.interrupted else "ended"
    rest = (
        ""
        if proof.complete
        else f"; the search {ended} before {proof.target:.6g} was proved, {proof.open} boxes are left"
    )
    return bold(proof.words, f"{said}; {proof.boxes} boxes of designs, {proof.seconds:.1f} s{rest}.")


def price_text(result: Result) -> list[str]:
    """Return the shadow prices of the best candidate, and what the starts show."""
    if result.best is None:
        return []
    region = [] if result.region is None else [result.region.words]
    points = [result.internal_points] if result.internal_points else []
    prices = price_words(result.study, result.best.variables, result.best.prices)
    return ["\n".join([*region, *points, *prices, result.agreement])]


def _add_indices(table: Table, result: Result, shown: tuple[Candidate, ...]) -> None:
    """Add the objective and, if it differs, the condition numbers at the neutral pose and over the poses."""
    objective = result.study.objective
    plain = objective.index == "condition_number" and not objective.poses and objective.region is None
    table.add_row(result.words, *(f"{c.objective:.6f}" for c in shown), style="bold", end_section=plain)
    if plain:
        return
    several = len(result.solved.objective.poses) > 1 and objective.region is None
    table.add_row("neutral condition number", *(f"{c.condition_number:.6f}" for c in shown), end_section=not several)
    if several:
        table.add_row("worst over the poses", *(f"{max(c.conditions):.6f}" for c in shown))
        table.add_row("best over the poses", *(f"{min(c.conditions):.6f}" for c in shown), end_section=True)


def _count(optima: int) -> str:
    return "1 local optimum" if optima == 1 else f"{optima} distinct local optima"
