"""Statements that hold with certainty, by interval arithmetic."""
