"""The design given by options, as a file or as sides and heights, and its characteristic length."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path

from ninedof.conditioning.characteristic_length import KINDS
from ninedof.optimize.result import Result
from ninedof.runs.design_file import Design, hexagonal_design, load_design
from ninedof.runs.folder import load


def chosen_design(design: Path | None, sides: Mapping[str, float | None], theta_z_deg: float | None) -> Design:
    """Return the design of a file, or of the sides and heights of the hexagonal family."""
    named = {name: value for name, value in sides.items() if value is not None}
    if design is not None:
        if named or theta_z_deg is not None:
            raise ValueError(f"design: got a file and {', '.join(named) or '--theta-z-deg'}, expected one of the two")
        return load_design(design)
    missing = [f"--{name}" for name, value in sides.items() if value is None]
    if missing:
        raise ValueError(f"design: got no {', '.join(missing)}, expected a design file or all of a1 a2 b1 b2 zp zs")
    return hexagonal_design(named | {"theta_z": math.radians(theta_z_deg or 0.0)})


def with_length(design: Design, lc: str | None) -> Design:
    """Return the design with the characteristic length given by --lc, if any."""
    return design if lc is None else design._replace(characteristic_length=length_option(lc))


def length_option(text: str) -> float | str:
    """Return the characteristic length given by --lc."""
    try:
        return float(text)
    except ValueError:
        if text not in KINDS:
            raise ValueError(f"--lc: got {text!r}, expected a number or one of {', '.join(KINDS)}") from None
        return text


def is_run(path: Path) -> bool:
    """Return whether a path is that of a run and not of a design file."""
    return path.is_dir() or path.suffix == ".json"


def design_or_result(path: Path) -> Design | Result:
    """Return the result of a run of a study, or the design of a file."""
    if not is_run(path):
        return load_design(path)
    run = load(path)
    if not isinstance(run, Result):
        raise ValueError(f"{path}: got a run without an optimum, expected one of `ninedof optimize` or a design file")
    if run.best is None:
        raise ValueError(f"{path}: the record holds no design: the run found none")
    return run
