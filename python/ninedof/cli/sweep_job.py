"""A sweep or an atlas at the terminal: its run folder with finished chunks, its result, figures and report."""

from __future__ import annotations

import shlex
from asyncio import CancelledError
from collections.abc import Callable, Iterable, Mapping
from contextlib import nullcontext
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import typer
from rich.table import Table

from ninedof.cli import options
from ninedof.cli.job_report import report_words, told, with_report
from ninedof.cli.long_run import CHUNKS, run_folder
from ninedof.cli.screen import INTERRUPTED, Screen, bold
from ninedof.design.indices import INDICES, size_of
from ninedof.runs.command_file import Input
from ninedof.runs.folder import FILE as RECORD
from ninedof.runs.folder import write_run
from ninedof.support.angles import degrees_of, plain_name
from ninedof.support.arguments import LONGEST
from ninedof.support.blocks import blocks
from ninedof.support.units import amount
from ninedof.sweep import SweepResult
from ninedof.sweep.chunks import STATE
from ninedof.sweep.cluster import dask_executor, is_of_cluster

if TYPE_CHECKING:
    from matplotlib.figure import Figure

AGAIN = "; the same command with --out {} --resume continues the run"
MOST_PRINTED = 10_000  # numbers in JSON; larger results are in the file only


@dataclass(frozen=True)
class Job:
    """The options that a sweep and an atlas share."""

    out: options.Out = None
    resume: options.Resume = False
    scheduler: options.Scheduler = None
    figures: options.Figures = True
    report: options.Report = True
    json: options.Json = False

    @cached_property
    def screen(self) -> Screen:
        """Where it prints."""
        return Screen(self.json)

    def compute(
        self, call: Callable[..., SweepResult], title: str, reads: Input | None = None
    ) -> tuple[SweepResult, Path]:
        """Compute with a progress bar; return the result and the run folder, which keeps finished chunks."""
        with run_folder(self.out, self.resume, reads) as folder:
            try:
                cluster = nullcontext() if self.scheduler is None else dask_executor(self.scheduler)
                with cluster as executor, self.screen.points(title) as bar:
                    return call(executor=executor, out=folder / CHUNKS, progress=bar.show), folder
            except KeyboardInterrupt:
                self.screen.print(bold("interrupted", f": {_kept(folder)}"))
                self.screen.data({"interrupted": True, "run": str(folder)})
            except (Exception, CancelledError) as error:
                if self.scheduler is None or not is_of_cluster(error):
                    raise
                reason = f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
                kept = _kept(folder, AGAIN)
                raise RuntimeError(f"--scheduler: lost {self.scheduler} ({reason[:LONGEST]}); {kept}") from None
        raise typer.Exit(INTERRUPTED)

    def write(
        self,
        result: SweepResult,
        folder: Path,
        data: Any,
        words: Callable[[], object],
        draw: Callable[[], Iterable[tuple[str, Figure]]],
    ) -> None:
        """Write the result and its record, say the words, then write figures, each with its name, and the report."""
        names: list[str] = []
        stem = next(iter(data))

        def drawn(place: Path) -> list[Path]:
            self.screen.say(f"drawing the {stem}")
            from ninedof import plot

            files: list[Path] = []
            for name, figure in draw():
                names.append(name)
                files += plot.save(figure, place, name)
            return files

        try:
            with told(self.screen, words, data) as once:
                drawing = with_report(drawn if self.figures else None, self.report and self.figures, self.screen, once)
                record = write_run(result, folder, drawing, results=data)
        except OSError as error:
            if not (folder / RECORD).is_file():
                kept = _kept(folder, AGAIN)
                error.add_note(f"{kept[0].upper()}{kept[1:]}.")
            raise
        made = f", figure{'s' * (len(names) > 1)} {', '.join(names)} (PNG, SVG, PDF)" if names else ""
        self.screen.print(f"run folder {folder}: {record.name}, {stem}.npz{made}{report_words(folder)}")
        self.screen.data({**data, "record": str(record)})


