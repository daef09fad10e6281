"""Figures do without a backend of matplotlib, so one that is not there does not matter: imported before matplotlib is.

matplotlib refuses to be imported with a MPLBACKEND that it does not know.
"""

from __future__ import annotations

import os
import sys
from contextlib import suppress

VARIABLE = "MPLBACKEND"


def load() -> None:
    """Import matplotlib, whatever backend the environment names."""
    named = os.environ.get(VARIABLE)
    if not named or "matplotlib" in sys.modules:
        return
    del os.environ[VARIABLE]
    try:
        import matplotlib
    finally:
        os.environ[VARIABLE] = named
    with suppress(ValueError):  # what matplotlib does itself on being imported
        matplotlib.rcParams["backend"] = named


load()
