"""Design studies: families, limits, objectives, poses and study files."""
