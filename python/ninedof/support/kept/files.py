"""Files written whole or not at all. Those that ninedof keeps hold a digest of their bytes, checked before use."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from ninedof.support.arguments import cleaned, path_argument
from ninedof.support.structs import made, plain_fields
from ninedof.support.text import decode, encode

if TYPE_CHECKING:
    import hashlib

Arrays = dict[str, NDArray[Any]]

PART = ".part-"  # begins the name of a file that is being written
MOST_NAME = 120  # bytes of a name that is put into a folder
SHORT = 40  # characters of a name that the name of its part repeats: a part of the longest name fits too
SEPARATORS = {";": "semicolons", "\t": "tabs"}  # of files that are no CSV to us
VERSION = 6  # of all files that ninedof keeps
WORDS, ARRAY = "words", "npy"  # the array of all that is none, and what names another there
DIGITS = 64  # of a digest
PIECE = 2**18  # bytes read at a time
DIGEST = b',\n  "digest": "'  # before the digest of a JSON file
CHANGED = "got no file as ninedof wrote it, expected one that was not changed or damaged since"


def part_name(name: str) -> str:
    """Return a new name for a file that is being written; it begins with PART and the name."""
    return f"{PART}{name[:SHORT]}-{os.urandom(4).hex()}"


def write_whole(path: Path, data: bytes | Callable[[IO[bytes]], object]) -> Path:
    """Write a file that appears whole or not at all, even if the power fails; return its path.

    In the place of its bytes there may be a function that writes them to a file that is open. OSError, of a full disk
    too, has the name of the file.
    """
    part = path.with_name(part_name(path.name))  # in the same folder: renaming is atomic there
    try:
        with part.open("w+b") as file:
            if callable(data):
                data(file)
            else:
                file.write(data)
            file.flush()
            os.fsync(file.fileno())
        os.replace(part, path)
    except OSError as error:
        raise naming(error, path) from None
    finally:
        with suppress(OSError):  # the first error is the one to be told
            part.unlink(missing_ok=True)
    return path


def naming(error: OSError, path: Path) -> OSError:
    """Return the error of a system call with the file that it is about: one on an open file has none."""
    return OSError(error.errno, error.strerror or str(error), os.fspath(path)) if error.errno else error


def read_whole(path: Path) -> bytes:
    """Return the bytes of a file; ValueError names one that cannot be read."""
    try:
        return path.read_bytes()
    except OSError as error:
        raise ValueError(f"{path}: cannot be read ({error.strerror or error})") from None


def read_text(path: str | os.PathLike[str]) -> str:
    """Return the text of a file, without a byte order mark and with line feeds; ValueError as `read_whole`."""
    try:
        return read_whole(Path(path)).decode("utf-8-sig").replace("\r\n", "\n").replace("\r", "\n")
    except UnicodeDecodeError:
        raise ValueError(f"{path}: cannot be read (not UTF-8 text)") from None


def csv_rows(text: str) -> list[tuple[int, list[str]]]:
    """Return the rows of a CSV text with the numbers of their lines; comments (#) and empty rows are left out."""
    import csv  # when it is needed, as it takes time to load

    reader = csv.reader(text.split("\n"))
    try:
        rows = [(reader.line_num, [entry.strip() for entry in row]) for row in reader]
    except csv.Error as error:
        raise ValueError(f"not a CSV file ({error})") from None
    return [(line, row) for line, row in rows if any(row) and not row[0].startswith("#")]


def csv_table(text: str) -> tuple[int, list[tuple[str, str]], list[tuple[int, list[str]]]]:
    """Return the line of the head of a CSV text, its columns, and the other rows with their lines.

    A column is its name and its unit, "" where it names none: "x (mm)", as `ninedof path` writes it.
    """
    rows = csv_rows(text)
    if not rows:
        raise ValueError("got an empty file, expected a line with the names of the columns")
    (line, head), *body = rows
    for mark, word in SEPARATORS.items():
        if mark in "".join(head):
            expected = "expected commas between columns and points in numbers, such as 0.5,1.25"
            raise ValueError(f"line {line}: got columns separated by {word}, {expected}")
    heads = [(name, end.rstrip(")")) for name, _, end in (cleaned(one).partition(" (") for one in head)]
    names = [name for name, _ in heads]
    for name in names:
        if not math.isnan(finite_or_nan(name)):
            raise ValueError(f"line {line}: got the number {name}, expected the names of the columns")
        if names.count(name) > 1:
            raise ValueError(f"line {line}, column {name}: got it twice, expected each column once")
    return line, heads, body


def require_entries(body: Sequence[tuple[int, Sequence[str]]], names: Sequence[str]) -> None:
    """Raise ValueError unless each row of a CSV text has an entry for each column."""
    for line, row in body:
        if len(row) != len(names):
            expected = f"expected {len(names)} ({cleaned(', '.join(names))})"
            raise ValueError(f"line {line}: got {len(row)} entries, {expected}")


def finite_or_nan(text: str) -> float:
    """Return the finite number of a text, NaN for all else."""
    try:
        value = float(text)
    except ValueError:
        return math.nan
    return value if math.isfinite(value) else math.nan


def own_or_new(name: str, path: Path, mark: str) -> None:
    """Raise ValueError, naming the argument, for a file in no folder or without the mark of those of ninedof."""
    if not path.absolute().parent.is_dir():
        raise ValueError(f"{name}: got {path}, expected a file in a folder that exists")
    if path.exists() and not (path.is_file() and mark.encode() in path.read_bytes()):
        raise ValueError(f"{name}: got {path}, which exists and was not written by ninedof, expected another name")


def is_plain_name(name: object) -> bool:
    """Return whether a name stays in the folder it is put into, on every system, and is no hidden file."""
    return (
        isinstance(name, str)
        and 0 < len(name.encode(errors="replace")) <= MOST_NAME
        and name.isprintable()
        and not name.startswith(".")
        and not set(name) & set("/\\:")
    )


def sha256(data: bytes) -> hashlib._Hash:
    """Return the running digest of bytes; the library of digests is loaded when it is needed."""
    import hashlib

    return hashlib.sha256(data)


def form_of(kind: str) -> str:
    """Return what a file says that it is."""
    return f"ninedof-{kind}-{VERSION}"


def json_bytes(kind: str, entries: Mapping[str, Any]) -> bytes:
    """Return entries as a JSON file of a kind, with their digest behind them."""
    body = encode({"format": form_of(kind), **entries}).encode().removesuffix(b"\n}")
    return body + DIGEST + sha256(body).hexdigest().encode() + b'"\n}\n'


def read_json(path: Path, kind: str) -> dict[str, Any]:
    """Read the entries of a file of `json_bytes`.

    ValueError names a file that cannot be read, was changed, or is of another kind or version.
    """
    data = read_whole(path)
    body, _, end = data.rpartition(DIGEST)
    if end != sha256(body).hexdigest().encode() + b'"\n}\n':
        raise ValueError(f"{path}: {CHANGED}")
    entries: dict[str, Any] = decode(f"{body.decode()}\n}}")
    if entries.pop("format", None) != form_of(kind):
        raise ValueError(
            f"{path}: got another format than {form_of(kind)!r}, expected a file of this version of ninedof"
        )
    return entries


def json_array(entries: Mapping[str, Any]) -> NDArray[np.str_]:
    """Return entries as one array, JSON: what is not a number among the arrays of a file."""
    return np.array(encode(entries, indent=None))


def from_json_array(array: NDArray[np.str_]) -> Any:
    """Return the entries that `json_array` took."""
    return decode(str(array))


def write_npz(path: Path, arrays: Mapping[str, Any], *, compressed: bool = False, salt: str = "") -> Path:
    """Write arrays as numpy does, with their digest as the comment of the archive; return the path.

    A text before the bytes, the salt, ties the file to what it belongs to.
    """
    return write_whole(path, partial(_pack, arrays, compressed, salt))


def read_npz(path: Path, salt: str = "") -> Arrays:
    """Read what `write_npz` wrote; ValueError names a file that cannot be read or was changed."""
    try:
        with path.open("rb") as file:
            digest = _digest(file, salt)
            if file.read() != digest:
                raise ValueError(f"{path}: {CHANGED}")
            file.seek(0)
            with np.load(file, allow_pickle=False) as arrays:
                return dict(arrays)
    except OSError as error:
        raise ValueError(f"{path}: cannot be read ({error.strerror or error})") from None


def _pack(arrays: Mapping[str, Any], compressed: bool, salt: str, file: IO[bytes]) -> None:
    from zipfile import ZIP_DEFLATED, ZIP_STORED, ZipFile  # when they are needed, as they take time to load

    with ZipFile(file, "w", ZIP_DEFLATED if compressed else ZIP_STORED) as archive:
        archive.comment = bytes(DIGITS)
        for name, value in arrays.items():
            with archive.open(f"{name}.npy", "w", force_zip64=True) as member:
                np.lib.format.write_array(member, np.asanyarray(value), allow_pickle=False)  # in pieces
    digest = _digest(file, salt)
    file.seek(-DIGITS, os.SEEK_END)
    file.write(digest)


def _digest(file: IO[bytes], salt: str) -> bytes:
    """Return the digest of all bytes of a file but those of its own digest, in front of which the file then stands."""
    digest, left = sha256(salt.encode()), file.seek(0, os.SEEK_END) - DIGITS
    file.seek(0)
    while left > 0:
        piece = file.read(min(left, PIECE))
        digest.update(piece)
        left -= len(piece)
    return digest.hexdigest().encode()


class Saved:
    """A dataclass that one .npz file holds: its arrays by the way to them, and one entry of JSON for all else."""

    KIND: ClassVar[str]
    COMPRESSED: ClassVar[bool] = False

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write everything to one .npz file, whole or not at all, and return its path.

        Parameters
        ----------
        path : path
            The suffix .npz is added if it is missing.

        """
        file = path_argument("path", path)
        file = file if file.suffix == ".npz" else file.with_name(file.name + ".npz")
        return write_npz(file, self._contents(), compressed=self.COMPRESSED)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Self:
        """Read what `save` wrote.

        Raises
        ------
        ValueError
            Naming the file, if it cannot be read, is damaged, or has another format.

        """
        contents = read_npz(path_argument("path", path))
        try:
            return cls._made(contents)
        except (KeyError, ValueError):
            expected = "expected what `save` wrote"
            raise ValueError(f"{os.fspath(path)}: got no {form_of(cls.KIND)!r} file, {expected}") from None

    def _contents(self) -> Arrays:
        """Return the arrays of the file."""
        arrays: Arrays = {}
        words = _apart(self._saved(), "", arrays)
        return {WORDS: json_array({"format": form_of(self.KIND), **words}), **arrays}

    @classmethod
    def _made(cls, arrays: Arrays) -> Self:
        """Return the result that has these arrays; raise KeyError or ValueError for those of another format."""
        words = from_json_array(arrays[WORDS])
        if words.pop("format") != form_of(cls.KIND):
            raise ValueError
        return cls._restored(_whole(words, "", arrays))

    def _saved(self) -> dict[str, Any]:
        """Return the entries of the file: plain values, and arrays among them."""
        return plain_fields(self)

    @classmethod
    def _restored(cls, entries: dict[str, Any]) -> Self:
        """Return the result of the entries that `_saved` returned, as JSON leaves them."""
        return made(cls, entries)


def _apart(value: Any, way: str, arrays: Arrays) -> Any:
    """Return a plain value with a name in place of each array, which `arrays` then has."""
    if isinstance(value, dict):
        return {key: _apart(one, _further(way, key), arrays) for key, one in value.items()}
    if isinstance(value, list):
        return [_apart(one, _further(way, k), arrays) for k, one in enumerate(value)]
    if isinstance(value, np.ndarray):
        assert way not in (WORDS, *arrays), f"{way} names two arrays"
        arrays[way] = value
        return {ARRAY: way}
    return value


def _whole(value: Any, way: str, arrays: Arrays) -> Any:
    """Return a value of `_apart` with its arrays; a mapping whose only key is ARRAY need not stand for one."""
    if value == {ARRAY: way} and way in arrays:
        return arrays[way]
    if isinstance(value, dict):
        return {key: _whole(one, _further(way, key), arrays) for key, one in value.items()}
    if isinstance(value, list):
        return [_whole(one, _further(way, k), arrays) for k, one in enumerate(value)]
    return value


def _further(way: str, key: object) -> str:
    return f"{way}.{key}" if way else str(key)


def read_toml(path: str | os.PathLike[str]) -> dict[str, Any]:
    """Read a TOML file; ValueError names one that cannot be read or is not TOML."""
    import tomllib  # when it is needed, as it takes time to load

    text = read_text(file := path_argument("path", path))
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise ValueError(f"{file}: not a TOML file we can read: nested too deep") from None
    except ValueError as error:  # invalid TOML, or an integer of thousands of digits
        raise ValueError(f"{file}: not a TOML file: {error}") from None


def write_toml(path: str | os.PathLike[str], tables: Mapping[str, Any]) -> None:
    """Write tables as a TOML file."""
    import tomli_w

    write_whole(path_argument("path", path), tomli_w.dumps(tables).encode())
