"""Study files: TOML tables to the arguments of a `Study`, and back."""

from __future__ import annotations

import os
import tomllib
from collections.abc import Iterator, Mapping
from typing import Any

from ninedof import _core
from ninedof.design import limits
from ninedof.design.objective import Objective
from ninedof.support.angles import angle_entry
from ninedof.support.arguments import known_keys, path_argument, shown, shown_key, table
from ninedof.support.files import write_whole
from ninedof.support.reading import DEEPEST, TOML, deep_key, read_text
from ninedof.support.units import AT_TOP, unit_entry


def read_toml(path: str | os.PathLike[str]) -> dict[str, Any]:
    """Read a TOML file, with or without a byte order mark.

    Raises
    ------
    ValueError
        Naming the file, if it cannot be read or is not TOML.

    """
    name = str(path_argument("path", path))
    try:
        text = read_text(path, TOML)
        if key := deep_key(text):
            raise ValueError(f"got the key {shown(key)}, expected at most {DEEPEST} parts")
        return tomllib.loads(text)
    except OSError as error:
        raise ValueError(f"{name}: cannot be read ({error.strerror})") from None
    except UnicodeDecodeError:
        raise ValueError(f"{name}: cannot be read (not UTF-8 text)") from None
    except RecursionError:
        raise ValueError(f"{name}: not a TOML file we can read: nested too deep") from None
    except ValueError as error:  # invalid TOML, or an integer of thousands of digits
        raise ValueError(f"{name}: not a TOML file: {error}") from None


def write_toml(path: str | os.PathLike[str], tables: Mapping[str, Any]) -> None:
    """Write tables as a TOML file."""
    import tomli_w

    write_whole(path_argument("path", path), tomli_w.dumps(tables).encode())


def study_arguments(data: Mapping[str, Any]) -> dict[str, Any]:
    """Return the arguments of `Study` for the tables of a study file."""
    if isinstance(data, Mapping) and "geometry" in data:
        raise ValueError("study: got a design (it has a table [geometry]), expected a study; see `ninedof evaluate`")
    names = ["design", "variables", "constraints", "objective", "solver"]
    known_keys("study", data, ["unit", *names])
    tables = {name: table(name, data.get(name, {})) for name in names}
    require_unit_at_top({name: given for name, given in tables.items() if name != "objective"})
    known_keys("design", tables["design"], ["family", "characteristic_length"])
    known_keys("solver", tables["solver"], ["starts", "seed"])
    return {
        "variables": tables["variables"],
        "constraints": {
            name: _limits(f"constraints.{shown_key(name)}", given) for name, given in tables["constraints"].items()
        },
        "objective": Objective.from_dict(tables["objective"]),
        **({"unit": data["unit"]} if "unit" in data else {}),
        **tables["design"],
        **tables["solver"],
    }


def require_unit_at_top(tables: Mapping[str, Mapping[str, Any]]) -> None:
    """Raise where the length unit stands in a table: in TOML a key below [solver] is one of that table."""
    for name, given in tables.items():
        if "unit" in given:
            raise ValueError(f"{name}.unit: got {shown(given['unit'])}, expected no unit here: {AT_TOP}")


def _limits(name: str, given: Any) -> Mapping[str, Any] | list[Mapping[str, Any]]:
    """Return the table of a limit, or the tables of one that is stated for the poses and for the neutral pose."""
    if isinstance(given, list) and any(isinstance(entry, Mapping) for entry in given):
        return [table(f"{name}[{k}]", entry) for k, entry in enumerate(given)]
    return table(name, given)


def study_tables(arguments: Mapping[str, Any]) -> dict[str, Any]:
    """Return the tables of a study file for the normalized arguments of a `Study`."""
    length = arguments["characteristic_length"]
    length_entry = {"characteristic_length": list(length) if isinstance(length, tuple) else length}
    silent = arguments["length_assumed"] and arguments["unit"]  # left out, so that a study read back says so again
    return {
        **unit_entry(arguments["unit"]),
        "design": {"family": arguments["family"], **({} if silent else length_entry)},
        "variables": dict(_variable(arguments["family"], arguments["variables"])),
        "constraints": {name: limits.to_table(name, limit) for name, limit in arguments["constraints"].items()},
        "objective": arguments["objective"].to_dict(),
        "solver": {"starts": arguments["starts"], "seed": arguments["seed"]},
    }


def _variable(family: str, variables: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    """Yield the entries of [variables], angles in degrees where that is exact."""
    angles = [name for name, kind, *_ in _core.family_variables(family) if kind == "angle"]
    for name, bound in variables.items():
        if name in angles:
            yield angle_entry(name, bound)
        else:
            yield name, list(bound) if isinstance(bound, tuple) else bound
