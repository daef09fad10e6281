"""Designs, one or several: their plates in plan, and their condition numbers over heights, turns and lists of poses."""
