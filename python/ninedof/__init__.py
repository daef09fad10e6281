"""Kinematic design of the nine-degree-of-freedom redundant parallel manipulator of Zanganeh and Angeles.

A public name is loaded when it is first used; with figures, which are in `ninedof.plot`, matplotlib is.
"""

from ninedof.support import starting as _starting  # noqa: F401  # first: signals while the rest is loaded

# isort: split
import ast as _ast
import sys as _sys
from importlib import import_module as _import_module
from pathlib import Path as _Path
from types import ModuleType as _ModuleType

try:
    from ninedof import _core
except ImportError as error:
    if "subinterpreter" in str(error):
        raise
    # A source tree without its compiled part.
    raise ImportError(
        "the compiled part of ninedof (ninedof._core) is missing or does not fit this Python: "
        "install the package with `pip install .` from its source directory and import it from elsewhere"
    ) from error

# The stub is the list of public names for people, type checkers and this file.
_MODULES = ("plot", "poses")
_PLACES = {
    one.name: line.module or ""
    for line in _ast.parse(_Path(__file__).with_suffix(".pyi").read_text("utf-8")).body
    if isinstance(line, _ast.ImportFrom)
    for one in line.names
}
__version__: str = _core.version
__all__ = sorted(_PLACES.keys() - {*_MODULES})


class _Package(_ModuleType):
    """The package, where `optimize` is the function: importing the room of that name does not take its place."""

    def __setattr__(self, name, value):
        if name not in __all__ or not isinstance(value, _ModuleType):
            super().__setattr__(name, value)

    def __reduce__(self):  # cloudpickle, and so Dask, looks modules up by their type, and this is another one
        return _import_module, (self.__name__,)


_sys.modules[__name__].__class__ = _Package


def __getattr__(name):
    """Load a public name when it is first used."""
    if name not in _PLACES:
        raise AttributeError(f"module 'ninedof' has no attribute {name!r}")
    place = f"{__name__}.{_PLACES[name]}".rstrip(".")
    value = _import_module(f"{place}.{name}") if name in _MODULES else getattr(_import_module(place), name)
    globals()[name] = value
    return value


def __dir__():
    """Return all names, those too that are not loaded yet."""
    return sorted({*globals(), *_PLACES})
