"""`ninedof optimize`: solve a study; by default that of the paper, beside the published optimum."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from itertools import chain
from pathlib import Path
from time import perf_counter
from typing import Any

import ninedof as nd
from ninedof.cli.answer import Answer, finish_job
from ninedof.cli.options import STARTS, THREADS, JobOptions, argument, option, struct
from ninedof.cli.screen import Screen, bold, exit_status
from ninedof.optimize.result import with_fixed_design
from ninedof.optimize.tables import agreement_words, best_prices, candidates_table, proof_words
from ninedof.paper.comparison import PaperComparison, compare, comparison_table, comparison_words
from ninedof.proof.optimum_steps import ways_of
from ninedof.records.record import run_folder, write_run
from ninedof.sheet.tables import limits_table
from ninedof.singularity.architecture import architecture_sentences
from ninedof.support.arguments import finite
from ninedof.support.running import ended_by_time, notes_told
from ninedof.support.units import amount, unit_entry

EXAMPLES = """
  ninedof optimize                         the paper's problem, beside the published optimum
  ninedof optimize study.toml --out run1   a study of your own, run folder run1
  ninedof optimize study.toml --certify    with a proof of how much better any design can be
  ninedof optimize study.toml --time 60    the best design of a minute, and what is left to gain
  ninedof optimize --json --no-figures | jq .optimization.status"""


@struct
class _Options(JobOptions):
    study: Path | None = argument("A study file (TOML). The paper's study if none is given.", None)
    starts: int | None = option(STARTS)
    seed: int | None = option("Seed, in place of the study's.")
    threads: int | None = option(THREADS)
    time: float | None = option("Seconds after which search and proof end with what there is.")
    convergence: bool = option(
        "Also follow many starts to their ends and draw how they converge.", False, "--convergence"
    )
    check: bool = option("Verify the best design by independent methods and print the report.", False, "--check")
    certify: bool = option("Also prove how much better a design of the study can be at most.", False, "--certify")


def optimize(options: _Options) -> None:
    """Find the best design of a study: by default, the design with the least condition number."""
    screen = options.screen
    file = options.study
    study = (nd.Study.paper() if file is None else nd.Study.load(file)).with_solver(options.starts, options.seed)
    if options.convergence and not options.figures:
        raise ValueError("--convergence: got it with --no-figures, expected one of the two")
    if options.time is not None and not finite("--time", options.time) > 0.0:
        raise ValueError(f"--time: got {options.time:g}, expected seconds, more than 0")
    if options.certify:
        ways_of(study)  # raises where no proof is known, before the work
    with run_folder(options.out) as directory:
        limit = math.inf if options.time is None else options.time
        how: dict[str, Any] = {"threads": options.threads, "certify": options.certify, "time_limit": limit}
        begin = perf_counter()
        run = _solve(study, file, how | {"out": directory}, screen)
        seconds = perf_counter() - begin
    if isinstance(run, PaperComparison):
        result, parts, data = run.result, _comparison_parts(run), run.to_dict()
    else:
        result, parts, data = run, _result_parts(run), {"optimization": run.to_dict()}
    data = {**unit_entry(study.unit), **data}
    draw = None
    if options.figures:
        from ninedof.records.figures import figures_of

        draw = figures_of(run, options.convergence)
    proof = result.proof
    ended = result.status == nd.Status.STOPPED or (proof is not None and not proof.complete and proof.better is None)
    if options.time is not None and ended and seconds >= options.time and not result.interrupted:
        ended_by_time(without="--time")
    if options.check and result.best is not None and not result.interrupted:
        parts = chain(parts, _checked(result, data))
    answer = Answer(parts, data, exit_status(result, timed=options.time is not None))
    finish_job(options, directory, answer, partial(write_run, run, directory), draw)


def _checked(result: nd.Result, data: dict[str, Any]) -> Iterator[str]:
    verdict = nd.check(result)
    data["check"] = {"passed": verdict.passed, "report": verdict.report()}
    yield verdict.report()


def _solve(study: nd.Study, file: Path | None, how: dict[str, Any], screen: Screen) -> PaperComparison | nd.Result:
    if file is None:
        with screen.bar("starts", "the paper's problem") as bar:
            return compare(study.starts, study.seed, progress=bar, **how)
    screen.print(*study.notes)
    for variable in study.defaulted:
        low, high = (study.shown(variable, end) for end in study.variables[variable])  # type: ignore[union-attr]
        ends = amount(f"[{low:g}, {high:g}]", study.unit_of(variable))
        screen.print(f"{variable} is not given: {ends} assumed")
    with screen.bar("starts", file.name) as bar, notes_told():
        return nd.optimize(study, progress=bar, **how)


def _comparison_parts(comparison: PaperComparison) -> Iterator[Any]:
    yield comparison_table(row.to_dict() for row in comparison.rows())
    yield comparison_words(comparison)
    if comparison.result.proof is not None:
        yield bold(*proof_words(comparison.result))
    if comparison.result.interrupted:
        yield bold(comparison.result.status, f": {comparison.result.reason}")


def _result_parts(result: nd.Result) -> Iterator[Any]:
    yield bold(result.status, f": {result.reason}")
    yield from result.study.tool.remark(result.study.unit)
    shown = with_fixed_design(result)
    if shown is not result:
        yield f"no variable is free; the design of the study has {result.words} {shown.objective:.6f}"
        yield from [limits_table(nd.sheet(shown))] if result.study.limits else []
    if result.candidates:
        yield candidates_table(result)
        *others, agreement = agreement_words(result)
        yield from (*others, *best_prices(result), agreement)
        elsewhere = result.study.objective.region is not None or bool(result.study.objective.poses)
        neutral = "at the neutral pose: " * elsewhere
        yield from (neutral + bound.sentence for bound in nd.applicable_bounds(result) if bound.name != "certificate")
        yield from architecture_sentences(result, result.study.unit)
        if result.proof is not None:
            yield bold(*proof_words(result))
