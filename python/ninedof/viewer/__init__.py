"""A design to move by hand, in a browser."""
