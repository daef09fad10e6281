"""Trade-offs: the best objective for each value of a limit.

`tracing` has the public function, `front` its result. `solving` solves the limits and finds their range.
"""

from ninedof.pareto.front import Front
from ninedof.pareto.tracing import pareto

__all__ = ["Front", "pareto"]
