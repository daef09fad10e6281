"""The best internal point for a pose, along a path and over a map."""
