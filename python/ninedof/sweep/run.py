"""Sweeps over configurations and over designs."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from dataclasses import replace
from functools import wraps
from typing import TYPE_CHECKING, Any, TypedDict, Unpack

from ninedof.conditioning.characteristic_length import length_argument
from ninedof.design.indices import What, indices_of
from ninedof.design.study import FAMILIES, in_radians_by_kind, variable_kinds
from ninedof.redundancy.rules import RULES
from ninedof.robot.configuration import Configuration, single
from ninedof.robot.designs import P, R_co, TakesDesigns, takes_designs
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import choice, finite, flag, shown
from ninedof.support.arrays import thread_argument
from ninedof.support.kept.chunks import chunk_argument
from ninedof.support.running import Progress
from ninedof.support.structs import options_of
from ninedof.support.units import plain_name, unit_argument
from ninedof.sweep.axis import Values, axes_of
from ninedof.sweep.grid import GridWork
from ninedof.sweep.points import (
    COORDINATES,
    FOLLOWING,
    INTERNAL,
    ROTATION,
    Poses,
    Variants,
    best_block,
    rule_of_study,
)
from ninedof.sweep.result import SweepResult

if TYPE_CHECKING:
    from concurrent.futures import Executor

# A chunk takes under a tenth of a second: signals are checked between chunks.
POSES, DESIGNS = 65536, 1024


def _as_in_the_study(function: TakesDesigns[P, R_co]) -> TakesDesigns[P, R_co]:
    """Let O be by default as in the region of the study of a result."""

    @wraps(function)
    def call(*args: Any, **kwargs: Any) -> R_co:
        design = next(iter(args), kwargs.get("geometry"))
        over = next((one for one in (*args, *kwargs.values()) if isinstance(one, Mapping)), {})
        return function(*args, **{"internal_point": rule_of_study(design, over)} | kwargs)

    return call


class GridOptions(TypedDict, total=False):
    """Options of both kinds of sweeps, as keywords."""

    executor: Executor | None
    out: str | os.PathLike[str] | None
    progress: Progress | None
    characteristic_length: float | str
    chunk: int | None
    unit: str | None


class SweepOptions(GridOptions, total=False):
    """Options of `sweep`, as keywords."""

    relative: bool
    internal_point: str
    threads: int | None


class DesignOptions(GridOptions, total=False):
    """Options of `sweep_designs`, as keywords."""

    family: str


@_as_in_the_study
@takes_designs
def sweep(
    geometry: Geometry,
    home: Configuration,
    over: Mapping[str, Values],
    index: What = "condition_number",
    **options: Unpack[SweepOptions],
) -> SweepResult:
    """Return an index over a grid of one, two or three of the nine configuration coordinates.

    The other coordinates stay as they are at `home`. The platform turns by the rotation vector theta about axes of the
    base frame, Q = exp(theta) Q_home.

    Parameters
    ----------
    geometry : Geometry
    home : Configuration
        A single one.
    over : mapping
        Name of a coordinate, x_p y_p z_p theta_x theta_y theta_z x_s y_s z_s, to its values: an array of shape (n,), or
        a tuple (low, high, count) for evenly spaced ones. Lengths in one unit, angles in radians, or in degrees with
        _deg behind the name: the dimension is then "theta_z_deg" and its values are degrees. The order of names is the
        order of dimensions.
    index : str, callable, or a sequence of them
        Names of the table in docs/sweeps.md, "condition_number" or "leg_lengths" among them. A callable takes the
        geometry, a stack of n configurations and the characteristic length and returns n numbers.
    options : SweepOptions
        Keywords, as follows.
    relative : bool
        Whether the values are displacements from `home`, the default. If not they are the coordinates themselves, and a
        swept theta takes the place of the rotation at home: Q = exp(theta), components that are not swept being zero.
    internal_point : {"held", "carried", "shifted", "best"}
        Position of O while the platform moves: at home, as in the paper's Fig. 6; as a point of the platform
        ("carried") or shifted with its origin, from where swept x_s, y_s, z_s displace it; or the point of least
        condition number (`best_internal_map`, over blocks of some 2000 points; NaN where no position is admissible). As
        in the region of its study for a Result, unless O is swept; else "held" by default.
    characteristic_length : float or str
        A number, or a kind of `ninedof.characteristic_length`, taken at each configuration; 1 by default, of a
        design its own.
    executor : concurrent.futures.Executor, optional
        Where the chunks are computed: threads, processes, or a cluster by Dask's `Client.get_executor()`. In this
        process by default. The values are the same, bit for bit. The executor handles lost workers: Dask repeats their
        chunks on others. An exception of the executor ends the sweep; finished chunks stay in `out`.
    out : path, optional
        Folder that keeps finished chunks. The same call continues a sweep that was interrupted or killed. A folder with
        the chunks of another question raises ValueError, which names both. Arrays are read from there as they are
        needed: memory does not hold them.
    chunk : int, optional
        Points per chunk; with "best" rounded up to whole blocks. The values do not depend on it.
    threads : int, optional
        Threads within a chunk; one per processor by default, and one with an executor.
    progress : callable, optional
        Called as progress(points done, points in all, None).
    unit : str, optional
        Name of the length unit, for labels: "mm", "cm", "m", "in" or "ft". None by default.

    Returns
    -------
    SweepResult
        Arrays over the swept coordinates, in the order of `over`.

    Raises
    ------
    ValueError
        If an argument does not fit; the message names it.
    KeyboardInterrupt
        After Ctrl-C, at the end of the current chunk. Finished chunks stay in `out`.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> home = nd.Configuration.neutral(zp=3.9828, zs=2.4435)
    >>> result = nd.sweep(g, home, {"x_p": (-1.0, 1.0, 5)})
    >>> result["condition_number"].round(4).tolist()
    [6.7289, 4.8289, 3.9071, 4.7669, 6.5228]

    """
    values = options_of(sweep, SweepOptions, options, relative=True, internal_point="held", characteristic_length=1.0)
    single(geometry, home, "home")
    relative, threads, executor = flag("relative", values["relative"]), values["threads"], values["executor"]
    grid = axes_of(over, COORDINATES, ROTATION)
    rule = choice("internal_point", values["internal_point"], RULES)
    length = length_argument(values["characteristic_length"])
    swept = {axis.name for axis in grid.axes}
    if swept & set(INTERNAL) and (rule == "best" or (rule in FOLLOWING and not relative)):
        where = "displaced from home" if rule == "best" else "displacements"
        raise ValueError(f'over: got {", ".join(sorted(swept))} with internal_point="{rule}", expected O to be {where}')
    if rule == "best" and isinstance(length, str):
        raise ValueError(
            f'characteristic_length: got {shown(length)} with internal_point="best" (that of a region, where '
            "nothing else is given), expected a number"
        )
    poses = Poses(geometry, home, relative, rule, length)
    points = chunk_argument(values["chunk"], POSES)
    if rule == "best":
        poses = replace(poses, block=best_block(grid.shape))
        size = math.prod(poses.block)
        points = size if values["chunk"] is None else -(-points // size) * size
    workers = 1 if threads is None and executor is not None else (thread_argument(threads) or None)
    units = {name: "rad" if name in ROTATION else "length" for name in COORDINATES}
    work = GridWork(poses, grid, indices_of(index), points, workers)
    return work.result(units, unit_argument(values["unit"]), executor, values["out"], values["progress"])


def sweep_designs(
    design: Mapping[str, float],
    over: Mapping[str, Values],
    index: What = "condition_number",
    **options: Unpack[DesignOptions],
) -> SweepResult:
    """Return an index at the neutral pose over a grid of one, two or three variables of a design family.

    Parameters
    ----------
    design : mapping
        Name to value of the variables that are not swept; those with a fixed default, as theta_z, may be left out.
        Angles in radians, or in degrees with _deg behind the name.
    over : mapping
        Name of a variable to its values: an array of shape (n,), or a tuple (low, high, count) for evenly spaced ones.
    index : str, callable, or a sequence of them
        As in `sweep`. The condition number of untwisted hexagonal designs comes from the closed form, a few
        nanoseconds each; other indices are evaluated design by design, about ten thousand per second.
    options : DesignOptions
        Keywords, as follows.
    family : str
        As in `Study`: "hexagonal", the default, "symmetric", "symmetric_nonplanar" or "general".
    characteristic_length : float or str
        A number, 1 by default, or a kind of `ninedof.characteristic_length`, taken at each design.
    executor, out, chunk, progress, unit : optional
        As in `sweep`.

    Returns
    -------
    SweepResult
        Arrays over the swept variables, in the order of `over`.

    Raises
    ------
    ValueError
        If an argument does not fit, or if no design exists at a point of the grid; the message names it.

    Examples
    --------
    >>> import ninedof as nd
    >>> plates = {"a1": 0.0, "a2": 5.8124, "b1": 2.9062, "b2": 0.0, "zp": 3.9828}
    >>> result = nd.sweep_designs(plates, {"zs": (2.3, 2.6, 4)})
    >>> result["condition_number"].round(3).tolist()
    [3.924, 3.909, 3.91, 3.929]

    """
    values = options_of(sweep_designs, DesignOptions, options, family="hexagonal", characteristic_length=1.0)
    family = choice("family", values["family"], FAMILIES)
    kinds = variable_kinds(family)
    grid = axes_of(over, list(kinds), [name for name, kind in kinds.items() if kind == "angle"])
    in_radians = in_radians_by_kind("design", design, kinds, finite)
    fixed = {name: finite(f"design[{name!r}]", value) for name, value in in_radians.items()}
    swept = [plain_name(axis.name) for axis in grid.axes]
    if both := [name for name in swept if name in fixed]:
        raise ValueError(f"design: got {both[0]}, which is swept, expected it in one place")
    variants = Variants(family, fixed, length_argument(values["characteristic_length"]))
    at_first = {name: float(first[0]) for name, first in grid.in_radians(0, 1).items()}
    variants.study().vector(at_first)  # raises for missing variables
    indices = indices_of(index, of_designs=True)
    variants.check(indices)
    fast = all(variants.has_closed_form(i, swept) for i in indices)
    work = GridWork(variants, grid, indices, chunk_argument(values["chunk"], POSES if fast else DESIGNS), 1)
    units = {name: "rad" if kind == "angle" else "length" for name, kind in kinds.items()}
    return work.result(units, unit_argument(values["unit"]), values["executor"], values["out"], values["progress"])
