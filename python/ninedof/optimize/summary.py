"""What an optimization found, in a few words: what binds, what it costs, how sure one may be."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ninedof.design.study import Study
    from ninedof.optimize.result import Candidate, Result

__all__ = ["price_words", "summary"]

LEAST_PRICE = 0.0005  # per cent for one per cent; less is printed as nothing


def price_words(study: Study, candidate: Candidate) -> list[str]:
    """Return what relaxing each binding limit or bound by 1 % would buy, the dearest first."""
    dearest = sorted(candidate.prices.items(), key=lambda item: -item[1])
    return [
        f"1 % {_relaxed(study, candidate, name)} {name} buys {price:.3g} %"
        for name, price in dearest
        if price >= LEAST_PRICE
    ]


def _relaxed(study: Study, candidate: Candidate, name: str) -> str:
    """Return which way a limit gives: more above, less below, wider where it is not known which side binds."""
    bound = study.variables.get(name)
    if name == "characteristic_length":
        bound = study.characteristic_length if isinstance(study.characteristic_length, tuple) else None
    if isinstance(bound, tuple):
        low, high = bound
        value = candidate.variables[name]
        return "less" if abs(value - low) < abs(high - value) else "more"
    if name not in study.constraints:
        return "more"
    limit = study.constraints[name]
    low_side, high_side = limit if isinstance(limit, tuple) else (limit.get("min"), limit.get("max"))
    if low_side is not None and high_side is not None:
        return "wider"
    return "more" if low_side is None else "less"


def summary(result: Result) -> str:
    """Return a few lines on a result."""
    lines = [f"{result.status}: {result.reason}"]
    best = result.best
    if best is None:
        return lines[0]
    objective = result.study.objective
    value = f"{objective.words} {best.objective:.6f}"
    if objective.index != "condition_number" or objective.poses:
        value += f"; condition number {best.condition_number:.6f} at the neutral pose"
    if len(best.conditions) > 1:
        value += f", {min(best.conditions):.6f} to {max(best.conditions):.6f} over the poses"
    lines.append(value)
    lines.append(f"limits reached: {', '.join(best.active) or 'nothing'}")
    lines.extend(price_words(result.study, best))
    found = f"{best.reached} of {result.starts_done} starts ended here ({100.0 * result.confidence:.0f} %)"
    if len(result.candidates) > 1:
        found += f"; the next best optimum has {result.candidates[1].objective:.6f}"
    lines.append(found)
    return "\n".join(lines)
