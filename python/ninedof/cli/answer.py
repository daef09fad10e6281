"""A command: a call that takes a struct of options, and what it answers."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import MISSING, fields
from inspect import Parameter, Signature, get_annotations
from typing import Any, NamedTuple, get_type_hints

import typer

from ninedof.cli.screen import DONE, Screen


class Answer(NamedTuple):
    """What a command has to say."""

    parts: Iterable[Any]
    """Sentences and tables."""
    data: Any
    """For --json."""
    status: int = DONE

    def show(self, json: bool) -> None:
        """Print it and end with its status."""
        screen = Screen(json)
        screen.print(*self.parts)
        screen.data(self.data)
        raise typer.Exit(self.status)


def command(call: Callable[..., Answer | None]) -> Callable[..., object]:
    """Return a command of a call that takes a struct of options; options that it shares with others come last."""
    kind: Any = next(iter(get_type_hints(call).values()))
    marks = get_type_hints(kind, include_extras=True)
    defaults = {one.name: Parameter.empty if one.default is MISSING else one.default for one in fields(kind)}
    names = dict.fromkeys(name for part in kind.__mro__ for name in get_annotations(part))

    def parsed(**values: Any) -> None:
        options: Any = kind(**values)
        answer = call(options)
        if answer is not None:
            answer.show(options.json)

    parsed.__name__, parsed.__doc__ = call.__name__, call.__doc__
    parsed.__signature__ = Signature(  # type: ignore[attr-defined]  # what typer reads
        [
            Parameter(name, Parameter.KEYWORD_ONLY, default=defaults[name], annotation=marks[name])
            for name in names
            if name in defaults
        ]
    )
    parsed.__annotations__ = {}
    return parsed
