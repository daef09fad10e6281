"""Finished pieces of an optimization in a folder: a run that was interrupted or killed goes on behind the last one.

Each piece follows from those before it. So a run is continued by doing everything again with the pieces that were kept,
which gives the same result, bit for bit.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from typing import Any

import numpy as np

from ninedof.chunks.store import Store
from ninedof.design.study import Study
from ninedof.optimize.result import Result, Status, result_from
from ninedof.proof.optimum import OptimumProof
from ninedof.support.files import Arrays
from ninedof.support.json import decode, encode

KEPT, CERTIFICATE = "result", "certificate"  # names of a piece in the store: the bytes of its JSON, and of a proof


class Pieces:
    """The pieces of one optimization, in the order in which they are needed."""

    def __init__(self, store: Store | None = None) -> None:
        """Begin with the pieces of a store; without one all are computed."""
        self._store, self._next = store, 0

    def result(self, study: Study, compute: Callable[[], Result], time_limit: float = math.inf) -> Result:
        """Return the result of a study; one that was interrupted, or that the time limit ended, is no piece."""
        if (found := self._read()) is not None:
            return result_from(study, _data(found))
        result = compute()
        if result.interrupted or (result.status == Status.STOPPED and result.seconds >= time_limit):
            self._store = None  # nothing follows from it that is worth keeping
        else:
            self._keep({KEPT: _bytes(result.to_dict())})
        return result

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
