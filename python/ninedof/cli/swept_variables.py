"""The family of `ninedof sweep` over variables of the design, and the values of those that are not swept."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

from ninedof.cli.chosen_design import Chosen, length_option
from ninedof.cli.options import HEXAGON, HexagonalOptions
from ninedof.design.family_variables import variables_of
from ninedof.design.study import FAMILIES as FAMILY_NAMES
from ninedof.design.study import Study
from ninedof.paper.published import published_variables
from ninedof.support.angles import plain_name
from ninedof.sweep.run import DesignOptions

FAMILIES = {name: tuple(Study(name).variables) for name in FAMILY_NAMES}
VARIABLES = frozenset(name for names in FAMILIES.values() for name in names)

Held = tuple[dict[str, float], DesignOptions]
"""The values of the variables that are not swept, and their family, characteristic length and unit of lengths."""


def swept_design(name: str | None, chosen: Chosen | None, options: HexagonalOptions, over: Iterable[str]) -> Held:
    """Return what a sweep over variables holds: of the design of a name, or of a hexagonal one given by its sides."""
    over = [plain_name(swept) for swept in over]
    if chosen is not None:
        return _of_named(name, chosen, over)
    own = options.given(*HEXAGON)
    twist = own.pop("theta_z_deg", None)
    if both := sorted(set(own) & set(over)):
        raise ValueError(f"--over: got {both[0]}, which --{both[0]} holds, expected one of the two")
    if others := [swept for swept in over if swept not in FAMILIES["hexagonal"]]:
        raise ValueError(f"--over: got {others[0]}, expected a DESIGN whose family has it")
    values = own or published_variables()
    if twist is not None:
        values["theta_z"] = math.radians(twist)
    return _held("hexagonal", values, over, 1.0 if options.lc is None else length_option(options.lc))


def _of_named(name: str | None, chosen: Chosen, over: list[str]) -> Held:
    if chosen.tool:
        raise ValueError(
            f"--over: got variables of {name}, which has a [tool], expected coordinates of the configuration"
        )
    fits: dict[str, Mapping[str, float]] = {}
    if chosen.result is not None and chosen.result.best is not None:
        fits[chosen.result.study.family] = chosen.result.best.variables
    for family in FAMILIES:
        if family not in fits and (found := variables_of(family, chosen.geometry, chosen.configuration)) is not None:
            fits[family] = found
    for family, values in fits.items():
        if set(over) <= set(FAMILIES[family]):
            return _held(family, values, over, chosen.characteristic_length, chosen.unit)
    expected = f"variables of one family: {', '.join(fits)}" if fits else "coordinates: O or p is not on the z axis"
    raise ValueError(f"--over: got {', '.join(over)}, which {name} does not have as variables, expected {expected}")


def _held(family: str, values: Mapping[str, float], over: list[str], length: float | str, unit: str = "") -> Held:
    values_held = {name: values[name] for name in FAMILIES[family] if name in values and name not in over}
    return values_held, {"family": family, "characteristic_length": length, "unit": unit}
