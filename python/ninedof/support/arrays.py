"""Checks and broadcasting of array arguments for the core, and large arrays looked at in pieces."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ninedof.support.arguments import shown, whole

Floats = NDArray[np.float64]

MOST_THREADS = 1024  # more than machines have processors: beyond it systems refuse them


def as_floats(name: str, value: ArrayLike, trailing: tuple[int, ...]) -> Floats:
    """Return `value` as float64 with the given trailing shape, or raise ValueError naming the argument."""
    try:
        array = np.asarray(value)
        if array.dtype.kind not in "biuf" or isinstance(value, np.ma.MaskedArray):
            raise TypeError
        array = array.astype(np.float64)
    except (TypeError, ValueError):
        raise ValueError(
            f"{name}: got {shown(value)}, expected real numbers of shape {_shape_text(trailing)}"
        ) from None
    if array.ndim < len(trailing) or array.shape[array.ndim - len(trailing) :] != trailing:
        raise ValueError(f"{name}: got shape {array.shape}, expected shape {_shape_text(trailing)}")
    return array


def one_or_each(name: str, value: ArrayLike, count: int) -> Floats:
    """Return one number for all, or an array (..., count), as an array (..., count)."""
    array = as_floats(name, value, ())
    return np.full(count, array) if array.ndim == 0 else as_floats(name, array, (count,))


def as_number(name: str, value: Any) -> float:
    """Return `value` as one float, or raise ValueError naming the argument."""
    array = as_floats(name, value, ())
    if array.ndim:
        raise ValueError(f"{name}: got shape {array.shape}, expected a number")
    return float(array)


def broadcast_leading(arrays: dict[str, tuple[Floats, int]]) -> tuple[tuple[int, ...], list[Floats]]:
    """Broadcast the leading dimensions of named arrays, each given with its number of trailing ones."""
    shape = leading_shape(arrays)
    return shape, [
        np.ascontiguousarray(np.broadcast_to(a, shape + a.shape[a.ndim - trailing :]))
        for a, trailing in arrays.values()
    ]


def leading_shape(arrays: dict[str, tuple[Floats, int]]) -> tuple[int, ...]:
    """Return the shape to which the leading dimensions broadcast."""
    leading = [a.shape[: a.ndim - trailing] for a, trailing in arrays.values()]
    try:
        return np.broadcast_shapes(*leading)
    except ValueError:
        got = ", ".join(f"{name} {lead}" for name, lead in zip(arrays, leading, strict=True))
        raise ValueError(f"leading dimensions do not broadcast: got {got}") from None


def frozen(array: Floats) -> Floats:
    """Return a C-contiguous copy that nobody can make writeable: its numbers belong to a bytes object."""
    return np.ndarray(np.shape(array), np.float64, np.asarray(array, dtype=np.float64).tobytes())


def all_finite(name: str, values: Floats, missing: bool = False) -> Floats:
    """Return `values`, or raise ValueError if one is infinite or NaN; NaN is allowed where it marks missing data."""
    for what, bad in (("an infinite number", np.isinf(values)), ("NaN", np.isnan(values) & (not missing))):
        if bad.any():
            raise ValueError(f"{name}: got {what}, expected finite numbers")
    return values


def checked_out(out: Any, shape: tuple[int, ...]) -> Floats | None:
    """Return `out` if it is None or an array that can take a result of this shape."""
    if out is None:
        return None
    got = repr(type(out).__name__)
    if isinstance(out, np.ndarray):
        flags = {"C-contiguous": out.flags.c_contiguous, "aligned": out.flags.aligned, "writeable": out.flags.writeable}
        faults = [f"not {name}" for name, fine in flags.items() if not fine]
        if out.shape == shape and out.dtype == np.float64 and not faults:
            return out
        got = ", ".join([f"one of {out.dtype} and shape {out.shape}", *faults])
    raise ValueError(f"out: got {got}, expected a writeable aligned C-contiguous float64 array of shape {shape}")


def filled(out: Any, shape: tuple[int, ...], compute: Callable[[Floats | None], Floats]) -> Any:
    """Return `out`, filled by `compute`, or without `out` a new result of the given shape; a number for shape ()."""
    values = compute(checked_out(out, shape))
    return values.reshape(shape)[()] if out is None else out


def _shape_text(trailing: tuple[int, ...]) -> str:
    return "(" + ", ".join(["...", *map(str, trailing)]) + ")"


def thread_argument(threads: Any) -> int:
    """Return a number of threads as the core takes it: 0 for one per processor."""
    return 0 if threads is None else whole("threads", threads, 1, MOST_THREADS)


BLOCK = 2**20  # entries, 8 MB


def blocks(array: NDArray[Any]) -> Iterator[tuple[int, NDArray[Any]]]:
    """Yield the number of the first entry of each piece, in the order of C, and the piece."""
    flat = np.ascontiguousarray(array).reshape(-1)
    for first in range(0, flat.size, BLOCK):
        yield first, flat[first : first + BLOCK]
