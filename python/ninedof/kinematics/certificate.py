"""The proof about the assembly modes of given leg lengths."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninedof.robot.configuration import Configuration
from ninedof.support.arrays import Floats
from ninedof.support.text import short_repr


@short_repr
class ModesCertificate(NamedTuple):
    """Proof about the assembly modes of exactly these joints and lengths, by interval arithmetic.

    Reference: Krawczyk's operator and bisection over the quaternions of each branch, docs/theory/position.md. O on both
    sides of both planes of internal joints is included. Where `complete`, the modes are all that exist.
    """

    complete: Any
    """Whether the number of modes is proved: no box is undecided. A bool, or an array of shape (...)."""
    proved: Any
    """Number of modes proved to exist, each counted once. An integer, or an array of shape (...)."""
    undecided: Any
    """Number of boxes that may hold none, one or several modes, as at a double mode; shape (...)."""
    boxes: Any
    """Number of boxes of rotations examined, shape (...)."""
    radius: Floats
    """The greatest distance of the exact mode from the listed one, shape of the modes; infinite if it is not proved.

    In every entry of Q, and in every coordinate of p and O divided by the longest leg.
    """
    places: Configuration
    """The middles of the undecided boxes, shape (..., most); NaN follows in a stack."""
    place_radius: Floats
    """Of the undecided boxes, as `radius`, shape (..., most)."""


def with_gaps(counts: NDArray[Any], values: NDArray[Any], width: int, gap: float) -> NDArray[Any]:
    """Return the values of all rows, one after the other, in a stack of shape (rows, most, width)."""
    most = int(counts.max(initial=0))
    out = np.full((len(counts), most, width), gap, dtype=values.dtype)
    out[np.arange(most) < counts[:, None]] = values.reshape(-1, width)
    return out


def each(shape: tuple[int, ...], values: NDArray[Any]) -> Any:
    """Return values of rows in the shape of their stack; one as Python has it where there is no stack."""
    return values.reshape(shape)[()] if shape else values.item()


def column(chunks: list[Any], name: str) -> NDArray[Any]:
    """Return a column of all chunks."""
    return np.concatenate([getattr(one, name) for one in chunks])


def certificate_of(shape: tuple[int, ...], counts: NDArray[Any], data: Any, chunks: list[Any]) -> ModesCertificate:
    """Build the certificate from what the core returns for chunks of rows; `data` says which rows have lengths."""
    undecided = column(chunks, "undecided")
    rows = with_gaps(undecided, column(chunks, "places"), 15, np.nan)
    full = (*shape, rows.shape[1])
    return ModesCertificate(
        complete=each(shape, (undecided == 0) & data),
        proved=each(shape, column(chunks, "proved").astype(np.int64)),
        undecided=each(shape, undecided.astype(np.int64)),
        boxes=each(shape, column(chunks, "boxes")),
        radius=with_gaps(counts, column(chunks, "radius"), 1, np.nan).reshape(*shape, -1 if len(counts) else 0),
        places=Configuration._shaped(full, rows[..., :3], rows[..., 3:12], rows[..., 12:]),
        place_radius=with_gaps(undecided, column(chunks, "place_radius"), 1, np.nan).reshape(full),
    )
