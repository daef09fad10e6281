"""The run folder of a command: the command typed again goes on there."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TypeVar

from ninedof.records import folder
from ninedof.support.command import goes_on
from ninedof.support.store import Store
from ninedof.workspace import CertifiedWorkspace, WorkspaceMap

S = TypeVar("S", WorkspaceMap, CertifiedWorkspace)


@contextmanager
def run_folder(out: Path | None) -> Iterator[Path]:
    """Yield the run folder of a command."""
    with folder.run_folder(out) as directory:
        goes_on(directory)
        yield directory


def piece(store: Store, number: int, kind: type[S], compute: Callable[[], S]) -> S:
    """Return a result that was kept, or compute and keep it; an interrupted one is no piece."""
    if (arrays := store.read(number)) is not None:
        return kind._made(arrays)
    result = compute()
    if not result.interrupted:
        store.keep(number, result._contents())
    return result
