"""The folders of runs."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from datetime import datetime
from pathlib import Path

from ninedof.support.command import goes_on
from ninedof.support.store import require_run_or_nothing

RUNS = Path("runs")


@contextmanager
def run_folder(out: Path | None) -> Iterator[Path]:
    """Yield the folder of a run: `out`, which is missing, empty or that of a run to go on with, or runs/<time> here.

    Whether the run there has the same question is for its `Store` to say, which also makes `out`. A folder of runs/
    in which nothing is kept is removed. The command that is typed again goes on in the folder.
    """
    if out is not None:
        require_run_or_nothing(out)
        goes_on(out)
        yield out
        return
    folder = _of_now()
    goes_on(folder)
    try:
        yield folder
    finally:
        with suppress(OSError):
            folder.rmdir()
            RUNS.rmdir()


def _of_now() -> Path:
    stamp = datetime.now().strftime("%Y%m%d-%H%M%S")
    for attempt in itertools.count():
        path = RUNS / (f"{stamp}-{attempt}" if attempt else stamp)
        try:
            path.mkdir(parents=True)
        except FileExistsError:
            continue
        except OSError as error:
            expected = "expected a writeable place"
            raise ValueError(f"out: got {path}, which cannot be created ({error.strerror}), {expected}") from None
        return path
    raise AssertionError("unreachable")
