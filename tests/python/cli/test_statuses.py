"""One table of exit statuses: whose matter an error is. Each is one line on standard error."""

import errno
import json

import numpy as np
import pytest

from ninedof.cli import screen
from ninedof.cli.ending import finish
from ninedof.records.design_file import HEXAGON, hexagonal_design
from ninedof.support.arguments import whole
from ninedof.support.extras import MissingExtra


def raising(error):
    raise error


CASES = {
    "our own check": (lambda: whole("starts", 0, 1), 2, "starts: got 0, expected a whole number"),
    "the core": (lambda: hexagonal_design(dict.fromkeys(HEXAGON, -1.0)), 2, "a1: got -1"),
    "of another": (lambda: json.loads("{"), 4, "JSONDecodeError: Expecting"),
    "of numpy": (lambda: np.stack([]), 4, "ValueError: need at least one array"),
    "memory": (lambda: raising(MemoryError()), 4, "out of memory"),
    "runtime": (lambda: raising(RuntimeError("no\ndevice")), 4, r"ninedof: no\ndevice"),
    "unexpected": (lambda: raising(KeyError("lost")), 4, "KeyError: 'lost'"),
    "file": (lambda: open("/none/x"), 1, "ninedof: /none/x: No such file or directory"),  # noqa: SIM115
    "two files": (lambda: raising(OSError(errno.EXDEV, "no", "a", None, "b")), 1, "ninedof: a and b: no"),
    "no file": (lambda: raising(OSError("lost")), 1, "ninedof: lost"),
    "extra": (lambda: raising(MissingExtra("needs x")), 2, "ninedof: needs x"),
    "interrupted": (lambda: raising(KeyboardInterrupt()), 130, "ninedof: interrupted"),
}


@pytest.mark.parametrize(("work", "status", "words"), CASES.values(), ids=CASES)
def test_an_error_ends_with_one_line_and_its_status(capsys, work, status, words):
    assert finish(work, []) == status
    said = capsys.readouterr()
    assert said.out == ""
    assert words in said.err
    assert said.err.startswith("ninedof: ")
    assert said.err.count("\n") == 1


def test_what_was_kept_is_named(capsys):
    error = RuntimeError("gone")
    error.add_note("Finished chunks are kept in run.")
    assert finish(lambda: raising(error), []) == 4
    assert capsys.readouterr().err == "ninedof: gone. Finished chunks are kept in run.\n"


@pytest.mark.parametrize(("code", "status"), [(None, 0), (0, 0), (3, 3), (130, 130), ("words", 4)])
def test_a_status_of_its_own_stays(code, status):
    assert finish(lambda: code, []) == status
    assert finish(lambda: raising(SystemExit(code)), []) == status


def test_the_table_is_that_of_the_documentation():
    assert (screen.DONE, screen.REFUSED, screen.BAD_INPUT, screen.NO_RESULT, screen.FAILED) == (0, 1, 2, 3, 4)
