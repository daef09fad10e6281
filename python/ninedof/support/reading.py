"""Files of users, read with a bound: only regular files, up to a size. A pipe would hang, a device never end."""

from __future__ import annotations

import errno
import os
import re
import stat

from ninedof.support.system import memory

TOML = 4 * 2**20  # bytes of a study or a design: 10 000 poses have 1 MB
# Of a record, a certificate of a machine or a manifest, of which none is written that is larger: 10^7 listed values
# have 300 MB. A damaged one of empty lists takes fifty times its bytes of memory.
JSON = min(2**29, memory() // 64)
TABLE = 2**29  # of a path: a million poses, with all that `ninedof path` writes of them, have 440 MB
PROOF = 2**31  # of a certificate of an optimum, which is not parsed here: 147 MB for six variables
DEEPEST = 16  # parts of a key of a TOML file; studies have three. The parser's time is quadratic in them

_KINDS = {stat.S_ISFIFO: "a pipe", stat.S_ISSOCK: "a socket"}

# The parts of TOML text that keys are made of; strings and comments as wholes, closed or not.
_TOKEN = re.compile(
    r'"""(?:[^"\\]|\\.|"(?!""))*+(?:""")?'
    + r"|'''(?:[^']|'(?!''))*+(?:''')?"
    + r'|"(?:[^"\\\n]|\\.)*+"?'
    + r"|'[^'\n]*+'?"
    r"|#[^\n]*+|[\w+-]++|[ \t]++|[^\w \t+-]",
    re.DOTALL,
)


def read_file(path: str | os.PathLike[str], most: int) -> bytes:
    """Return what a regular file of at most so many bytes holds.

    Raises
    ------
    OSError
        For any other file too, at once; `strerror` says what it is.

    """
    name = os.fspath(path)
    flags = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_BINARY", 0)
    try:
        number = os.open(name, flags)
    except ValueError as error:  # a null character
        raise OSError(errno.EINVAL, str(error), name) from None
    try:
        about = os.fstat(number)
        if stat.S_ISDIR(about.st_mode):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), name)
        if not stat.S_ISREG(about.st_mode):
            what = next((words for is_kind, words in _KINDS.items() if is_kind(about.st_mode)), "a device")
            raise OSError(errno.EINVAL, f"{what}, expected a file", name)
        with open(number, "rb", closefd=False) as file:
            data = file.read(most + 1) if about.st_size <= most else b""
        if about.st_size > most or len(data) > most:
            raise OSError(errno.EFBIG, f"{about.st_size} bytes, expected at most {most}", name)
        return data
    finally:
        os.close(number)


def read_text(path: str | os.PathLike[str], most: int) -> str:
    """Return the text of such a file, without a byte order mark; line ends are those of Python.

    Raises
    ------
    OSError
        As `read_file`.
    UnicodeDecodeError
        For what is not UTF-8.

    """
    text = read_file(path, most).decode("utf-8-sig")
    return text.replace("\r\n", "\n").replace("\r", "\n")


def deep_key(text: str) -> str:
    """Return the first key of TOML text that has too many parts, "" if there is none."""
    parts: list[str] = []
    dotted = False
    for found in _TOKEN.finditer(text):
        piece = found[0]
        if piece.isspace() and piece != "\n":
            continue
        if piece == "." and parts:
            dotted = True
        elif piece[0] in "\"'" or piece[0].isalnum() or piece[0] in "_-+":
            parts = [*parts, piece] if dotted else [piece]
            dotted = False
            if len(parts) > DEEPEST:
                return ".".join(parts)
        else:
            parts, dotted = [], False
    return ""
