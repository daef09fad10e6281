"""Optional packages, with a message that says what to install, and the versions that results depend on."""

from __future__ import annotations

import importlib
import platform
from typing import Any

import numpy as np

from ninedof import _core


class MissingExtra(ImportError):
    """An optional package is not installed."""


def optional(module: str, extra: str, purpose: str) -> Any:
    """Return an optional module, or raise MissingExtra with the extra of ninedof that installs it.

    `purpose` is what needs it, as the subject of a sentence.
    """
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise MissingExtra(
            f"{purpose} needs {module}, which cannot be imported ({error}): pip install 'ninedof[{extra}]'"
        ) from None


def versions() -> dict[str, str]:
    """Return the versions of the package, of Python, of numpy and of what the core was built with."""
    return {
        "ninedof": _core.version,
        "python": platform.python_version(),
        "numpy": np.__version__,
        "machine": platform.machine(),
        **_core.built_with,
    }
