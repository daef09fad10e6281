"""Sweeps: an index over a grid of configurations or of designs.

`axis` says where the points are, `index` what is computed there, `poses` and `variants` make robots of the points,
`result` is what a caller gets; `run` and `figures` hold what a caller calls.
"""

from ninedof.sweep.figures import sweep_figure
from ninedof.sweep.result import SweepResult
from ninedof.sweep.run import sweep, sweep_designs

__all__ = ["SweepResult", "sweep", "sweep_designs", "sweep_figure"]
