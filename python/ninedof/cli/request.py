"""A command is a struct of options and a call: the fields of the struct are what the parser reads."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields
from inspect import Parameter, Signature, get_annotations
from typing import Any, TypeVar, get_type_hints

R = TypeVar("R")


def request(kind: type[R]) -> Callable[[Callable[[R], None]], Callable[..., None]]:
    """Return a decorator that makes a command of a call with one struct, a dataclass whose fields have typer's marks.

    Options that a class shares with others, in a class that it derives from, come last.
    """
    marks = get_type_hints(kind, include_extras=True)
    defaults = {field.name: field.default for field in fields(kind)}  # type: ignore[arg-type]  # a dataclass
    names = dict.fromkeys(name for of in kind.__mro__ for name in get_annotations(of))
    parameters = [
        Parameter(name, Parameter.KEYWORD_ONLY, default=defaults[name], annotation=marks[name])
        for name in names
        if name in defaults
    ]

    def decorate(call: Callable[[R], None]) -> Callable[..., None]:
        def command(**options: Any) -> None:
            call(kind(**options))

        command.__name__, command.__doc__ = call.__name__, call.__doc__
        command.__annotations__ = {one.name: one.annotation for one in parameters}
        command.__signature__ = Signature(parameters)  # type: ignore[attr-defined]
        return command

    return decorate
