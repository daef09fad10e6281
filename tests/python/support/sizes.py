"""Sizes of cases: quick ones by default, long ones where the environment has NINEDOF_LONG=1."""

import os

LONG = os.environ.get("NINEDOF_LONG") == "1"


def size(quick, long):
    """How many cases, points or steps: `long` for a thorough run, `quick` otherwise."""
    return long if LONG else quick
