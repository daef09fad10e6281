"""TOML files of users: studies and designs."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

from ninedof.support.arguments import path_argument
from ninedof.support.files import read_text, write_whole


def read_toml(path: str | os.PathLike[str]) -> dict[str, Any]:
    """Read a TOML file, with or without a byte order mark.

    Raises
    ------
    ValueError
        Naming the file, if it cannot be read or is not TOML.

    """
    import tomllib  # when it is needed, as it takes time to load

    text = read_text(file := path_argument("path", path))
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise ValueError(f"{file}: not a TOML file we can read: nested too deep") from None
    except ValueError as error:  # invalid TOML, or an integer of thousands of digits
        raise ValueError(f"{file}: not a TOML file: {error}") from None


def write_toml(path: str | os.PathLike[str], tables: Mapping[str, Any]) -> None:
    """Write tables as a TOML file."""
    import tomli_w

    write_whole(path_argument("path", path), tomli_w.dumps(tables).encode())
