"""`ninedof pareto`: a trade-off, its table and its run folder."""

from __future__ import annotations

import math
from functools import partial
from pathlib import Path
from typing import Any

import ninedof as nd
from ninedof.cli.answer import Answer, finish_job
from ninedof.cli.options import STARTS, THREADS, JobOptions, argument, option, struct
from ninedof.cli.posed import named_design
from ninedof.cli.screen import DONE, INTERRUPTED, NO_RESULT, bold
from ninedof.design.limits import names_with_max, split_label
from ninedof.design.objective import CONDITION_LIMIT
from ninedof.optimize.pareto.front import front_table
from ninedof.optimize.pareto.limits import TOLERANCE, with_degrees
from ninedof.optimize.pareto.solving import range_words
from ninedof.records.load import split
from ninedof.records.record import run_folder, write_run
from ninedof.support.running import notes_told

EXAMPLES = """
  ninedof pareto --against radius_ratio    the paper's optimum for several sizes of the base
  ninedof pareto study.toml --against stroke --value 0.1 --value 0.2 --value 0.4
  ninedof pareto study.toml --against base_cone_deg --value 30 --value 35
  ninedof pareto study.toml --against tolerance    what accuracy costs: joints and legs off by so much
  ninedof pareto runs/20260101-120000 --points 7   the study of a run, against the limit of greatest price
  ninedof pareto study.toml --against leg_ratio --out front     again after an interruption"""


@struct
class _Options(JobOptions):
    study: Path | None = argument(
        "A study file (TOML), or a run folder: its study. The paper's study if none is given.", None
    )
    against: str | None = option(
        'The limit that is swept: a constraint ("leg_ratio at neutral", "base_cone_deg"), '
        "condition_limit, or tolerance: what accuracy costs. By default radius_ratio, of a run the limit of "
        "greatest price.",
        values=[*names_with_max(), CONDITION_LIMIT, TOLERANCE],
    )
    value: list[float] | None = option(
        "A limit to solve, angles in degrees; may be repeated. By default the command selects the limits."
    )
    points: int = option("Number of limits, if the command selects them.", 13)
    starts: int | None = option(STARTS)
    threads: int | None = option(THREADS)


def pareto(options: _Options) -> None:
    """Compute the least condition number for each value of a limit."""
    screen = options.screen
    least = 0.0 if options.against == TOLERANCE else math.ulp(0.0)  # 0 is the machine as it is drawn
    for limit in options.value or ():
        if not least <= limit < math.inf:
            raise ValueError(
                f"--value: got {limit:g}, expected a finite number {'from 0 on' if not least else 'above 0'}"
            )
    file = options.study
    study, run = _study_of(file)
    study = study.with_solver(options.starts)
    against = options.against
    if against is None:
        against = nd.Study.paper().limits[0].name if run is None else _dearest(run)
    against = with_degrees(against)  # at the terminal angles are degrees
    name = "the paper's problem" if file is None else file.name
    screen.print(*study.notes)
    if options.against is None and options.value:
        values = ", ".join(f"{value:g}" for value in options.value)
        screen.print(f"--against is not given: the front is against {against} at {values}")
    with run_folder(options.out) as directory, screen.bar("limits", f"{name}, {against}") as bar, notes_told():
        how: dict[str, Any] = {"threads": options.threads, "progress": bar.show, "out": directory}
        front = nd.pareto(study, against, options.value or None, points=options.points, **how)
    parts: list[Any] = [front_table(front)] if front.limits else []
    if not options.value and not front.interrupted:
        parts += filter(None, [range_words(front)])
    if front.interrupted:
        count = "1 limit is" if len(front) == 1 else f"{len(front)} limits are"
        parts.append(bold("interrupted", f": {count} solved so far and kept in {directory}"))
    draw = (lambda: [("front", nd.plot.front(front))]) if any(map(math.isfinite, front.limits)) else None
    status = NO_RESULT if all(map(math.isnan, front.objectives)) else DONE
    answer = Answer(parts, {"front": front.to_dict()}, INTERRUPTED if front.interrupted else status)
    finish_job(options, directory, answer, partial(write_run, front, directory), draw)


def _study_of(study: Path | None) -> tuple[nd.Study, nd.Result | None]:
    """Return the study of a file, or that of a run with its result; that of the paper without either."""
    if study is None:
        return nd.Study.paper(), None
    place, point = split(str(study))
    if not point and not place.is_dir() and place.suffix != ".json":
        return nd.Study.load(study), None
    run = named_design(str(study)).result
    assert run is not None  # a run folder
    return run.study, run


def _dearest(run: nd.Result) -> str:
    """Return the limit of a run whose relaxation gains most."""
    prices = run.prices or {}
    names = [name for name in prices if split_label(name)[0] in names_with_max() or name == CONDITION_LIMIT]
    if not names:
        own = [one.label for one in run.study.limits if "max" in one.sides]
        raise ValueError(
            "--against: got none, expected the limit to sweep: no limit with a max has a price in this run"
            f"; with a max its study has {', '.join(own) or 'none'}"
        )
    return max(names, key=lambda name: prices[name])
