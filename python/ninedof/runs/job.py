"""From a result to a run folder: gather what the figures show, draw them, write the record."""

from __future__ import annotations

import itertools
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ninedof.chunks.store import MANIFEST
from ninedof.conditioning.conditioning import condition_number
from ninedof.optimize.optimize import trace
from ninedof.optimize.result import Result
from ninedof.paper import published
from ninedof.paper.comparison import Comparison, Row
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.runs.records import Record, describe_result, write_record

if TYPE_CHECKING:
    from ninedof.plot import DesignCurves

__all__ = ["new_directory", "record_comparison", "record_result", "run_directory"]

Say = Callable[[str], object]
"""Told what is being done, a few words at a time."""

Named = tuple[str, Geometry, Configuration, float, float]
"""A design to draw: name, geometry, neutral configuration, condition number there, characteristic length."""

RUNS = Path("runs")
TRACED_STARTS = 200  # runs shown in the convergence figure, at one pose
FEWEST_TRACED = 10  # however many poses a run has to look at


def new_directory(out: Path | None) -> Path:
    """Create the run folder before any work is done: `out`, or runs/<time> here.

    An existing folder must be empty: a run never overwrites another.
    """
    if out is not None:
        if out.exists() and (not out.is_dir() or any(out.iterdir())):
            raise ValueError(f"out: got {out}, which exists and is not an empty folder, expected a new one")
        _create(out, exist_ok=True)
        return out
    stamp = datetime.now().strftime("%Y%m%d-%H%M%S")
    for attempt in itertools.count():
        path = RUNS / (f"{stamp}-{attempt}" if attempt else stamp)
        if _create(path, exist_ok=False):
            return path
    raise AssertionError("unreachable")


@contextmanager
def run_directory(out: Path | None) -> Iterator[Path]:
    """Create the run folder as `new_directory` does; input refused before anything was kept takes it away again."""
    there = out is not None and out.exists()
    directory = new_directory(out)
    try:
        yield directory
    except ValueError:
        if not any(path.is_file() and not _is_preparation(path) for path in directory.rglob("*")):
            _remove(directory, there)
        raise


def _is_preparation(path: Path) -> bool:
    return path.name.startswith(".") or path.name == MANIFEST


def _remove(directory: Path, keep: bool) -> None:
    for entry in directory.iterdir():
        shutil.rmtree(entry) if entry.is_dir() else entry.unlink()
    if not keep:
        directory.rmdir()
        if directory.parent == RUNS:
            with suppress(OSError):  # other runs are there
                RUNS.rmdir()


def _create(path: Path, exist_ok: bool) -> bool:
    """Create a folder; return whether it is ours."""
    try:
        path.mkdir(parents=True, exist_ok=exist_ok)
    except FileExistsError:
        return False
    except OSError as error:
        reason = error.strerror
        raise ValueError(f"out: got {path}, which cannot be created ({reason}), expected a writeable place") from None
    return True


def record_comparison(c: Comparison, directory: Path, figures: bool, say: Say) -> Path:
    """Write the run folder of the paper's problem; return the path of the record."""
    results = {
        "published": {"a1": published.A1, "b1": published.B1, "zp": published.ZP, "condition_number": published.KAPPA},
        "as_printed": c.as_printed,
        "why": c.why,
        "designs": [describe_row(row) for row in c.rows()],
        "optimization": describe_result(c.result),
    }
    designs = [("published, best zs", c.best_zs), ("optimum", c.same_class)] if c.same_class is not None else []
    named = [
        (name, row.geometry, row.configuration, row.condition_number, 1.0) for name, row in designs if row is not None
    ]
    compared = {"level": published.KAPPA, "crossings": c.crossings}
    return _record(c.result, results, named if figures else [], directory, say, **compared)


def record_result(result: Result, directory: Path, figures: bool, say: Say) -> Path:
    """Write the run folder of a study; return the path of the record."""
    # Without a least value there is no design to draw.
    shown = result.candidates[:1] if result.status != "unbounded" else ()
    named = [("optimum", c.geometry, c.configuration, c.condition_number, c.characteristic_length) for c in shown]
    return _record(result, {"optimization": describe_result(result)}, named if figures else [], directory, say)


def _record(
    result: Result, results: dict[str, Any], designs: list[Named], directory: Path, say: Say, **compared: Any
) -> Path:
    """Write the record, then the figures, then the record again with their names: an interruption loses no result."""
    record = Record(result.study, results)
    path = write_record(record, directory)
    if designs and not result.interrupted:
        files = _figures(designs, result, directory, say, **compared)
        write_record(replace(record, files=tuple(f.name for f in files)), directory)
    return path


def describe_row(row: Row) -> dict[str, Any]:
    """Return a row of the comparison as plain JSON values."""
    return {
        "title": row.title,
        "variables": row.variables,
        "condition_number": row.condition_number,
        "leg_lengths": dict(zip(("l", "q", "r"), row.legs, strict=True)),
        "radius_ratio": row.radius_ratio,
        "gain_percent": row.gain,
        "active": list(row.active),
    }


def _figures(
    designs: list[Named],
    result: Result,
    directory: Path,
    say: Say,
    **compared: Any,
) -> list[Path]:
    """Draw the designs in space, their condition number along zs and theta_z, and the convergence."""
    say("drawing the mechanisms")
    from ninedof import plot

    panels = [plot.Mechanism(name, g, c, kappa, _heights(c)) for name, g, c, kappa, _ in designs]
    unit = "l_c" if compared else ""  # the paper's unit; a study keeps its own
    files = plot.save(plot.mechanisms(panels, unit), directory, "mechanism")
    say("drawing the condition number along zs and theta_z")
    curves = [_curves(*designs[0], **compared), *(_curves(*design) for design in designs[1:])]
    files += plot.save(plot.condition_curves(curves, unit), directory, "condition")
    if result.best is not None and len(result.best.conditions) > 1:
        say("drawing the condition number at each pose")
        looked_at = plot.PoseConditions("optimum", result.best.conditions)
        files += plot.save(plot.poses([looked_at]), directory, "poses")
    say("drawing the convergence")
    runs = {formulation: _traces(result, formulation) for formulation in ("minimax", "plain")}
    if runs["minimax"] and result.objective is not None:
        files += plot.save(plot.convergence(runs["minimax"], runs["plain"], result.objective), directory, "convergence")
    return files


def _heights(c: Configuration) -> str:
    return f"zp = {c.position[2]:.4f}, zs = {c.internal_point[2]:.4f}"


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
    """Follow single runs from low-discrepancy starts; none where no variable is free."""
    study = result.study
    if not any(isinstance(bound, tuple) for bound in study.variables.values()):
        return []
    problem = study.problem()
    count = max(FEWEST_TRACED, TRACED_STARTS // (1 + len(study.objective.poses)))
    rows = problem.starts(count, study.seed)
    return [trace(study, dict(zip(problem.names, x.tolist(), strict=True)), formulation).best for x in rows]
