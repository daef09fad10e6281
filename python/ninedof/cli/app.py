"""The command line: registers the commands and runs the one that was asked for."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from importlib import import_module
from pkgutil import walk_packages
from typing import Annotated, Any

import typer
from typer.core import TyperGroup

from ninedof.cli import commands
from ninedof.cli.answer import command
from ninedof.cli.ending import finish, interruptible
from ninedof.support.running import running

PROGRAM = "ninedof"
COMPLETE = f"_{PROGRAM.upper()}_COMPLETE"  # set by a shell that completes a line
OWN = ("-h", "--help", "--version", "--install-completion", "--show-completion")  # options of no command
DEFAULT = "optimize"  # the command of a line that begins with a study file or an option
# In --help; the other commands are between them by their names.
FIRST = ("optimize", "pareto", "compare", "evaluate", "failure", "report", "sheet", "view")
LAST = ("atlas", "workspace", "paper", "path")


def _with_command(words: Sequence[str]) -> list[str]:
    needs_it = not words or words[0].endswith(".toml") or (words[0].startswith("-") and words[0] not in OWN)
    return [DEFAULT, *words] if needs_it else list(words)


class _Commands(TyperGroup):
    """The commands; a shell completes a line without one as one of the default command."""

    def make_context(self, info_name: str | None, args: list[str], *more: Any, **extra: Any) -> Any:
        return super().make_context(info_name, _with_command(args) if args else args, *more, **extra)

    def shell_complete(self, ctx: Any, incomplete: str) -> Any:
        items = super().shell_complete(ctx, incomplete)
        if incomplete.startswith("-") and (default := self.get_command(ctx, DEFAULT)) is not None:
            inner = default.make_context(DEFAULT, [], parent=ctx, resilient_parsing=True)
            own = {item.value for item in items}
            items += [item for item in default.shell_complete(inner, incomplete) if item.value not in own]
        return items


def _version(value: bool) -> None:
    if value:
        from ninedof import __version__

        typer.echo(__version__)
        raise typer.Exit


def _root(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version and exit.")
    ] = False,
) -> None:
    pass


FILES = {
    one.name.rpartition(".")[2]: one.name
    for one in walk_packages(commands.__path__, f"{commands.__name__}.")
    if not one.ispkg
}
"""The modules of the commands by their names."""


def app(*names: str) -> typer.Typer:
    """Return the program with some commands, by default with all: each has its rooms to load."""
    program = typer.Typer(
        cls=_Commands,
        no_args_is_help=False,
        rich_markup_mode="rich",
        pretty_exceptions_enable=False,
        context_settings={"help_option_names": ["-h", "--help"]},
        help="Optimum design of the nine-degree-of-freedom parallel manipulator of Zanganeh and Angeles.",
        epilog="Without a command: [bold]ninedof optimize[/bold], the paper's design problem. Exit status: 0 done, "
        "1 refused by the system (a file, the disk), 2 bad input, 3 no acceptable result, 4 a failure of memory, a "
        "library or a cluster, 130 interrupted.",
    )
    program.callback()(_root)
    for name in names or (*FIRST, *sorted(FILES.keys() - {*FIRST, *LAST}), *LAST):
        module = import_module(FILES[name])
        examples = module.EXAMPLES.replace("\n", "\n\n")  # a paragraph each
        program.command(epilog=f"[bold]Examples[/bold]{examples}")(command(getattr(module, name)))
    return program


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line and end with its exit status; an error is one line on standard error."""
    words = _with_command(sys.argv[1:] if arguments is None else arguments)
    if not os.environ.get("COLUMNS", "1").strip("0"):
        del os.environ["COLUMNS"]  # nothing can be written on no columns: as wide as the terminal
    names = FILES.keys() & {words[0]} if COMPLETE not in os.environ else ()
    program = app(*names)
    with interruptible(), running(PROGRAM, words):
        raise SystemExit(finish(lambda: program(words, prog_name=PROGRAM, standalone_mode=False), words))
