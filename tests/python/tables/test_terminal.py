"""Tables on terminals of a width."""

import io
import math

import pytest
from rich.console import Console

from ninedof.sheet.rows import LimitRow, limit_amount
from ninedof.tables import RIGHT, Column, Table
from ninedof.tables.numbers import load_text, spread
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


@pytest.mark.parametrize(
    ("value", "among", "text"),
    [
        (612.34567, [1.0], "612.35"),
        (112345.678, [], "112346"),
        (-0.012345678, [], "-0.012346"),
        (3e-13, [-250.0, math.inf], "0"),
        (2.5e9, [], "2.5e+09"),
        (math.inf, [1.0], "inf"),
    ],
)
def test_forces_have_five_digits_at_any_size_and_rounding_is_0(value, among, text):
    assert load_text(value, among) == text
    assert spread(value, value, among) == text


@pytest.mark.parametrize(("unit", "text"), [("number", "612.35"), ("power", "612.35 force mm/s")])
def test_limits_of_forces_have_the_digits_of_forces(unit, text):
    row = LimitRow("force", "max", 900.0, 612.34567, 0.3, "l1", unit)
    assert limit_amount(row, row.value, "mm") == text
    assert limit_amount(row._replace(unit="length"), row.value, "mm") == "612.3457 mm"


def test_the_name_of_a_row_stays_in_one_line_where_there_is_room():
    name = "platform cone external (deg)"
    heads = [Column("at every pose"), *(Column(head) for head in ("limit", "proved", "margin", ""))]
    row = (name, "≤ 45", "≤ 44.9999999", "within 1e-06, on the limit", "proved of all the machines")
    out = printed(Table("", heads, [row]), 80)
    assert max(map(len, out.splitlines())) <= 80
    assert name in out
