"""`ninedof view`: a design in the browser, to move by hand."""

from __future__ import annotations

import sys
import warnings
import webbrowser
from pathlib import Path

import ninedof as nd
from ninedof.cli.options import DESIGN_OR_PUBLISHED, argument, option, struct

EXAMPLES = """
  ninedof view runs/20260101-120000                   the best design of a run, with the limits of its study
  ninedof view design.toml --path path.csv --port 0   with a path to play, at any free port
  ninedof view                                        the published design"""


@struct
class _Options:
    design: str | None = argument(DESIGN_OR_PUBLISHED, None)
    path: Path | None = option("Poses to play: a CSV file as of `ninedof path`.")
    host: str = option(
        "Address to listen at; 0.0.0.0 is reached from the whole network, without a password.", "127.0.0.1"
    )
    port: int = option("Port; 0 takes any free one.", 8080)
    dark: bool = option("Dark colours.", False, "--dark")
    browser: bool = option("Open the page in the browser.", False, "--open")


def view(options: _Options) -> None:
    """Show a design in the browser, to move by hand: platform, O, variables; numbers and limits follow.

    Needs the extra `viewer`. Ctrl-C ends it.
    """
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        viewer = nd.view(options.design, host=options.host, port=options.port, path=options.path, dark=options.dark)
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
