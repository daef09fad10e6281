"""A design study: family, free variables, constraints and objective."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from copy import copy
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.conditioning.characteristic_length import characteristic_length as length_of
from ninedof.conditioning.characteristic_length import length_argument
from ninedof.design import actuators as bought
from ninedof.design.actuators import FOR, LEG_KINDS, Actuator
from ninedof.design.design_point import DesignPoint, design_point
from ninedof.design.duty import DUTIES, About, LegDuty, Loads, Masses, Speeds, Tolerances, duty, require_small
from ninedof.design.limits import OF_LENGTHS, ROWS, Limit, form, parse, require_stated
from ninedof.design.objective import Objective, internal_motion
from ninedof.design.tables import limits_table, variables_table
from ninedof.design.tool import Tool
from ninedof.robot.configuration import Configuration
from ninedof.support.arguments import (
    bound,
    choice,
    finite,
    flag,
    instance,
    is_number,
    items,
    known_keys,
    number,
    shown,
    table,
    text,
    whole,
)
from ninedof.support.arrays import Floats, as_floats
from ninedof.support.kept.files import read_toml, write_toml
from ninedof.support.structs import Check, Fixed, Named, check_entries, entry, plain, within
from ninedof.support.text import short_repr
from ninedof.support.units import (
    DEG,
    angle_entry,
    degrees_of,
    in_radians,
    require_unit_at_top,
    unit_argument,
    unit_entry,
    unit_of_forces,
)
from ninedof.tables.html import notebook

Bound = float | tuple[float, float]
"""A fixed value, or (low, high)."""

LENGTH = "characteristic_length"
UNGIVEN = float("1.0")  # an object of its own: told from a 1.0 that was given
TABLES = {
    "design": ("family", LENGTH, "actuators_for", "greatest_price"),
    "variables": (),
    "constraints": (),
    "objective": (),
    "solver": ("starts", "seed"),
    **dict.fromkeys(DUTIES, ()),
}
"""The tables of a study file, and the arguments that are keys of one; the others are arguments as a whole."""
MOST_STARTS = 1_000_000  # each may be searched four times, and all ends are kept
FAMILIES = tuple(_core.design_family_names())
"""From few variables to many."""


def variable_kinds(family: str) -> dict[str, str]:
    """Return the variables of a family by name: "length", "coordinate" or "angle"."""
    return {one.name: one.kind for one in _core.family_variables(family)}


def in_radians_by_kind(where: str, values: Any, kinds: Mapping[str, str], check: Check) -> dict[str, Any]:
    """Return named values with angles in radians; raise for unknown names."""
    angles = [name for name, kind in kinds.items() if kind == "angle"]
    known_keys(where, values, [*kinds, *(name + DEG for name in angles)])
    return in_radians(values, dict.fromkeys(angles, check))


def _constraints(name: str, value: Any) -> Mapping[str, Any]:
    known_keys(name, value, ROWS)
    return Fixed({key: form(parse(key, limits)) for key, limits in value.items()})


def _length(name: str, value: Any) -> float | str | tuple[float, float]:
    if isinstance(value, str) or is_number(value):
        return length_argument(value)
    low, high = (finite(name, x) for x in items(name, value, "a number, a kind, or (low, high)", 2))
    if not 0.0 < low <= high:
        raise ValueError(f"{name}: got {shown(value)}, expected 0 < low <= high")
    return low if low == high else (low, high)


def _objective(name: str, value: Any) -> Objective:
    return value if isinstance(value, Objective) else Objective.from_dict(value)


def _unit(name: str, value: Any) -> str:
    return unit_argument(value)


@short_repr
@dataclass(frozen=True)
class Study(Named):
    """A design problem: minimize an objective over the free variables of a family, subject to limits.

    Immutable; `dataclasses.replace` makes another.

    Parameters
    ----------
    family : str
        "hexagonal": the plates of eqs. (37)-(38), variables a1 a2 b1 b2 zp zs theta_z. "symmetric": planar triples,
        each with its radius and angle. "symmetric_nonplanar": with heights too. "general": all 36 joint coordinates.
    variables : mapping
        Name to (low, high) for a free variable (either may be infinite) or to a number for a fixed one. Those left out
        take the family's defaults, in characteristic lengths if that is a number and in units of length otherwise; a
        hexagonal design has sides in [0, 60], heights in [0.05, 80] and theta_z = 0. Lengths in any one
        unit, angles in radians, or in degrees with _deg behind the name: {"theta_z_deg": (-60, 60)}. The attribute
        has radians.
    constraints : mapping
        Name to (low, high), None for an open side, or to a mapping of min, max (max_deg for an angle) and options:
        {"stroke_ratio": (None, 1.4), "base_cone": {"max_deg": 45, "axis": [0, 0, 1]}}. 0 < zs < zp always (eq. 9b).
        A limit holds at every pose of the objective, or with "at": "neutral" at the neutral pose alone, where it is
        named "leg_ratio at neutral". A list of two such mappings states both. Limits that compare poses take no
        "neutral": strokes, and cones about the legs' own neutral directions.

        ratios: radius_ratio (base / platform, largest joint distance from the axis), leg_ratio (longest / shortest leg
        over all poses), stroke_ratio (longest / shortest of one leg over the poses), zs_fraction (zs / zp).
        lengths: stroke, leg_length, external_length, upper_length, lower_length and leg_clearance (`of` "length" or
        "zp"), joint_height and joint_spacing (`of` "length" or "radius"), height, footprint. leg_clearance takes the
        `radius` of a leg in place of min. angles: base_cone and platform_cone (`axis` of the cone, by default the
        leg's own neutral direction). singularity_free (min, `steps`): no singular pose on the way to any pose. force,
        rate and power of each leg, under `loads` and `masses` and for the `speeds` of the tool.
    objective : Objective or mapping
        What is minimized; by default the condition number at the neutral pose. A mapping is read as the table
        [objective] of a study file.
    characteristic_length : float, str or (low, high)
        l_c of eqs. (30)-(33), in the same unit: a number, 1 by default, which a UserWarning of `optimize` and `pareto`
        says where lengths have a `unit`; a kind of `ninedof.characteristic_length`, taken at the
        neutral pose; or bounds, and it is a free variable. An upper bound of a variable of a million characteristic
        lengths or more counts as none.
    starts, seed : int
        Number of low-discrepancy starts and the shift of their sequence. `optimize` goes on to at most four times as
        many while few of them agree, or while fewer than 16 were tried and none led to a design.
    unit : str, optional
        Name of the length unit, "mm", "cm", "m", "in" or "ft", shown wherever a length stands. A label: nothing is
        converted. None by default. The `unit` of poses and regions is something else, the scale of their shifts.
    about : About or mapping
        Project, author and revision: the title block of reports.
    tool : Tool or mapping
        The point of the platform, with its axes, that region, paths, loads, errors and the condition number belong to.
        The origin of the plate by default.
    loads, masses, speeds, tolerances : Loads, Masses, Speeds, Tolerances or mappings
        What the machine carries, how fast it moves and how well it is made: defaults of `sheet`, of the commands about
        one design, and of reports. Tolerances are less than a tenth of the greatest zp.
    actuators : sequence of Actuator or mappings, or path
        Legs that can be bought, or a CSV file with the columns name, shortest, longest, force, rate and price:
        `optimize` chooses rows with the design. None by default.
    actuators_for : {"kinds", "all"}
        Whether the external, the upper and the lower legs each take a row, or all nine the same.
    greatest_price : float, optional
        Of the nine actuators together.

    Raises
    ------
    ValueError
        Naming the entry that does not fit, what came and what was expected.

    Examples
    --------
    >>> import ninedof as nd
    >>> study = nd.Study(variables={"theta_z": (-1.0, 1.0)}, constraints={"radius_ratio": (None, 2.0)})
    >>> round(nd.optimize(study).condition_number, 6)
    3.749827

    """

    family: str = entry(partial(choice, known=FAMILIES), "hexagonal")
    variables: Mapping[str, Bound] = entry(table, Fixed())
    constraints: Mapping[str, Any] = entry(_constraints, Fixed())
    characteristic_length: float | str | tuple[float, float] = entry(_length, UNGIVEN)
    starts: int = entry(partial(whole, least=1, most=MOST_STARTS), 64)
    seed: int = entry(partial(whole, least=0), 0)
    objective: Objective = entry(_objective, Objective())
    unit: str = entry(_unit, "")
    """Name of the length unit; "" without one."""
    about: About = entry(duty(About), About())
    tool: Tool = entry(duty(Tool), Tool())
    loads: Loads = entry(duty(Loads), Loads())
    masses: Masses = entry(duty(Masses), Masses())
    speeds: Speeds = entry(duty(Speeds), Speeds())
    tolerances: Tolerances = entry(duty(Tolerances), Tolerances())
    actuators: tuple[Actuator, ...] = entry(bought.actuator_rows, ())
    actuators_for: str = entry(partial(choice, known=FOR), FOR[0])
    greatest_price: float | None = entry(partial(finite, least=0.0), None)
    defaulted: tuple[str, ...] = field(default=(), init=False, compare=False, repr=False)
    """Free variables that were not given and took the family's default bounds."""
    length_assumed: bool = field(default=False, init=False, compare=False, repr=False)
    """Whether the characteristic length was not given."""

    __hash__ = None  # type: ignore[assignment]  # mappings inside

    def __post_init__(self) -> None:
        """Complete the variables, normalize numbers, and validate the problem in the core."""
        assumed = self.characteristic_length is UNGIVEN
        if assumed:
            object.__setattr__(self, LENGTH, 1.0)  # not UNGIVEN: copies have it given
        if isinstance(self.actuators, str | os.PathLike):
            object.__setattr__(self, "actuators", bought.catalogue(self.actuators, _unit("unit", self.unit)))
        check_entries(self)
        bought.require_together(self.actuators, self.greatest_price, self.constraints)
        named = in_radians_by_kind("variables", self.variables, variable_kinds(self.family), bound)
        variables: dict[str, Bound] = {}
        for one in _core.family_variables(self.family):
            length = self.characteristic_length
            unit = length if isinstance(length, float) and one.kind in ("length", "coordinate") else 1.0
            name, low, high = one.name, one.low * unit, one.high * unit
            variables[name] = bound(name, named[name]) if name in named else low if low == high else (low, high)
        region = self.objective.region
        if region is not None and region.tool_height != self.tool.position[2]:
            region = copy(region)
            object.__setattr__(region, "tool_height", self.tool.position[2])
            object.__setattr__(self, "objective", replace(self.objective, region=region))
        for name, value in {
            "variables": Fixed(variables),
            "length_assumed": assumed,
            "defaulted": tuple(n for n, b in variables.items() if n not in named and isinstance(b, tuple)),
        }.items():
            object.__setattr__(self, name, value)
        self.problem()
        require_small(self.tolerances, float(np.max(variables["zp"])), self.unit)

    @classmethod
    def paper(cls) -> Study:
        """Return the study of the paper, eqs. (8)-(9), with the base at most twice the platform (section 5)."""
        return cls(family="hexagonal", constraints={"radius_ratio": (None, 2.0)})

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Study:
        """Read a study from a TOML file.

        Raises
        ------
        ValueError
            If the file cannot be read, is not TOML, or an entry does not fit; the message names the file.

        """
        data = read_toml(path)
        with within(os.fspath(path), ": "):
            if isinstance(name := data.get("actuators"), str):
                data["actuators"] = bought.beside_study(path, name, _unit("unit", data.get("unit", "")))
            return cls.from_dict(data)

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Study:
        """Make a study from the tables of a study file."""
        if isinstance(data, Mapping) and "geometry" in data:
            raise ValueError(
                "study: got a design (it has a table [geometry]), expected a study; see `ninedof evaluate`"
            )
        known_keys("study", data, ["unit", "actuators", *TABLES])
        tables = {name: table(name, data.get(name, {})) for name in TABLES}
        require_unit_at_top({name: entries for name, entries in tables.items() if name != "objective"})
        actuators = data.get("actuators", ())
        rows = (
            actuators
            if isinstance(actuators, bought.Rows)
            else items("actuators", actuators, "rows with name, shortest and longest")
        )
        if "actuators" in data and not rows:
            raise ValueError("actuators: got no rows, expected at least one actuator")
        arguments: dict[str, Any] = {"unit": data.get("unit", ""), "actuators": rows}
        for name, names in TABLES.items():
            known_keys(name, tables[name], names or tables[name])
            arguments |= tables[name] if names else {name: tables[name]}
        return cls(**arguments)

    def to_dict(self) -> dict[str, Any]:
        """Return the tables of a study file; `Study.from_dict` reads them back."""
        design: dict[str, Any] = {"family": self.family}
        if not (self.length_assumed and self.unit):  # else a study read back says so again
            design[LENGTH] = plain(self.characteristic_length)
        if self.actuators_for != FOR[0]:
            design["actuators_for"] = self.actuators_for
        if self.greatest_price is not None:
            design["greatest_price"] = self.greatest_price
        constraints: dict[str, list[dict[str, Any]]] = {}
        for limit in self.limits:
            constraints.setdefault(limit.name, []).append(limit.to_dict())
        variables = (angle_entry(n, b) if n in self.angles else (n, b) for n, b in self.variables.items())
        return {
            **unit_entry(self.unit),
            **({"actuators": [row.to_dict() for row in self.actuators]} if self.actuators else {}),
            "design": design,
            "variables": {name: plain(value) for name, value in variables},
            "constraints": {name: one if len(one) > 1 else one[0] for name, one in constraints.items()},
            "objective": self.objective.to_dict(),
            "solver": {"starts": self.starts, "seed": self.seed},
            **{name: entries for name in DUTIES if (entries := getattr(self, name).to_dict())},
        }

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the study as a TOML file."""
        write_toml(path, self.to_dict())

    def with_solver(self, starts: int | None = None, seed: int | None = None) -> Study:
        """Return the same study with another number of starts or another seed."""
        return self._with(starts=self.starts if starts is None else starts, seed=self.seed if seed is None else seed)

    @property
    def catalogue(self) -> str:
        """Name of the file that the actuators are from, as it was given; "" where there is none."""
        return self.actuators.file if isinstance(self.actuators, bought.Rows) else ""

    def with_actuators(self, rows: Mapping[str, Actuator]) -> Study:
        """Return the study of legs that have these rows, by "external", "upper" and "lower": with their limits."""
        limits = dict(self.constraints)
        for kind, row in table("rows", rows).items():
            limits |= bought.row_limits(choice("rows", kind, LEG_KINDS), instance("rows", row, Actuator), self.stated)
        return self._with(constraints=limits, actuators=(), actuators_for=FOR[0], greatest_price=None)

    def require_no_choice(self) -> None:
        """Raise ValueError for a study with actuators, to one who does not choose rows."""
        if self.actuators:
            raise ValueError("study: got one with actuators, expected the run of `optimize`, which has chosen them")

    def _with(self, **changes: Any) -> Study:
        new = replace(self, **changes)
        for name in ("defaulted", "length_assumed"):
            object.__setattr__(new, name, getattr(self, name))
        return new

    @cached_property
    def stated(self) -> dict[str, bool]:
        """Whether it states "loads" and "speeds", without which forces and rates of legs are not looked at."""
        m, speeds = self.masses, self.speeds
        weighs = any((m.platform, m.cylinder, m.rod, m.internal_point))
        return {"loads": bool(self.loads.wrenches) or weighs, "speeds": bool(speeds.linear or speeds.angular)}

    @property
    def length_note(self) -> str:
        """The sentence to print first where lengths have a unit and the characteristic length was left out; else ""."""
        if not (self.unit and self.length_assumed):
            return ""
        return (
            f"characteristic_length is not given: 1 {self.unit} assumed. A turn of 1 rad then counts as much as a "
            f"shift of 1 {self.unit}, and the condition number depends on it: give the length that a turn of "
            f'1 rad shall count as, in {self.unit}, or a word such as "optimal"'
        )

    @property
    def force_unit(self) -> str:
        """The unit of forces: "N" where masses are stated and lengths have a unit, else ""."""
        return unit_of_forces(self.unit, self.masses)

    @property
    def free_variables(self) -> tuple[str, ...]:
        """The variables that have a range."""
        return tuple(name for name, ends in self.variables.items() if isinstance(ends, tuple))

    @property
    def has_free_variables(self) -> bool:
        """Whether a variable has a range, a length is sought, or O is placed at some pose."""
        region, poses = self.objective.region, self.objective.poses
        placed = [pose.internal_point for pose in poses] + ([region.internal_point] if region else [])
        length = isinstance(self.characteristic_length, tuple)
        return length or "best" in placed or bool(self.free_variables)

    @property
    def gravity_note(self) -> str:
        """The sentence to print first where masses are no kilograms, by gravity, or it is in another unit; else ""."""
        size = math.hypot(*self.loads.gravity)
        if not (self.unit and self.masses) or size == 0.0 or 1.5 <= size <= 30.0:
            return ""
        return (
            f"gravity is {size:g}: with a unit of lengths masses are kilograms, forces newtons and gravity is in m/s², "
            "9.81 on earth, whatever the unit. Give pounds as kilograms: 1 lb is 0.45359237 kg, 1 lbf is 4.4482216 N"
        )

    @property
    def notes(self) -> list[str]:
        """The sentences to print first, of what was left out and of units that do not go together."""
        return [note for note in (self.length_note, self.gravity_note) if note]

    @property
    def angles(self) -> tuple[str, ...]:
        """Names of the variables that are angles, in radians; in files and on screens in degrees."""
        return tuple(name for name, kind in variable_kinds(self.family).items() if kind == "angle")

    def unit_of(self, variable: str) -> str:
        """Return the unit in which a variable is shown: "deg" for an angle, else that of lengths."""
        return "deg" if text("variable", variable) in self.angles else self.unit

    def shown(self, variable: str, value: float) -> float:
        """Return the value of a variable in the unit in which it is shown: angles in degrees."""
        value = number("value", value)
        return degrees_of(value) if text("variable", variable) in self.angles else value

    @cached_property
    def limits(self) -> tuple[Limit, ...]:
        """The constraints, one after the other; those stated twice have two."""
        return tuple(limit for name, value in self.constraints.items() for limit in parse(name, value))

    @property
    def words(self) -> str:
        """The objective in words, with the unit of lengths."""
        return self.objective.worded(self.unit)

    def _repr_html_(self) -> str:
        limits = [limits_table(self)] if self.limits else []
        return notebook(f"Study: least {self.words}", variables_table(self), *limits)

    def problem(self, over_region: bool = False) -> _core.Problem:
        """Return the study as the core's problem, validated there; of a region, without it, or to be solved over it."""
        if flag("over_region", over_region) not in self._problems:
            require_stated(self.limits, self.stated)
            self._problems[over_region] = _core.Problem(
                self.family,
                [b if isinstance(b, tuple) else (b, b) for b in self.variables.values()],
                [self.limit_for_core(limit) for limit in self.limits],
                self.characteristic_length,
                self.objective.for_core(over_region),
                self.tool.position,
                self.tool.rotation,
            )
        return self._problems[over_region]

    def limit_for_core(self, limit: Limit) -> _core.Limit:
        """Return a limit of the study as the core takes it: in the tool's frame, and with loads and speeds."""
        needs = instance("limit", limit, Limit).row.needs
        return limit.for_core(self.tool, self.leg_duty.for_core() if needs else None)

    @cached_property
    def leg_duty(self) -> LegDuty:
        """Loads, masses, speeds and motion of O, for limits of the forces, rates and powers of legs."""
        masses = self.masses.seen_from(self.tool) if self.tool else self.masses
        return LegDuty(self.loads, masses, self.speeds, internal_motion(self.objective))

    @cached_property
    def _problems(self) -> dict[bool, _core.Problem]:
        return {}

    def zp(self, neutral: Configuration) -> float:
        """Return the height zp of the plate of a design whose neutral configuration, that of the tool, is given."""
        return float(instance("neutral", neutral, Configuration).position[2]) - self.tool.position[2]

    def leg_limits(self, neutral: Configuration, ranges: ArrayLike | None = None) -> tuple[Floats, Floats]:
        """Return the least and greatest length of each leg of a design, shapes (9,); 0 and infinity where it has none.

        The neutral configuration is a single one; `ranges`, shape (9, 2), are those in which something else keeps each
        leg.
        """
        ends = as_floats("ranges", [(0.0, math.inf)] * 9 if ranges is None else ranges, (9, 2))
        if ends.ndim > 2:
            raise ValueError(f"ranges: got shape {ends.shape}, expected shape (9, 2)")
        low, high = ends.T.copy()
        for limit in self.limits:
            if limit.name in OF_LENGTHS and limit.at == "poses":
                unit, legs = self.zp(neutral) if limit.of == "zp" else 1.0, OF_LENGTHS[limit.name]
                low[legs] = np.maximum(low[legs], unit * limit.low)
                high[legs] = np.minimum(high[legs], unit * limit.high)
        return low, high

    def evaluate(self, variables: Mapping[str, float]) -> DesignPoint:
        """Return objective, condition numbers, margins and exact gradients of one design.

        Parameters
        ----------
        variables : mapping
            Name to value, as `vector` takes them; bounds are not enforced.

        """
        return replace(design_point(self.problem(), self.vector(variables)), study=self)

    def vector(self, variables: Mapping[str, float]) -> list[float]:
        """Return named values in the order of the problem.

        Angles are in radians, or in degrees with _deg behind the name. Fixed variables may be left out. So may a free
        characteristic length, which is then the one that is best at the neutral pose, and free offsets of O, which are
        then zero.
        """
        names = self.problem().names
        kinds = dict.fromkeys(names, "") | variable_kinds(self.family)
        values = {
            name: finite(name, x) for name, x in in_radians_by_kind("variables", variables, kinds, finite).items()
        }
        for name in self.free_variables:
            if name not in values:
                raise ValueError(f"{name}: got no value, expected a number (the variable is free in this study)")
        # The robot does not depend on the length, until it is known.
        every: dict[str, Any] = {**dict.fromkeys(names, 0.0), **self.variables, LENGTH: 1.0, **values}
        x = [every[name] for name in names]
        if LENGTH in names and LENGTH not in values:
            x[names.index(LENGTH)] = self._best_length(x)
        return x

    def _best_length(self, x: list[float]) -> float:
        """Return the characteristic length that is best at the neutral pose, within the bounds."""
        point = design_point(self.problem(), x)
        best = float(length_of(point.geometry, point.configuration, "optimal"))
        low, high = self.characteristic_length if isinstance(self.characteristic_length, tuple) else (0.0, math.inf)
        return min(max(best if math.isfinite(best) else 1.0, low), high)

    def __getstate__(self) -> dict[str, Any]:
        """Leave out the problems of the core, which are made again."""
        return {name: value for name, value in vars(self).items() if name != "_problems"}
