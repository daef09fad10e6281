"""A robot and where it stands, from a TOML file, a run's record or named values: what `ninedof evaluate` looks at."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ninedof.conditioning.characteristic_length import characteristic_length
from ninedof.conditioning.conditioning import condition_number, isotropy_residual, manipulability, singular_values
from ninedof.design.study_file import read_toml
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.runs.records import load_record

__all__ = ["Design", "indices", "load_design"]


class Design(NamedTuple):
    """A geometry, a configuration and the characteristic length to judge them by."""

    geometry: Geometry
    configuration: Configuration
    characteristic_length: float | str


HEXAGON = ("a1", "a2", "b1", "b2")
TRIPLES = ("base_external", "base_internal", "platform_external", "platform_internal")


def hexagonal_design(values: Mapping[str, float], length: float | str = 1.0) -> Design:
    """Return the design of hexagonal variables; theta_z, in radians, is 0 unless given."""
    geometry = Geometry.hexagonal(**{name: values[name] for name in HEXAGON})
    return Design(geometry, Configuration.neutral(values["zp"], values["zs"], values.get("theta_z", 0.0)), length)


def load_design(path: str | os.PathLike[str]) -> Design:
    """Read a design.

    A TOML file has `characteristic_length` (a number or a kind, 1.0 by default) and two tables: [geometry] with a1 a2
    b1 b2, or with four lists of three joints base_external, base_internal, platform_external, platform_internal;
    [configuration] with zp, zs and theta_z (radians), or with position, internal_point and, optionally, rotation
    (three rows). A run folder or its record.json gives the best design of that run.

    Raises
    ------
    ValueError
        Naming the file and the entry.

    """
    file = Path(path)
    try:
        if file.is_dir() or file.suffix == ".json":
            return _from_record(file)
        return _from_tables(read_toml(file))
    except ValueError as error:
        text = str(error)
        raise ValueError(text if text.startswith(str(file)) else f"{file}: {text}") from None


def _from_record(file: Path) -> Design:
    record = load_record(file)
    try:
        candidates = record.results["optimization"]["candidates"]
        variables = candidates[0]["variables"] if candidates else None
    except (KeyError, TypeError, IndexError):
        raise ValueError("the record holds no optimization") from None
    if variables is None:
        raise ValueError("the record holds no design: the run found none")
    point = record.study.evaluate(variables)
    return Design(point.geometry, point.configuration, point.characteristic_length)


def _from_tables(data: Mapping[str, Any]) -> Design:
    if "design" in data or "variables" in data:
        raise ValueError(
            "design: got a study, expected a design with [geometry] and [configuration]; see `ninedof optimize`"
        )
    _only("design", data, ("geometry", "configuration", "characteristic_length"))
    geometry, configuration = (_table(data, name) for name in ("geometry", "configuration"))
    if "zp" in configuration or "zs" in configuration:
        _only("configuration", configuration, ("zp", "zs", "theta_z"))
        _all("configuration", configuration, ("zp", "zs"))
        c = Configuration.neutral(configuration["zp"], configuration["zs"], configuration.get("theta_z", 0.0))
        if c.shape:
            raise ValueError("configuration: got lists, expected one number for each of zp, zs and theta_z")
    else:
        _only("configuration", configuration, ("position", "rotation", "internal_point"))
        _all("configuration", configuration, ("position", "internal_point"))
        c = Configuration(**configuration)
    names = HEXAGON if any(name in geometry for name in HEXAGON) else TRIPLES
    _only("geometry", geometry, names)
    _all("geometry", geometry, names)
    if names is HEXAGON:
        for name in HEXAGON:
            if isinstance(geometry[name], bool) or not isinstance(geometry[name], int | float):
                raise ValueError(f"geometry.{name}: got {geometry[name]!r}, expected a number")
        g = Geometry.hexagonal(**geometry)
    else:
        g = Geometry(**geometry)
    length = data.get("characteristic_length", 1.0)
    if isinstance(length, bool) or not isinstance(length, int | float | str):
        raise ValueError(f"characteristic_length: got {length!r}, expected a number or a kind")
    return Design(g, c, length)


def _table(data: Mapping[str, Any], name: str) -> Mapping[str, Any]:
    table = data.get(name)
    if not isinstance(table, Mapping):
        raise ValueError(f"{name}: got {'nothing' if table is None else repr(table)}, expected a table [{name}]")
    return table


def _only(where: str, table: Mapping[str, Any], names: tuple[str, ...]) -> None:
    for key in table:
        if key not in names:
            raise ValueError(f"{where}: got the entry {key!r}, expected only {', '.join(names)}")


def _all(where: str, table: Mapping[str, Any], names: tuple[str, ...]) -> None:
    for name in names:
        if name not in table:
            raise ValueError(f"{where}.{name}: got nothing, expected a value")


def indices(design: Design) -> dict[str, Any]:
    """Return every index of a design as plain values, and the condition number under each kind of length."""
    g, c, length = design
    lc = characteristic_length(g, c, length) if isinstance(length, str) else float(length)
    if isinstance(length, str) and not math.isfinite(lc):
        kappa: dict[str, float] = {"condition_number": math.inf}
    else:
        kappa = {
            "condition_number": float(condition_number(g, c, lc)),
            "condition_number_frobenius": float(condition_number(g, c, lc, norm="frobenius")),
            "manipulability": float(manipulability(g, c, lc)),
            "isotropy_residual": float(isotropy_residual(g, c, lc)),
        }
    kinds = {}
    for kind in ("optimal", "natural", "mean_leg", "platform_radius"):
        value = float(characteristic_length(g, c, kind))
        kinds[kind] = {
            "length": value,
            "condition_number": float(condition_number(g, c, value)) if math.isfinite(value) else math.inf,
        }
    lengths = leg_lengths(g, c).tolist()
    return {
        "characteristic_length": lc,
        **kappa,
        "reciprocal": 0.0 if math.isinf(kappa["condition_number"]) else 1.0 / kappa["condition_number"],
        "singular_values": singular_values(g, c, lc).tolist() if math.isfinite(lc) else [math.inf] * 6,
        "leg_lengths": {"l": lengths[:3], "q": lengths[3:6], "r": lengths[6:]},
        "leg_ratio": max(lengths) / min(lengths) if min(lengths) > 0.0 else math.inf,
        "characteristic_lengths": kinds,
        "singular": bool(np.isinf(kappa["condition_number"])),
    }
