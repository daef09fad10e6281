"""`ninedof optimize`: solve a study; by default that of the paper, beside the published optimum."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import typer

from ninedof.cli.comparison_table import comparison_table, comparison_words
from ninedof.cli.job_report import report_words, told, with_report
from ninedof.cli.long_run import CHUNKS, run_folder
from ninedof.cli.options import Figures, Json, Out, Report, Resume, Starts, StudyFile, Threads
from ninedof.cli.remembered import given
from ninedof.cli.result_table import price_text, proof_words, result_table
from ninedof.cli.screen import Screen, bold, exit_status
from ninedof.design.study import Study
from ninedof.optimize.bounds import applicable_bounds
from ninedof.optimize.optimize import optimize as solve
from ninedof.optimize.result import Result
from ninedof.paper.comparison import Comparison, compare
from ninedof.proof.optimum import FILE as CERTIFICATE
from ninedof.proof.optimum import left_out_of
from ninedof.runs.command_file import Input
from ninedof.runs.describe import describe_comparison
from ninedof.runs.figures import figures_of
from ninedof.runs.folder import write_run
from ninedof.support.arguments import finite
from ninedof.support.arrays import thread_argument
from ninedof.support.units import amount, unit_entry
from ninedof.verify.verdict import check as examine

PLACE = 1
EXAMPLES = """[bold]Examples[/bold]

  ninedof optimize                         the paper's problem, beside the published optimum

  ninedof optimize study.toml --out run1   a study of your own, run folder run1

  ninedof optimize study.toml --certify    with a proof of how much better any design can be

  ninedof optimize study.toml --time 60    the best design of a minute, and what is left to gain

  ninedof optimize --json --no-figures | jq .optimization.status"""


def optimize(
    study: StudyFile = None,
    out: Out = None,
    resume: Resume = False,
    starts: Starts = None,
    seed: Annotated[int | None, typer.Option(help="Seed, in place of the study's.")] = None,
    threads: Threads = None,
    time: Annotated[
        float | None, typer.Option(help="Seconds after which the search ends with the best design so far.")
    ] = None,
    figures: Figures = True,
    report: Report = True,
    convergence: Annotated[
        bool,
        typer.Option("--convergence", help="Also follow many starts to their ends and draw how they converge."),
    ] = False,
    check: Annotated[
        bool, typer.Option("--check", help="Verify the best design by independent methods and print the report.")
    ] = False,
    certify: Annotated[
        bool, typer.Option("--certify", help="Also prove how much better a design of the study can be at most.")
    ] = False,
    json: Json = False,
) -> None:
    """Find the best design of a study: by default, the design with the least condition number."""
    screen = Screen(json)
    thread_argument(threads)
    reads = Input.of(None if study is None else str(study))
    study = None if study is None else Path(given(str(study)))
    chosen = (Study.paper() if study is None else Study.load(study)).with_solver(starts, seed)
    if convergence and not figures:
        raise ValueError("--convergence: got it with --no-figures, expected one of the two")
    if time is not None and not finite("--time", time) > 0.0:
        raise ValueError(f"--time: got {time:g}, expected seconds, more than 0")
    if certify:
        left_out_of(chosen)  # raises where no proof is known, before the work
    with run_folder(out, resume, reads) as directory:
        limit = math.inf if time is None else time
        how = {"threads": threads, "certify": certify, "time_limit": limit, "out": directory / CHUNKS}
        run: Comparison | Result
        run = _solve_paper(chosen, how, screen) if study is None else _solve_study(chosen, study.name, how, screen)
    result = run if isinstance(run, Result) else run.result
    data = {"optimization": result.to_dict()} if isinstance(run, Result) else describe_comparison(run)
    drawn_now = figures and not result.interrupted
    draw = figures_of(run, screen.say, convergence) if drawn_now else None
    words = partial(_comparison_words if isinstance(run, Comparison) else _result_words, run, screen)  # type: ignore[arg-type]
    with told(screen, words, {**unit_entry(chosen.unit), **data}) as once:
        record = write_run(run, directory, with_report(draw, drawn_now and report, screen, once))
    if check and result.best is not None and not result.interrupted:
        verdict = examine(result)
        screen.print(verdict.report())
        data["check"] = {"passed": verdict.passed, "report": verdict.report()}
    stems = sorted({path.stem for path in directory.glob("*.png")})
    drawn = f", figures {', '.join(stems)} (PNG, SVG, PDF)" if stems else ""
    proof = f", {CERTIFICATE}" if (directory / CERTIFICATE).is_file() else ""
    screen.print(f"run folder {directory}: {record.name}{proof}{drawn}{report_words(directory)}")
    screen.data({**unit_entry(chosen.unit), **data, "record": str(record)})
    raise typer.Exit(exit_status(result, timed=time is not None))


def _solve_paper(study: Study, how: dict[str, Any], screen: Screen) -> Comparison:
    with screen.progress("the paper's problem") as bar:
        return compare(study.starts, study.seed, progress=bar, **how)


def _comparison_words(comparison: Comparison, screen: Screen) -> None:
    screen.print(comparison_table(comparison))
    screen.print(comparison_words(comparison))
    if comparison.result.proof is not None:
        screen.print(proof_words(comparison.result))
    if comparison.result.interrupted:
        screen.print(bold(comparison.result.status, f": {comparison.result.reason}"))


def _solve_study(study: Study, name: str, how: dict[str, Any], screen: Screen) -> Result:
    if study.length_note:
        screen.print(study.length_note)
    for variable in study.defaulted:
        low, high = (study.shown(variable, end) for end in study.variables[variable])  # type: ignore[union-attr]
        ends = amount(f"[{low:g}, {high:g}]", study.unit_of(variable))
        screen.print(f"{variable} is not given: {ends} assumed")
    with screen.progress(name) as bar:
        return solve(replace(study), progress=bar, **how)  # without the notes, which were printed


def _result_words(result: Result, screen: Screen) -> None:
    screen.print(bold(result.status, f": {result.reason}"))
    if result.candidates:
        screen.print(result_table(result))
        screen.print(*price_text(result))
        for bound in applicable_bounds(result):
            if bound.name != "certificate":
                screen.print(bound.sentence)
        if result.proof is not None:
            screen.print(proof_words(result))
