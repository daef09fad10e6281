"""The versions that results depend on."""

from __future__ import annotations

import platform

import numpy as np

from ninedof import _core


def versions() -> dict[str, str]:
    """Return the versions of the package, of Python, of numpy and of what the core was built with."""
    return {
        "ninedof": _core.version,
        "python": platform.python_version(),
        "numpy": np.__version__,
        "machine": platform.machine(),
        **_core.built_with,
    }
