"""Finished pieces of an optimization in a folder: a run that was interrupted or killed goes on behind the last one.

Each piece follows from those before it. So a run is continued by doing everything again with the pieces that were kept,
which gives the same result, bit for bit.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ninedof.design.study import Study
from ninedof.optimize.result import Result, Status, result_from
from ninedof.proof.optimum_proof import OptimumProof
from ninedof.support.files import Arrays, from_json_array, json_array
from ninedof.support.store import Store

WORDS, CERTIFICATE = "words", "certificate"  # names of a piece: its JSON, and the bytes of a certificate


class Pieces:
    """The pieces of one optimization, in the order in which they are needed."""

    def __init__(self, store: Store | None = None) -> None:
        """Begin with the pieces of a store; without one all are computed."""
        self._store, self._next = store, 0
        self.new_pieces = 0
        """Number of pieces that were not in the store."""

    def result(self, study: Study, compute: Callable[[], Result], time_limit: float = math.inf) -> Result:
        """Return the result of a study; one that was interrupted, or that the time limit ended, is no piece."""
        if (piece := self._read()) is not None:
            return result_from(study, from_json_array(piece[WORDS]))
        result = compute()
        if result.interrupted or (result.status == Status.STOPPED and result.seconds >= time_limit):
            self._store = None  # nothing follows from it that is worth keeping
        self._keep({WORDS: json_array(result.to_dict())})
        return result

    def proof(self, compute: Callable[[], OptimumProof]) -> OptimumProof:
        """Return a proof with its certificate."""
        if (piece := self._read()) is not None:
            proof = OptimumProof.from_dict(from_json_array(piece[WORDS]))
            return replace(proof, certificate=piece[CERTIFICATE].tobytes())
        proof = compute()
        if not proof.interrupted:
            words = json_array(proof.to_dict())
            self._keep({WORDS: words, CERTIFICATE: np.frombuffer(proof.certificate, dtype=np.uint8)})
        return proof

    def _read(self) -> Arrays | None:
        """Return the next piece, if it was kept: those behind one that is missing are not read."""
        piece = None if self._store is None else self._store.read(self._next)
        self._next += piece is not None
        self.new_pieces += piece is None
        return piece

    def _keep(self, arrays: Arrays) -> None:
        if self._store is not None:
            self._store.keep(self._next, arrays)
            self._next += 1
