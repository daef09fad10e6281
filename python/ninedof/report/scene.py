"""The machine as plain values for the view of the page: joints, plates, poses, region and workspace body."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from ninedof.conditioning.conditioning import condition_number
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.sheet.sheet import Sheet
from ninedof.support.arrays import Floats

DIGITS = 6  # significant, of coordinates in the page


def machine(
    name: str,
    g: Geometry,
    length: float,
    poses: Iterable[tuple[str, Configuration]],
    lines: Sequence[Floats] = (),
    body: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """Return a machine with its named poses, the lines of a region and the body of a workspace, where there are some.

    `length` is the characteristic length.
    """
    from ninedof.robot.plates import outlines

    base = np.vstack([g.base_external, g.base_internal])
    platform = np.vstack([g.platform_external, g.platform_internal])
    return {
        "name": name,
        "base": numbers(base),
        "platform": numbers(platform),
        "basePlate": [numbers(face) for face in outlines(base)],
        "platformPlate": [numbers(face) for face in outlines(platform)],
        "poses": [_pose(words, g, c, length) for words, c in poses],
        "region": [numbers(line) for line in lines],
        "body": body,
    }


def _pose(words: str, g: Geometry, c: Configuration, length: float) -> dict[str, Any]:
    kappa = condition_number(g, c, length) if np.isfinite(length) else np.inf
    return {
        "name": words,
        "p": numbers(c.position),
        "q": [[round(float(x), 9) for x in row] for row in c.rotation],
        "s": numbers(c.internal_point),
        "kappa": f"{kappa:.6f}" if np.isfinite(kappa) else "infinite",
        "lengths": [f"{x:.6g}" for x in leg_lengths(g, c)],
    }


def worst_poses(sheet: Sheet) -> list[tuple[str, Configuration]]:
    """Return the neutral pose and the worst poses of a sheet, each with all that is worst there."""
    said: dict[int, list[str]] = {0: []}
    said.setdefault(sheet.condition_number.pose, []).append("worst condition number")
    said.setdefault(sheet.clearance.pose, []).append(f"least clearance, {' and '.join(sheet.clearance.legs)}")
    if len(sheet.configurations) > 1:
        lengths = leg_lengths(sheet.geometry, sheet.configurations)
        most = max(range(9), key=lambda k: sheet.legs[k].stroke_ratio)
        for words, pick in (("shortest", np.argmin), ("longest", np.argmax)):
            said.setdefault(int(pick(lengths[:, most])), []).append(f"{sheet.legs[most].name} {words}")
    for name, det in sheet.determinants.items():
        said.setdefault(det.pose, []).append(f"least |det {name[-1].upper()}|")
    neutral = ["neutral pose", *(said.pop(0) if len(sheet.configurations) > 1 else [])]
    rows = [(0, neutral), *said.items()]
    return [(", ".join(words), sheet.configurations[k]) for k, words in rows]


def scene(machines: Iterable[Mapping[str, Any]], unit: str = "", start: int = 0) -> dict[str, Any]:
    """Return what the view shows; `start` is the machine it begins with."""
    return {"unit": unit, "machines": list(machines), "start": start}


def numbers(points: Floats) -> Any:
    """Return coordinates as lists of short numbers."""
    values = np.asarray(points, dtype=float)
    size = float(np.abs(values).max(initial=0.0))
    decimals = DIGITS - 1 - int(np.floor(np.log10(size))) if size > 0.0 else 0
    return (np.round(values, decimals) + 0.0).tolist()
