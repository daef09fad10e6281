"""Optional packages, imported in one place with a message that says what to install."""

from __future__ import annotations

import importlib
from typing import Any


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
