"""`ninedof optimize`: solve a study, or the paper's beside the published optimum."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ninedof.cli.commands.comparison import comparison_table, comparison_words
from ninedof.cli.commands.screen import Screen, exit_status
from ninedof.cli.commands.tables import price_text, result_table
from ninedof.design.study import Study
from ninedof.optimize.bounds import applicable_bounds
from ninedof.optimize.optimize import optimize as solve
from ninedof.optimize.result import Result
from ninedof.paper import paper as the_paper
from ninedof.runs.describe import describe_comparison
from ninedof.runs.directory import new_directory
from ninedof.runs.figures import figures_of
from ninedof.runs.folder import write_run
from ninedof.support.arrays import thread_argument
from ninedof.verify.verdict import check as examine


def optimize(
    study: Path | None,
    out: Path | None,
    starts: int | None,
    seed: int | None,
    threads: int | None,
    figures: bool,
    json: bool,
    check: bool = False,
) -> int:
    """Solve a study, or the paper's beside the published optimum; print, record, return the exit status."""
    screen = Screen(json)
    thread_argument(threads)
    chosen = (Study.paper() if study is None else Study.load(study)).with_solver(starts, seed)
    directory = new_directory(out)
    if study is None:
        return _optimize_paper(chosen, directory, threads, figures, screen, check)
    return _optimize_study(chosen, study.name, directory, threads, figures, screen, check)


def _optimize_paper(
    study: Study, directory: Path, threads: int | None, figures: bool, screen: Screen, check: bool
) -> int:
    with screen.progress("the paper's problem") as bar:
        comparison = the_paper.compare(study.starts, study.seed, threads, bar.starts)
    screen.print(comparison_table(comparison))
    screen.print(comparison_words(comparison))
    if comparison.result.interrupted:
        screen.print(f"[bold]{comparison.result.status}[/bold]: {comparison.result.reason}")
    checked = _checked(comparison.result, check, screen)
    record = write_run(comparison, directory, figures_of(comparison, screen.say) if figures else None)
    _say_where(screen, record)
    screen.data({**describe_comparison(comparison), "record": str(record), **checked})
    return exit_status(comparison.result)


def _optimize_study(
    study: Study, name: str, directory: Path, threads: int | None, figures: bool, screen: Screen, check: bool
) -> int:
    for variable in study.defaulted:
        low, high = study.variables[variable]  # type: ignore[misc]  # a free one
        screen.print(f"{variable} is not given: [{low:g}, {high:g}] assumed")
    with screen.progress(name) as bar:
        result = solve(study, threads=threads, progress=bar.starts)
    screen.print(f"[bold]{result.status}[/bold]: {result.reason}")
    if result.candidates:
        screen.print(result_table(result))
        screen.print(*price_text(result))
        for bound in applicable_bounds(result):
            screen.print(bound.sentence)
    checked = _checked(result, check, screen)
    record = write_run(result, directory, figures_of(result, screen.say) if figures else None)
    _say_where(screen, record)
    screen.data({"optimization": result.to_dict(), "record": str(record), **checked})
    return exit_status(result)


def _checked(result: Result, wanted: bool, screen: Screen) -> dict[str, Any]:
    """Check the best design where asked to, say how it went, and return it for the machine-readable result."""
    if not wanted or result.best is None:
        return {}
    verdict = examine(result)
    screen.print(verdict.report())
    return {"check": {"passed": verdict.passed, "report": verdict.report()}}


def _say_where(screen: Screen, record: Path) -> None:
    figures = sorted({path.stem for path in record.parent.glob("*.png")})
    drawn = f", figures {', '.join(figures)} (PNG and SVG)" if figures else ""
    screen.print(f"run folder {record.parent}: {record.name}{drawn}")
