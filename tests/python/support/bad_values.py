"""Values that callers hand over by mistake or in malice: of no kind in particular, and made from a good value."""

import ctypes
import datetime
import fractions
import functools
from pathlib import Path

import numpy as np


class Text(str):
    """A text of another class."""


class Array(np.ndarray):
    """An array of another class."""


class Unprintable:
    def __repr__(self):
        raise RuntimeError("no text")


def nested(depth):
    out = []
    for _ in range(depth):
        out = [out]
    return out


def endless():
    out = []
    out.append(out)
    return out


# Made anew for each call: a generator is used up, an array might be written to.
ANY = {
    "None": lambda: None,
    "True": lambda: True,
    "an object": object,
    "an unprintable object": Unprintable,
    "a class": lambda: float,
    "a function": lambda: lambda *a, **k: None,
    "empty text": lambda: "",
    "text": lambda: "x",
    "text of another class": lambda: Text("x"),
    "text with escapes": lambda: "\x1b]0;a\x07\r\n[bold]b[/]\u202e",
    "text of a lone surrogate": lambda: "a\ud800",
    "long text": lambda: "y" * 100_000,
    "a number as text": lambda: "1.0",
    "bytes": lambda: b"x",
    "a bytearray": lambda: bytearray(b"x"),
    "a memoryview of bytes": lambda: memoryview(b"abc"),
    "a memoryview of numbers": lambda: memoryview(np.ones(3)),
    "a list, empty": list,
    "a tuple, empty": tuple,
    "a dict, empty": dict,
    "a dict": lambda: {"a": 1},
    "a dict of odd keys": lambda: {None: None, 3: [], (): {}},
    "a set": lambda: {1.0, 2.0},
    "a generator": lambda: (x for x in (1.0, 2.0, 3.0)),
    "a range": lambda: range(3),
    "a list in lists": lambda: nested(3000),
    "a list in itself": endless,
    "a ragged list": lambda: [[1.0], [2.0, 3.0]],
    "a list of texts": lambda: ["a", "b"],
    "a list of None": lambda: [None, None, None],
    "a list with a huge number": lambda: [10**400, 1, 1],
    "NaN": lambda: float("nan"),
    "inf": lambda: float("inf"),
    "-inf": lambda: float("-inf"),
    "-1": lambda: -1,
    "0": lambda: 0,
    "1": lambda: 1,
    "-1.5": lambda: -1.5,
    "1.5": lambda: 1.5,
    "2^31": lambda: 2**31,
    "2^62": lambda: 2**62,
    "2^63": lambda: 2**63,
    "10^400": lambda: 10**400,
    "-10^5000": lambda: -(10**5000),
    "a denormal": lambda: 5e-324,
    "1e300": lambda: 1e300,
    "-1e300": lambda: -1e300,
    "1e-300": lambda: 1e-300,
    "complex": lambda: 1j,
    "a fraction": lambda: fractions.Fraction(1, 3),
    "a date": lambda: datetime.date(2000, 1, 1),
    "a ctypes number": lambda: ctypes.c_double(1.0),
    "a numpy number NaN": lambda: np.float64("nan"),
    "a numpy whole number": lambda: np.int64(-1),
    "a numpy truth": lambda: np.True_,
    "a numpy date": lambda: np.datetime64("2000-01-01"),
    "an array, 0-d": lambda: np.array(1.5),
    "an array (0,)": lambda: np.zeros(0),
    "an array (0, 3)": lambda: np.zeros((0, 3)),
    "an array (2, 3)": lambda: np.ones((2, 3)),
    "an array (3, 3)": lambda: np.eye(3),
    "an array (7,)": lambda: np.ones(7),
    "an array of texts": lambda: np.array(["a", "b", "c"]),
    "an array of objects": lambda: np.array([None, "b", 1.0], dtype=object),
    "an array of records": lambda: np.zeros(3, dtype=[("x", float), ("y", float)]),
    "an array of many dimensions": lambda: np.zeros((1,) * 32),
    "a path with NUL": lambda: Path("a\0b"),
    "a path to nothing": lambda: Path("missing/there"),
    "a folder": lambda: Path("."),
}


def _put(value, number, at=0):
    out = value.copy()
    out.flat[at] = number
    return out


def _misaligned(value):
    raw = np.zeros(value.nbytes + 1, dtype=np.uint8)
    raw[1:] = np.frombuffer(np.ascontiguousarray(value).tobytes(), dtype=np.uint8)
    return raw[1:].view(np.float64).reshape(value.shape)


def _spaced(value):
    out = np.full((*value.shape, 2), np.nan)
    out[..., 0] = value
    return out[..., 0]


def _read_only(value):
    out = value.copy()
    out.flags.writeable = False
    return out


# The same numbers in another form: refused, or the same result bit by bit. Each also tells which numbers these are.
SAME = {
    "big-endian": lambda v: v.astype(">f8"),
    "not contiguous": _spaced,
    "reversed": lambda v: v[::-1].copy()[::-1],
    "in Fortran's order": np.asfortranarray,
    "misaligned": _misaligned,
    "read-only": _read_only,
    "float16": lambda v: v.astype(np.float16),
    "float32": lambda v: v.astype(np.float32),
    "long double": lambda v: v.astype(np.longdouble),
    "an array of another class": lambda v: v.view(Array),
    "a list": lambda v: v.tolist(),
    "a tuple": lambda v: tuple(v.tolist()),
    "whole numbers": lambda v: np.round(v).astype(np.int32),
    "small whole numbers": lambda v: np.clip(np.round(v), 0, 100).astype(np.uint8),
    "truths": lambda v: v > 0.0,
    "a memoryview": lambda v: memoryview(np.ascontiguousarray(v)),
}

# Other numbers, shapes and kinds.
OTHER = {
    **{
        f"{word} in it": functools.partial(_put, number=number)
        for word, number in {
            "NaN": np.nan,
            "inf": np.inf,
            "-inf": -np.inf,
            "a denormal": 5e-324,
            "1e300": 1e300,
            "-1e300": -1e300,
            "1e-300": 1e-300,
        }.items()
    },
    "all NaN": lambda v: np.full_like(v, np.nan),
    "all zero": np.zeros_like,
    "all denormal": lambda v: np.full_like(v, 5e-324),
    "all 1e300": lambda v: np.full_like(v, 1e300),
    "of mixed scale": lambda v: v * np.logspace(-150, 150, v.size).reshape(v.shape),
    "negative": np.negative,
    "an entry too few": lambda v: v[:-1],
    "an entry too many": lambda v: np.concatenate([v, v[:1]]),
    "one dimension more": lambda v: np.stack([v, v]),
    "two dimensions more, empty": lambda v: np.zeros((0, 2, *v.shape)),
    "turned": lambda v: v.T if v.ndim > 1 else v[:, None],
    "flat": lambda v: v.ravel() if v.ndim > 1 else v[None, None],
    "complex": lambda v: v.astype(complex),
    "texts": lambda v: v.astype(str),
    "bytes": lambda v: v.astype(bytes),
    "objects": lambda v: v.astype(object),
    "dates": lambda v: np.zeros(v.shape, dtype="datetime64[s]"),
    "durations": lambda v: np.zeros(v.shape, dtype="timedelta64[s]"),
    "masked": lambda v: np.ma.masked_array(v, mask=_put(np.zeros(v.shape, bool), True)),
}
