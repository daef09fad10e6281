"""The design that a command is about: named by DESIGN, or by sides and heights; and its characteristic length."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import ninedof as nd
from ninedof.cli.options import HEXAGON, SIDES, HexagonalOptions, word_or_number
from ninedof.conditioning.characteristic_length import KINDS
from ninedof.paper.published import published_variables
from ninedof.records.design_file import hexagonal_design
from ninedof.records.load import design_and_result
from ninedof.sheet.pose_words import pose_words
from ninedof.support.arrays import Floats


@dataclass(frozen=True)
class Chosen:
    """A design at its neutral pose, and the result of its study, if there is one."""

    geometry: nd.Geometry
    configuration: nd.Configuration
    characteristic_length: float | str
    unit: str
    tool: nd.Tool
    result: nd.Result | None = None

    @property
    def design(self) -> nd.Design:
        """The design alone."""
        return nd.Design(self.geometry, self.configuration, self.characteristic_length, self.unit, self.tool)

    @property
    def machine(self) -> nd.Result | nd.Design:
        """The result, or the design alone without one."""
        return self.result or self.design

    def words(self, c: nd.Configuration) -> str:
        """Return a pose of the design in words."""
        return pose_words(c, self.configuration.rotation, self.unit)

    @property
    def study(self) -> nd.Study | None:
        """The study that it is from."""
        return None if self.result is None else self.result.study

    @property
    def duty(self) -> nd.Study:
        """The study that says what the machine is for; one of the tool alone without a study."""
        return self.study or nd.Study(tool=self.tool)

    @property
    def stated(self) -> dict[str, Any]:
        """Title block and tool of its study, as entries of a record's question for the report; those that it has."""
        entries = {"about": self.duty.about.to_dict(), "tool": self.tool.to_dict()}
        return {name: entry for name, entry in entries.items() if entry}

    @property
    def permitted_lengths(self) -> tuple[Floats, Floats] | None:
        """The least and greatest length of each leg by its study; None without one."""
        return None if self.result is None else self.result.permitted_lengths


C = TypeVar("C", bound=Chosen)


def named_design(name: str | None) -> Chosen:
    """Return the design that an argument DESIGN names; the published design at its best zs without one."""
    if name is None:
        return Chosen(*hexagonal_design(published_variables()))
    design, result = design_and_result(nd.load(name), name)
    return Chosen(*design, result)


def chosen_design(name: str | None, options: HexagonalOptions) -> Chosen:
    """Return the design that an argument DESIGN names, or that of the sides and heights of the hexagonal family."""
    values = options.given(*HEXAGON)
    if name is None:
        if missing := [f"--{side}" for side in SIDES if side not in values]:
            expected = "expected a design file or all of a1 a2 b1 b2 zp zs"
            raise ValueError(f"design: got no {', '.join(missing)}, {expected}")
        chosen = Chosen(*hexagonal_design(values | {"theta_z": math.radians(values.get("theta_z_deg", 0.0))}))
    elif values:
        raise ValueError(f"design: got {name} and {', '.join(values)}, expected one of the two")
    else:
        chosen = named_design(name)
    return with_length(chosen, options.lc)


def with_length(chosen: C, lc: str | None) -> C:
    """Return the design with the characteristic length given by --lc, if any."""
    return chosen if lc is None else replace(chosen, characteristic_length=length_option(lc))


def length_option(text: str) -> float | str:
    """Return the characteristic length given by --lc."""
    return word_or_number("--lc", text, KINDS, f"a number or one of {', '.join(KINDS)}")
