"""Large arrays, looked at in pieces: one that is mapped from a file does not stay in memory."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

BLOCK = 2**20  # entries, 8 MB


def blocks(array: NDArray[Any]) -> Iterator[tuple[int, NDArray[Any]]]:
    """Yield the number of the first entry of each piece, in the order of C, and the piece; pages read are let go."""
    if not array.flags.c_contiguous:
        array = np.ascontiguousarray(array)
    flat = array.reshape(-1)
    for first in range(0, flat.size, BLOCK):
        yield first, flat[first : first + BLOCK]
        forget(array)


def forget(array: NDArray[Any]) -> None:
    """Let the pages of an array that is mapped from a file go; they are read again where they are needed."""
    pages = getattr(array, "_mmap", None)
    if pages is None:
        return
    import mmap

    if isinstance(pages, mmap.mmap) and hasattr(pages, "madvise"):
        pages.madvise(mmap.MADV_DONTNEED)
