"""The names of the nine legs."""

LEGS = tuple(f"{kind}{i}" for kind in "lqr" for i in (1, 2, 3))
"""External, upper and lower internal: the order of `leg_lengths`."""
