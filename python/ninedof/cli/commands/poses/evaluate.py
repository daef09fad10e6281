"""`ninedof evaluate`: the indices of one design, and of a run its poses and limits in short."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np

import ninedof as nd
from ninedof.cli.answer import Answer
from ninedof.cli.commands.machines.compare import compared, plot_argument
from ninedof.cli.options import (
    HEXAGON,
    ONE_DESIGN,
    PLOT,
    VARIABLES,
    HexagonalOptions,
    argument,
    changes_option,
    option,
    struct,
)
from ninedof.cli.posed import beyond_words, chosen_design, named_design, searching
from ninedof.design.indices import computed
from ninedof.records.design_file import indices
from ninedof.sheet.pose_words import outside_words
from ninedof.sheet.tables import limits_table, poses_table
from ninedof.singularity.architecture import architecture_sentences
from ninedof.support.units import DEG, amount, unit_entry
from ninedof.tables import Line, Table, columns

DETERMINANTS = "singularity margins: det N, B, C"
EXAMPLES = """
  ninedof evaluate --a1 0 --a2 5.8124 --b1 2.9062 --b2 0 --zp 3.9828 --zs 2.4435
  ninedof evaluate design.toml --lc optimal
  ninedof evaluate runs/20260101-120000    the best design of a run
  ninedof evaluate runs/20260101-120000 --set a2=+10%    what if a2 were longer?
  ninedof evaluate runs/20260101-120000#7    the design of point 7 of a front"""


@struct
class _Options(HexagonalOptions):
    design: str | None = argument(ONE_DESIGN, None)
    changes: list[str] | None = option(
        "What if? A variable of the run's study: a2=900 or a2=+10%. Repeatable.", None, "--set", values=VARIABLES
    )
    plot: Path | None = option(PLOT)


def evaluate(options: _Options) -> Answer:
    """Print the indices of one design and configuration; of a run also its study's poses and limits in short."""
    if options.changes:
        return _changed(options)
    if options.plot is not None:
        raise ValueError("--plot: got it without --set, expected both")
    chosen = chosen_design(options.design, options)
    values = unit_entry(chosen.unit) | indices(chosen.design)
    title = "Indices" if chosen.result is None else "At the neutral pose"
    parts: list[Any] = [*chosen.tool.remark(chosen.unit), _table(title, values, chosen.unit)]
    if values["singular"]:
        parts.append("This configuration is singular: the platform or O can move with all legs locked.")
    parts += architecture_sentences(chosen, chosen.unit)
    if not 0.0 < chosen.configuration.internal_point[2] < chosen.duty.zp(chosen.configuration):
        parts.append("O is not between base and platform: studies require 0 < zs < zp.")
    if chosen.result is not None:
        with searching(options.screen, "evaluate", chosen):
            of_run = nd.sheet(chosen.result, characteristic_length=chosen.characteristic_length)
        parts += beyond_words(chosen.geometry, chosen.configuration, of_run.configurations)
        parts += outside_words(of_run.configurations, of_run.tool, of_run.unit)
        fails = chosen.result.status == nd.Status.INFEASIBLE
        over: list[Any] = [f"{chosen.result.status}: {chosen.result.reason}"] if fails else []
        over += [poses_table(of_run)] if len(of_run.configurations) > 1 else []
        over += [limits_table(of_run)] if of_run.limits else []
        parts = over + parts  # what the study asks for comes first
        values |= {"sheet": of_run.to_dict()}
    return Answer(parts, values)


def _changed(options: _Options) -> Answer:
    """Return the run beside its design with other values of some variables."""
    plot_argument(options.plot)
    options.refuse("with --set, which changes a run", *HEXAGON, "lc")
    chosen = named_design(options.design) if options.design else None
    if chosen is None or (result := chosen.result) is None:
        raise ValueError(f"--set: got {options.design or 'no design'}, expected a run, whose study has variables")
    changes = changes_option(options.changes or ())
    changed = result.with_changes(**changes)
    with searching(options.screen, "evaluate", chosen):
        comparison = nd.compare(result, changed, names=("run", "changed"))
    answer = compared(comparison, options.plot)
    words = (_set_words(name.removesuffix(DEG), result, changed) for name in changes)
    return answer._replace(parts=[*words, *answer.parts, *result.study.tolerances.remark()])


def _set_words(name: str, result: nd.Result, changed: nd.Result) -> str:
    """Return from what to what a variable was set."""
    study = result.study
    was, now = (study.shown(name, (one.variables or {})[name]) for one in (result, changed))
    unit, digits = study.unit_of(name), 7 if f"{was:.7g}" != f"{now:.7g}" else 15
    if was == now:
        return f"set: {name} is {amount(f'{was:.7g}', unit)} in the run already"
    return f"set: {name} from {amount(f'{was:.{digits}g}', unit)} to {amount(f'{now:.{digits}g}', unit)}"


def _table(title: str, values: dict[str, Any], unit: str) -> Table:
    rows: list[Any] = [
        _line(DETERMINANTS if name == "singularity_margins" else index.words, values[name])
        for name, index in computed().items()
        if name in values and name not in ("singular_values", "leg_lengths")
    ]
    rows += [_line("characteristic length", values["characteristic_length"], unit), ()]
    rows += [_line(f"singular value {k} of J'", x) for k, x in enumerate(values["singular_values"], start=1)]
    rows.append(())
    rows += [_line(f"legs {kind}1 {kind}2 {kind}3", lengths, unit) for kind, lengths in values["leg_lengths"].items()]
    rows.append(())
    for kind, at in values["characteristic_lengths"].items():
        if math.isfinite(at["length"]):
            words = f"{_digits(at['length'])}: condition number {_digits(at['condition_number'])}"
            rows.append(Line(f"at the {kind} length", [words], unit=unit))
    return Table(title, columns("", ">"), rows)


def _line(name: str, numbers: Any, unit: str = "") -> Line:
    return Line(name, ["  ".join(map(_digits, np.atleast_1d(numbers)))], unit=unit)


def _digits(value: float) -> str:
    """Return six decimals, and of what is smaller than 1e-3 six figures."""
    return f"{value:.6f}" if value == 0.0 or abs(value) >= 1e-3 else f"{value:.6g}"
