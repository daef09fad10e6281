"""Calls a public name with each argument replaced in turn, and judges what comes of it.

A call must return, with no NaN where the good call has none, or raise a ValueError of one line that names the argument.
"""

import contextlib
import dataclasses
import enum
import io
import os
import random
import re
import signal
import sys
import traceback
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from bad_values import ANY, OTHER, SAME

import ninedof as nd

LONGEST_CALL = 30  # seconds until a call counts as one that hangs: no measure of speed
LONGEST_WORDS = 1500  # characters of a message
CALLED = ("progress", "index", "rule", "executor")  # what is wrong with a function of the caller is the caller's
HUGE = {"2^31", "2^62", "1e300"}


class Hangs(BaseException):
    pass


@dataclass(frozen=True)
class Row:
    """A good call, and what is special about it."""

    call: object
    arguments: object
    """Returns the arguments by name, made anew."""
    huge: tuple[str, ...] = ()
    """Arguments for which a huge number is a lot of work, and rightly taken."""
    words: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    """By which other words than its own name a message may name an argument."""
    nan: tuple[str, ...] = ()
    """Arguments whose extreme numbers may give NaN, where the documentation says so."""
    loose: tuple[str, ...] = ()
    """Arguments whose other forms need not give the same result: names of places, what is written to."""
    few: int = 12
    """How many values of each argument are tried in a short run; all under NINEDOF_LONG, see .ci/nightly."""
    dear: tuple[str, ...] = ()
    """Arguments of which only a few values are tried in a short run."""


@dataclass
class Tally:
    tried: int = 0
    taken: int = 0
    failures: list[str] = field(default_factory=list)


def places(arguments):
    """Where values stand: the arguments, and what lies in mappings and sequences among them."""

    def within(path, value):
        yield path, value
        if isinstance(value, Mapping):
            for key, entry in value.items():
                yield from within((*path, key), entry)
        elif isinstance(value, list | tuple) and not hasattr(value, "_fields") and numbers(value) is None:
            for k, entry in enumerate(value[:2]):
                yield from within((*path, k), entry)

    for name, value in arguments.items():
        yield from within((name,), value)


def numbers(value):
    """A value as an array of numbers, None if it is none."""
    if isinstance(value, list | tuple | np.ndarray) and not hasattr(value, "_fields"):
        with contextlib.suppress(ValueError, TypeError):
            array = np.asarray(value, dtype=None)
            if array.dtype.kind in "fiu" and array.size and array.ndim:
                return np.array(array, dtype=np.float64)
    return None


def put(value, path, new):
    """A value with what is at a path in it replaced."""
    if not path:
        return new
    if isinstance(value, Mapping):
        return {key: put(entry, path[1:], new) if key == path[0] else entry for key, entry in value.items()}
    return type(value)(put(entry, path[1:], new) if k == path[0] else entry for k, entry in enumerate(value))


def attacks(row):
    """Path, what is there instead, and how to make it; last whether it is the same numbers in another form."""
    for path, value in places(row.arguments()):
        for label, make in ANY.items():
            called = label in ("a class", "a function") and path[0] in CALLED
            if not called and not (label in HUGE and path[0] in row.huge):
                yield path, label, make, None
        array = numbers(value)
        if array is None:
            if isinstance(value, float) and not isinstance(value, bool):
                for kind in (np.float16, np.float32, np.longdouble, np.array):
                    made = kind(value)
                    yield path, f"{kind.__name__} of it", lambda made=made: made, float(made)
            continue
        for label, change in OTHER.items():
            yield path, label, lambda change=change, array=array: change(array.copy()), None
        for label, change in SAME.items():
            made = change(array)
            exact = np.array(made, dtype=np.float64)
            yield path, label, lambda change=change, array=array: change(array.copy()), exact


def fingerprint(value):
    """What must not change in an argument."""
    if isinstance(value, np.ma.MaskedArray):
        return value.data.tobytes(), value.mask.tobytes()
    if isinstance(value, np.ndarray):
        return value.shape, value.dtype.str, value.tobytes() if value.dtype.kind != "O" else len(value)
    if isinstance(value, Mapping):
        return tuple((repr(key), fingerprint(entry)) for key, entry in value.items())
    if isinstance(value, list | tuple):
        return len(value), tuple(fingerprint(entry) for entry in value[:4] if entry is not value and len(value) > 1)
    if isinstance(value, nd.Configuration):
        return tuple(fingerprint(a) for a in (value.position, value.rotation, value.internal_point))
    return None


