"""What each command does, and how it looks on a terminal."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table

from ninedof import job
from ninedof import paper as the_paper
from ninedof.arrays import thread_argument
from ninedof.designs import Design, hexagonal_design, indices, load_design
from ninedof.lengths import KINDS
from ninedof.optimize import Result, Status
from ninedof.optimize import optimize as solve
from ninedof.records import describe_result, to_json
from ninedof.study import Study

DONE, NO_RESULT, INTERRUPTED = 0, 3, 130  # 2, bad input, is the command line's


def exit_status(result: Result) -> int:
    """Return what the shell is told."""
    if result.interrupted:
        return INTERRUPTED
    return DONE if result.status == Status.OPTIMAL else NO_RESULT


class Screen:
    """Where words go: standard output, or standard error where standard output is for JSON."""

    def __init__(self, json: bool) -> None:
        """Choose the consoles."""
        self.json = json
        self.progress_console = Console(stderr=True)
        self.words = Console(stderr=True) if json else Console(highlight=False)

    def print(self, *parts: Any) -> None:
        """Print words or a table for a person."""
        self.words.print(*parts)

    def data(self, value: Any) -> None:
        """Print the machine-readable result, if it was asked for."""
        if self.json:
            print(to_json(value))

    def say(self, doing: str) -> None:
        """Say what is being done besides solving."""
        self.progress_console.print(f"  {doing}", style="dim", highlight=False)

    @contextmanager
    def progress(self, title: str) -> Iterator[_Bar]:
        """Show a bar of starts while solving, then what else is done."""
        columns = (
            TextColumn("{task.description}"),
            BarColumn(bar_width=24),
            MofNCompleteColumn(),
            TextColumn("{task.fields[best]}"),
            TimeElapsedColumn(),
        )
        with Progress(*columns, console=self.progress_console) as shown:
            yield _Bar(shown, title)


class _Bar:
    def __init__(self, shown: Progress, title: str) -> None:
        self._shown = shown
        self._task = shown.add_task(title, total=None, best="")

    def starts(self, done: int, total: int, best: float) -> None:
        """Take the progress of an optimization."""
        self._shown.update(self._task, completed=done, total=total, best=f"best {best:.6f}")


def optimize(
    study: Path | None,
    out: Path | None,
    starts: int | None,
    seed: int | None,
    threads: int | None,
    figures: bool,
    json: bool,
) -> int:
    """Solve a study, or the paper's beside the published optimum; print, record, return the exit status."""
    screen = Screen(json)
    thread_argument(threads)
    chosen = (Study.paper() if study is None else Study.load(study)).with_solver(starts, seed)
    directory = job.new_directory(out)
    if study is None:
        return _optimize_paper(chosen, directory, threads, figures, screen)
    return _optimize_study(chosen, study.name, directory, threads, figures, screen)


def _optimize_paper(study: Study, directory: Path, threads: int | None, figures: bool, screen: Screen) -> int:
    with screen.progress("the paper's problem") as bar:
        comparison = the_paper.compare(study.starts, study.seed, threads, bar.starts)
    screen.print(comparison_table(comparison))
    screen.print(comparison_words(comparison))
    if comparison.result.interrupted:
        screen.print(f"[bold]{comparison.result.status}[/bold]: {comparison.result.reason}")
    record = job.record_comparison(comparison, directory, figures, screen.say)
    _say_where(screen, record)
    screen.data(
        {
            "designs": [job.describe_row(row) for row in comparison.rows()],
            "why": comparison.why,
            "optimization": describe_result(comparison.result),
            "record": str(record),
        }
    )
    return exit_status(comparison.result)


