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
    """Return an optional package, or raise with the command that installs it.

    Parameters
    ----------
    module : str
        Name of the module, such as "xarray".
    extra : str
        The extra of ninedof that installs it.
    purpose : str
        What needs it, as the subject of a sentence.

    Raises
    ------
    MissingExtra
        Naming the package, what needs it and what to install.

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
