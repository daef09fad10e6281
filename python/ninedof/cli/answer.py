"""A command: a call that takes a struct of options, and what it answers."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable
from dataclasses import MISSING, fields
from typing import Any, NamedTuple, get_type_hints

import typer

from ninedof.cli.options import Options
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


def expanded(call: Callable[..., object]) -> Callable[..., object]:
    """Return a command whose parameters are the fields of the one struct that `call` takes, its own ones first."""
    kind: Any = next(iter(get_type_hints(call).values()), None)
    if not isinstance(kind, type) or not issubclass(kind, Options):
        return call
    hints = get_type_hints(kind, include_extras=True)
    order = [name for part in kind.__mro__ for name in inspect.get_annotations(part)]
    known = sorted(fields(kind), key=lambda field: order.index(field.name))

    def command(**values: Any) -> object:
        asked = kind(**values)
        answer = call(asked)
        if isinstance(answer, Answer):
            answer.show(asked.json)
        return answer

    command.__signature__ = inspect.Signature(  # type: ignore[attr-defined]
        [
            inspect.Parameter(
                field.name,
                inspect.Parameter.KEYWORD_ONLY,
                default=inspect.Parameter.empty if field.default is MISSING else field.default,
                annotation=hints[field.name],
            )
            for field in known
        ]
    )
    command.__doc__, command.__name__, command.__annotations__ = call.__doc__, call.__name__, {}
    return command
