"""Files written whole or not at all, and results saved as one file of named arrays."""

from __future__ import annotations

import io
import os
import re
import secrets
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import IO, Any, ClassVar, Self

from numpy.typing import NDArray

from ninedof.support.arguments import path_argument
from ninedof.support.npz import DAMAGE, read_npz, write_npz
from ninedof.support.reading import JSON, read_file
from ninedof.support.system import sync_folder

Arrays = dict[str, NDArray[Any]]

PART = ".part-"  # begins the name of a file that is being written
MOST_NAME = 120  # bytes of a name that is put into a folder

_PART = re.compile(rf"{re.escape(PART)}(.+)-[0-9a-f]{{8}}", re.DOTALL)
_SHORT = 40  # characters of a name that the name of its part repeats: a part of the longest name fits too


def part_name(name: str) -> str:
    """Return a new name for the part of a file that is being written; it begins with PART and, if short, the name."""
    return f"{PART}{name[:_SHORT]}-{secrets.token_hex(4)}"


def is_leftover(path: Path, names: re.Pattern[str]) -> bool:
    """Return whether a path is the part of a file of one of these names, left by a run that was killed as it wrote.

    A name has at most 40 characters, as in `part_name`. A folder or a link is none, and nor are files of other names:
    they are somebody else's.
    """
    part = _PART.fullmatch(path.name)
    return bool(part and names.fullmatch(part[1])) and path.is_file() and not path.is_symlink()


def write_whole(path: Path, data: bytes | Callable[[IO[bytes]], object]) -> Path:
    """Write a file that appears whole or not at all, even if the power fails; return its path.

    In the place of its bytes there may be a function that writes them to a file that is open.

    Raises
    ------
    OSError
        With the name of the file: the disk is full, or the folder gone.

    """
    part = path.with_name(part_name(path.name))  # in the same folder: renaming is atomic there
    try:
        with part.open("wb") as file:
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
    sync_folder(path.parent)
    return path


def naming(error: OSError, path: Path) -> OSError:
    """Return the error of a system call with the file that it is about: one on an open file has none."""
    return OSError(error.errno, error.strerror or str(error), os.fspath(path)) if error.errno else error


def why_not_writable(path: Path) -> str:
    """Return why a file cannot be written there, "" where it can: to be known before the work, not after it."""
    try:
        if path.is_dir():
            return "it is a folder"
        if path.is_symlink() and not path.exists():
            return "it is a link to nothing"
        with suppress(FileNotFoundError):
            path.lstat()  # raises where the name is too long
        part = path.with_name(part_name(path.name))
        part.touch()
        part.unlink()
    except OSError as error:
        return error.strerror or str(error)
    except ValueError as error:  # a zero byte
        return str(error)
    return ""


def own_or_new(name: str, path: Path, mark: str) -> None:
    """Raise ValueError, naming the argument, for a file that exists without the mark of those that ninedof writes."""
    if reason := why_not_writable(path):
        raise ValueError(f"{name}: got {path}, which cannot be written ({reason}), expected a writeable place")
    if path.exists() and not _has(path, mark):
        raise ValueError(f"{name}: got {path}, which exists and was not written by ninedof, expected another name")


def _has(path: Path, mark: str) -> bool:
    try:
        return mark.encode() in read_file(path, JSON)
    except OSError:
        return False


def is_plain_name(name: object) -> bool:
    """Return whether a name stays in the folder it is put into, on every system, and is no hidden file."""
    return (
        isinstance(name, str)
        and 0 < len(name.encode(errors="replace")) <= MOST_NAME
        and name.isprintable()
        and not name.startswith(".")
        and not set(name) & set("/\\:")
    )


def npz_bytes(arrays: Mapping[str, Any], *, compressed: bool = False) -> bytes:
    """Return the bytes of a .npz file."""
    buffer = io.BytesIO()
    write_npz(buffer, arrays, compressed=compressed)
    return buffer.getvalue()


class Saved(ABC):
    """A result that one .npz file holds."""

    FORMAT: ClassVar[str]
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
        contents = self._contents()
        return write_whole(file, lambda opened: write_npz(opened, contents, compressed=self.COMPRESSED))

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Self:
        """Read what `save` wrote.

        Parameters
        ----------
        path : path

        Raises
        ------
        ValueError
            Naming the file, if it cannot be read, is damaged, or has another format.

        """
        path_argument("path", path)
        try:
            contents = read_npz(Path(path))
            return cls._made(contents)
        except OSError as error:
            raise ValueError(f"{os.fspath(path)}: cannot be read ({error.strerror or error})") from None
        except DAMAGE:
            expected = f"got no {cls.FORMAT!r} file, expected a whole one that `save` wrote"
            raise ValueError(f"{os.fspath(path)}: {expected}") from None

    @abstractmethod
    def _contents(self) -> dict[str, Any]:
        """Return the arrays of the file."""

    @classmethod
    @abstractmethod
    def _made(cls, contents: Arrays) -> Self:
        """Return the result that has these arrays; raise an error of DAMAGE for those of another format."""
