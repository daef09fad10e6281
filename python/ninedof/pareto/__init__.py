"""Trade-offs: the best objective for each value of a limit.

`tracing` holds what a caller calls, `front` what it returns; `sweep` solves and `span` finds where to.
"""

from ninedof.pareto.front import Front
from ninedof.pareto.tracing import pareto

__all__ = ["Front", "pareto"]
