"""The reference of the command line: a page for each command, from what its `--help` is made of."""

from __future__ import annotations

import re
from typing import Any

import typer

from ninedof.cli.app import app

WORDS = {"str": "text", "int": "integer", "float": "number", "Path": "file"}


def all_commands() -> dict[str, Any]:
    """Return the commands by name, in the order of `ninedof --help`."""
    return dict(typer.main.get_command(app()).commands)  # type: ignore[attr-defined]


def pages() -> dict[str, str]:
    """Return the Markdown of each page; the first digits of its name put it in its place."""
    return {f"{k:02}-{name}": page(name, command) for k, (name, command) in enumerate(all_commands().items(), 1)}


def page(name: str, command: Any) -> str:
    """Return the page of a command."""
    arguments = [p for p in command.params if p.param_type_name == "argument"]
    options = [p for p in command.params if p.param_type_name == "option"]
    usage = " ".join(["ninedof", name, *(shown(argument) for argument in arguments), "[OPTIONS]"])
    lines = [f"# ninedof {name}", "", prose(command.help), "", "```bash", usage, "```", ""]
    if arguments:
        lines += ["## Arguments", "", *table(("argument", "meaning"), [row(p, shown(p)) for p in arguments]), ""]
    lines += ["## Options", "", *table(("option", "meaning"), [row(p, spelled(p)) for p in options]), ""]
    return "\n".join(lines + examples(command.epilog or ""))


def shown(argument: Any) -> str:
    """Return an argument as usage lines have it: in brackets where it may be left out."""
    word = str(argument.name).upper() + "..." * (argument.nargs == -1)
    return word if argument.required else f"[{word}]"


def spelled(option: Any) -> str:
    """Return an option with the kind of its value."""
    names = " / ".join([*option.opts, *option.secondary_opts])
    if option.is_flag:
        return names
    kind = getattr(option.type_descriptor.annotation, "__name__", "") or ""
    inner = re.match(r"list\[(\w+)\]", str(option.type_descriptor.annotation))
    word = WORDS.get(inner[1] if inner else kind, "value")
    count = option.nargs if isinstance(option.nargs, int) and option.nargs > 1 else 1
    return f"{names} {' '.join([f'<{word}>'] * count)}"


def row(parameter: Any, word: str) -> tuple[str, str]:
    """Return a row of a table: how the parameter is written, what it means and its default."""
    meaning = prose(parameter.help or "")
    default = parameter.default
    if parameter.required:
        meaning += " Required."
    elif isinstance(default, (int, float, str)) and not isinstance(default, bool):
        meaning += f" Default: `{default}`."
    return f"`{word}`", meaning


def table(titles: tuple[str, str], rows: list[tuple[str, str]]) -> list[str]:
    """Return the lines of a Markdown table."""
    return [
        f"| {' | '.join(cells)} |".replace("\n", " ")
        for cells in (titles, ("---", "---"), *((a, b.replace("|", "\\|")) for a, b in rows))
    ]


def prose(text: str) -> str:
    """Return help text as Markdown: rich's markup removed, signs of Markdown escaped."""
    return re.sub(r"([*<\[\]_])", r"\\\1", re.sub(r"\[/?\w+\]", "", text.strip()))


def examples(epilog: str) -> list[str]:
    """Return the examples at the end of the help text, as lines of a page."""
    lines = [line.strip() for line in re.sub(r"\[/?\w+\]", "", epilog).splitlines()]
    lines = [line for line in lines if line and line not in ("Example", "Examples")]
    lines = [re.sub(r"\s{3,}", "  # ", line, count=1) for line in lines]  # what follows a wide gap is said, not typed
    return ["## Examples", "", "```bash", *lines, "```", ""] if lines else []
