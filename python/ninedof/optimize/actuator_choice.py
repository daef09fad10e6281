"""Which actuators a design takes, and what the next best would be."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ninedof.design.actuators import LEG_KINDS, Actuator, price_words
from ninedof.design.study import Study
from ninedof.support.text import short_repr

EACH = 3  # legs of a kind


@short_repr
@dataclass(frozen=True)
class Combination:
    """A row for each kind of legs, and the objective of the best design found with them."""

    external: Actuator
    upper: Actuator
    lower: Actuator
    objective: float

    @property
    def rows(self) -> dict[str, Actuator]:
        """The rows by kind of legs."""
        return {kind: getattr(self, kind) for kind in LEG_KINDS}

    @property
    def price(self) -> float | None:
        """Of nine actuators; None where that of a row is unknown."""
        prices = [row.price for row in self.rows.values()]
        return None if None in prices else float(EACH * sum(price or 0.0 for price in prices))

    @property
    def words(self) -> str:
        """The names of the rows."""
        if self.external == self.upper == self.lower:
            return f"{self.external.name} for all legs"
        return ", ".join(f"{kind} {row.name}" for kind, row in self.rows.items())


@short_repr
@dataclass(frozen=True)
class ActuatorChoice:
    """The combination of rows that a result has, and the search that chose it."""

    chosen: Combination
    next_best: Combination | None = None
    """The best of the others; None where none was found, or the search ended before."""
    combinations: int = 0
    """All combinations of the rows that were tried."""
    solved: int = 0
    """Continuous studies that were solved for the choice."""
    left_out: tuple[str, ...] = ()
    """Rows that were not tried: another can do as much and costs no more, or their stroke is too short."""
    notes: tuple[str, ...] = ()
    """The file that the rows are from, and what was not looked at."""

    @property
    def words(self) -> list[str]:
        """The choice in sentences."""
        out = [f"actuators: {self.chosen.words}{_priced(self.chosen)}"]
        if (other := self.next_best) is not None:
            more = other.objective / self.chosen.objective - 1.0
            apart = f"{other.objective:.6f}, {100.0 * abs(more):.2g} % {'more' if more > 0.0 else 'less'}"
            value = apart if abs(more) >= 5e-7 else "the same objective"
            of = " of the rows that were tried" * bool(self.left_out)
            out.append(f"the next best{of}: {other.words} has {value}{_priced(other)}")
        out.append(f"{self.solved} studies solved for {self.combinations} combinations of actuators")
        if self.left_out:
            why = "another can do as much for no more, or the region needs a longer stroke"
            out.append(f"not tried: {', '.join(self.left_out)}; {why}")
        return [*out, *self.notes]


def _priced(one: Combination) -> str:
    return "" if one.price is None else f"; price {price_words(one.price)}"


def notes_of(study: Study) -> tuple[str, ...]:
    """Return where the actuators of a study are from, and which of their columns have no effect in it."""
    columns = (("force", "loads"), ("rate", "speeds"))
    count = len(study.actuators)
    file = [f"actuators from {study.catalogue}, {count} row{'s' * (count > 1)}"] if study.catalogue else []
    return (
        *file,
        *(
            f"the {column}s of the actuators are not looked at: the study states no {needs}"
            for column, needs in columns
            if not study.stated[needs] and any(getattr(row, column) < math.inf for row in study.actuators)
        ),
    )
