"""Standard output and error of a command that nobody may be reading: what cannot be written never ends a run."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any, TextIO


class Steady:
    """A text stream whose errors are kept in place of raised; after the first one, nothing more is written."""

    def __init__(self, stream: TextIO) -> None:
        """Take a stream."""
        self._stream = stream
        self.failure: OSError | None = None
        """What the system said when a write failed for another reason than that the reader went away."""
        self._over = False

    def write(self, text: str) -> int:
        """Write text, or drop it; characters that the encoding does not have become escapes."""
        if not isinstance(text, str):
            raise TypeError(f"got {type(text).__name__}, expected a str")
        if not self._over:
            try:
                self._stream.write(_encodable(text, self._stream))
            except (OSError, ValueError) as error:  # ValueError: the stream was closed
                self._end(error)
        return len(text)

    def writelines(self, lines: Any) -> None:
        """Write several texts."""
        for line in lines:
            self.write(line)

    def flush(self) -> None:
        """Pass on what was written."""
        if not self._over:
            try:
                self._stream.flush()
            except (OSError, ValueError) as error:
                self._end(error)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)

    def _end(self, error: OSError | ValueError) -> None:
        """Lead what is still in the buffer nowhere: Python would fail to write it once more when it ends."""
        self._over = True
        if isinstance(error, OSError) and not isinstance(error, BrokenPipeError):
            self.failure = error
        with suppress(OSError, ValueError, AttributeError):  # not a file of the system
            nowhere = os.open(os.devnull, os.O_WRONLY)
            try:
                os.dup2(nowhere, self._stream.fileno())
            finally:
                os.close(nowhere)


def _encodable(text: str, stream: TextIO) -> str:
    """Return a text that the encoding of a stream has; escapes for what it does not have."""
    encoding = getattr(stream, "encoding", None) or "utf-8"
    try:
        text.encode(encoding)
    except UnicodeEncodeError:
        return text.encode(encoding, "backslashreplace").decode(encoding)
    except LookupError:
        pass
    return text


@contextmanager
def steady() -> Iterator[Steady]:
    """Put steady streams in the place of standard output and error for the time of a command; yield the output.

    Where one was closed before the program began, Python has None: its words go nowhere.
    """
    _fill_closed()
    before = sys.stdout, sys.stderr
    with open(os.devnull, "w", encoding="utf-8") as nowhere:
        output, error = (Steady(nowhere if stream is None else stream) for stream in before)
        sys.stdout, sys.stderr = output, error
        try:
            yield output
        finally:
            output.flush()
            error.flush()
            sys.stdout, sys.stderr = before


def _fill_closed() -> None:
    """Open nothing under the numbers of closed standard streams: a file of the run would get them, and their words."""
    for number in (0, 1, 2):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # takes the lowest number that is free
