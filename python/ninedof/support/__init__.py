"""Arrays, arguments, angles and optional dependencies, independent of robots."""
