"""Leg lengths, velocity matrices, rates and accelerations."""
