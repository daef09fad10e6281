"""A design study: family, free variables, constraints and objective."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any

from ninedof import _core
from ninedof.conditioning.characteristic_length import characteristic_length as length_of
from ninedof.conditioning.characteristic_length import length_argument
from ninedof.design import limits
from ninedof.design.design_point import DesignPoint, design_point
from ninedof.design.objective import Objective
from ninedof.design.study_file import read_toml, study_arguments, study_tables, write_toml
from ninedof.robot.configuration import Configuration
from ninedof.support.angles import DEG, degrees_of, in_radians
from ninedof.support.arguments import choice, finite, is_number, known_keys, number, pair, shown, text, whole
from ninedof.support.short import short_repr
from ninedof.support.units import unit_argument

Bound = float | tuple[float, float]
"""A fixed value, or (low, high)."""

LENGTH = "characteristic_length"
UNGIVEN = float("1.0")  # an object of its own: told from a 1.0 that was given
MOST_STARTS = 1_000_000  # each may be searched four times, and all ends are kept


@short_repr
@dataclass(frozen=True)
class Study:
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
        {"leg_ratio": (None, 3.0), "base_cone": {"max_deg": 45, "axis": [0, 0, 1]}}. 0 < zs < zp (eq. 9b) always holds.
        A limit holds at every pose of the objective, or with "at": "neutral" at the neutral pose alone, where it is
        named "leg_ratio at neutral". A list of two such mappings states both. Limits that compare poses take no
        "neutral": strokes, and cones about the legs' own neutral directions.

        ratios: radius_ratio (base / platform, largest joint distance from the axis), leg_ratio (longest / shortest leg
        over all poses), stroke_ratio (longest / shortest of one leg over the poses), zs_fraction (zs / zp).
        lengths: stroke, leg_length, external_length, upper_length, lower_length and leg_clearance (`of` "length" or
        "zp"), joint_height and joint_spacing (`of` "length" or "radius"), height, footprint. leg_clearance takes the
        `radius` of a leg in place of min. angles: base_cone and platform_cone (`axis` of the cone, by default the
        leg's own neutral direction). singularity_free (min, `steps`): no singular pose on the way to any pose.
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
        many while few of them agree.
    unit : str, optional
        Name of the length unit, "mm", "cm", "m", "in" or "ft", shown wherever a length stands. A label: nothing is
        converted. None by default. The `unit` of poses and regions is something else, the scale of their shifts.

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

    family: str = "hexagonal"
    variables: Mapping[str, Bound] = field(default_factory=dict)
    constraints: Mapping[str, limits.Limits] = field(default_factory=dict)
    characteristic_length: float | str | tuple[float, float] = UNGIVEN
    starts: int = 64
    seed: int = 0
    objective: Objective = field(default_factory=Objective)
    unit: str = ""
    """Name of the length unit; "" without one."""
    defaulted: tuple[str, ...] = field(default=(), init=False, compare=False, repr=False)
    """Free variables that were not given and took the family's default bounds."""
    length_assumed: bool = field(default=False, init=False, compare=False, repr=False)
    """Whether the characteristic length was not given."""

    __hash__ = None  # type: ignore[assignment]  # mappings inside

    def __post_init__(self) -> None:
        """Complete the variables, normalize numbers, and validate the problem in the core."""
        family = choice("family", self.family, _core.design_family_names())
        known = _core.family_variables(family)
        assumed = self.characteristic_length is UNGIVEN
        length = 1.0 if assumed else _length(self.characteristic_length)  # not UNGIVEN again: copies have it given
        given = self._known("variables", self.variables, [name for name, *_ in known])
        known_keys("constraints", self.constraints, limits.CONSTRAINTS)
        variables: dict[str, Bound] = {}
        for name, kind, low, high in known:
            unit = length if isinstance(length, float) and kind in ("length", "coordinate") else 1.0
            default: Bound = low * unit if low == high else (low * unit, high * unit)
            variables[name] = _bound(name, given.get(name, default))
        objective = self.objective
        for name, value in {
            "variables": MappingProxyType(variables),
            "constraints": MappingProxyType({n: limits.parse(n, value) for n, value in self.constraints.items()}),
            "characteristic_length": length,
            "objective": objective if isinstance(objective, Objective) else Objective.from_dict(objective),
            "starts": whole("starts", self.starts, 1, MOST_STARTS),
            "seed": whole("seed", self.seed, 0),
            "unit": unit_argument(self.unit),
            "length_assumed": assumed,
            "defaulted": tuple(n for n, b in variables.items() if n not in given and isinstance(b, tuple)),
        }.items():
            object.__setattr__(self, name, value)
        self.problem()

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
        try:
            return cls.from_dict(data)
        except ValueError as error:
            raise ValueError(f"{os.fspath(path)}: {error}") from None

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Study:
        """Make a study from the tables of a study file."""
        return cls(**study_arguments(data))

    def to_dict(self) -> dict[str, Any]:
        """Return the tables of a study file; `Study.from_dict` reads them back."""
        return study_tables(vars(self))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the study as a TOML file."""
        write_toml(path, self.to_dict())

    def with_solver(self, starts: int | None = None, seed: int | None = None) -> Study:
        """Return the same study with another number of starts or another seed."""
        new = replace(self, starts=self.starts if starts is None else starts, seed=self.seed if seed is None else seed)
        for name in ("defaulted", "length_assumed"):
            object.__setattr__(new, name, getattr(self, name))
        return new

    @property
    def length_note(self) -> str:
        """What to say first where lengths have a unit and the characteristic length was not given; else ""."""
        if not (self.unit and self.length_assumed):
            return ""
        return (
            f"characteristic_length is not given: 1 {self.unit} assumed. A turn of 1 rad then counts as much as a "
            f"shift of 1 {self.unit}, and the condition number depends on it: give the reach of the tool in "
            f'{self.unit}, or a word such as "optimal"'
        )

    @property
    def angles(self) -> tuple[str, ...]:
        """Names of the variables that are angles, in radians; in files and on screens in degrees."""
        return tuple(name for name, kind, *_ in _core.family_variables(self.family) if kind == "angle")

    def unit_of(self, variable: str) -> str:
        """Return the unit in which a variable is shown: "deg" for an angle, else that of lengths."""
        return "deg" if text("variable", variable) in self.angles else self.unit

    def shown(self, variable: str, value: float) -> float:
        """Return the value of a variable in the unit in which it is shown: angles in degrees."""
        value = number("value", value)
        return degrees_of(value) if text("variable", variable) in self.angles else value

    @property
    def words(self) -> str:
        """The objective in words, with the unit of lengths."""
        return self.objective.worded(self.unit)

    def _known(self, where: str, given: Any, names: list[str]) -> dict[str, Any]:
        """Return named values with angles in radians; raise for unknown names."""
        known_keys(where, given, [*names, *(name + DEG for name in self.angles)])
        return in_radians(where, given, self.angles)

    def problem(self, over_region: bool = False) -> _core.Problem:
        """Return the study as the core's problem, validated there; of a region, without it, or to be solved over it."""
        bounds = [b if isinstance(b, tuple) else (b, b) for b in self.variables.values()]
        constraints = [limits.for_core(name, limit) for name, limit in limits.each(self.constraints)]
        objective = self.objective.for_core(over_region)
        return _core.Problem(self.family, bounds, constraints, self.characteristic_length, objective)

    def evaluate(self, variables: Mapping[str, float]) -> DesignPoint:
        """Return objective, condition numbers, margins and exact gradients of one design.

        Parameters
        ----------
        variables : mapping
            Name to value, as `vector` takes them; bounds are not enforced.

        """
        return design_point(self.problem(), self.vector(variables))

    def vector(self, variables: Mapping[str, float]) -> list[float]:
        """Return named values in the order of the problem.

        Angles are in radians, or in degrees with _deg behind the name. Fixed variables may be left out. So may a free
        characteristic length, which is then the one that is best at the neutral pose, and free offsets of O, which are
        then zero.
        """
        problem = self.problem()
        names = list(problem.names)
        given = self._known("variables", variables, names)
        out = []
        for name in names:
            bound = self.variables.get(name, 0.0)
            if name in given:
                out.append(finite(name, given[name]))
            elif isinstance(bound, tuple):
                raise ValueError(f"{name}: got no value, expected a number (the variable is free in this study)")
            else:
                out.append(bound)
        if LENGTH in names and LENGTH not in given:
            out[names.index(LENGTH)] = 1.0  # any value: the robot does not depend on it
            out[names.index(LENGTH)] = self._best_length(problem, out)
        return out

    def _best_length(self, problem: _core.Problem, x: list[float]) -> float:
        """Return the characteristic length that is best at the neutral pose, within the bounds."""
        best = float(length_of(problem.geometry(x), Configuration(*problem.configurations(x))[0], "optimal"))
        low, high = self.characteristic_length if isinstance(self.characteristic_length, tuple) else (0.0, math.inf)
        return min(max(best if math.isfinite(best) else 1.0, low), high)

    def __getstate__(self) -> dict[str, Any]:
        """Return plain dictionaries: read-only views cannot be pickled or copied."""
        constraints = {n: _converted(v, Mapping, dict) for n, v in self.constraints.items()}
        return self.__dict__ | {"variables": dict(self.variables), "constraints": constraints}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Make the dictionaries read-only again."""
        constraints = {n: _converted(v, dict, MappingProxyType) for n, v in state["constraints"].items()}
        views = {"variables": MappingProxyType(state["variables"]), "constraints": MappingProxyType(constraints)}
        self.__dict__.update(state | views)


def _converted(limits: Any, kind: type, to: Callable[[Any], Any]) -> Any:
    """Return limits with every mapping of a kind converted, those of a sequence too."""
    if isinstance(limits, tuple):
        return tuple(_converted(limit, kind, to) for limit in limits)
    return to(limits) if isinstance(limits, kind) else limits


def _bound(name: str, value: Any) -> Bound:
    if is_number(value):
        return finite(name, value)
    low, high = pair(name, value, "a number, or (low, high)")
    return number(name, low), number(name, high)


def _length(value: Any) -> float | str | tuple[float, float]:
    if isinstance(value, str) or is_number(value):
        return length_argument(value)
    low, high = (finite(LENGTH, x) for x in pair(LENGTH, value, "a number, a kind, or (low, high)"))
    if not 0.0 < low <= high:
        raise ValueError(f"{LENGTH}: got {shown(value)}, expected 0 < low <= high")
    return low if low == high else (low, high)
