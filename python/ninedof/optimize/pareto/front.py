"""The result of a trade-off: the best design for each limit, or the reason why there is none; its knee."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from ninedof.design.study import Study
from ninedof.optimize.pareto.limits import TOLERANCE, unit_of, without_degrees
from ninedof.optimize.result import Result, Status
from ninedof.optimize.tables import MOST_GAIN
from ninedof.support.units import unit_entry, with_unit
from ninedof.tables import RIGHT, Column, Table
from ninedof.tables.html import notebook

SAME = 1e-9  # relative: smaller differences of objectives do not count
FLAT = 1e-6  # of the range of the objective: a front that bulges less has no knee


@dataclass(frozen=True, eq=False)
class Front:
    """The least objective for each value of a limit, from the tightest to the loosest."""

    study: Study
    """The given study, with the index that was minimized; the limit takes the values of `limits`."""
    against: str
    """The limit that moves, by its name in `pareto`."""
    limits: tuple[float, ...]
    """Radians for an angle, or degrees where the name in `against` ends in _deg."""
    results: tuple[Result, ...]
    """One for each limit."""
    interrupted: bool = False
    """Whether Ctrl-C ended the work; the limits solved so far are included."""
    seconds: float = 0.0

    def __len__(self) -> int:
        """Return the number of limits."""
        return len(self.limits)

    def __iter__(self) -> Iterator[Result]:
        """Iterate over the results, from the tightest limit to the loosest."""
        return iter(self.results)

    def __repr__(self) -> str:
        """Show the ends of the limit and of the objective."""
        values = [value for value in self.objectives if not math.isnan(value)]
        ends = f"{self.limits[0]:.6g} to {self.limits[-1]:.6g}" if self.limits else "none"
        words = f"{self.study.words} = {max(values):.6f} to {min(values):.6f}" if values else "no design"
        count = f"{len(self)} limits of {self.against}, {ends}"
        return f"<Front: {count}; {words}{', interrupted' * self.interrupted}>"

    def _repr_html_(self) -> str:
        return notebook(front_table(self))

    @property
    def objectives(self) -> tuple[float, ...]:
        """The objective at each limit; NaN where there is no best design."""
        return tuple(objective_of(result) for result in self.results)

    @property
    def limit_name(self) -> str:
        """The limit's name in prices and active limits: `against` without _deg."""
        return str(without_degrees(self.against)[0])

    @property
    def unit(self) -> str:
        """The unit of `limits`: "deg", "rad", the length unit of the study, or "" for a ratio."""
        return unit_of(self.study, self.against)

    @property
    def of_tolerances(self) -> bool:
        """Whether the limit is the tolerance, which is harder to keep where it is larger."""
        return self.against == TOLERANCE

    @property
    def prices(self) -> tuple[float | None, ...]:
        """Per cent by which the objective falls when the limit is relaxed by 1 %; None without an optimum.

        Of a tolerance, relaxed is smaller: its price is that of the reserve that the limits leave for it.
        """
        return tuple(self._price(result) for result in self.results)

    def _price(self, result: Result) -> float | None:
        if result.best is None or result.status != Status.OPTIMAL:
            return None
        prices = result.best.prices
        if not self.of_tolerances:
            return prices.get(self.limit_name, 0.0)
        parts: dict[str, float] = {}  # of each limit, which a tolerance 1 % smaller relaxes by 1 % of its reserve
        for side, share in ({} if result.reserve is None else result.reserve.shares).items():
            name = side.rpartition(" ")[0]  # of "stroke_ratio max"
            parts[name] = max(abs(1.0 - 1.0 / share), parts.get(name, 0.0))
        return sum(prices.get(name, 0.0) * part for name, part in parts.items())

    @property
    def dominated(self) -> tuple[bool, ...]:
        """Whether a tighter limit allows a design that is as good: this limit has no effect."""
        out, best = [], math.inf
        for value in self.objectives:
            out.append(value >= best * (1.0 - SAME))
            best = min(best, value) if not math.isnan(value) else best
        return tuple(out)

    def table(self) -> list[dict[str, Any]]:
        """Return one row for each limit, as plain values.

        Returns
        -------
        list of dict
            limit (in `unit`); status and reason; objective, condition_number, the worst over the poses, and
            neutral_condition_number; price; active;
            variables (angles in radians) of the best design, None where there is none; dominated. `active` leaves out
            the swept limit where its price is 0: the best design without the limit just meets it.

        """
        rows = []
        columns = (self.limits, self.results, self.objectives, self.prices, self.dominated)
        for limit, result, value, price, flat in zip(*columns, strict=True):
            best = None if math.isnan(value) else result.best
            rows.append(
                {
                    "limit": limit,
                    "status": str(result.status),
                    "reason": result.reason,
                    "objective": best and best.objective,
                    "condition_number": best and best.condition_number,
                    "neutral_condition_number": best and best.neutral_condition_number,
                    "price": price,
                    "active": best and [name for name in best.active if name != self.limit_name or price != 0.0],
                    "variables": best and dict(best.variables),
                    "dominated": flat,
                }
            )
        return rows

    def to_dict(self) -> dict[str, Any]:
        """Return the front as plain JSON values, without the results of the limits."""
        return {
            **unit_entry(self.study.unit),
            "against": self.against,
            **({"limit_unit": self.unit} if self.unit else {}),
            "objective": self.study.words,
            "interrupted": self.interrupted,
            "seconds": self.seconds,
            "rows": self.table(),
        }


