"""The optimizer, its result, its lower bounds and its summary."""
