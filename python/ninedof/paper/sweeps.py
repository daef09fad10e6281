"""The sweeps behind the figures of the paper."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ninedof.conditioning.hexagonal import HEXAGONAL
from ninedof.design.indices import INDICES, Index
from ninedof.design.study import Study
from ninedof.optimize.optimize import optimize
from ninedof.optimize.result import Status
from ninedof.paper import published
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry, triples
from ninedof.support.arguments import choice, whole
from ninedof.support.arrays import Floats
from ninedof.support.kept.files import Arrays
from ninedof.support.running import Progress
from ninedof.sweep.axis import Axis, Grid
from ninedof.sweep.grid import GridWork
from ninedof.sweep.points import Poses
from ninedof.sweep.result import SweepResult

if TYPE_CHECKING:
    from concurrent.futures import Executor

FIGURES = ("6", "7")
SHOWN = ("x_p", "y_p", "z_p", "theta_x", "theta_y", "theta_z", "x_s", "y_s", "z_s")
REACH = 1.0  # l_c or rad, either way from the neutral pose
OCTAVES = 4  # ratios from 1/16 to 16
MOST_POINTS = 100_000
SIDES = ("a", "b")
STARTS = 32


def sweep_figure(
    figure: str,
    points: int | None = None,
    *,
    executor: Executor | None = None,
    out: str | os.PathLike[str] | None = None,
    progress: Progress | None = None,
) -> SweepResult:
    """Return the numbers behind a figure of the paper.

    "6" is the condition number of the published design against displacement in each of the nine coordinates, one at a
    time, with the others fixed: the platform moves and O stays, or O moves and the platform stays. zs, which the paper
    does not print, has its best value.

    "7" is the least condition number of the hexagonal family for each ratio a1/a2, and for each b1/b2, all other
    variables re-optimized with the base at most twice the platform, as in section 5. A ratio and its inverse belong to
    mirrored robots of the same condition number. It falls as a ratio grows, as the paper says, but only above 1. Each
    point is an optimization with sides 1 and 1/ratio (or ratio and 1) and a free characteristic length. The condition
    number depends only on lengths over l_c, so this is the study with a fixed ratio and l_c = 1.

    Parameters
    ----------
    figure : {"6", "7"}
    points : int, optional
        Values along each curve: by default 201 from -1 to 1 l_c or rad, or 33 ratios, evenly spaced by their logarithm,
        from 1/16 to 16.
    executor, out, progress : optional
        As in `sweep`.

    Returns
    -------
    SweepResult
        "6": condition_number over (coordinate, displacement). "7": condition_number over (sides, ratio), and design,
        the variables of the best design in units of l_c, over (sides, ratio, variable). NaN where no optimum was found.

    Raises
    ------
    ValueError
        If an argument does not fit.

    Examples
    --------
    >>> import ninedof as nd
    >>> curves = nd.sweep_figure("6", points=3)
    >>> curves["coordinate"].tolist()[:2], curves["condition_number"][0].round(2).tolist()
    (['x_p', 'y_p'], [6.73, 3.91, 6.52])

    """
    which = choice("figure", figure, FIGURES)
    work = _figure_6(_points(points, 201)) if which == "6" else _figure_7(_points(points, 8 * OCTAVES + 1))
    units = {"coordinate": "1", "sides": "1", "ratio": "1", "displacement": "l_c or rad"}
    result = work.result(units, "", executor, out, progress)
    words = {"coordinate": np.array(SHOWN)} if which == "6" else {"sides": np.array([f"{s}1/{s}2" for s in SIDES])}
    return replace(result, coords={**result.coords, **words}, attributes={**result.attributes, "figure": which})


def _points(points: int | None, default: int) -> int:
    return default if points is None else whole("points", points, 2, MOST_POINTS)


def _figure_6(points: int) -> GridWork:
    home = Configuration.neutral(published.ZP, published.published_zs()[2])
    axes = (Axis("coordinate", len(SHOWN), 0.0, len(SHOWN) - 1.0), Axis("displacement", points, -REACH, REACH))
    return GridWork(_Displaced(published.published_geometry(), home), Grid(axes), (INDICES["condition_number"],), 16384)


@dataclass(frozen=True, eq=False)
class _Displaced:
    """A configuration moved along one of its coordinates."""

    geometry: Geometry
    home: Configuration

    def values(self, at: dict[str, Floats], indices: tuple[Index, ...], threads: int | None) -> Arrays:
        moved = {name: np.where(at["coordinate"].round() == k, at["displacement"], 0.0) for k, name in enumerate(SHOWN)}
        return Poses(self.geometry, self.home, True, "held", 1.0).values(moved, indices, threads)

    def question(self) -> dict[str, Any]:
        return {
            "kind": "Fig. 6",
            "geometry": triples(self.geometry),
            "home": {"position": self.home.position, "internal_point": self.home.internal_point},
            "internal_point": "held",
        }


def _figure_7(points: int) -> GridWork:
    ratios = np.exp2(np.linspace(-OCTAVES, OCTAVES, points))
    axes = (Axis("sides", len(SIDES), 0.0, len(SIDES) - 1.0), Axis("ratio", points, explicit=ratios))
    indices = (
        INDICES["condition_number"],
        Index("design", None, dimension="variable", components=HEXAGONAL, unit="l_c"),
    )
    return GridWork(_Ratios(), Grid(axes), indices, 1)


@dataclass(frozen=True)
class _Ratios:
    """The best design with a ratio of two sides."""

    def values(self, at: dict[str, Floats], indices: tuple[Index, ...], threads: int | None) -> Arrays:
        kappa = np.full(len(at["ratio"]), np.nan)
        design = np.full((len(kappa), len(HEXAGONAL)), np.nan)
        for k, (side, ratio) in enumerate(zip(at["sides"].round().astype(int), at["ratio"].tolist(), strict=True)):
            result = optimize(ratio_study(SIDES[side], ratio))
            if result.interrupted:
                raise KeyboardInterrupt
            if result.status == Status.OPTIMAL and result.best is not None:
                best = result.best
                kappa[k] = best.condition_number
                design[k] = [best.variables[name] / best.characteristic_length for name in HEXAGONAL]
        return {"condition_number": kappa, "design": design}

    def question(self) -> dict[str, Any]:
        return {"kind": "Fig. 7", "study": ratio_study("a", 1.0).to_dict()}


def ratio_study(side: str, ratio: float) -> Study:
    """Return the paper's study with the ratio of the first to the second side held, the longer side being 1."""
    pair = {f"{side}1": min(ratio, 1.0), f"{side}2": min(1.0 / ratio, 1.0)}
    others: dict[str, Any] = {f"{o}{i}": (0.0, 20.0) for o in SIDES if o != side for i in (1, 2)}
    heights: dict[str, Any] = {"zp": (1e-3, 50.0), "zs": (1e-3, 50.0)}
    return Study(
        variables=pair | others | heights,
        constraints=Study.paper().constraints,
        characteristic_length=(1e-3, 50.0),
        starts=STARTS,
    )
