"""`ninedof sweep`: an index over a grid of configurations or designs."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from functools import partial
from pathlib import Path

import numpy as np

import ninedof as nd
from ninedof.cli.answer import Figures
from ninedof.cli.options import DESIGN, HEXAGON, THREADS, HexagonalOptions, argument, length_option, option, struct
from ninedof.cli.posed import Chosen, chosen_design, named_design, with_length
from ninedof.cli.sweep_job import Job, describe, json_data
from ninedof.design.indices import computed
from ninedof.design.study import FAMILIES as FAMILY_NAMES
from ninedof.design.variables import variables_of
from ninedof.paper.published import published_variables
from ninedof.redundancy.rules import RULES
from ninedof.support.arguments import choice
from ninedof.support.units import DEG, plain_name
from ninedof.sweep.axis import Values
from ninedof.sweep.points import COORDINATES, INTERNAL, POSITION, ROTATION, rule_of_study
from ninedof.sweep.result import summary_table

FAMILIES = {name: tuple(nd.Study(name).variables) for name in FAMILY_NAMES}
VARIABLES = frozenset(name for names in FAMILIES.values() for name in names)
FIGURES = ("figure-6", "figure-7")
OF_POSES = ("absolute", "internal_point", "threads")
NONE_WITH_FIGURES = ("over", "index", *OF_POSES, "lc", "chunk", *HEXAGON)
EXAMPLES = """
  ninedof sweep figure-6                   the condition number against displacement, as in the paper's Fig. 6
  ninedof sweep --over x_p=-1:1:201 --over theta_z_deg=-60:60:121
  ninedof sweep design.toml --over z_s=-1:1:401 --index singular_values --index leg_lengths
  ninedof sweep --over a1=0:3:31 --over b2=0:3:31      designs in place of configurations
  ninedof sweep runs/20260101-120000 --over platform_internal_angle_deg=-60:60:121 --index leg_ratio"""


@struct
class _Options(HexagonalOptions, Job):
    what: str | None = argument(
        f"figure-6, figure-7, or {DESIGN}. By default the published design at its best zs.", None
    )
    over: list[str] | None = option(
        "NAME=LOW:HIGH:COUNT or NAME=VALUE,VALUE,..., up to three times. Names: x_p y_p z_p theta_x theta_y "
        "theta_z x_s y_s z_s, or variables of the design's family, as a1 a2 b1 b2 zp zs. Angles in radians, or in "
        "degrees with _deg behind the name.",
        values=sorted({*COORDINATES, *VARIABLES}),
    )
    index: list[str] | None = option(
        f"The index, condition_number by default; may be repeated. One of "
        f"{', '.join(computed())}; over designs also six_legged.",
        values=computed(),
    )
    absolute: bool = option("Values are the coordinates themselves, not displacements.", False, "--absolute")
    internal_point: str | None = option(
        "Position of O while the platform moves: held, carried, shifted or best; by default as in the region of the "
        "run's study, else held, and held where O is swept.",
        values=RULES,
    )
    points: int | None = option("Points of each curve of a figure.")
    chunk: int | None = option("Points per chunk. The result does not depend on it.")
    threads: int | None = option(THREADS)


def sweep(job: _Options) -> None:
    """Compute an index over one to three coordinates of the configuration, or variables of the design."""
    what, chosen, start, note = job.what, None, "", ""
    if what in FIGURES:
        job.refuse(f"with {what}", *NONE_WITH_FIGURES)
        call: Callable[..., nd.SweepResult] = partial(nd.sweep_figure, what.removeprefix("figure-"), job.points)
        title = what.replace("figure-", "Fig. ")
    else:
        grid = _grid(job)
        title = f"over {', '.join(grid)}"
        chosen = None if what is None else chosen_design(what, job)
        if all(plain_name(name) in COORDINATES for name in grid):
            start = "" if job.absolute else "from the neutral pose"
            rule = job.internal_point or rule_of_study(chosen, grid)
            note = _held_words(grid, rule) + _note(chosen)
            call = _over_poses(chosen, job, grid, rule)
        else:
            job.refuse("in a sweep over designs", *OF_POSES)
            note = f"at the neutral pose alone{_note(chosen)}"
            call = _over_designs(what, chosen, job, grid)
    title += f", {start}" * bool(start)
    result, folder = job.compute(call, title)
    title += f"; {note}" * bool(note)
    drawn = f"{start}; {note}" if start else note
    summary = {name: describe(result, name) for name in result if result[name].dtype.kind == "f"}
    table = summary_table(summary, title, result.units)
    stated = None if chosen is None else chosen.stated
    job.write(result, folder, json_data(result, summary), table, lambda: _figures(result, what, drawn), stated)


def _held_words(grid: Iterable[str], rule: str) -> str:
    """Return where O is in a sweep over coordinates, and what of the platform stays."""
    swept = set(map(plain_name, grid))
    moved = rule if not swept & set(INTERNAL) else "moved" if rule == "held" else f"{rule} and moved"
    stays = {"in one orientation": ROTATION, "at one position": POSITION}
    return ", ".join([f"with O {moved}", *(words for words, names in stays.items() if not swept & set(names))])


def _note(chosen: Chosen | None) -> str:
    """Return that a sweep of a design whose study is about a region or poses is not over them; "" for other designs."""
    study = None if chosen is None else chosen.study
    if study is None or not (study.objective.poses or study.objective.region):
        return ""
    return f", not over the {'region' if study.objective.region else 'poses'} of the study"


def _over_poses(
    chosen: Chosen | None, job: _Options, grid: Mapping[str, Values], rule: str
) -> Callable[..., nd.SweepResult]:
    """Return the sweep over coordinates of a design, or of the published one at its best zs."""
    if chosen is None:
        chosen = chosen_design(None, job) if job.values_of(*HEXAGON) else with_length(named_design(None), job.lc)
    return partial(
        nd.sweep,
        chosen.geometry,
        chosen.configuration,
        grid,
        job.index or "condition_number",
        relative=not job.absolute,
        internal_point=rule,
        characteristic_length=chosen.characteristic_length,
        unit=chosen.unit,
        chunk=job.chunk,
        threads=job.threads,
    )


def _over_designs(
    name: str | None, chosen: Chosen | None, job: _Options, grid: Mapping[str, Values]
) -> Callable[..., nd.SweepResult]:
    """Return the sweep over variables of the design of a name, or of a hexagonal one given by its sides."""
    over = list(map(plain_name, grid))
    if chosen is None:
        family, values = "hexagonal", _sides(job, over)
        length, unit = 1.0 if job.lc is None else length_option(job.lc), ""
    else:
        family, values = _variables(name, chosen, over)
        length, unit = chosen.characteristic_length, chosen.unit
    return partial(
        nd.sweep_designs,
        {name: values[name] for name in FAMILIES[family] if name in values and name not in over},
        grid,
        job.index or "condition_number",
        family=family,
        characteristic_length=length,
        unit=unit,
        chunk=job.chunk,
    )


def _sides(job: _Options, over: Iterable[str]) -> Mapping[str, float]:
    own = job.values_of(*HEXAGON)
    twist = own.pop("theta_z_deg", None)
    if both := sorted(set(own) & set(over)):
        raise ValueError(f"--over: got {both[0]}, which --{both[0]} holds, expected one of the two")
    if others := [swept for swept in over if swept not in FAMILIES["hexagonal"]]:
        raise ValueError(f"--over: got {others[0]}, expected a DESIGN whose family has it")
    values = own or published_variables()
    return values if twist is None else values | {"theta_z": math.radians(twist)}


def _variables(name: str | None, chosen: Chosen, over: list[str]) -> tuple[str, Mapping[str, float]]:
    if chosen.tool:
        raise ValueError(
            f"--over: got variables of {name}, which has a [tool], expected coordinates of the configuration; "
            "a changed design with its tool is that of `ninedof evaluate RUN --set`, a front of `ninedof pareto RUN`"
        )
    fits: dict[str, Mapping[str, float]] = {}
    if chosen.result is not None and chosen.result.best is not None:
        fits[chosen.result.study.family] = chosen.result.best.variables
    for family in FAMILIES:
        if family not in fits and (own := variables_of(family, chosen.geometry, chosen.configuration)) is not None:
            fits[family] = own
    for family, values in fits.items():
        if set(over) <= set(FAMILIES[family]):
            return family, values
    expected = f"variables of one family: {', '.join(fits)}" if fits else "coordinates: O or p is not on the z axis"
    raise ValueError(f"--over: got {', '.join(over)}, which {name} does not have as variables, expected {expected}")


def _grid(job: _Options) -> dict[str, Values]:
    what, over = job.what, job.over or ()
    if what is not None and what.startswith("figure-") and not Path(what).exists():
        raise ValueError(f"sweep: got {what}, expected one of {', '.join(FIGURES)}, or a design")
    if not over:
        raise ValueError(f"sweep: got no --over, expected --over NAME=LOW:HIGH:COUNT, or one of {', '.join(FIGURES)}")
    job.refuse("with --over", "points")
    grid = dict(parse_over(text) for text in over)
    for name in grid:
        if plain_name(name) not in VARIABLES:
            hexagonal = (n for n in FAMILIES["hexagonal"] if n not in COORDINATES)
            choice("--over", name, (*COORDINATES, *(angle + DEG for angle in ROTATION), *hexagonal))
    plain = {plain_name(name) for name in grid}
    if not plain <= set(COORDINATES) and not plain <= VARIABLES:  # theta_z is both
        got = ", ".join(grid)
        raise ValueError(f"--over: got {got}, expected coordinates of the configuration or variables of the design")
    if len(grid) < len(over):
        raise ValueError(f"--over: got {', '.join(over)}, expected different names")
    return grid


def parse_over(text: str) -> tuple[str, Values]:
    """Read NAME=LOW:HIGH:COUNT or NAME=VALUE,VALUE,...; the name of an angle in degrees ends in _deg."""
    name, equals, rest = text.partition("=")
    parts = rest.split(":")
    try:
        if not equals or len(parts) not in (1, 3):
            raise ValueError
        if len(parts) == 1:
            return name, np.array([float(value) for value in rest.split(",")])
        return name, (float(parts[0]), float(parts[1]), int(parts[2]))
    except ValueError:
        expected = "NAME=LOW:HIGH:COUNT, or NAME=VALUE,VALUE,..."
        raise ValueError(f"--over: got {text!r}, expected {expected}") from None


def _figures(result: nd.SweepResult, what: str | None, note: str) -> Figures:
    from ninedof.paper import figures

    if what in FIGURES:
        yield "sweep", (figures.figure_6 if what == "figure-6" else figures.figure_7)(result)
        return
    names = list(result)
    for name in names:
        yield ("sweep" if len(names) == 1 else f"sweep_{name}"), nd.plot.sweep(result, name, note)
