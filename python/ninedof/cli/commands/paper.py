"""`ninedof paper`: every number of the paper beside ours."""

from __future__ import annotations

from rich.table import Table

from ninedof.cli.options import Json, Threads
from ninedof.cli.screen import Screen
from ninedof.paper.verdicts import verdicts

PLACE = 7
EXAMPLES = "[bold]Example[/bold]\n\n  ninedof paper --json | jq '.[].verdict'"


def paper(threads: Threads = None, json: Json = False) -> None:
    """Print every number of the paper beside ours, and a verdict on each."""
    screen = Screen(json)
    found = verdicts(threads)
    table = Table(
        title="The paper's numbers and ours, lengths in units of l_c", title_justify="left", title_style="bold"
    )
    for title, ratio in (("where", 3), ("printed", 6), ("ours", 9), ("verdict", 8)):
        table.add_column(title, ratio=ratio, overflow="fold")
    for v in found:
        table.add_row(v.where, v.printed, v.ours, v.verdict, end_section=True)
    screen.print(table)
    screen.data([{"where": v.where, "printed": v.printed, "ours": v.ours, "verdict": v.verdict} for v in found])
