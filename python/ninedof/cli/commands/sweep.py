"""`ninedof sweep`: what is asked for, and a few words about what came out."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from rich.table import Table

from ninedof.cli.commands.evaluation import chosen_design, length_option
from ninedof.cli.commands.kept import compute, run_folder, write
from ninedof.cli.commands.screen import DONE, INTERRUPTED, Screen
from ninedof.paper import paper
from ninedof.runs.design_file import Design, hexagonal_design
from ninedof.support.arguments import shown
from ninedof.support.arrays import thread_argument
from ninedof.sweep import SweepResult, sweep_designs, sweep_figure
from ninedof.sweep import sweep as sweep_poses
from ninedof.sweep.axis import Values
from ninedof.sweep.poses import COORDINATES

__all__ = ["SweepOptions", "sweep"]

FIGURES = ("figure-6", "figure-7")
HEIGHTS = ("zp", "zs")
MOST_PRINTED = 10_000  # numbers that JSON repeats; the file has them all


@dataclass(frozen=True)
class SweepOptions:
    """What the command line says about the points."""

    over: Sequence[str]
    index: Sequence[str]
    absolute: bool
    internal_point: str | None
    lc: str | None
    points: int | None
    chunk: int | None
    threads: int | None


def sweep(
    what: str | None,
    sides: Mapping[str, float | None],
    theta_z_deg: float | None,
    options: SweepOptions,
    out: Path | None,
    resume: bool,
    scheduler: str | None,
    figures: bool,
    json: bool,
) -> int:
    """Sweep; print, record, return the exit status."""
    screen = Screen(json)
    thread_argument(options.threads)
    if what in FIGURES:
        _expect_none(f"with {what}", vars(options) | dict(sides) | {"theta_z_deg": theta_z_deg, "points": None})
        asked: Callable[..., SweepResult] = partial(sweep_figure, what.removeprefix("figure-"), options.points)
        title = what.replace("figure-", "Fig. ")
    else:
        asked, title = _asked(what, sides, theta_z_deg, options)
    with run_folder(out, resume) as directory:
        result = compute(asked, title, directory, scheduler, screen)
    if result is None:
        return INTERRUPTED
    summary = {name: describe(result, name) for name in result if result[name].dtype.kind == "f"}
    screen.print(_table(summary, title))
    write(
        result, directory, "sweep", (lambda: _figure(result, what)) if figures else None, screen, _data(result, summary)
    )
    return DONE


def _asked(
    what: str | None, sides: Mapping[str, float | None], theta_z_deg: float | None, options: SweepOptions
) -> tuple[Callable[..., SweepResult], str]:
    """Return the sweep of the options, and its title."""
    if what is not None and what.startswith("figure-") and not Path(what).exists():
        raise ValueError(f"sweep: got {what}, expected one of {', '.join(FIGURES)}, or a design")
    if not options.over:
        raise ValueError(f"sweep: got no --over, expected --over NAME=LOW:HIGH:COUNT, or one of {', '.join(FIGURES)}")
    _expect_none("with --over", {"points": options.points})
    over = dict(parse_over(text) for text in options.over)
    if len(over) < len(options.over):
        raise ValueError(f"--over: got {', '.join(options.over)}, expected different names")
    index = tuple(options.index) or ("condition_number",)
    title = f"over {', '.join(over)}"
    length = None if options.lc is None else length_option(options.lc)
    if any(name not in COORDINATES for name in over):
        unheard = {name: getattr(options, name) for name in ("absolute", "internal_point", "threads")}
        _expect_none("in a sweep over designs", unheard)
        held = _variables(what, sides, theta_z_deg, over)
        length = 1.0 if length is None else length
        return partial(sweep_designs, held, over, index, characteristic_length=length, chunk=options.chunk), title
    design = _design(what, sides, theta_z_deg)
    return partial(
        sweep_poses,
        design.geometry,
        design.configuration,
        over,
        index,
        relative=not options.absolute,
        internal_point=options.internal_point or "held",
        characteristic_length=design.characteristic_length if length is None else length,
        chunk=options.chunk,
        threads=options.threads,
    ), title


def _expect_none(where: str, given: Mapping[str, Any]) -> None:
    """Refuse options that nothing would read."""
    for name, value in given.items():
        if value is not None and value is not False and value != ():
            text = " ".join(value) if isinstance(value, list) else value
            got = "it" if value is True else text
            raise ValueError(f"--{name.replace('_', '-')}: got {got}, expected none {where}")


def parse_over(text: str) -> tuple[str, Values]:
    """Read NAME=LOW:HIGH:COUNT or NAME=VALUE,VALUE,...; an angle's name may end in _deg."""
    expected = "NAME=LOW:HIGH:COUNT, or NAME=VALUE,VALUE,..."
    name, equals, rest = text.partition("=")
    parts = rest.split(":")
    try:
        if not equals or len(parts) not in (1, 3):
            raise ValueError
        in_degrees = name.startswith("theta") and name.endswith("_deg")
        unit = math.radians if in_degrees else float
        name = name.removesuffix("_deg") if in_degrees else name
        if len(parts) == 1:
            return name, np.array([unit(float(value)) for value in rest.split(",")])
        return name, (unit(float(parts[0])), unit(float(parts[1])), int(parts[2]))
    except ValueError:
        raise ValueError(f"--over: got {text!r}, expected {expected}") from None


