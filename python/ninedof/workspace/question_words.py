"""The question of a workspace in words: its limits, its box, where O is."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from ninedof.design.limits import kind_unit
from ninedof.redundancy.rules import where_o
from ninedof.robot.configuration import Configuration
from ninedof.robot.leg_names import LEGS as LEG_NAMES
from ninedof.support.arrays import Floats
from ninedof.support.units import amount
from ninedof.workspace.question import ROWS

KINDS = {"external": slice(0, 3), "upper internal": slice(3, 6), "lower internal": slice(6, 9)}

ASKED = {
    "constant_orientation": "positions of the platform at the neutral rotation alone: no tilts and no yaws",
    "orientation": "rotations of the platform at one position",
    "reachable": "positions of the platform where one of a set of rotations, or more, is allowed",
    "inclusive": "positions of the platform where every one of a set of rotations is allowed",
    "dexterous": "positions of the platform where each of some rotations spread over all is allowed",
}


def asked_lines(
    keywords: Mapping[str, Any], home: Configuration, own: set[str], left: Sequence[str], unit: str = ""
) -> Iterator[str]:
    """Yield what is asked, a line for each part."""
    yield f"workspace: {ASKED[keywords['archetype']]}"
    p, o = (amount(_point(point), unit) for point in (home.position, home.internal_point))
    yield f"home: p = {p}, O = {o}"
    yield f"O: {rule_words(keywords, unit)}"
    for name, value in keywords["criteria"].items():
        whose = ", of the study" if name in own else ""
        for words in criterion_words(name, value, unit):
            yield f"limit: {words}{whose}"
    if left:
        yield f"of the study, no limit of a single pose: {', '.join(left)}"
    if "box" in keywords:
        low, high = keywords["box"]
        yield f"box: p from {_point(low)} to {amount(_point(high), unit)}"
    if "position" in keywords:
        yield f"position: p = {amount(_point(keywords['position']), unit)}"
    if "region" in keywords:
        yield "region: " + ", ".join(
            f"{name} to {math.degrees(a):.6g} degrees" for name, a in keywords["region"].items()
        )


def rule_words(keywords: Mapping[str, Any], unit: str) -> str:
    """Return where O is, in words; where the platform does not turn, carried is the same as shifted."""
    rule = keywords["internal_point"]
    turns = "position" in keywords or "rotation" not in keywords
    return where_o(rule, unit) + ("; without turns as shifted" if isinstance(rule, Mapping) and not turns else "")


def criterion_words(name: str, value: Any, unit: str, brief: bool = False) -> Iterator[str]:
    """Yield a criterion in words, for legs of several kinds one for each; without nine ranges of legs if brief."""
    if name == "leg_limits":
        ranges = [*zip(*(np.broadcast_to(end, 9).tolist() for end in value), strict=True)]
        if any(len(set(ranges[legs])) > 1 for legs in KINDS.values()):
            each = (f"{leg} {low:.6g} to {high:.6g}" for leg, (low, high) in zip(LEG_NAMES, ranges, strict=True))
            needs = "legs as the study has them"
            yield needs if brief else amount(f"{needs}: {', '.join(each)}", unit)
            return
        for kind, legs in KINDS.items() if len(set(ranges)) > 1 else [("all", slice(9))]:
            low, high = ranges[legs][0]
            if low > 0.0 or math.isfinite(high):
                yield amount(f"{kind} legs {low:.6g} to {high:.6g}", unit)
        return
    row = ROWS[name]
    if row.kind == "sign":
        yield "connected with home, on its side of every singularity"
        return
    entries = value if isinstance(value, Mapping) else {row.sides[0]: value}
    words = {"min": "at least", "max": "at most"}
    for side in row.sides:
        if side not in entries:
            continue
        if row.is_angle:
            about = f"the axis {_point(entries['axis'])}" if "axis" in entries else "each leg's direction at home"
            yield f"{name.replace('_', ' ')} {math.degrees(entries[side]):.6g} degrees about {about}"
        else:
            yield amount(f"{name.replace('_', ' ')} {words[side]} {entries[side]:.6g}", kind_unit(row.kind, unit))


def _point(values: Sequence[float] | Floats) -> str:
    return "(" + ", ".join(f"{value:.6g}" for value in np.asarray(values, dtype=np.float64) + 0.0) + ")"
