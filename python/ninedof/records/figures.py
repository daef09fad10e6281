"""The figures of a study's run: mechanisms, condition number about it and over its region; convergence if asked.

They are drawn with matplotlib, so this module is loaded where they are.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import pairwise
from operator import itemgetter
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from ninedof import plot
from ninedof.conditioning.conditioning import condition_number
from ninedof.design.design_point import DesignPoint
from ninedof.design.domains.poses import Pose
from ninedof.design.domains.region import region_lines
from ninedof.design.tool import Tool
from ninedof.optimize.optimize import trace
from ninedof.optimize.region_map import region_map
from ninedof.optimize.result import Result
from ninedof.paper import published
from ninedof.paper.comparison import PaperComparison
from ninedof.plot import DesignCurves
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.arrays import Floats
from ninedof.support.margins import is_violated
from ninedof.support.units import amount

Named = tuple[str, Figure]
"""A figure behind the name of its files."""

Drawn = tuple[str, Geometry, Configuration, float, float]
"""A design to draw: name, geometry, neutral configuration, condition number there, characteristic length."""

TRACED_STARTS = 200  # runs shown in the convergence figure, at one pose
POINTS = 161  # of a curve over several poses
HALVINGS = 24  # of a step of it, to the edge of a limit
FEWEST_TRACED = 10  # however many poses each run evaluates


def figures_of(run: Result | PaperComparison, convergence: bool = False) -> Callable[[], Iterator[Named]] | None:
    """Return a function that yields the figures as they are drawn, behind the names of their files.

    None for an interrupted run or one without an optimum. The convergence follows hundreds of starts to their ends,
    which takes longer than the optimization: drawn if asked.
    """
    designs: list[Drawn]
    if isinstance(run, Result):
        # Without a least value there is no design to draw.
        candidates = run.candidates[:1] if run.status != "unbounded" else ()
        objective = run.study.objective
        title = "optimum at the neutral pose" if objective.poses or objective.region is not None else "optimum"
        designs = [
            (title, c.geometry, c.configuration, c.neutral_condition_number, c.characteristic_length)
            for c in candidates
        ]
        result, compared = run, {}
    else:
        rows = [("published, best zs", run.best_zs), ("optimum", run.same_class)] if run.same_class is not None else []
        designs = [
            (n, row.geometry, row.configuration, row.condition_number, 1.0) for n, row in rows if row is not None
        ]
        result, compared = run.result, {"level": published.KAPPA, "crossings": run.crossings}
    if result.interrupted or not designs:
        return None
    return lambda: _figures(designs, result, convergence, **compared)


def _figures(designs: list[Drawn], result: Result, convergence: bool, **compared: Any) -> Iterator[Named]:
    """Yield the designs in space, their condition number along zs and theta_z and over poses, and the convergence."""
    unit = "l_c" if compared else result.study.unit  # the paper's unit; a study keeps its own
    note = "" if compared else unit
    region, tool = None if compared else result.study.objective.region, result.study.tool
    where = "" if compared else "the region" if region is not None else "the poses" * bool(result.study.objective.poses)
    worst = f"{result.study.words.split(' over ')[0]} over {where} {result.objective:.4f}; " if where else ""
    panels = []
    for name, g, c, kappa, _ in designs:
        lines = () if region is None else region_lines(region, c)
        plate = tool.plate(c)
        zp, zs = (amount(f"{point[2]:.4f}", note) for point in (plate.position, plate.internal_point))
        panels.append(plot.Robot(name, g, c, kappa, f"{worst}zp = {zp}, zs = {zs}", lines, tool))
    yield "mechanism", plot.mechanisms(panels, unit)
    yield "drawing", plot.drawing(*designs[-1][1:3], note, tool)
    posed = not compared and len(result.solved.objective.poses) > 0
    curves = [_curves(tool, designs[0], **compared), *(_curves(tool, design) for design in designs[1:])]
    yield "condition", plot.condition_curves(_over_poses(result) if posed else curves, unit)
    if not compared and (of_region := region_map(result)) is not None:
        yield "region", plot.region_map(of_region)
    elif result.best is not None and len(result.best.conditions) > 1:
        poses = result.solved.objective.poses  # numbered from 1: pose 0 of the sheet is the neutral one
        of_unit = f", in {unit}" if unit and any(pose.unit != "zp" for pose in poses) else ""
        words = f"Poses, numbered as in the sheet: shifts from the neutral pose{of_unit}, and the rotation vector"
        yield "poses", plot.poses({"optimum": result.best.conditions}, list(map(_pose_name, poses)), note=words)
    if convergence and result.objective is not None and result.solved.free_variables:
        minimax, plain = (_traces(result, formulation) for formulation in ("minimax", "plain"))
        yield "convergence", plot.convergence(minimax, plain, result.objective)


def _pose_name(pose: Pose) -> str:
    """Return the shifts from the neutral pose as a name."""
    scale = " zp" if pose.unit == "zp" else ""
    shifts = [f"{axis} {x:+.3g}{scale}" for axis, x in zip("xyz", pose.position, strict=True) if x]
    turns = [f"θ{axis} {np.degrees(x):+.3g}°" for axis, x in zip("xyz", pose.rotation, strict=True) if x]
    return ", ".join(shifts + turns).replace("-", "\N{MINUS SIGN}") or "neutral"


def _curves(tool: Tool, design: Drawn, level: float | None = None, crossings: tuple[float, ...] = ()) -> DesignCurves:
    name, g, c, kappa, lc = design
    plate = tool.plate(c)
    zp, zs = float(plate.position[2]), float(plate.internal_point[2])
    theta_z = float(np.arctan2(plate.rotation[1, 0], plate.rotation[0, 0]))
    own = tool.plates(g)

    def kappas(heights: Any, turns: Any) -> Any:
        g, c = tool.robot(own, Configuration.neutral(zp, heights, turns))
        return condition_number(g, c, lc)

    heights = np.linspace(0.02, 0.98, 385) * zp
    twists = theta_z + np.radians(np.linspace(-60.0, 60.0, 361))
    around = np.asarray(kappas(zs, theta_z + np.array([-1e-6, 1e-6])))
    compared = level is not None
    return DesignCurves(
        name=name,
        zs=heights,
        along_zs=kappas(heights, theta_z),
        theta_z=twists,
        along_theta_z=kappas(zs, twists),
        point=(zs, theta_z, kappa),
        slope=float(np.diff(around)[0] / 2e-6) if compared else None,
        level=level,
        crossings=crossings,
        least=(zs, kappa) if compared else None,
    )


def _over_poses(result: Result) -> list[DesignCurves]:
    """Return the objective of a study over its poses, or those that ruled its region, and its limits."""
    best, study = result.best, result.solved
    assert best is not None
    home = study.tool.plate(best.configuration)
    zp, own = float(home.position[2]), float(home.internal_point[2])
    turns = [n for n in ("theta_z", "platform_external_angle", "platform_internal_angle") if n in study.variables]
    twist = float(np.arctan2(home.rotation[1, 0], home.rotation[0, 0]))
    zs, lifted = _along(np.linspace(0.02, 0.98, POINTS) * zp, own, lambda z: study.evaluate(best.variables | {"zs": z}))
    turn, turned = _along(
        np.radians(np.linspace(-60.0, 60.0, POINTS)),
        0.0,
        lambda a: study.evaluate(best.variables | {n: best.variables[n] + a for n in turns}),
    )
    is_condition = study.objective.index == "condition_number"
    index, _, over = study.words.partition(" over ")
    if result.region is not None:
        count = len(result.region.poses)
        over = "the pose that ruled the region" if count == 1 else f"the {count} poses that ruled the region"
    zs_kappa, twist_kappa = ([point.neutral_condition_number for point in points] for points in (lifted, turned))
    curves = DesignCurves(
        name=f"{index} over {over}",
        zs=zs,
        along_zs=[point.objective for point in lifted],
        theta_z=twist + turn,
        along_theta_z=[point.objective for point in turned],
        point=(own, twist, best.objective),
        index="condition number" if is_condition else index,
        neutral=(zs_kappa, twist_kappa) if is_condition else None,
        violated=(list(map(_is_violated, lifted)), list(map(_is_violated, turned))),
    )
    return [curves]


def _along(
    grid: Floats, own: float, point_at: Callable[[float], DesignPoint]
) -> tuple[Floats, tuple[DesignPoint, ...]]:
    """Return places and designs there: of a grid, the optimum's own, and both sides of each edge of the limits."""
    row = sorted(((x, point_at(x)) for x in (*grid.tolist(), own)), key=itemgetter(0))
    edges = []
    for low, high in pairwise(row):
        if _is_violated(low[1]) == _is_violated(high[1]):
            continue
        for _ in range(HALVINGS):
            middle = 0.5 * (low[0] + high[0])
            there = (middle, point_at(middle))
            low, high = (there, high) if _is_violated(there[1]) == _is_violated(low[1]) else (low, there)
        edges += [low, high]
    places, points = zip(*sorted(row + edges, key=itemgetter(0)), strict=True)
    return np.array(places), points


def _is_violated(point: DesignPoint) -> bool:
    return any(is_violated(margin) for margin in point.margins.values())


def _traces(result: Result, formulation: str) -> list[tuple[float, ...]]:
    """Return the course of single starts, low-discrepancy ones."""
    study = result.solved
    problem = study.problem()
    count = max(FEWEST_TRACED, TRACED_STARTS // (1 + len(study.objective.poses)))
    rows = problem.starts(count, study.seed)
    return [trace(study, dict(zip(problem.names, x.tolist(), strict=True)), formulation).best for x in rows]
