"""Sentences on a result: active limits, their shadow prices, and the agreement of the starts."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

from ninedof.design.study import LENGTH, Study
from ninedof.support.angles import degrees_of
from ninedof.support.units import amount

LEAST_PRICE = 0.0005  # per cent of the objective for one per cent of the limit; smaller prices have no number
MOST_GAIN = 10.0  # per cent of the objective: first-order prices hold for small gains only
SURE = 0.95  # probability with which a better optimum would have been met


def price_words(study: Study, variables: Mapping[str, float], prices: Mapping[str, float]) -> list[str]:
    """Return one sentence for each price of a candidate, the largest first: for 1 %, a steep one for a smaller step.

    Parameters
    ----------
    study : Study
    variables, prices : mapping
        Of a candidate; a price is the per cent by which the objective falls when that limit is relaxed by 1 %.

    """
    largest_first = sorted(prices.items(), key=lambda item: -item[1])
    return [_price_sentence(study, variables, name, price) for name, price in largest_first]


def _price_sentence(study: Study, variables: Mapping[str, float], name: str, price: float) -> str:
    step = 1.0  # per cent
    while step * price >= MOST_GAIN and math.isfinite(price):
        step /= 10.0
    gain = f"{step * price:.3g} %" if price >= LEAST_PRICE else f"less than {LEAST_PRICE:g} %"
    part = _part(study, variables, name, 0.01 * step)
    return f"{step:g} % {_direction(study, variables, name)} {name}{part} buys {gain}"


def reached_words(study: Study, variables: Mapping[str, float], active: Iterable[str]) -> str:
    """Return the active limits and bounds of a candidate; where the study names its length unit, with their values."""
    return ", ".join(name + _part(study, variables, name) for name in active) or "nothing"


def _part(study: Study, variables: Mapping[str, float], name: str, share: float = 1.0) -> str:
    """Return a share of a limit or bound in brackets, such as " (45 deg)"; nothing without a unit or a single value."""
    if not study.unit:
        return ""
    if name in variables:
        value, unit = variables[name], "deg" if name in study.angles else study.unit
    else:
        limit = next((limit for limit in study.limits if limit.label == name), None)
        if limit is None or len(limit.sides) != 1:
            return ""
        (value,), unit = limit.sides.values(), limit.unit(study.unit)
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

    Parameters
    ----------
    completed, arrived, abandoned : int
        Starts followed to their end, those of them that ended at the best objective, and starts given up.
    optimal : bool
        Whether the best design is an optimum.

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