def _optimize_study(
    study: Study, name: str, directory: Path, threads: int | None, figures: bool, screen: Screen
) -> int:
    for variable in study.defaulted:
        low, high = study.variables[variable]  # type: ignore[misc]  # a free one
        screen.print(f"{variable} is not given: [{low:g}, {high:g}] assumed")
    with screen.progress(name) as bar:
        result = solve(study, threads=threads, progress=bar.starts)
    screen.print(f"[bold]{result.status}[/bold]: {result.reason}")
    if result.candidates:
        screen.print(result_table(result))
    record = job.record_result(result, directory, figures, screen.say)
    _say_where(screen, record)
    screen.data({"optimization": describe_result(result), "record": str(record)})
    return exit_status(result)


def _say_where(screen: Screen, record: Path) -> None:
    figures = sorted({path.stem for path in record.parent.glob("*.png")})
    drawn = f", figures {', '.join(figures)} (PNG and SVG)" if figures else ""
    screen.print(f"run folder {record.parent}: {record.name}{drawn}")


def comparison_table(c: the_paper.Comparison) -> Table:
    """Lay the published optimum and ours side by side: one design a column."""
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

    def line(label: str, printed: str, *values: str, **style: Any) -> None:
        table.add_row(label, printed, *values, **style)

    base, platform = ("a1", "a2"), ("b1", "b2")
    for label, names, printed in (("base a1, a2", base, "0, -"), ("platform b1, b2", platform, "5.8124, -")):
        line(label, printed, *(", ".join(_short(r.variables[n]) for n in names) for _, r in rows))
    line("base / platform", "-", *(f"{r.radius_ratio:.4f}" for _, r in rows))
    line("height zp", f"{the_paper.ZP:.4f}", *(f"{r.variables['zp']:.4f}" for _, r in rows))
    line("height of O, zs", "-", *(f"{r.variables['zs']:.4f}" for _, r in rows), end_section=True)
    for k, label in enumerate(("external legs l", "upper internal q", "lower internal r")):
        line(label, "-", *(f"{r.legs[k]:.4f}" for _, r in rows), end_section=k == 2)
    line("condition number", f"{the_paper.KAPPA:.4f}", *(f"{r.condition_number:.6f}" for _, r in rows), style="bold")
    line("below 3.9110 by", "-", *("-" if abs(r.gain) < 0.005 else f"{r.gain:.2f} %" for _, r in rows))
    line("limits reached", "-", *("\n".join(_binding(r.variables, r.active)) for _, r in rows))
    return table


def _binding(variables: Mapping[str, float], active: tuple[str, ...]) -> list[str]:
    return [f"{name} = {_short(variables[name])}" if name in variables else name for name in active] or ["nothing"]


def _short(value: float) -> str:
    return "0" if value == 0.0 else f"{value:.4f}"


def comparison_words(c: the_paper.Comparison) -> str:
    """Say what the table does not."""
    below, above = c.crossings
    return (
        f"Read with a as the base, as eqs. (37)-(38) have it, eq. (39) allows no condition number under "
        f"{c.as_printed:.4f}: a and b are swapped, and a2, b2, zs are missing. "
        f"With base side {the_paper.BASE_SIDE:.4f} and platform side {the_paper.PLATFORM_SIDE:.4f}, 3.9110 occurs at "
        f"zs = {below:.4f} and {above:.4f}; the least along zs is {c.best_zs.condition_number:.4f} at "
        f"{c.best_zs.variables['zs']:.4f}.\n\n{c.why}\n"
    )


def result_table(result: Result) -> Table:
    """Lay the candidates of a study side by side, best first."""
    shown = result.candidates[:4]
    table = Table(title=f"{_count(len(result.candidates))}, {result.starts_done} starts", title_justify="left")
    table.add_column("", overflow="fold")
    for k in range(len(shown)):
        table.add_column("best" if k == 0 else f"no. {k + 1}", justify="right", overflow="fold")
    table.add_row("condition number", *(f"{c.condition_number:.6f}" for c in shown), style="bold", end_section=True)
    for name in result.study.variables:
        table.add_row(name + " (rad)" * (name == "theta_z"), *(_short(c.variables[name]) for c in shown))
    table.add_section()
    table.add_row("limits reached", *(", ".join(c.active) or "nothing" for c in shown))
    table.add_row("starts that ended here", *(str(c.reached) for c in shown))
    table.add_row("stationarity", *(f"{c.optimality_residual:.1e}" for c in shown))
    table.add_row("violation", *(f"{c.constraint_violation:.1e}" for c in shown))
    return table


