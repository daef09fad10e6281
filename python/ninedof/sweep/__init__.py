"""Sweeps and atlases: an index over a grid of configurations or of designs, and surveys of many designs.

`axis` has the points, `points` the robots there, `grid` the work, `survey` the designs of an `atlas`;
`support.kept.chunks` computes both, in memory, in a folder or on a cluster; `result` has the labelled arrays.
"""

from ninedof.sweep.atlas import atlas
from ninedof.sweep.result import SweepResult
from ninedof.sweep.run import sweep, sweep_designs

__all__ = ["SweepResult", "atlas", "sweep", "sweep_designs"]