def _kept(folder: Path, more: str = "") -> str:
    """Return what is kept of a run that has no record."""
    if not (folder / CHUNKS / STATE).is_file():
        return "nothing is kept of what was computed"
    return f"finished chunks are kept in {folder}{more.format(shlex.quote(str(folder)))}"


def describe(result: SweepResult, name: str) -> dict[str, Any]:
    """Return the extremes of an index with their coordinates, and the numbers of infinite and missing values.

    The extremes of a signed index are those of its modulus, with their signs.
    """
    values = result[name]
    out: dict[str, Any] = {"points": int(values.size), "infinite": 0, "missing": 0}
    ends: dict[str, tuple[float, int]] = {}  # the size that is least or greatest so far, and where
    for first, piece in blocks(values):
        missing, infinite = np.isnan(piece), np.isinf(piece)
        out["infinite"] += int(infinite.sum())
        out["missing"] += int(missing.sum())
        known = np.flatnonzero(~(missing | infinite))
        if known.size:
            size = size_of(name, piece[known])
            for word, sign, pick in (("least", 1.0, np.argmin), ("greatest", -1.0, np.argmax)):
                at = int(pick(size))
                if word not in ends or sign * size[at] < sign * ends[word][0]:
                    ends[word] = float(size[at]), first + int(known[at])
    for word, (_, number) in ends.items():
        place = np.unravel_index(number, values.shape)
        out[word] = {"value": float(values[place]), "at": result.at(name, place)}
    return out


def summary_table(summary: Mapping[str, Mapping[str, Any]], title: str, units: Mapping[str, str]) -> Table:
    """Return the table of the least and the greatest value of each index, with their coordinates; angles in degrees."""
    table = Table(title=title, title_justify="left", title_style="bold")
    counts = [word for word in ("infinite", "missing") if any(row[word] for row in summary.values())]
    for head in ("index", "", "value", "at", *counts):
        table.add_column(head, justify="right" if head in ("value", *counts) else "left", overflow="fold")
    for name, row in summary.items():
        what = " modulus" if name in INDICES and INDICES[name].signed else ""
        least, greatest = (_end(row.get(word), name, units) for word in ("least", "greatest"))
        table.add_row(name.replace("_", " "), f"least{what}", *least, *(str(row[word]) for word in counts))
        table.add_row("", f"greatest{what}", *greatest, end_section=True)
    return table


def _end(end: Mapping[str, Any] | None, name: str, units: Mapping[str, str]) -> tuple[str, str]:
    if end is None:
        return "-", "-"
    at = end["at"]
    moved = "rad" if str(at.get("coordinate", "")).startswith("theta") else "l_c"  # of Fig. 6
    units = {dim: moved if unit == "l_c or rad" else unit for dim, unit in units.items()}
    where = (
        f"{plain_name(dim)} = {_number(value, units.get(dim, ''), 5)}" if isinstance(value, float) else f"{dim} {value}"
        for dim, value in at.items()
    )
    return _number(end["value"], units.get(name, ""), 6), "\n".join(where)


def _number(value: float, unit: str, digits: int) -> str:
    if unit == "rad":
        value, unit = degrees_of(value), "deg"
    return amount(f"{value:.{digits}g}", "" if unit in ("1", "length") else unit)


def json_data(result: SweepResult, summary: Mapping[str, Any]) -> dict[str, Any]:
    """Return the data of --json, with all values of a small result."""
    about = {"dims": dict(result.dims), "units": dict(result.units), "indices": summary}
    data: dict[str, Any] = {"sweep": {**about, "attributes": result.attributes}}
    if sum(a.size for a in (*result.arrays.values(), *result.coords.values())) <= MOST_PRINTED:
        data["sweep"]["coords"] = {name: values.tolist() for name, values in result.coords.items()}
        data["sweep"]["arrays"] = {name: values.tolist() for name, values in result.arrays.items()}
    return data
