"""Pieces that an optimization goes on from: additional starts, and the finished pieces of a run that ended early.

Each piece follows from those before it. So a run is continued by doing everything again with the pieces that were kept,
which gives the same result, bit for bit.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from ninedof.design.study import LENGTH, Study
from ninedof.optimize.candidate import Candidate
from ninedof.optimize.result import Result, Status, result_from
from ninedof.proof.optimum_proof import OptimumProof
from ninedof.support.arguments import finite, shown
from ninedof.support.arrays import Floats
from ninedof.support.kept.files import Arrays, from_json_array, json_array
from ninedof.support.kept.store import Store
from ninedof.support.structs import within
from ninedof.support.units import in_radians

Warm = Result | Candidate | Mapping[str, float]
"""A start: a result stands for its best candidates."""

MOST_OF_A_RESULT = 4  # candidates, so that most starts remain the low-discrepancy ones


def warm_starts(study: Study, warm: Warm | Iterable[Warm] | None) -> Floats | None:
    """Return additional starts as rows of full vectors, or None without any.

    Fixed variables keep the study's value. A characteristic length or an offset of O that is not free in this study is
    ignored, so that the result of one study may start another.
    """
    starts = warm_variables(warm)
    names = set(study.problem().names)
    rows = [_row(study, names, start) for start in starts]
    return np.array(rows) if rows else None


def warm_variables(warm: Warm | Iterable[Warm] | None) -> list[Mapping[str, float]]:
    """Return the values of each start by name: a result stands for its best candidates."""
    if warm is None:
        return []
    argument: Any = warm
    several = isinstance(argument, Iterable) and not isinstance(argument, Mapping | str)
    starts: list[Any] = []
    for item in argument if several else [argument]:
        starts += item.candidates[:MOST_OF_A_RESULT] if isinstance(item, Result) else [item]
    starts = [start.variables if isinstance(start, Candidate) else start for start in starts]
    for start in starts:
        if not isinstance(start, Mapping):
            expected = "a Result, a Candidate, a mapping of names to values, or a sequence of them"
            raise ValueError(f"warm: got {shown(start)}, expected {expected}")
    return starts


def _row(study: Study, names: set[str], start: Mapping[str, Any]) -> list[float]:
    fixed = {name: bound for name, bound in study.variables.items() if not isinstance(bound, tuple)}
    with within("warm", ": "):
        start = in_radians(start, dict.fromkeys(study.angles, finite))
        values = {n: v for n, v in start.items() if n in names or not (n == LENGTH or str(n).startswith("pose"))}
        return study.vector(values | {name: value for name, value in fixed.items() if name in values})


WORDS, CERTIFICATE, UNFINISHED = "words", "certificate", "unfinished"
"""Names of a piece: its JSON, the bytes of a certificate, and what a proof has that ended before its end."""


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

    def proof(
        self, compute: Callable[[OptimumProof | None], OptimumProof], time_limit: float = math.inf
    ) -> OptimumProof:
        """Return a proof with its certificate; one that was interrupted, or that the time limit ended, goes on.

        `compute` takes what was proved earlier.
        """
        earlier = None
        if (piece := self._read()) is not None:
            proof = OptimumProof.from_dict(from_json_array(piece[WORDS]))
            proof = replace(proof, certificate=piece[CERTIFICATE].tobytes())
            if UNFINISHED not in piece:
                return proof
            earlier = proof
            self._next, self.new_pieces = self._next - 1, self.new_pieces + 1
        proof = compute(earlier)
        piece = {
            WORDS: json_array(proof.to_dict()),
            CERTIFICATE: np.frombuffer(proof.certificate, dtype=np.uint8),
        }
        unfinished = not proof.complete and proof.better is None and proof.seconds >= time_limit
        self._keep(piece | ({UNFINISHED: np.array([])} if proof.interrupted or unfinished else {}))
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
