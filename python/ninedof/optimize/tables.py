"""The tables and sentences of an optimization; `result` is a Result."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from ninedof.design.pose import rule_words
from ninedof.design.study import LENGTH
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.optimize.words import price_words, reached_words
from ninedof.redundancy.redundancy import best_internal_point
from ninedof.robot.idle import idle_names
from ninedof.tables import RIGHT, SHORT, Column, Line, Table

SHOWN = 4  # candidates, side by side
MOST_PLACED = 200  # poses at which O is placed for the sentence on it, a few milliseconds each
MOST_FIXED = 8  # variables; of more, only the free ones are listed


def candidates_table(result: Any) -> Table:
    """Return the best candidates side by side, best first."""
    candidates, study = result.candidates[:SHOWN], result.study
    heads = ["best", *(f"no. {k}" for k in range(2, len(candidates) + 1))]
    rows: list[Any] = [*_index_lines(result), ()]
    for name in listed_variables(study.variables):
        if name != LENGTH:
            values = [study.shown(name, c.variables[name]) for c in candidates]
            rows.append(Line(name, values, SHORT, study.unit_of(name)))
    if study.characteristic_length != 1.0:
        rows.append(Line("characteristic length", [c.characteristic_length for c in candidates], SHORT, study.unit))
    rows += [
        (),
        Line("limits reached", [", ".join(c.active) or "nothing" for c in candidates]),
        Line("starts that ended here", [c.reached for c in candidates], "d"),
        Line("stationarity", [c.optimality_residual for c in candidates], ".1e"),
        Line("violation", [c.constraint_violation for c in candidates], ".1e"),
    ]
    count = len(result.candidates)
    title = "1 local optimum" if count == 1 else f"{count} distinct local optima, best first"
    return Table(title, [Column(), *(Column(head, "", RIGHT) for head in heads)], rows)


def listed_variables(variables: Mapping[str, Any]) -> list[str]:
    """Return the names of the variables that are listed: the fixed ones where they are few."""
    free = [name for name, bound in variables.items() if isinstance(bound, tuple)]
    return list(variables) if len(variables) - len(free) <= MOST_FIXED else free


def _index_lines(result: Any) -> Iterator[Line]:
    """Yield the objective and, if it differs, the condition numbers at the neutral pose and over the poses."""
    objective, candidates = result.study.objective, result.candidates[:SHOWN]
    yield Line(result.words, [c.objective for c in candidates], ".6f")
    if objective.index == "condition_number" and not objective.poses and objective.region is None:
        return
    yield Line("neutral condition number", [c.neutral_condition_number for c in candidates], ".6f")
    if len(result.solved.objective.poses) > 1 and objective.region is None:
        yield Line("worst over the poses", [max(c.conditions) for c in candidates], ".6f")
        yield Line("best over the poses", [min(c.conditions) for c in candidates], ".6f")


def design_words(result: Any) -> Iterator[str]:
    """Yield what belongs to the best design: the region, where O is, its actuators, the reserve of its limits."""
    if result.region is not None:
        yield result.region.words
    if result.internal_points:
        yield result.internal_points
    if result.actuators is not None:
        yield from result.actuators.words
    if result.reserve is not None:
        yield from result.reserve.words


def agreement_words(result: Any) -> Iterator[str]:
    """Yield the words on the best design, and how many starts agree."""
    yield from design_words(result)
    yield result.agreement


def best_prices(result: Any) -> list[str]:
    """Return the shadow prices of the best candidate."""
    best = result.best
    return [] if best is None else price_words(result.study, best.variables, best.prices)


def proof_words(result: Any) -> tuple[str, str]:
    """Return what is proved of all designs of the study, and how near the best one is to it."""
    proof, best = result.proof, result.condition_number
    assert proof is not None
    assert best is not None
    gap = proof.gap(best)
    near = f"{100.0 * gap:.2g} % of that" if gap >= 1e-4 else f"{gap:.1e} of that, relatively"
    rest = ""
    if not proof.complete:
        ended = "was interrupted" if proof.interrupted else "ended"
        rest = f"; the search {ended} before {proof.target:.6g} was proved, {proof.open} boxes are left"
    boxes = f"{proof.boxes} boxes of designs, {proof.seconds:.1f} s{rest}."
    return proof.words, f"\nThe best design is within {near}; {boxes}"


def internal_point_words(result: Any) -> str:
    """Return where O is at the poses of a study, and legs that never move because of it; "" with fewer than two."""
    best = result.best
    if best is None or len(result.solved.objective.poses) < 2:
        return ""
    where = rule_words(result.solved.objective.poses)
    idle = ", ".join(idle_names(leg_lengths(best.geometry, best.configurations)))
    if not idle:
        return where
    sentence = f'{where}; {idle} never move, with internal_point = "best" they would'
    poses = best.configurations[1:]
    if result.study.objective.index != "condition_number" or len(poses) > MOST_PLACED:
        return sentence
    best_points = best_internal_point(
        best.geometry, poses.position, poses.rotation, characteristic_length=best.characteristic_length
    )
    return f"{sentence}: this design would have {best_points.value.max():.6f} at worst, limits aside"


def summary_lines(result: Any) -> list[str]:
    """Return a few lines: status, objective, active limits and their prices, what the starts show."""
    lines = [f"{result.status}: {result.reason}"]
    best = result.best
    if best is None:
        return lines
    objective = result.study.objective
    value = f"{result.words} {best.objective:.6f}"
    if objective.index != "condition_number" or objective.poses or objective.region is not None:
        value += f"; condition number {best.neutral_condition_number:.6f} at the neutral pose"
    if len(best.conditions) > 1:
        value += f", {min(best.conditions):.6f} to {max(best.conditions):.6f} over the poses"
    lines.append(value)
    lines.append(f"limits reached: {reached_words(result.study, best.variables, best.active)}")
    lines.extend(design_words(result))
    lines.extend(price_words(result.study, best.variables, best.prices))
    if len(result.candidates) > 1:
        lines.append(f"the next best optimum has {result.candidates[1].objective:.6f}")
    lines.extend(result.agreement.split(". "))
    return lines
