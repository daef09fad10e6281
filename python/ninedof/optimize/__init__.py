"""The optimizer, its result, its lower bounds and its summary; `pareto` has fronts, trade-offs with one limit."""
