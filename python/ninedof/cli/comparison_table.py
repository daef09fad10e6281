"""The table of the published optimum beside ours."""

from __future__ import annotations

from collections.abc import Mapping

from rich.table import Table

from ninedof.cli.result_table import short
from ninedof.paper import published
from ninedof.paper.comparison import Comparison


def comparison_table(c: Comparison) -> Table:
    """Return the table of the published optimum beside ours, one design per column."""
    table = Table(title="The paper's design problem, lengths in units of l_c", title_justify="left", title_style="bold")
    table.add_column("", overflow="fold")
    table.add_column("published\nas printed", justify="right", overflow="fold")
    shown = [
        ("published\nreproduced", c.reproduced),
        ("same base\nand height", c.same_base_and_height),
        ("base at most\n2 x platform", c.same_class),
    ]
    rows = [(title, row) for title, row in shown if row is not None]
    for title, _ in rows:
        table.add_column(title, justify="right", overflow="fold")

    base, platform = ("a1", "a2"), ("b1", "b2")
    for label, names, printed in (("base a1, a2", base, "0, -"), ("platform b1, b2", platform, "5.8124, -")):
        table.add_row(label, printed, *(", ".join(short(r.variables[n]) for n in names) for _, r in rows))
    table.add_row("base / platform", "-", *(f"{r.radius_ratio:.4f}" for _, r in rows))
    table.add_row("height zp", f"{published.ZP:.4f}", *(f"{r.variables['zp']:.4f}" for _, r in rows))
    table.add_row("height of O, zs", "-", *(f"{r.variables['zs']:.4f}" for _, r in rows), end_section=True)
    for k, label in enumerate(("external legs l", "upper internal q", "lower internal r")):
        table.add_row(label, "-", *(f"{r.legs[k]:.4f}" for _, r in rows), end_section=k == 2)
    table.add_row(
        "condition number", f"{published.KAPPA:.4f}", *(f"{r.condition_number:.6f}" for _, r in rows), style="bold"
    )
    table.add_row("below 3.9110 by", "-", *("-" if abs(r.gain) < 0.005 else f"{r.gain:.2f} %" for _, r in rows))
    table.add_row("limits reached", "-", *("\n".join(_binding(r.variables, r.active)) for _, r in rows))
    return table


def _binding(variables: Mapping[str, float], active: tuple[str, ...]) -> list[str]:
    return [f"{name} = {short(variables[name])}" if name in variables else name for name in active] or ["nothing"]


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
