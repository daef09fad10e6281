"""Which actuators a design takes, and what the next best would be."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ninedof.design.actuators import Actuator, actuator_rows
from ninedof.design.study import Study
from ninedof.support.arguments import items, table
from ninedof.support.short import short_repr
from ninedof.support.structs import Fixed

EACH = 3  # legs of a kind


@short_repr
@dataclass(frozen=True)
class Combination:
    """A row for each kind of legs, and the best design found with them."""

    rows: Mapping[str, Actuator]
    """By kind of legs: "external", "upper", "lower"."""
    objective: float

    @property
    def price(self) -> float | None:
        """Of nine actuators; None where that of a row is unknown."""
        prices = [row.price for row in self.rows.values()]
        return None if None in prices else float(EACH * sum(price or 0.0 for price in prices))

    @property
    def words(self) -> str:
        """The names of the rows."""
        names = [row.name for row in self.rows.values()]
        return f"{names[0]} for all legs" if len(set(names)) == 1 else ", ".join(
            f"{kind} {name}" for kind, name in zip(self.rows, names, strict=True)
        )  # fmt: skip

    def to_dict(self) -> dict[str, Any]:
        """Return plain values."""
        rows = {kind: row.to_dict() for kind, row in self.rows.items()}
        return {"rows": rows, "objective": self.objective, "price": self.price}

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Combination:
        """Return the combination of a mapping as `to_dict` makes it."""
        rows = table("actuators.rows", data.get("rows"))
        return cls(Fixed({kind: actuator_rows(kind, [row])[0] for kind, row in rows.items()}), data["objective"])


@short_repr
@dataclass(frozen=True)
class ActuatorChoice:
    """The combination of rows that a result has, and the search that chose it."""

    chosen: Combination
    next_best: Combination | None
    """The best of the others; None where none was found, or the search ended before."""
    combinations: int
    """Combinations of rows that are within the price."""
    solved: int
    """Continuous studies that were solved for the choice."""
    left_out: tuple[str, ...] = ()
    """Rows left out: another can do all that they can and costs no more, or their stroke is too short."""
    notes: tuple[str, ...] = ()
    """What was not looked at."""

    @property
    def words(self) -> list[str]:
        """The choice in sentences."""
        out = [f"actuators: {self.chosen.words}{_priced(self.chosen)}"]
        if self.next_best is not None:
            more = self.next_best.objective / self.chosen.objective - 1.0
            size = (
                f"{self.next_best.objective:.6f}, {100.0 * more:.2g} % more" if more >= 5e-7 else "the same objective"
            )
            out.append(f"the next best: {self.next_best.words} has {size}{_priced(self.next_best)}")
        out.append(f"{self.solved} studies solved for {self.combinations} combinations of actuators")
        if self.left_out:
            why = "another can do as much for no more, or the region needs a longer stroke"
            out.append(f"not tried: {', '.join(self.left_out)}; {why}")
        return [*out, *self.notes]

    def to_dict(self) -> dict[str, Any]:
        """Return plain values."""
        return self.__dict__ | {
            "chosen": self.chosen.to_dict(),
            "next_best": None if self.next_best is None else self.next_best.to_dict(),
            "left_out": list(self.left_out),
            "notes": list(self.notes),
        }

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> ActuatorChoice:
        """Return the choice of a mapping as `to_dict` makes it."""
        other = data.get("next_best")
        return cls(
            Combination.from_dict(table("actuators.chosen", data.get("chosen"))),
            None if other is None else Combination.from_dict(table("actuators.next_best", other)),
            data["combinations"],
            data["solved"],
            *(items(name, data.get(name), "names") for name in ("left_out", "notes")),
        )


def _priced(one: Combination) -> str:
    return "" if one.price is None else f"; price {one.price:g}"


def notes_of(study: Study) -> tuple[str, ...]:
    """Return which columns of the actuators have no effect in a study."""
    columns = (("force", "loads"), ("rate", "speeds"))
    return tuple(
        f"the {column}s of the actuators are not looked at: the study states no {needs}"
        for column, needs in columns
        if not study.stated[needs] and any(getattr(row, column) < float("inf") for row in study.actuators)
    )
