"""Trade-offs: the best objective for each value of a limit.

`tracing` has the public function, `front` its result. `solving` solves the limits and finds their range.
"""

from ninedof.optimize.pareto.front import Front
from ninedof.optimize.pareto.tracing import pareto

__all__ = ["Front", "pareto"]
