"""The tables and sentences of an optimization; `result` is a Result."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from ninedof.design.domains.poses import rule_words
from ninedof.design.domains.region_poses import configurations_at
from ninedof.design.study import LENGTH, Study
from ninedof.design.tables import listed_variables
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.redundancy.redundancy import best_internal_point
from ninedof.robot.idle import idle_names
from ninedof.support.units import amount, degrees_of
from ninedof.tables import RIGHT, SHORT, Column, Line, Table

LEAST_PRICE = 0.0005  # per cent of the objective for one per cent of the limit; smaller prices have no number
MOST_GAIN = 10.0  # per cent of the objective: first-order prices hold for small gains only
ENDS = 1e9 * np.array([(1.0, 2.0, 3.0, 2.0, 1.0, 1.0), (-2.0, 1.0, -1.0, -1.0, 3.0, -1.0)])
"""Coordinates of two poses at ends of a region."""
SURE = 0.95  # probability with which a better optimum would have been met


def price_words(study: Study, variables: Mapping[str, float], prices: Mapping[str, float]) -> list[str]:
    """Return one sentence for each price of a candidate, the largest first: for 1 %, a steep one for a smaller step."""
    largest_first = sorted(prices.items(), key=lambda item: -item[1])
    return [_price_sentence(study, variables, name, price) for name, price in largest_first]


def _price_sentence(study: Study, variables: Mapping[str, float], name: str, price: float) -> str:
    step = 1.0  # per cent
    while step * price >= MOST_GAIN and math.isfinite(price):
        step /= 10.0
    gain = f"{step * price:.3g} %" if price >= LEAST_PRICE else f"less than {LEAST_PRICE:g} %"
    part = _part(study, variables, name, 0.01 * step)
    return f"{step:g} % {_direction(study, variables, name)} {name}{part} gains {gain}"


def _part(study: Study, variables: Mapping[str, float], name: str, share: float = 1.0) -> str:
    """Return a share of a limit or bound in brackets, such as " (45 deg)"; nothing without a unit or a single value."""
    if not study.unit:
        return ""
    if name in variables:
        value, unit = variables[name], study.unit_of(name)
    else:
        limit = next((limit for limit in study.limits if limit.label == name), None)
        if limit is None or len(limit.sides) != 1:
            return ""
        (value,), unit = limit.sides.values(), limit.unit(study.unit, study.force_unit)
    value = degrees_of(value) if unit == "deg" else value
    return f" ({amount(f'{share * value:.6g}', unit)})" if unit and value != 0.0 and math.isfinite(value) else ""


def _direction(study: Study, variables: Mapping[str, float], name: str) -> str:
    """Return the direction that relaxes a limit: "more", "less", or "wider" if both sides are limited."""
    bound = study.characteristic_length if name == LENGTH else study.variables.get(name)
    if isinstance(bound, tuple):
        low, high = bound
        value = variables[name]
        return "less" if abs(value - low) < abs(high - value) else "more"
    sides = next((limit.sides for limit in study.limits if limit.label == name), {})
    return "wider" if len(sides) > 1 else "less" if "min" in sides else "more"


def least_share(completed: int) -> float:
    """Return the share of starts that a better optimum must attract to be met by `completed` starts with 95 %.

    Of an optimum that each start reaches with probability p, all n starts miss it with probability (1 - p)^n.
    """
    return float(1.0 - (1.0 - SURE) ** (1.0 / completed))


def agreement_sentence(completed: int, arrived: int, abandoned: int, optimal: bool) -> str:
    """Return how many starts were followed to their end, how many arrived, and what may have been missed.

    Of those `completed` the ones that `arrived` ended at the best objective; `abandoned` ones were given up. Whether
    the best design is an optimum is `optimal`.
    """
    if completed < 1:
        return "no start was followed to its end"
    share = f"{'all' if arrived == completed else arrived or 'none'} of them to this optimum"
    if completed == 1:
        share = "to this optimum" if arrived else "not to this optimum"
    out = f"{completed} start{' was' if completed == 1 else 's were'} followed to the end"
    if optimal:
        out += f", {share}"
    if abandoned:
        others = f"{abandoned} other{' was' if abandoned == 1 else 's were'}"
        out += f"; {others} given up after a short run, having fallen behind, which proves nothing"
    if not optimal:
        return out
    which = "starts that are not given up" if abandoned else "starts"
    return (
        f"{out}. A better optimum to which {100.0 * least_share(completed):.0f} % of {which} lead would have been met "
        f"with a probability of {100.0 * SURE:.0f} %; a rarer one may have been missed"
    )


def axis_hint(study: Study) -> str:
    """Return a sentence on axes of cones that point against the legs; "" where none does.

    While the platform is above the base, legs point up from the base and down from the platform.
    """
    against = [
        limit.label
        for limit in study.limits
        if limit.axis and limit.high <= math.pi / 2 and (limit.axis[2] < 0.0) == limit.name.startswith("base")
    ]
    if not against:
        return ""
    return (
        f". The axis of {' and of '.join(against)} points against the legs: an axis points from the joint along the "
        "leg, upwards at the base and downwards at the platform"
    )


SHOWN = 4  # candidates, side by side
MOST_PLACED = 200  # poses at which O is placed for the sentence on it, a few milliseconds each


def candidates_table(result: Any) -> Table:
    """Return the best candidates side by side, best first."""
    candidates, study = result.candidates[:SHOWN], result.study
    heads = ["best", *(f"no. {k}" for k in range(2, len(candidates) + 1))]
    rows: list[Any] = [*_index_lines(result), ()]
    for name in listed_variables(study):
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
    lengths = leg_lengths(best.geometry, best.configurations)
    region = result.study.objective.region
    if region is not None and region.internal_point != "best":
        # At the poses that ruled a leg may be equally long by chance.
        others = configurations_at(region, best.configurations[0], ENDS)
        lengths = np.concatenate([lengths, leg_lengths(best.geometry, others)])
    idle = ", ".join(idle_names(lengths))
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
    reached = [name + _part(result.study, best.variables, name) for name in best.active]
    lines.append(f"limits reached: {', '.join(reached) or 'nothing'}")
    lines.extend(design_words(result))
    lines.extend(price_words(result.study, best.variables, best.prices))
    if len(result.candidates) > 1:
        lines.append(f"the next best optimum has {result.candidates[1].objective:.6f}")
    lines.extend(result.agreement.split(". "))
    return lines
