"""Arrays, arguments, angles and optional dependencies: knows nothing of robots."""
