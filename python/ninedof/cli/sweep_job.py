"""A sweep or an atlas at the terminal: its run folder with finished chunks, its result, figures and report."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from ninedof.cli.answer import Answer, Figures, finish_job
from ninedof.cli.options import SCHEDULER, JobOptions, option, struct
from ninedof.cli.scheduler import executor_at
from ninedof.design.indices import size_of
from ninedof.records.record import run_folder, write_run
from ninedof.support.arrays import blocks
from ninedof.sweep import SweepResult
from ninedof.tables import Table

MOST_PRINTED = 10_000  # numbers in JSON; larger results are in the file only


@struct
class Job(JobOptions):
    """The options that a sweep and an atlas share."""

    scheduler: str | None = option(f"{SCHEDULER} the chunks.")

    def compute(self, call: Callable[..., SweepResult], title: str) -> tuple[SweepResult, Path]:
        """Compute with a progress bar; return the result and the run folder, which keeps finished chunks."""
        with run_folder(self.out) as folder:
            try:
                with executor_at(self.scheduler) as executor, self.screen.bar("points", title) as bar:
                    return call(executor=executor, out=folder, progress=bar.show), folder
            except KeyboardInterrupt:
                self.screen.data({"interrupted": True, "run": str(folder)})
                raise

    def write(
        self,
        result: SweepResult,
        folder: Path,
        data: Any,
        table: Table,
        draw: Callable[[], Figures],
        stated: Mapping[str, Any] | None = None,
    ) -> None:
        """Write the result and its record, print the table, then write figures and the report.

        `stated` is what the record says of the study of the design.
        """
        write = partial(write_run, result, folder, question=stated, results=data)
        finish_job(self, folder, Answer([table], data), write, draw)


def describe(result: SweepResult, name: str) -> dict[str, Any]:
    """Return the extremes of an index with their coordinates, and the numbers of infinite and missing values.

    The extremes of a signed index are those of its modulus, with their signs.
    """
    values = result[name]
    out: dict[str, Any] = {"points": int(values.size), "infinite": 0, "missing": 0}
    least, greatest = [], []  # where those of each piece are
    for first, piece in blocks(values):
        out["infinite"] += int(np.isinf(piece).sum())
        out["missing"] += int(np.isnan(piece).sum())
        finite = np.flatnonzero(np.isfinite(piece))
        if finite.size:
            sizes = size_of(name, piece[finite])
            least.append(first + finite[sizes.argmin()])
            greatest.append(first + finite[sizes.argmax()])
    if least:
        for word, ends, pick in (("least", least, np.argmin), ("greatest", greatest, np.argmax)):
            place = np.unravel_index(ends[pick(size_of(name, values.flat[ends]))], values.shape)
            out[word] = {"value": float(values[place]), "at": result.at(name, place)}
    return out


def json_data(result: SweepResult, summary: Mapping[str, Any]) -> dict[str, Any]:
    """Return the data of --json, with all values of a small result."""
    about = {"dims": dict(result.dims), "units": dict(result.units), "indices": summary}
    data: dict[str, Any] = {"sweep": {**about, "attributes": result.attributes}}
    if sum(a.size for a in (*result.arrays.values(), *result.coords.values())) <= MOST_PRINTED:
        data["sweep"]["coords"] = {name: values.tolist() for name, values in result.coords.items()}
        data["sweep"]["arrays"] = {name: values.tolist() for name, values in result.arrays.items()}
    return data
