"""Imports of optional packages; the error says what to install."""

from __future__ import annotations

import importlib
from typing import Any

__all__ = ["MissingExtra", "optional"]


class MissingExtra(ImportError):
    """A package that only some users need is not installed."""


def optional(module: str, extra: str, purpose: str) -> Any:
    """Import an optional package.

    Parameters
    ----------
    module : str
        Its name, as "xarray".
    extra : str
        The extra of this package that installs it.
    purpose : str
        What it is needed for, as the subject of a sentence.

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
