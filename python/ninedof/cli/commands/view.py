"""`ninedof view`: a design in the browser, to move by hand."""

from __future__ import annotations

import sys
import warnings
import webbrowser
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from ninedof.cli.options import DesignOrPublished
from ninedof.support.extras import MissingExtra
from ninedof.viewer import view as view_of

PLACE = 3
EXAMPLES = """[bold]Examples[/bold]

  ninedof view runs/20260101-120000                   the best design of a run, with the limits of its study

  ninedof view design.toml --path path.csv --port 0   with a path to play, at any free port

  ninedof view                                        the published design"""


@dataclass(frozen=True, kw_only=True)
class ViewOptions:
    """The options."""

    design: DesignOrPublished = None
    path: Annotated[Path | None, typer.Option(help="Poses to play: a CSV file as of `ninedof path`.")] = None
    host: Annotated[
        str, typer.Option(help="Address to listen at; 0.0.0.0 is reached from the whole network, without a password.")
    ] = "127.0.0.1"
    port: Annotated[int, typer.Option(help="Port; 0 takes any free one.")] = 8080
    dark: Annotated[bool, typer.Option("--dark", help="Dark colours.")] = False
    browser: Annotated[bool, typer.Option("--open", help="Open the page in the browser.")] = False


def view(options: ViewOptions) -> None:
    """Show a design in the browser, to move by hand: platform, O, variables; numbers and limits follow.

    Needs the extra `viewer`. Ctrl-C ends it.
    """
    try:
        with warnings.catch_warnings(record=True) as warned:
            warnings.simplefilter("always")
            viewer = view_of(options.design, host=options.host, port=options.port, path=options.path, dark=options.dark)
    except MissingExtra as error:
        raise ValueError(str(error)) from None
    with viewer:
        for one in warned:
            print(f"ninedof: {one.message}", file=sys.stderr)
        try:
            print(f"{viewer.url}  (Ctrl-C ends the viewer)", flush=True)
            if options.browser:
                webbrowser.open(viewer.url)
            viewer.wait()
        except KeyboardInterrupt:
            print("closed", file=sys.stderr)