def _count(optima: int) -> str:
    return "1 local optimum" if optima == 1 else f"{optima} distinct local optima"


def evaluate(
    design: Path | None, sides: Mapping[str, float | None], theta_z_deg: float | None, lc: str | None, json: bool
) -> int:
    """Print the indices of a design."""
    screen = Screen(json)
    given = _design(design, sides, theta_z_deg)
    if lc is not None:
        given = given._replace(characteristic_length=_length(lc))
    values = indices(given)
    table = Table(title="Indices", title_justify="left", title_style="bold", show_header=False)
    table.add_column()
    table.add_column(justify="right")
    for name in ("condition_number", "reciprocal", "condition_number_frobenius", "manipulability", "isotropy_residual"):
        if name in values:
            table.add_row(name.replace("_", " "), f"{values[name]:.6f}")
    table.add_row("characteristic length", f"{values['characteristic_length']:.6f}", end_section=True)
    for k, value in enumerate(values["singular_values"]):
        table.add_row(f"singular value {k + 1} of J'", f"{value:.6f}", end_section=k == 5)
    for kind, lengths in values["leg_lengths"].items():
        table.add_row(f"legs {kind}1 {kind}2 {kind}3", "  ".join(f"{v:.6f}" for v in lengths))
    table.add_row("longest / shortest leg", f"{values['leg_ratio']:.6f}", end_section=True)
    for kind, found in values["characteristic_lengths"].items():
        if math.isfinite(found["length"]):
            table.add_row(f"at the {kind} length {found['length']:.6f}", f"k = {found['condition_number']:.6f}")
    screen.print(table)
    if values["singular"]:
        screen.print("This configuration is singular: with all legs locked, the platform or O can still move.")
    p, o = given.configuration.position[2], given.configuration.internal_point[2]
    if not 0.0 < o < p:
        screen.print("O is not between base and platform: studies keep 0 < zs < zp.")
    screen.data(values)
    return DONE


def _design(design: Path | None, sides: Mapping[str, float | None], theta_z_deg: float | None) -> Design:
    named = {name: value for name, value in sides.items() if value is not None}
    if design is not None:
        if named or theta_z_deg is not None:
            raise ValueError(
                f"evaluate: got a design file and {', '.join(named) or '--theta-z-deg'}, expected one of the two"
            )
        return load_design(design)
    missing = [f"--{name}" for name, value in sides.items() if value is None]
    if missing:
        raise ValueError(f"evaluate: got no {', '.join(missing)}, expected a design file or all of a1 a2 b1 b2 zp zs")
    return hexagonal_design(named | {"theta_z": math.radians(theta_z_deg or 0.0)})


def _length(text: str) -> float | str:
    try:
        return float(text)
    except ValueError:
        if text not in KINDS:
            raise ValueError(f"--lc: got {text!r}, expected a number or one of {', '.join(KINDS)}") from None
        return text


def paper(threads: int | None, json: bool) -> int:
    """Print the paper's numbers beside ours."""
    screen = Screen(json)
    found = the_paper.verdicts(threads)
    table = Table(
        title="The paper's numbers and ours, lengths in units of l_c", title_justify="left", title_style="bold"
    )
    for title, ratio in (("where", 3), ("printed", 6), ("ours", 9), ("verdict", 8)):
        table.add_column(title, ratio=ratio, overflow="fold")
    for v in found:
        table.add_row(v.where, v.printed, v.ours, v.verdict, end_section=True)
    screen.print(table)
    screen.data([{"where": v.where, "printed": v.printed, "ours": v.ours, "verdict": v.verdict} for v in found])
    return DONE
