"""The table and sentences of a workspace and of its question; `workspace` is a WorkspaceMap."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from ninedof import _core
from ninedof.design.domains.region import Region
from ninedof.design.indices import INDICES
from ninedof.design.tool import Tool
from ninedof.redundancy.rules import point_words, where_o
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import LEGS as LEG_NAMES
from ninedof.support.units import amount, kind_unit, unit_of_forces
from ninedof.tables import RIGHT, Column, Line, Table
from ninedof.workspace.question import LEG_LIMITS, ROWS

SHOWN = 8  # limits in the table
STATUSES = {
    "limited": "the greatest number of poses was reached before the wanted error",
    "empty": "no allowed pose was found",
    "stopped": "interrupted: the state after the last complete level",
}


def workspace_table(workspace: Any, most: int = SHOWN) -> Table:
    """Return volume, largest ball and box, indices, and the limits that end the workspace, at most so many."""
    angles, unit = workspace.of_angles, "deg" if workspace.of_angles else workspace.unit
    cubed = "rad³, of 8 π² in all" if angles else workspace.unit + "³" * bool(workspace.unit)

    def place(values: Any) -> list[str]:
        return ["  ".join(f"{math.degrees(x) if angles else x:.4g}" for x in values)]

    rows: list[Any] = [
        Line("volume", [workspace.volume], ".6g", cubed),
        Line("  error, estimated", [workspace.error], ".2g"),
        Line(f"  share of the {'region' if angles else 'box'}", [f"{100.0 * workspace.share:.3g} %"]),
    ]
    if workspace.unseen > 0.0:
        rows.append(Line("  of it, for parts that may be unseen", [workspace.unseen], ".2g"))
    if len(workspace.pieces) > 1:
        rows.append(Line("  pieces", [len(workspace.pieces)]))
    if workspace.ball_radius > 0.0:
        inscribed = {
            "ball: radius": [workspace.ball_radius],
            "ball: centre": workspace.ball_centre,
            "box: sides": workspace.box_high - workspace.box_low,
            "box: centre": 0.5 * (workspace.box_low + workspace.box_high),
        }
        rows += [Line(f"largest {what}", place(values), unit=unit) for what, values in inscribed.items()]
    rows += [
        (),
        Line("global conditioning index", [workspace.conditioning_index], ".5f"),
        Line("condition number: median", [workspace.percentiles[50]], ".4f"),
        Line("condition number: 95 %", [workspace.percentiles[95]], ".4f"),
        Line("condition number: worst", [workspace.worst_condition_number], ".4f"),
        *_index_lines(workspace),
        (),
    ]
    shares = list(workspace.limits().items())
    for name, share in shares[:most]:
        words = "ends of the torsion" if name == "box" and angles else name.replace("_", " ")
        rows.append(Line(f"boundary by {words}", [f"{100.0 * share:.1f} %"]))
    if (rest := sum(share for _, share in shares[most:])) > 0.0:
        rows.append(Line("boundary by others", [f"{100.0 * rest:.1f} %"]))
    return Table("Workspace", [Column(), Column("", "", RIGHT)], rows)


def _index_lines(workspace: Any) -> Iterator[Line]:
    for name, over in workspace.indices.items():
        index = INDICES[name]
        unit = workspace.unit if index.unit == "length" else ""
        what = f"mean, least, greatest{' modulus' if index.signed else ''}"
        parts: Any = [(index.words, over.mean, over.least, over.greatest)]
        if index.components:
            parts = zip(index.components, over.mean, over.least, over.greatest, strict=True)
        for label, *values in parts:
            yield Line(f"{label}: {what}", ["  ".join(f"{value:.5g}" for value in values)], unit=unit)


def workspace_words(workspace: Any) -> Iterator[tuple[str, str]]:
    """Yield remarks on the table, one sentence each: a status to be stressed, and the rest."""
    if workspace.status in STATUSES:
        yield workspace.status, f": {STATUSES[workspace.status]}"
    if not workspace.home_allowed:
        yield "", f"the home pose is not allowed: {workspace.home_limit}"
    if workspace.box_limits and workspace.of_angles:
        yield "", "the workspace reaches the boundary of the region: it is larger in a larger region"


def cut_words(workspace: Any) -> Iterator[tuple[str, str]]:
    """Yield which faces of its box cut a workspace of positions, and the options for a box half as long again there."""
    if not workspace.box_limits or workspace.of_angles:
        return
    cells, low, high = workspace.cells, workspace.low, workspace.high
    reach, allowed = 0.5 * (high - low), cells.fraction > 0.0
    at = [(0.51 * cells.size >= there)[allowed].any(axis=0) for there in (cells.centre - low, high - cells.centre)]
    faces = [
        f"{axis} {side}"
        for k, axis in enumerate("xyz")
        for side, cut in zip(("low", "high"), at, strict=True)
        if cut[k]
    ]
    ends = zip("xyz", low - at[0] * reach, high + at[1] * reach, at[0] | at[1], strict=True)
    larger = " ".join(f"--{axis} {a:.5g} {b:.5g}" for axis, a, b, cut in ends if cut)
    by = f": {', '.join(faces)}; a larger one: {larger}" if faces else "; it is larger in a larger box"
    yield "the box cuts the workspace", by


def share_words(region: Region, workspace: _core.RegionShare, unit: str) -> str:
    """Return a sentence on how much of a region keeps the limits."""
    words = f"region of the study, {region.worded(unit)}: {100.0 * workspace.share:.4g} % of it within these limits"
    broken = f"; violated: {', '.join(name.replace('_', ' ') for name in workspace.passed)}" if workspace.passed else ""
    return f"{words}, {workspace.looked_at} poses looked at{broken}"


KINDS = {"external": slice(0, 3), "upper internal": slice(3, 6), "lower internal": slice(6, 9)}

CRITERIA = {
    "constant_orientation": "positions of the platform at the neutral rotation alone: no tilts and no yaws",
    "orientation": "rotations of the platform at one position",
    "reachable": "positions of the platform where one of a set of rotations, or more, is allowed",
    "inclusive": "positions of the platform where every one of a set of rotations is allowed",
    "dexterous": "positions of the platform where each of some rotations spread over all is allowed",
}


def criteria_lines(
    keywords: Mapping[str, Any], home: Configuration, own: set[str], left: Sequence[str], unit: str, tool: Tool
) -> Iterator[str]:
    """Yield what is asked, a line for each part."""
    yield f"workspace: {CRITERIA[keywords['archetype']]}"
    p, o = (amount(point_words(point), unit) for point in (home.position, home.internal_point))
    yield f"home: p = {p}, O = {o}"
    yield f"O: {rule_words(keywords, unit)}"
    for name, value in keywords["criteria"].items():
        whose = ", of the study" if name in own else ""
        for words in criterion_words(name, value, unit, tool):
            yield f"limit: {words}{whose}"
    if left:
        yield f"of the study, no limit of a single pose: {', '.join(left)}"
    if "box" in keywords:
        low, high = keywords["box"]
        yield f"box: p from {point_words(low)} to {amount(point_words(high), unit)}"
    if "position" in keywords:
        yield f"position: p = {amount(point_words(keywords['position']), unit)}"
    if "region" in keywords:
        yield "region: " + ", ".join(
            f"{name} to {math.degrees(a):.6g} degrees" for name, a in keywords["region"].items()
        )


def rule_words(keywords: Mapping[str, Any], unit: str) -> str:
    """Return where O is, in words; where the platform does not turn, carried is the same as shifted."""
    rule = keywords["internal_point"]
    turns = "position" in keywords or "rotation" not in keywords
    return where_o(rule, unit) + ("; without turns as shifted" if isinstance(rule, Mapping) and not turns else "")


def criterion_words(name: str, value: Any, unit: str, tool: Tool | None = None, brief: bool = False) -> Iterator[str]:
    """Yield a criterion in words, for legs of several kinds one for each; without nine ranges of legs if brief."""
    if name == LEG_LIMITS:
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
    of_masses = isinstance(value, Mapping) and value.get("duty", {}).get("masses")
    of = kind_unit(row.kind, unit, unit_of_forces(unit, of_masses))
    for side in row.sides:
        if side not in entries:
            continue
        if row.is_angle:
            about = "each leg's direction at home"
            if "axis" in entries:  # in the plate's frame, as the study has it
                turn = tool.axes if tool and row.body == "platform" else np.eye(3)
                about = f"the axis {point_words(np.round(turn @ entries['axis'], 12))}"
            yield f"{name.replace('_', ' ')} {math.degrees(entries[side]):.6g} degrees about {about}"
        else:
            yield amount(f"{name.replace('_', ' ')} {words[side]} {entries[side]:.6g}", of)
