"""The reference of the command line: a page for each command, from the records of its `--help`."""

from __future__ import annotations

import re
from typing import Any

import typer

from ninedof.cli.app import app


def all_commands() -> dict[str, Any]:
    """Return the commands by name, in the order of `ninedof --help`."""
    return dict(typer.main.get_group(app()).commands)


def pages() -> dict[str, str]:
    """Return the Markdown of each page; the first digits of its name put it in its place."""
    return {f"{k:02}-{name}": page(name, command) for k, (name, command) in enumerate(all_commands().items(), 1)}


def page(name: str, command: Any) -> str:
    """Return the page of a command."""
    context = typer.Context(command, info_name=name)
    usage = " ".join(["ninedof", name, *command.collect_usage_pieces(context)])
    lines = [f"# ninedof {name}", "", prose(command.help), "", "```bash", usage, "```", ""]
    for kind in ("argument", "option"):
        records = [p.get_help_record(context) for p in command.params if p.param_type_name == kind]
        if records:
            lines += [f"## {kind.capitalize()}s", "", f"| {kind} | meaning |", "| --- | --- |"]
            lines += [f"| `{word(name)}` | {prose(meaning)} |" for name, meaning in records] + [""]
    return "\n".join(lines + examples(command.epilog or ""))


def word(name: str) -> str:
    """Return the name of an argument or option as a cell of a table: any list is told by its entries."""
    return re.sub(r"list\[(\w+)\]", r"\1", name).replace("|", "\\|")


def prose(text: str) -> str:
    """Return help text as Markdown, its signs escaped."""
    return re.sub(r"([*<\[\]_|])", r"\\\1", text.strip())


def examples(epilog: str) -> list[str]:
    """Return the examples at the end of the help text, as lines of a page."""
    lines = [line.strip() for line in epilog.splitlines() if line.strip() and "[/bold]" not in line]
    lines = [re.sub(r"\s{3,}", "  # ", line, count=1) for line in lines]  # what follows a wide gap is a comment
    return ["## Examples", "", "```bash", *lines, "```", ""] if lines else []
