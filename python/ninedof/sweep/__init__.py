"""Sweeps: an index over a grid of configurations or of designs.

`axis` has the points, `index` the quantities, `poses` and `variants` the robots at the points, `work` the chunks,
`result` the labelled arrays. The public functions are in `run`.
"""

from ninedof.sweep.result import SweepResult
from ninedof.sweep.run import sweep, sweep_designs

__all__ = ["SweepResult", "sweep", "sweep_designs"]
