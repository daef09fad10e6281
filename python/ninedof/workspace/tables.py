"""The table and sentences of a workspace; `workspace` is a WorkspaceMap."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from ninedof.design.indices import INDICES
from ninedof.design.region import Region
from ninedof.tables import RIGHT, Column, Line, Table
from ninedof.workspace.region_share import RegionShare

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
    """Yield mean, least and greatest of each index that was asked for."""
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
    if workspace.box_limits:
        where, what = ("boundary of the region", "region") if workspace.of_angles else ("faces of the box", "box")
        yield "", f"the workspace reaches the {where}: it is larger in a larger {what}"


def share_words(region: Region, workspace: RegionShare, unit: str = "") -> str:
    """Return a sentence on how much of a region keeps the limits."""
    words = f"region of the study, {region.worded(unit)}: {100.0 * workspace.share:.4g} % of it within these limits"
    broken = f"; passed: {', '.join(name.replace('_', ' ') for name in workspace.passed)}" if workspace.passed else ""
    return f"{words}, {workspace.looked_at} poses looked at{broken}"
