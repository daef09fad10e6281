"""Indices over a workspace: the mean by volume, the least and the greatest value with their poses."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from ninedof.design.indices import Index, size_of
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.arrays import Floats
from ninedof.support.short import short_repr
from ninedof.workspace.cells import WorkspaceCells


@short_repr
@dataclass(frozen=True, eq=False)
class IndexStatistics:
    """An index over a workspace; lists have one entry for each component of an index of several numbers.

    Values are taken at the centres of the cells, so that the error is of the order of a cell. The mean weights each
    cell by its allowed volume; the extremes use cells of which at least half is allowed. Poses where the index is
    unknown (NaN) do not count. Of singularity margins, which are signed, the extremes are those of the modulus.
    """

    mean: Any
    least: Any
    least_at: Any
    """Coordinates of the map."""
    greatest: Any
    greatest_at: Any


def statistics_of(
    geometry: Geometry,
    domain: Mapping[str, Any],
    rule: tuple[str, float, Floats],
    criteria: Mapping[str, Any],
    cells: WorkspaceCells,
    indices: tuple[Index, ...],
    threads: int | None,
) -> dict[str, IndexStatistics]:
    """Return the statistics of each index. Each pose has one rotation, and O by a rule that is a formula."""
    counted = (cells.fraction > 0.0) & ((cells.piece == 0) | (not criteria["singularity_free"]))
    at, fraction = cells.centre[counted], cells.fraction[counted]
    volume = np.prod(cells.size[counted], axis=1)
    weight = fraction * np.where(volume > 0.0, volume, 1.0) * _density(domain, at)
    length = criteria["characteristic_length"]
    c = _configurations(geometry, domain, rule, at)
    inner = fraction >= 0.5

    def over(index: Index) -> IndexStatistics:
        values = index.values(geometry, c, length, threads) if len(at) > 0 else np.empty((0, *index.tail))
        return _statistics(index.name, np.asarray(values), weight, inner, at)

    return {index.name: over(index) for index in indices}


def _statistics(name: str, values: Floats, weight: Floats, inner: Any, at: Floats) -> IndexStatistics:
    if values.ndim > 1:
        each = [_statistics(name, column, weight, inner, at) for column in values.T]
        return IndexStatistics(*([getattr(one, field.name) for one in each] for field in fields(IndexStatistics)))
    known, size = ~np.isnan(values), size_of(name, values)
    inner = inner & known
    total = float(weight[known].sum())
    if not (total > 0.0 and inner.any()):
        nowhere = [float("nan")] * 3
        return IndexStatistics(float("nan"), float("nan"), nowhere, float("nan"), nowhere)
    least, greatest = np.flatnonzero(inner)[[size[inner].argmin(), size[inner].argmax()]].tolist()
    mean = float((weight[known] * values[known]).sum()) / total
    return IndexStatistics(
        mean, float(values[least]), at[least].tolist(), float(values[greatest]), at[greatest].tolist()
    )


def _configurations(
    geometry: Geometry, domain: Mapping[str, Any], rule: tuple[str, float, Floats], at: Floats
) -> Configuration:
    """Return the configurations at coordinates of the map, with O by the rule."""
    p, q = at, np.broadcast_to(domain["rotations"][0], (len(at), 3, 3))
    if domain["archetype"] == "orientation":
        p, q = np.broadcast_to(domain["position"], at.shape), _turned(domain["chart"], at, q)
    kind, fraction, point = rule
    if kind == "fixed":
        return Configuration(p, q, np.broadcast_to(point, at.shape))
    if kind == "platform":
        return Configuration(p, q, p + q @ point)
    lower, upper = geometry.base_internal.mean(axis=0), geometry.platform_internal.mean(axis=0)
    return Configuration(p, q, lower + fraction * (p + q @ upper - lower))


def _turned(chart: str, at: Floats, centre: Floats) -> Floats:
    """Return the rotations at coordinates of a region of orientations."""
    zero = np.zeros((len(at), 9))
    start = Configuration(zero[:, :3], centre, zero[:, :3])
    if chart == "rotation_vector":
        zero[:, :3] = at
        return start.moved(zero).rotation
    torsion, tilt = zero, zero.copy()
    torsion[:, 2] = at[:, 2]
    tilt[:, 0], tilt[:, 1] = -at[:, 1], at[:, 0]
    return start.moved(torsion).moved(tilt).rotation


def _density(domain: Mapping[str, Any], at: Floats) -> Any:
    """Return Haar's measure per unit of the coordinates; 1 for positions."""
    if domain["archetype"] != "orientation":
        return 1.0
    if domain["chart"] == "rotation_vector":
        return np.sinc(np.linalg.norm(at, axis=1) / (2.0 * np.pi)) ** 2
    return np.sinc(np.linalg.norm(at[:, :2], axis=1) / np.pi)
