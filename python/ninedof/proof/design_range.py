"""A range of designs: which variables of a study vary, between which ends; whether any of them keeps every limit."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from ninedof import _core
from ninedof.conditioning.conditioning import condition_number
from ninedof.design.domains.region_poses import configurations_at, o_is_placed
from ninedof.design.limit_numbers import crossed, with_scaled_limits
from ninedof.design.study import Study
from ninedof.design.variables import angles_in_radians, given_values
from ninedof.robot.configuration import Configuration
from ninedof.support.arguments import finite, items, shown, table, text
from ninedof.support.arrays import Floats
from ninedof.support.kept.files import sha256
from ninedof.support.structs import Fixed
from ninedof.support.units import amount, plain_name

EXISTS, NONE, UNDECIDED = "exists", "none", "undecided"
MOST_VARIED = 4
LONGEST = 1e9  # seconds
METHOD = 3  # of the proofs: sets that another one proved are not gone on with
POSES, SIDE = 400, 25  # of the sample: poses of the region, designs along a side


class HasDesign(Protocol):
    """A result of a study: what `Result` has."""

    @property
    def study(self) -> Study:
        """The study."""

    @property
    def variables(self) -> Mapping[str, float] | None:
        """The design; None without one."""


@dataclass(frozen=True)
class DesignRange:
    """The designs that are asked for, and what they have to keep."""

    study: Study
    vary: tuple[str, ...]
    """The variables that vary."""
    ranges: tuple[tuple[float, float], ...]
    """The ends of each; angles in radians."""
    at: Mapping[str, float]
    """All variables: of those that vary the design that is marked, or the middle."""
    condition_number: float | None
    """A bound besides the limits of the study."""
    moved: tuple[str, ...] = ()
    """The variables whose value in the result or the study lies outside of the range: `at` has the middle."""

    def for_core(self) -> _core.DesignQuestion:
        """Return the question as the core takes it."""
        names, region = list(self.study.variables), self.study.objective.region
        return _core.DesignQuestion(
            problem=self.study.problem(),
            region=[] if region is None else [region.for_core()],
            at=[self.at[name] for name in names],
            varied=[names.index(name) for name in self.vary],
            low=[low for low, _ in self.ranges],
            high=[high for _, high in self.ranges],
            condition=math.inf if self.condition_number is None else float(self.condition_number),
        )

    def eased(self, share: float) -> DesignRange:
        """Return the same question with every limit wider by a share of it, or narrower where that is negative."""
        sides = {"min": 1.0 - share, "max": 1.0 + share}
        without = crossed(self.study, lambda _, side: sides[side])
        condition = None if self.condition_number is None else self.condition_number * sides["max"]
        study = with_scaled_limits(self.study, lambda label, side: 1.0 if label in without else sides[side])
        return replace(self, study=study, condition_number=condition)

    def values(self, names: Collection[str]) -> str:
        """Return values of variables in words."""
        shown = (f"{name} = {self.study.shown(name, self.at[name]):.5g}" for name in names)
        return ", ".join(amount(words, self.study.unit_of(name)) for name, words in zip(names, shown, strict=True))

    @property
    def held(self) -> str:
        """The values of the variables that do not vary, in words; without those that the study fixes at 0."""
        return self.values([name for name in self.study.variables if name not in self.vary and self.at[name] != 0.0])

    def sampled_condition(self, first: int, second: int) -> tuple[Floats, Floats, Floats] | None:
        """Return the worst condition number over a sample of poses, at designs of the plane of two of the variables.

        Values of the first variable (n,) and of the second (n,), and a row for each value of the second, NaN where
        there is no robot, infinite where O is not between the plates; None where the characteristic length depends on
        the design. Nothing of it is proved.
        """
        length = self.study.characteristic_length
        if not isinstance(length, float | int):
            return None
        problem = self.study.problem()
        x, y = (np.linspace(*self.ranges[k], SIDE) for k in (first, second))
        worst = np.full((SIDE, SIDE), np.nan)
        for n, m in np.ndindex(SIDE, SIDE):
            values = dict(self.at) | {self.vary[first]: float(x[m]), self.vary[second]: float(y[n])}
            if values["zs"] >= values["zp"]:
                worst[n, m] = np.inf
                continue
            row = [values.get(name, 0.0) for name in problem.names]
            with suppress(ValueError):  # no robot there
                worst[n, m] = np.max(condition_number(problem.geometry(row), self._poses(row), float(length)))
        return x, y, worst

    def _poses(self, row: list[float]) -> Configuration:
        every, region = Configuration(*self.study.problem().configurations(row)), self.study.objective.region
        if region is None:
            return every[1:] if len(every) > 1 else every
        return configurations_at(region, every[0], _core.even_poses(region.for_core(), POSES))

    @property
    def digest(self) -> str:
        """Digest of the question: another run goes on with the same question only, whichever design is marked."""
        held = sorted((name, value) for name, value in self.at.items() if name not in self.vary)
        parts = (METHOD, self.study.to_dict(), self.vary, self.ranges, held, self.condition_number)
        return sha256(repr(parts).encode()).hexdigest()

    @property
    def words(self) -> str:
        """The ranges in words."""
        parts = []
        for name, ends in zip(self.vary, self.ranges, strict=True):
            low, high = (f"{self.study.shown(name, end):g}" for end in ends)
            parts.append(f"{name} from {low} to {amount(high, self.study.unit_of(name))}")
        return ", ".join(parts)


def design_range(
    of: Study | HasDesign,
    vary: Collection[str] | Mapping[str, tuple[float, float] | None],
    at: Mapping[str, float | str] | None = None,
    condition_number: float | None = None,
    most: int = MOST_VARIED,
) -> DesignRange:
    """Return what `admissible` is asked for, checked; it says what the arguments mean. `most` variables may vary."""
    study, values = _asked(of, at)
    expected = f"names of one to {most} variables"
    pairs = vary.items() if isinstance(vary, Mapping) else [(name, None) for name in items("vary", vary, expected)]
    varied = {text("vary", name): ends for name, ends in pairs}
    if not 1 <= len(varied) <= most:
        raise ValueError(f"vary: got {shown(vary)}, expected {expected}")
    ends = angles_in_radians(study, {name: two for name, two in varied.items() if two is not None}, _ends)
    names = tuple(dict.fromkeys(map(plain_name, varied)))
    ranges = tuple(_range(study, name, ends.get(name)) for name in names)
    known, moved = set(values), list[str]()
    for name, (low, high) in zip(names, ranges, strict=True):
        if not low <= values.get(name, math.nan) <= high:
            values[name] = 0.5 * (low + high)
            moved += [name] if name in known else []
    missing = [name for name in study.variables if name not in values]
    if missing:
        raise ValueError(f"at: got no {missing[0]}, expected a value: it is free in the study and does not vary")
    if condition_number is not None:
        condition_number = finite("condition_number", condition_number, 1.0)
    return DesignRange(study, names, ranges, Fixed(values), condition_number, tuple(moved))


def design_values(of: HasDesign | Mapping[str, float]) -> Mapping[str, float]:
    """Return the variables of a result, or a mapping as it is."""
    values = getattr(of, "variables", of)
    if values is None:
        raise ValueError("design: got a result without a design, expected one with a best candidate")
    return table("design", values)


def _asked(of: Study | HasDesign, at: Mapping[str, float | str] | None) -> tuple[Study, dict[str, float]]:
    study = of if isinstance(of, Study) else getattr(of, "study", None)
    if not isinstance(study, Study):
        raise ValueError(f"of: got {shown(of)}, expected a Study or a Result")
    study.require_no_choice()
    values = {name: ends for name, ends in study.variables.items() if not isinstance(ends, tuple)}
    if of is not study:
        values |= {name: x for name, x in design_values(of).items() if name in study.variables}  # type: ignore[arg-type]
    values |= given_values(study, values, {} if at is None else table("at", at), "at")
    if o_is_placed(study):
        raise ValueError('internal_point: got "best", expected a region that says where O is: "shifted" or "held"')
    return study, values


def _ends(name: str, ends: object) -> tuple[float, float]:
    low, high = (finite(f"vary.{name}", end) for end in items(f"vary.{name}", ends, "(low, high)", 2))
    if not low < high:
        raise ValueError(f"vary.{name}: got ({low:g}, {high:g}), expected low < high")
    return low, high


def _range(study: Study, name: str, ends: tuple[float, float] | None) -> tuple[float, float]:
    if name not in study.variables:
        raise ValueError(f"vary: got {shown(name)}, expected variables of the study: {', '.join(study.variables)}")
    bounds = study.variables[name] if ends is None else ends
    if not isinstance(bounds, tuple):
        ends_too = f"its ends too, (low, high) or --vary {name}=LOW:HIGH"
        raise ValueError(f"vary.{name}: got a variable that is fixed in the study, expected {ends_too}")
    return _ends(name, bounds)
