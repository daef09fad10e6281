"""Tables on terminals of a width."""

import io

import pytest
from rich.console import Console

from ninedof.tables import RIGHT, Column, Table
from ninedof.tables.terminal import terminal

NAMES = ["platform_external_radius", "base_internal_radius", "zp", "platform_cone"]


def printed(table, width):
    console = Console(file=io.StringIO(), width=width)
    console.print(terminal(table, width))
    return console.file.getvalue()


@pytest.mark.parametrize("width", [80, 100])
def test_no_name_is_torn_where_numbers_can_leave_it_room(width):
    heads = [Column("no.", "", RIGHT), Column("neutral\ncondition number", "", ".6f"), Column("largest stroke", "mm")]
    table = Table("", [*heads, Column("limits reached")], [["1", 4.421365, "500 to 600", ", ".join(NAMES)]])
    out = printed(table, width)
    assert max(map(len, out.splitlines())) <= width
    for name in NAMES:
        assert name in out
    rows = [(f"variables.platform_internal_{k}_height", "[100.0, 500.0]", "symmetric_nonplanar, 20 mm") for k in "ab"]
    out = printed(Table("", [Column(), Column("A"), Column("B")], rows), width)
    assert max(map(len, out.splitlines())) <= width
    for name, *_ in rows:
        assert name in out
