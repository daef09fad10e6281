"""Leg lengths, velocity matrices, rates and accelerations; all assembly modes of given lengths, and tracking of one."""
