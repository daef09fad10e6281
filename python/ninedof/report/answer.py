"""The answer of an optimization: the best design, the limits it reaches with their prices, what the starts show."""

from __future__ import annotations

from collections.abc import Iterator

from ninedof.design.study import LENGTH
from ninedof.optimize.prices import price_words
from ninedof.optimize.result import Candidate, Result, Status
from ninedof.optimize.result_html import SHOWN
from ninedof.report.markup import Html, beside, bullets, facts, joined, paragraphs, table, tag
from ninedof.report.numbers import short
from ninedof.support.units import with_unit

NO_CLAIM = "The best design found is shown below. It is not claimed to be an optimum."


def answer(result: Result) -> Html:
    """Return the answer of an optimization."""
    if result.best is None:
        causes = ", ".join(result.causes) or "none found"
        return joined(paragraphs([_sentence(result.reason)]), facts([("status", result.status), ("causes", causes)]))
    claim = [_sentence(result.reason)] if result.status != Status.OPTIMAL else []
    if result.status == Status.STOPPED:
        claim.append(NO_CLAIM)
    return joined(
        paragraphs(claim),
        beside(_designs(result), joined(_prices(result), tag("h3", "What the search shows"), _agreement(result))),
    )


def _designs(result: Result) -> Html:
    shown = result.candidates[:SHOWN]
    study = result.study
    head = ["", *("best" if k == 0 else f"no. {k + 1}" for k in range(len(shown)))]
    rows: list[tuple[str, ...]] = [("objective", *(f"{c.objective:.6f}" for c in shown))]
    rows.append(("condition number, neutral pose", *(f"{c.condition_number:.6f}" for c in shown)))
    if len(shown[0].conditions) > 1:
        for words, pick in (("worst", max), ("best", min)):
            rows.append((f"{words} over the poses", *(f"{pick(c.conditions):.6f}" for c in shown)))
    rows.append(())
    numbers: list[tuple[str, str, list[float]]] = []
    for name in shown[0].variables:
        if name == LENGTH or name not in study.variables:
            continue
        values = [study.shown(name, c.variables[name]) for c in shown]
        unit = study.unit_of(name)
        numbers.append((with_unit(name.replace("_", " "), unit), unit, values))
    length = [c.characteristic_length for c in shown]
    numbers.append((with_unit("characteristic length", study.unit), study.unit, length))
    for label, unit, values in numbers:
        among = [x for _, other, listed in numbers if other == unit for x in listed]
        rows.append((label, *(short(x, among) for x in values)))
    rows.append(())
    rows.append(("starts that ended here", *(str(c.reached) for c in shown)))
    rows.append(("stationarity", *(f"{c.optimality_residual:.1e}" for c in shown)))
    rows.append(("violation", *(f"{c.constraint_violation:.1e}" for c in shown)))
    others = len(result.candidates)
    count = "one local optimum" if others == 1 else f"{others} distinct local optima, best first"
    return table(f"Design: {count}" if result.status == Status.OPTIMAL else "Design", head, rows)


def _prices(result: Result) -> Html:
    best: Candidate = result.best  # type: ignore[assignment]
    if not best.active:
        return joined(tag("h3", "Limits reached"), paragraphs(["No limit and no bound is reached."]))
    said = price_words(result.study, best.variables, best.prices)
    without = [f"{name} is on its bound or limit; it has no price" for name in best.active if name not in best.prices]
    said = [_sentence(words.replace("_", " ")) for words in [*said, *without]]
    return joined(tag("h3", "Limits reached, and what relaxing them buys"), bullets(said))


def _agreement(result: Result) -> Html:
    return paragraphs(_sentence(text) for text in _said(result))


def _said(result: Result) -> Iterator[str]:
    if result.region is not None:
        yield result.region.words
    if result.internal_points:
        yield result.internal_points
    yield result.agreement


def _sentence(text: str) -> str:
    """Return a message as a sentence; names of symbols keep their letter."""
    ended = text if text.endswith((".", "?", "!")) else f"{text}."
    first = ended.split(maxsplit=1)[0]
    return ended[0].upper() + ended[1:] if first.isalpha() and len(first) > 1 else ended