def leaves(value, path="", deep=0):
    """Numbers in a result by place; entries of a sequence count as one place."""
    if deep > 8 or isinstance(value, str | bytes | enum.Enum | nd.Study):
        return
    if isinstance(value, np.ndarray | float | np.floating):
        yield path, value
    elif isinstance(value, nd.Configuration):
        for name in ("position", "rotation", "internal_point"):
            yield f"{path}.{name}", getattr(value, name)
        if type(value) is not nd.Configuration and hasattr(value, "__slots__"):
            for name in value.__slots__:
                yield from leaves(getattr(value, name), f"{path}.{name}", deep + 1)
    elif isinstance(value, nd.Geometry):
        for name in ("base_external", "base_internal", "platform_external", "platform_internal"):
            yield f"{path}.{name}", getattr(value, name)
    elif dataclasses.is_dataclass(value) and not isinstance(value, type):
        for f in dataclasses.fields(value):
            if f.name not in ("seconds",):
                yield from leaves(getattr(value, f.name), f"{path}.{f.name}", deep + 1)
    elif hasattr(value, "_fields"):
        for name in value._fields:
            yield from leaves(getattr(value, name), f"{path}.{name}", deep + 1)
    elif isinstance(value, Mapping):
        for key, entry in value.items():
            yield from leaves(entry, f"{path}[{key!r}]", deep + 1)
    elif isinstance(value, list | tuple):
        for entry in value:
            yield from leaves(entry, f"{path}[]", deep + 1)


def bits(result):
    """A result as numbers to compare."""
    return [(place, np.shape(number), np.asarray(number).tobytes()) for place, number in leaves(result)]


def with_nan(result):
    return {
        place for place, number in leaves(result) if np.asarray(number).dtype.kind in "fc" and np.isnan(number).any()
    }


def _late(_signal, _frame):
    raise Hangs


@contextlib.contextmanager
def bounded(quiet=True):
    """End a call that hangs; warnings are errors; nothing is printed, if it shall be quiet."""
    before = signal.signal(signal.SIGALRM, _late)
    signal.alarm(LONGEST_CALL)
    try:
        with warnings.catch_warnings(), contextlib.redirect_stdout(io.StringIO() if quiet else sys.stdout):
            warnings.simplefilter("error")
            yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


def named(words, text):
    return any(re.search(rf"(?<![A-Za-z0-9]){re.escape(word)}(?![A-Za-z0-9])", text) for word in words)


def words_of(error):
    try:
        return str(error)
    except Exception:
        return "no words"


def fault_of(error, words):
    """What is wrong with an exception; "" for bad input, said in one line that names the argument."""
    if isinstance(error, OSError) and error.filename is not None:
        return ""  # the system does not write there, and says where
    if not isinstance(error, ValueError) or isinstance(error, UnicodeError):
        frames = traceback.extract_tb(error.__traceback__)
        last = next((f for f in reversed(frames) if f"{os.sep}ninedof{os.sep}" in f.filename), frames[-1])
        where = f"{last.filename.rpartition('ninedof' + os.sep)[2]}:{last.lineno}"
        return f"{type(error).__name__} ({where}): {words_of(error)[:150]!r}"
    text = str(error)
    if not named(words, text):
        return f"does not name it: {text[:200]!r}"
    if any(ord(c) < 32 or c in "\u202e\x7f" for c in text):
        return f"has more than one line or an escape: {text[:200]!r}"
    if len(text) > LONGEST_WORDS:
        return f"has {len(text)} characters: {text[:100]!r}"
    return ""


def attack(name, row, every):
    """Try every attack of a row, or some of each argument; return the tally."""
    tally = Tally()
    with bounded():
        good = row.call(**row.arguments())
    usual = with_nan(good)
    trials = list(attacks(row))
    if not every:
        trials = some_of(trials, row.few, row.dear, name)
    for path, label, make, exact in trials:
        tally.tried += 1
        arguments = row.arguments()
        bad = make()
        arguments[path[0]] = put(arguments[path[0]], path[1:], bad)
        before = {key: fingerprint(value) for key, value in arguments.items() if key != "out"}
        words = {path[0], *(str(key) for key in path if isinstance(key, str)), *row.words.get(path[0], ())}
        if isinstance(bad, str | Path) and str(bad).isprintable():
            words |= {str(bad)}  # a file by its name
        words |= {"out"} & set(arguments)  # which has another shape than the result, then
        fault, found = "", None
        try:
            with bounded():
                found = row.call(**arguments)
            tally.taken += 1
        except Hangs:
            fault = "hangs"
        except Exception as error:
            fault = fault_of(error, words)
        else:
            fault = _fault_of_result(row, path, label, found, usual, exact)
        after = {key: fingerprint(value) for key, value in arguments.items() if key != "out"}
        if not fault and before != after:
            fault = "changes its input"
        if fault:
            tally.failures.append(f"{name}, {'.'.join(map(str, path))} is {label}: {fault}")
    return tally


def _fault_of_result(row, path, label, found, usual, exact):
    if exact is not None and path[0] not in row.loose:
        with bounded():
            arguments = row.arguments()
            try:
                reference = row.call(**(arguments | {path[0]: put(arguments[path[0]], path[1:], exact)}))
            except ValueError as error:
                return f"is taken, but not as float64: {error}"
        if bits(reference) != bits(found):
            return "does not give what float64 gives"
    if "NaN" not in label and path[0] not in row.nan and (new := with_nan(found) - usual):
        return f"gives NaN at {', '.join(sorted(new)[:3])}"
    return ""


def some_of(trials, few, dear, name):
    """A seeded choice of the attacks at each place."""
    pick = random.Random(name)
    by_place = {}
    for trial in trials:
        by_place.setdefault(trial[0], []).append(trial)
    out = []
    for path, here in by_place.items():
        out += pick.sample(here, min(3 if path[0] in dear else few, len(here)))
    return out
