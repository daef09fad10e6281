"""The tables of the paper's numbers beside ours, from plain values as records have them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from ninedof.paper import published
from ninedof.paper.comparison import Comparison
from ninedof.tables import RIGHT, Column, Line, Table

TITLES = {
    "published, read so that it gives 3.9110": "published\nreproduced",
    "best with the same base and height": "same base\nand height",
    "best with the base at most twice the platform": "base at most\n2 x platform",
}


def comparison_table(designs: Iterable[Mapping[str, Any]]) -> Table:
    """Return the published optimum beside ours, one design per column."""
    shown = [row for row in designs if row["title"] in TITLES]
    heads = ["published\nas printed", *(TITLES[row["title"]] for row in shown)]

    def line(label: str, printed: str, texts: Iterable[str]) -> Line:
        return Line(label, [printed, *texts])

    def pair(names: Sequence[str]) -> Iterable[str]:
        return (", ".join(_short(row["variables"][name]) for name in names) for row in shown)

    rows: list[Any] = [
        line("base a1, a2", "0, -", pair(["a1", "a2"])),
        line("platform b1, b2", "5.8124, -", pair(["b1", "b2"])),
        line("base / platform", "-", (f"{row['radius_ratio']:.4f}" for row in shown)),
        line("height zp", f"{published.ZP:.4f}", (f"{row['variables']['zp']:.4f}" for row in shown)),
        line("height of O, zs", "-", (f"{row['variables']['zs']:.4f}" for row in shown)),
        (),
    ]
    for label, leg in (("external legs l", "l"), ("upper internal q", "q"), ("lower internal r", "r")):
        rows.append(line(label, "-", (f"{row['leg_lengths'][leg]:.4f}" for row in shown)))
    gains = [row["gain_percent"] for row in shown]
    rows += [
        (),
        line("condition number", f"{published.KAPPA:.4f}", (f"{row['condition_number']:.6f}" for row in shown)),
        line("below 3.9110 by", "-", ("-" if abs(gain) < 0.005 else f"{gain:.2f} %" for gain in gains)),
        line("limits reached", "-", ("\n".join(_active(row)) or "nothing" for row in shown)),
    ]
    title = "The published optimum beside ours, lengths in units of l_c"
    return Table(title, [Column(), *(Column(head, "", RIGHT) for head in heads)], rows)


def _active(row: Mapping[str, Any]) -> list[str]:
    values = row["variables"]
    return [f"{name} = {_short(values[name])}" if name in values else name for name in row["active"]]


def _short(value: float) -> str:
    return "0" if value == 0.0 else f"{value:.4f}"


def comparison_words(c: Comparison) -> str:
    """Return the remarks below the table."""
    below, above = c.crossings
    return (
        f"Read with a as the base, as eqs. (37)-(38) have it, eq. (39) allows no condition number under "
        f"{c.as_printed:.4f}: a and b are swapped, and a2, b2, zs are missing. "
        f"With base side {published.BASE_SIDE:.4f} and platform side {published.PLATFORM_SIDE:.4f}, 3.9110 occurs at "
        f"zs = {below:.4f} and {above:.4f}; the least along zs is {c.best_zs.condition_number:.4f} at "
        f"{c.best_zs.variables['zs']:.4f}.\n\n{c.why}\n"
    )


def verdicts_table(rows: Iterable[Mapping[str, str]]) -> Table:
    """Return every number of the paper beside ours."""
    names = ("where", "printed", "ours", "verdict")
    lines: list[Any] = []
    for row in rows:
        lines += [tuple(row[name] for name in names), ()]
    title = "The paper's numbers and ours, lengths in units of l_c"
    return Table(title, [Column(name) for name in names], lines)