def objective_of(result: Result) -> float:
    """Return the objective of a result; NaN without a design or if the study is unbounded."""
    if result.best is None or result.status not in (Status.OPTIMAL, Status.STOPPED):
        return math.nan
    return result.best.objective


def front_table(front: Front) -> Table:
    """Return the table of a front: one limit per row, the tightest first."""
    limit = front.limit_name.replace("_", " ")
    columns = [
        Column("no.", "", RIGHT),
        Column(f"{limit}\n{with_unit('at most', 'deg' if front.unit == 'rad' else front.unit)}", "", RIGHT),
        Column("objective", "", ".6f"),
        Column("neutral\ncondition number", "", ".6f"),
        Column("price\n% for 1 %", "", ".2g" if front.of_tolerances else ".3f"),
        Column("limits reached"),
    ]
    points = list(enumerate(front.table(), start=1))
    rows = [
        (
            str(number),  # RUN#1 names the first
            limit_text(front, row["limit"]),
            *(
                None if row["objective"] is None else row[key]
                for key in ("objective", "neutral_condition_number", "price")
            ),
            _row_words(front, row),
        )
        for number, row in points
    ]
    steep = max((price or 0.0 for price in front.prices), default=0.0) >= MOST_GAIN
    reasons: dict[str, list[str]] = {}
    for number, row in points:
        if _without_design(row) and row["reason"]:
            reasons.setdefault(f"{row['status']}: {row['reason']}", []).append(str(number))
    notes = [f"no. {', '.join(numbers)} {words}" for words, numbers in reasons.items()]
    notes += ["price: slope of the objective at that limit; a steep one holds for much less than 1 %"] * steep
    return Table(f"{front.study.words} against {limit}", columns, rows, notes)


def limit_text(front: Front, value: float) -> str:
    """Return a limit of a front as text; angles in degrees."""
    return f"{math.degrees(value) if front.unit == 'rad' else value:.5g}"


def _row_words(front: Front, row: Mapping[str, Any]) -> str:
    """Return what a row of the table of a front reached, or why it has no design."""
    if _without_design(row):
        return f"{row['status']}{', see below' * bool(row['reason'])}"
    active = ", ".join(row["active"]) or "nothing"
    if row["dominated"]:
        return f"{active} (no better than a {'larger tolerance' if front.of_tolerances else 'tighter limit'})"
    return f"{active} ({front.limit_name} without effect)" if row["price"] == 0.0 < row["limit"] else active


def _without_design(row: Mapping[str, Any]) -> bool:
    return row["objective"] is None or row["status"] != Status.OPTIMAL


class Preferred(NamedTuple):
    """The point of a front to look at first."""

    number: int
    """Counted from 1, as the table of the front has it."""
    words: str
    """Why."""


def preferred(front: Front) -> Preferred | None:
    """Return the knee of a front, else the tightest limit with the least objective; None without a design.

    The knee is the point farthest below the straight line between the two ends, both axes over their ranges. Limits
    that are no better than a tighter one do not count, nor does an infinite one.
    """
    points = [
        (k, limit, value)
        for k, (limit, value, flat) in enumerate(zip(front.limits, front.objectives, front.dominated, strict=True), 1)
        if not (math.isnan(value) or flat)
    ]
    if not points:
        return None
    at = np.array([point for point in points if math.isfinite(point[1])])
    if len(at) > 2:
        x, y = ((column - column[-1]) / (column[0] - column[-1]) for column in at[:, 1:].T)  # 1 at the tightest, 0 last
        if (x - y).max() > FLAT:
            words = "the knee of the front: farthest below the straight line between its ends"
            return Preferred(int(at[(x - y).argmax(), 0]), words)
    return Preferred(points[-1][0], "the least objective; the front has no knee")
