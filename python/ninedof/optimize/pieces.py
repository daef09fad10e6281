"""Finished pieces of an optimization in a folder: a run that was interrupted or killed goes on behind the last one.

Each piece follows from those before it. So a run is continued by doing everything again with the pieces that were kept,
which gives the same result, bit for bit.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from typing import Any

import numpy as np

from ninedof.chunks.store import Store
from ninedof.design.study import Study
from ninedof.optimize.result import Result, result_from
from ninedof.proof.optimum import OptimumProof
from ninedof.support.files import Arrays
from ninedof.support.json import decode, encode

KEPT, CERTIFICATE = "result", "certificate"  # names of a piece in the store: the bytes of its JSON, and of a proof


class Pieces:
    """The pieces of one optimization, in the order in which they are needed."""

    def __init__(self, store: Store | None = None) -> None:
        """Begin with the pieces of a store; without one all are computed."""
        self._store, self._next = store, 0

    def result(self, study: Study, compute: Callable[[], Result]) -> Result:
        """Return the result of a study with poses; one that was interrupted is no piece."""
        if (found := self._read()) is not None:
            return result_from(study, _data(found))
        result = compute()
        if not result.interrupted:
            self._keep({KEPT: _bytes(result.to_dict())})
        return result

    def plain(self, compute: Callable[[], Any]) -> Any:
        """Return plain values: lists in place of tuples, whether they were kept or not."""
        if (found := self._read()) is not None:
            return _data(found)
        text = encode(compute(), indent=None)
        self._keep({KEPT: np.frombuffer(text.encode(), dtype=np.uint8)})
        return decode(text)

    def proof(self, compute: Callable[[], OptimumProof]) -> OptimumProof:
        """Return a proof with its certificate."""
        if (found := self._read()) is not None:
            return replace(OptimumProof.from_dict(_data(found)), certificate=found[CERTIFICATE].tobytes())
        proof = compute()
        if not proof.interrupted:
            data = {KEPT: _bytes(proof.to_dict()), CERTIFICATE: np.frombuffer(proof.certificate, dtype=np.uint8)}
            self._keep(data)
        return proof

    def _read(self) -> Arrays | None:
        """Return the next piece, if it was kept: those behind one that is missing are not looked at."""
        found = None if self._store is None else self._store.read(self._next)
        if found is not None:
            self._next += 1
        return found

    def _keep(self, arrays: Arrays) -> None:
        if self._store is not None:
            with suppress(OSError):  # a full disk: the result is worth more than its piece
                self._store.write(self._next, arrays)
            self._next += 1


def _bytes(value: Any) -> np.ndarray[Any, np.dtype[np.uint8]]:
    return np.frombuffer(encode(value, indent=None).encode(), dtype=np.uint8)


def _data(found: Arrays) -> Any:
    return decode(found[KEPT].tobytes().decode())
