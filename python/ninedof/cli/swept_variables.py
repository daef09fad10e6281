"""The family of `ninedof sweep` over variables of the design, and the values of those that are not swept."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

from ninedof.cli.chosen_design import length_option, named_design, with_length
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


def swept_design(
    name: str | None, sides: Mapping[str, float | None], theta_z_deg: float | None, over: Iterable[str], lc: str | None
) -> Held:
    """Return what a sweep over variables holds: of the named design, or of a hexagonal one given by its sides."""
    over = [plain_name(swept) for swept in over]
    if name is not None:
        return _of_named(name, sides, theta_z_deg, over, lc)
    own = {side: value for side, value in sides.items() if value is not None}
    if both := sorted(set(own) & set(over)):
        raise ValueError(f"--over: got {both[0]}, which --{both[0]} holds, expected one of the two")
    if others := [swept for swept in over if swept not in FAMILIES["hexagonal"]]:
        raise ValueError(f"--over: got {others[0]}, expected a DESIGN whose family has it")
    values = own or published_variables()
    if theta_z_deg is not None:
        values["theta_z"] = math.radians(theta_z_deg)
    return _held("hexagonal", values, over, 1.0 if lc is None else length_option(lc))


def _of_named(
    name: str, sides: Mapping[str, float | None], theta_z_deg: float | None, over: list[str], lc: str | None
) -> Held:
    if theta_z_deg is not None or any(value is not None for value in sides.values()):
        raise ValueError(f"sweep: got {name} and sides or heights of another design, expected one of the two")
    chosen = with_length(named_design(name), lc)
    length = chosen.characteristic_length
    if chosen.tool:
        raise ValueError(
            f"--over: got variables of {name}, which has a [tool], expected coordinates of the configuration"
        )
    if chosen.result is not None and chosen.result.best is not None and chosen.study is not None:
        family = chosen.study.family
        if set(over) <= set(FAMILIES[family]):
            return _held(family, chosen.result.best.variables, over, length, chosen.unit)
    fits = []
    for family, names in FAMILIES.items():
        values = variables_of(family, chosen.geometry, chosen.configuration)
        if values is not None and set(over) <= set(names):
            return _held(family, values, over, length, chosen.unit)
        fits += [family] * (values is not None)
    expected = f"variables of one family: {', '.join(fits)}" if fits else "coordinates: O or p is not on the z axis"
    raise ValueError(f"--over: got {', '.join(over)}, which {name} does not have as variables, expected {expected}")


def _held(family: str, values: Mapping[str, float], over: list[str], length: float | str, unit: str = "") -> Held:
    values_held = {name: values[name] for name in FAMILIES[family] if name in values and name not in over}
    return values_held, {"family": family, "characteristic_length": length, "unit": unit}
