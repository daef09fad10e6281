"""`ninedof atlas`: a survey of the hexagonal family."""

from __future__ import annotations

import math
from functools import partial

import numpy as np

import ninedof as nd
from ninedof.cli.answer import Figures
from ninedof.cli.options import option, struct
from ninedof.cli.sweep_job import Job
from ninedof.conditioning.hexagonal import HEXAGONAL
from ninedof.sweep.result import atlas_table
from ninedof.sweep.survey import RADIUS_RATIO, squared_radius_ratio

EXAMPLES = """
  ninedof atlas                                        a million designs
  ninedof atlas --designs 100000000 --out atlas        a hundred million; again after an interruption"""


@struct
class _Options(Job):
    designs: int = option("Number of designs.", 1_000_000)
    seed: int = option("Shifts the sequence of designs.", 0)


def atlas(job: _Options) -> None:
    """Survey the hexagonal family: the distribution of its designs, and the best for each size of the base."""
    result, folder = job.compute(partial(nd.atlas, job.designs, job.seed), f"{job.designs:,} designs")
    rows = [
        {
            RADIUS_RATIO: float(low),
            "condition_number": float(kappa),
            "design": dict(zip(result["variable"].tolist(), design.tolist(), strict=True)),
        }
        for low, kappa, design in zip(result[RADIUS_RATIO], result["best"], result["design"], strict=True)
        if np.isfinite(kappa)
    ]
    data = {"atlas": {"designs": int(result["histogram"].sum()), "best": rows}}
    job.write(result, folder, data, atlas_table(rows), lambda: _figures(result))


def _figures(result: nd.SweepResult) -> Figures:
    best = nd.optimize(nd.Study.paper()).best
    assert best is not None, "the paper's study has an optimum"
    sides = np.array([[best.variables[name] for name in HEXAGONAL]])
    yield "atlas", nd.plot.atlas(result, (math.sqrt(squared_radius_ratio(sides)[0]), best.condition_number))
