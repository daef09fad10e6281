"""A design study: which family, which variables are free, what is allowed. Files are TOML."""

from __future__ import annotations

import difflib
import math
import os
import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from ninedof import _core
from ninedof.arrays import Floats
from ninedof.configuration import Configuration
from ninedof.geometry import Geometry

__all__ = ["DesignPoint", "Study"]

LARGEST = 500.0  # of a logarithm of a condition number; beyond, a singular value has vanished

Bound = float | tuple[float, float]
"""A fixed value, or (low, high)."""


@dataclass(frozen=True, eq=False)
class DesignPoint:
    """One design of a study, with exact gradients."""

    variables: dict[str, float]
    """Every variable of the family."""
    condition_number: float
    """Of J' at the neutral configuration; infinite where it is singular."""
    gradient: dict[str, float]
    """d(condition number)/d(variable); NaN where singular. Where singular values tie, that of one of them."""
    margins: dict[str, float]
    """Smallest margin of each constraint: the logarithm of the ratio left, negative where violated."""
    margin_gradients: dict[str, dict[str, float]]
    """d(margin)/d(variable) of that margin."""
    geometry: Geometry
    configuration: Configuration


@dataclass(frozen=True)
class Study:
    """A design problem: least condition number over the free variables of a family, within limits.

    Parameters
    ----------
    family : str
        "hexagonal": the plates of eqs. (37)-(38), variables a1 a2 b1 b2 zp zs theta_z.
    variables : mapping
        Name to (low, high) for a free variable (either may be infinite) or to a number for a fixed one. Those left out
        take the family's defaults: sides in [0, 60], heights in [0.05, 80] characteristic lengths, theta_z = 0.
        Lengths in one unit of your choice, angles in radians.
    constraints : mapping
        Name to (low, high), None for an open side. "radius_ratio": base / platform circumradius; "leg_ratio": longest /
        shortest leg; "zs_fraction": zs / zp. 0 < zs < zp (eq. 9b) always holds.
    characteristic_length : float
        l_c of eqs. (30)-(33), in the same unit. A number: the kinds of `ninedof.characteristic_length` are not for
        studies yet. An upper bound of a million characteristic lengths or more counts as none.
    starts, seed : int
        Number of low-discrepancy starts and the shift of their sequence.

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
    constraints: Mapping[str, tuple[float | None, float | None]] = field(default_factory=dict)
    characteristic_length: float = 1.0
    starts: int = 64
    seed: int = 0
    defaulted: tuple[str, ...] = field(default=(), init=False, compare=False, repr=False)
    """Free variables that were not given and took the family's default bounds."""

    __hash__ = None  # type: ignore[assignment]  # mappings inside

    def __post_init__(self) -> None:
        """Complete the variables, normalise numbers, and let the core check the whole."""
        if not isinstance(self.family, str):
            raise ValueError(f"family: got {self.family!r}, expected one of {_core.design_family_names()}")
        known = _core.family_variables(self.family)
        if isinstance(self.characteristic_length, str):
            raise ValueError(
                f"characteristic_length: got {self.characteristic_length!r}, expected a number: in a study the kinds "
                "are not available yet"
            )
        length = _number("characteristic_length", self.characteristic_length)
        _known_keys("variables", self.variables, [name for name, *_ in known])
        _known_keys("constraints", self.constraints, _core.constraint_names())
        variables: dict[str, Bound] = {}
        for name, is_angle, low, high in known:
            unit = 1.0 if is_angle else length
            default: Bound = low if low == high else (low * unit, high * unit)
            variables[name] = _bound(name, self.variables.get(name, default))
        constraints = {name: _limit(name, value) for name, value in self.constraints.items()}
        for name, value in {
            "variables": variables,
            "constraints": constraints,
            "characteristic_length": length,
            "starts": _whole("starts", self.starts, 1, 2**31 - 1),
            "defaulted": tuple(n for n, b in variables.items() if n not in self.variables and isinstance(b, tuple)),
            "seed": _whole("seed", self.seed, 0, 2**63 - 1),
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
        try:
            text = Path(path).read_text(encoding="utf-8")
            return cls.from_dict(tomllib.loads(text))
        except (OSError, UnicodeDecodeError) as error:
            reason = error.strerror if isinstance(error, OSError) else "not UTF-8 text"
            raise ValueError(f"{os.fspath(path)}: cannot be read ({reason})") from None
        except tomllib.TOMLDecodeError as error:
            raise ValueError(f"{os.fspath(path)}: not a TOML file: {error}") from None
        except RecursionError:
            raise ValueError(f"{os.fspath(path)}: not a TOML file we can read: nested too deep") from None
        except ValueError as error:
            raise ValueError(f"{os.fspath(path)}: {error}") from None

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Study:
        """Make a study from the tables of a study file."""
        if isinstance(data, Mapping) and "geometry" in data:
            raise ValueError(
                "study: got a design (it has a table [geometry]), expected a study; see `ninedof evaluate`"
            )
        _known_keys("study", data, ["design", "variables", "constraints", "objective", "solver"])
        tables = {name: _table(name, data.get(name, {})) for name in ("design", "objective", "solver", "variables")}
        _known_keys("design", tables["design"], ["family", "characteristic_length"])
        _known_keys("objective", tables["objective"], ["index"])
        _known_keys("solver", tables["solver"], ["starts", "seed"])
        index = tables["objective"].get("index", "condition_number")
        if index != "condition_number":
            raise ValueError(f'objective.index: got {index!r}, expected "condition_number"')
        constraints = {}
        for name, limit in _table("constraints", data.get("constraints", {})).items():
            _known_keys(f"constraints.{name}", _table(f"constraints.{name}", limit), ["min", "max"])
            constraints[name] = (limit.get("min"), limit.get("max"))
        return cls(variables=tables["variables"], constraints=constraints, **tables["design"], **tables["solver"])

    def with_solver(self, starts: int | None = None, seed: int | None = None) -> Study:
        """Return the same study with another number of starts or another seed."""
        return replace(self, starts=self.starts if starts is None else starts, seed=self.seed if seed is None else seed)

    def to_dict(self) -> dict[str, Any]:
        """Return the tables of a study file; `Study.from_dict` reads them back."""
        return {
            "design": {"family": self.family, "characteristic_length": self.characteristic_length},
            "variables": {name: list(b) if isinstance(b, tuple) else b for name, b in self.variables.items()},
            "constraints": {
                name: {key: v for key, v in zip(("min", "max"), limit, strict=True) if v is not None}
                for name, limit in self.constraints.items()
            },
            "objective": {"index": "condition_number"},
            "solver": {"starts": self.starts, "seed": self.seed},
        }

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the study as a TOML file."""
        import tomli_w

        Path(path).write_text(tomli_w.dumps(self.to_dict()), encoding="utf-8")

    def problem(self) -> _core.Problem:
        """Return the study as the core takes it, checked there once more."""
        bounds = [b if isinstance(b, tuple) else (b, b) for b in self.variables.values()]
        limits = [
            (name, 0.0 if low is None else low, math.inf if high is None else high)
            for name, (low, high) in self.constraints.items()
        ]
        return _core.Problem(self.family, bounds, limits, self.characteristic_length)

    def evaluate(self, variables: Mapping[str, float]) -> DesignPoint:
        """Return condition number, margins and exact gradients of one design.

        Parameters
        ----------
        variables : mapping
            Name to value. Fixed variables may be left out; bounds are not enforced.

        """
        x = self.vector(variables)
        problem = self.problem()
        names = list(self.variables)
        values = dict(zip(names, x, strict=True))
        core = problem.evaluate(x)
        regular = core["log_condition_number"] < LARGEST
        kappa = math.exp(core["log_condition_number"]) if regular else math.inf
        slope = kappa * core["gradient"] if regular else np.full(len(names), np.nan)
        margins: dict[str, tuple[float, Floats]] = {}
        for name, value, margin_slope in core["margins"]:
            if name not in margins or value < margins[name][0]:
                margins[name] = (value, margin_slope)
        return DesignPoint(
            variables=values,
            condition_number=kappa,
            gradient=dict(zip(names, slope.tolist(), strict=True)),
            margins={name: value for name, (value, _) in margins.items()},
            margin_gradients={n: dict(zip(names, s.tolist(), strict=True)) for n, (_, s) in margins.items()},
            geometry=problem.geometry(x),
            configuration=Configuration(*problem.configuration(x)),
        )

    def vector(self, variables: Mapping[str, float]) -> list[float]:
        """Return named values in the family's order, fixed variables filled in."""
        _known_keys("variables", variables, list(self.variables))
        out = []
        for name, bound in self.variables.items():
            if name in variables:
                out.append(_finite(name, variables[name]))
            elif isinstance(bound, tuple):
                raise ValueError(f"{name}: got no value, expected a number (the variable is free in this study)")
            else:
                out.append(bound)
        return out


def _known_keys(where: str, given: Mapping[str, Any], known: Iterable[str]) -> None:
    known = list(known)
    if not isinstance(given, Mapping):
        raise ValueError(f"{where}: got {given!r}, expected a mapping of names")
    for key in given:
        if key not in known:
            close = difflib.get_close_matches(str(key).lower(), known, n=1, cutoff=0.5)
            hint = f" (did you mean {close[0]!r}?)" if close else ""
            raise ValueError(f"{where}: got the entry {key!r}, expected only {', '.join(known)}{hint}")


def _table(name: str, value: Any) -> Mapping[str, Any]:
    if not isinstance(value, Mapping):
        raise ValueError(f"{name}: got {value!r}, expected a table")
    return value


def _number(name: str, value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float | np.integer | np.floating):
        raise ValueError(f"{name}: got {value!r}, expected a number")
    try:
        return float(value)
    except OverflowError:
        raise ValueError(f"{name}: got {str(value)[:20]}..., expected a number of ordinary size") from None


def _finite(name: str, value: Any) -> float:
    number = _number(name, value)
    if not math.isfinite(number):
        raise ValueError(f"{name}: got {value!r}, expected a finite number")
    return number


def _whole(name: str, value: Any, least: int, most: int) -> int:
    if isinstance(value, bool) or not isinstance(value, int | np.integer) or not least <= value <= most:
        raise ValueError(f"{name}: got {value!r}, expected a whole number from {least} to {most}")
    return int(value)


def _pair(name: str, value: Any, expected: str) -> tuple[Any, Any]:
    if not isinstance(value, list | tuple | np.ndarray) or np.ndim(value) != 1 or len(value) != 2:
        raise ValueError(f"{name}: got {value!r}, expected {expected}")
    low, high = value
    return low, high


def _bound(name: str, value: Any) -> Bound:
    if isinstance(value, int | float | np.integer | np.floating) and not isinstance(value, bool):
        return _finite(name, value)
    low, high = _pair(name, value, "a number, or (low, high)")
    return _number(name, low), _number(name, high)


def _limit(name: str, value: Any) -> tuple[float | None, float | None]:
    low, high = _pair(name, value, "(low, high), None for an open side")
    return None if low is None else _number(name, low), None if high is None else _number(name, high)
