"""Shadow prices in words: what relaxing an active limit or bound gains."""

from __future__ import annotations

from collections.abc import Mapping

from ninedof.design.limits import each, label, place
from ninedof.design.study import LENGTH, Study

LEAST_PRICE = 0.0005  # per cent of the objective for one per cent of the limit; smaller prices are left out


def price_words(study: Study, variables: Mapping[str, float], prices: Mapping[str, float]) -> list[str]:
    """Return one sentence for each price of a candidate, the largest first.

    Parameters
    ----------
    study : Study
    variables, prices : mapping
        Of a candidate; a price is the per cent by which the objective falls when that limit is relaxed by 1 %.

    """
    largest_first = sorted(prices.items(), key=lambda item: -item[1])
    return [
        f"1 % {_direction(study, variables, name)} {name} buys {price:.3g} %"
        for name, price in largest_first
        if price >= LEAST_PRICE
    ]


def _direction(study: Study, variables: Mapping[str, float], name: str) -> str:
    """Return the direction that relaxes a limit: "more", "less", or "wider" if both sides are limited."""
    bound = study.variables.get(name)
    if name == LENGTH:
        bound = study.characteristic_length if isinstance(study.characteristic_length, tuple) else None
    if isinstance(bound, tuple):
        low, high = bound
        value = variables[name]
        return "less" if abs(value - low) < abs(high - value) else "more"
    stated = {label(constraint, place(limit)): limit for constraint, limit in each(study.constraints)}
    if name not in stated:
        return "more"
    limit = stated[name]
    low_side, high_side = limit if isinstance(limit, tuple) else (limit.get("min"), limit.get("max"))
    if low_side is not None and high_side is not None:
        return "wider"
    return "more" if low_side is None else "less"
