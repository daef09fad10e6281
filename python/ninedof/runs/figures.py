"""The figures of a study's run: mechanisms, condition number about the design and at each pose, convergence."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ninedof.conditioning.conditioning import condition_number
from ninedof.optimize.optimize import trace
from ninedof.optimize.result import Result
from ninedof.paper import published
from ninedof.paper.comparison import Comparison
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.units import amount

if TYPE_CHECKING:
    from ninedof.plot import DesignCurves

Say = Callable[[str], object]
"""Called with a few words about what is being drawn."""

Named = tuple[str, Geometry, Configuration, float, float]
"""A design to draw: name, geometry, neutral configuration, condition number there, characteristic length."""

TRACED_STARTS = 200  # runs shown in the convergence figure, at one pose
FEWEST_TRACED = 10  # however many poses each run evaluates


def figures_of(run: Result | Comparison, say: Say) -> Callable[[Path], list[Path]] | None:
    """Return a function that draws the figures into a folder; None for an interrupted run or one without an optimum."""
    designs: list[Named]
    if isinstance(run, Result):
        # Without a least value there is no design to draw.
        shown = run.candidates[:1] if run.status != "unbounded" else ()
        designs = [("optimum", c.geometry, c.configuration, c.condition_number, c.characteristic_length) for c in shown]
        result, compared = run, {}
    else:
        rows = [("published, best zs", run.best_zs), ("optimum", run.same_class)] if run.same_class is not None else []
        named = [(name, row) for name, row in rows if row is not None]
        designs = [(name, row.geometry, row.configuration, row.condition_number, 1.0) for name, row in named]
        result, compared = run.result, {"level": published.KAPPA, "crossings": run.crossings}
    if result.interrupted or not designs:
        return None
    return lambda directory: _figures(designs, result, directory, say, **compared)


def _figures(designs: list[Named], result: Result, directory: Path, say: Say, **compared: Any) -> list[Path]:
    """Draw the designs in space, their condition number along zs and theta_z, and the convergence."""
    say("drawing the mechanisms")
    from ninedof import plot

    unit = "l_c" if compared else result.study.unit  # the paper's unit; a study keeps its own
    note = "" if compared else unit
    panels = [plot.Mechanism(name, g, c, kappa, _heights(c, note)) for name, g, c, kappa, _ in designs]
    files = plot.save(plot.mechanisms(panels, unit), directory, "mechanism")
    say("drawing the condition number along zs and theta_z")
    curves = [_curves(*designs[0], **compared), *(_curves(*design) for design in designs[1:])]
    files += plot.save(plot.condition_curves(curves, unit), directory, "condition")
    if result.best is not None and len(result.best.conditions) > 1:
        say("drawing the condition number at each pose")
        conditions = plot.PoseConditions("optimum", result.best.conditions)
        files += plot.save(plot.poses([conditions]), directory, "poses")
    say("drawing the convergence")
    runs = {formulation: _traces(result, formulation) for formulation in ("minimax", "plain")}
    if runs["minimax"] and result.objective is not None:
        files += plot.save(plot.convergence(runs["minimax"], runs["plain"], result.objective), directory, "convergence")
    return files


def _heights(c: Configuration, unit: str) -> str:
    zp, zs = (amount(f"{point[2]:.4f}", unit) for point in (c.position, c.internal_point))
    return f"zp = {zp}, zs = {zs}"


def _curves(
    name: str,
    g: Geometry,
    c: Configuration,
    kappa: float,
    lc: float,
    level: float | None = None,
    crossings: tuple[float, ...] = (),
) -> DesignCurves:
    from ninedof.plot import DesignCurves

    zp, zs = float(c.position[2]), float(c.internal_point[2])
    theta_z = float(np.arctan2(c.rotation[1, 0], c.rotation[0, 0]))
    heights = np.linspace(0.02, 0.98, 385) * zp
    twists = theta_z + np.radians(np.linspace(-60.0, 60.0, 361))
    around = np.asarray(condition_number(g, Configuration.neutral(zp, zs, theta_z + np.array([-1e-6, 1e-6])), lc))
    compared = level is not None
    return DesignCurves(
        name=name,
        zs=heights,
        along_zs=condition_number(g, Configuration.neutral(zp, heights, theta_z), lc),
        theta_z=twists,
        along_theta_z=condition_number(g, Configuration.neutral(zp, zs, twists), lc),
        point=(zs, theta_z, kappa),
        slope=float(np.diff(around)[0] / 2e-6) if compared else None,
        level=level,
        crossings=crossings,
        least=(zs, kappa) if compared else None,
    )


def _traces(result: Result, formulation: str) -> list[tuple[float, ...]]:
    """Return the course of single starts, low-discrepancy ones; none where no variable is free."""
    study = result.solved
    if not any(isinstance(bound, tuple) for bound in study.variables.values()):
        return []
    problem = study.problem()
    count = max(FEWEST_TRACED, TRACED_STARTS // (1 + len(study.objective.poses)))
    rows = problem.starts(count, study.seed)
    return [trace(study, dict(zip(problem.names, x.tolist(), strict=True)), formulation).best for x in rows]