def _design(what: str | None, sides: Mapping[str, float | None], theta_z_deg: float | None) -> Design:
    """Return the design that is moved: the published one at its best zs where none is given."""
    if what is None and theta_z_deg is None and all(v is None for v in sides.values()):
        return hexagonal_design(paper.published_variables())
    return chosen_design(None if what is None else Path(what), sides, theta_z_deg)


def _variables(
    what: str | None, sides: Mapping[str, float | None], theta_z_deg: float | None, over: Mapping[str, Values]
) -> dict[str, float]:
    """Return the variables that a sweep over designs holds: the published ones where none is given."""
    if what is not None:
        raise ValueError(f"sweep: got {shown(what)} and --over {', '.join(over)}, expected a design by --a1 ... --zs")
    given = {name: value for name, value in sides.items() if value is not None}
    if both := sorted(set(given) & set(over)):
        raise ValueError(f"--over: got {both[0]}, which --{both[0]} holds, expected one of the two")
    values = given or paper.published_variables()
    if theta_z_deg is not None:
        values["theta_z"] = math.radians(theta_z_deg)
    return {name: value for name, value in values.items() if name not in over}


def describe(result: SweepResult, name: str) -> dict[str, Any]:
    """Return what is most and least of an index, where, and how many points have none."""
    values = result[name]
    finite = np.isfinite(values)
    out: dict[str, Any] = {
        "points": int(values.size),
        "infinite": int(np.isinf(values).sum()),
        "missing": int(np.isnan(values).sum()),
    }
    if finite.any():
        for word, pick in (("least", np.argmin), ("greatest", np.argmax)):
            fill = np.inf if word == "least" else -np.inf
            at = np.unravel_index(int(pick(np.where(finite, values, fill))), values.shape)
            out[word] = {"value": float(values[at]), "at": result.at(name, at)}
    return out


def _table(summary: Mapping[str, Mapping[str, Any]], title: str) -> Table:
    table = Table(title=title, title_justify="left", title_style="bold")
    counts = [word for word in ("infinite", "missing") if any(row[word] for row in summary.values())]
    for head in ("index", "", "value", "at", *counts):
        table.add_column(head, justify="right" if head in ("value", *counts) else "left", overflow="fold")
    for name, row in summary.items():
        table.add_row(name.replace("_", " "), "least", *_end(row.get("least")), *(str(row[word]) for word in counts))
        table.add_row("", "greatest", *_end(row.get("greatest")), end_section=True)
    return table


def _end(end: Mapping[str, Any] | None) -> tuple[str, str]:
    if end is None:
        return "-", "-"
    where = (f"{name} = {v:.5g}" if isinstance(v, float) else f"{name} {v}" for name, v in end["at"].items())
    return f"{end['value']:.6g}", "\n".join(where)


def _data(result: SweepResult, summary: Mapping[str, Any]) -> dict[str, Any]:
    data: dict[str, Any] = {"sweep": {"dims": dict(result.dims), "indices": summary, "attributes": result.attributes}}
    if sum(a.size for a in (*result.arrays.values(), *result.coords.values())) <= MOST_PRINTED:
        data["sweep"]["coords"] = {name: values.tolist() for name, values in result.coords.items()}
        data["sweep"]["arrays"] = {name: values.tolist() for name, values in result.arrays.items()}
    return data


def _figure(result: SweepResult, what: str | None) -> Any:
    from ninedof import plot

    named = {"figure-6": plot.figure_6, "figure-7": plot.figure_7}
    return named[what](result) if what in named else plot.sweep(result)
