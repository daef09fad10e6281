"""What a run was asked to do, as `command.json` in its folder: enough to begin it again, or to go on with it.

It holds the arguments as they were typed, and the text of the file that they name: a run is that of its study, also
where somebody has changed the file since.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from ninedof.runs.directory import COMMAND
from ninedof.runs.folder import FILE as RECORD
from ninedof.runs.objects import split
from ninedof.support.arguments import LONGEST_NAME
from ninedof.support.json import decode
from ninedof.support.reading import JSON, read_text
from ninedof.support.seal import unsealed, write_sealed
from ninedof.support.versions import versions

FORMAT = "ninedof-command-1"
FILE = COMMAND
MOST = 2 * JSON  # bytes: the text of a record, with its quotes escaped
OF_A_PLACE = ("--out", "--scheduler")


@dataclass(frozen=True)
class Input:
    """The file that a command reads: a study, a design, or the record of a run."""

    name: str
    text: str
    point: str = ""
    """"7" of "RUN#7"."""

    @classmethod
    def of(cls, name: str | None) -> Input | None:
        """Return the file that an argument names; None without one, and if it cannot be read as text."""
        if name is None:
            return None
        place, point = split(name)
        file = place / RECORD if place.is_dir() else place
        try:
            return cls(file.name, read_text(file, JSON), point)
        except (OSError, UnicodeDecodeError):
            return None

    def write(self, folder: Path) -> str:
        """Write the file into a folder; return the argument that names it there."""
        file = folder / Path(self.name).name
        file.write_text(self.text, encoding="utf-8")
        return f"{file}#{self.point}" if self.point else str(file)


@dataclass(frozen=True)
class Asked:
    """The command line of a run."""

    arguments: tuple[str, ...]
    folder: str
    """Where it was typed."""
    input: Input | None = None
    ninedof: str = ""
    """The version."""
    status: int | None = None
    """The exit status of the run, once it has ended by itself."""

    def write(self, file: Path) -> None:
        """Write it, whole or not at all."""
        write_sealed(file, {"format": FORMAT, **asdict(self)}, MOST)

    def own_arguments(self) -> Iterator[str]:
        """Yield the arguments without those of a place: --out, --resume, and --scheduler.

        Whoever wrote the file does not choose what computer is called: a scheduler runs code in what connects to it.
        """
        skip = False
        for word in self.arguments:
            if skip:
                skip = False
            elif word in OF_A_PLACE:
                skip = True
            elif word != "--resume" and not word.startswith(tuple(f"{name}=" for name in OF_A_PLACE)):
                yield word

    def same_work(self, other: Asked) -> bool:
        """Return whether two commands ask for the same of the same file."""
        return self.input == other.input and tuple(self.own_arguments()) == tuple(other.own_arguments())

    def ended(self, status: int) -> Asked:
        """Return it with the status at the end."""
        return replace(self, status=status)


def asked(arguments: tuple[str, ...], reads: Input | None) -> Asked:
    """Return the command line that is being run, with the file that it reads."""
    try:
        place = str(Path.cwd())
    except OSError:  # the folder is gone
        place = ""
    return Asked(arguments, place, reads, versions()["ninedof"])


def read_command(file: Path) -> Asked:
    """Read what `Asked.write` wrote.

    Raises
    ------
    ValueError
        Naming the file, if it cannot be read or is none.

    """
    try:
        data: Any = decode(read_text(file, MOST))
        if isinstance(data, dict) and data.get("format") == FORMAT:
            data = unsealed(data, file, required=True)
        known = data["input"]
        kept = None if known is None else Input(*(_text(known[key]) for key in ("name", "text", "point")))
        if kept is not None and not _is_file_name(kept.name):
            raise KeyError("name")
        arguments = data["arguments"]
        status = data["status"]
        if data["format"] != FORMAT or not isinstance(arguments, list) or not arguments:
            raise KeyError("format")
        if status is not None and type(status) is not int:
            raise TypeError
        return Asked(tuple(map(_text, arguments)), _text(data["folder"]), kept, _text(data["ninedof"]), status)
    except OSError as error:
        raise ValueError(f"{file}: cannot be read ({error.strerror})") from None
    except (KeyError, TypeError, RecursionError, UnicodeError):
        raise ValueError(f"{file}: got no whole {FORMAT!r} file, expected one written by ninedof") from None
    except ValueError as error:
        if str(error).startswith(f"{file}: "):
            raise
        raise ValueError(f"{file}: not a JSON file: {error}") from None


def _text(value: object) -> str:
    if not isinstance(value, str) or "\0" in value:
        raise TypeError
    value.encode()  # raises for half a surrogate pair: no file has one
    return value


def _is_file_name(name: str) -> bool:
    return name not in ("", "..") and Path(name).name == name and len(name.encode()) <= LONGEST_NAME
