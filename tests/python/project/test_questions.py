"""The page of questions: every command line and every name that it gives is there."""

import re
import shlex
from pathlib import Path

import pytest
import typer

import ninedof as nd
from ninedof.cli.app import app

PAGE = (Path(__file__).parents[3] / "docs" / "questions.md").read_text(encoding="utf-8")
ROWS = [line.strip("| ").split(" | ") for line in PAGE.splitlines() if line.startswith("| [")]
LINES = [line for row in ROWS for line in re.findall(r"`(ninedof [^`]+)`", " ".join(row[1:]))]
NAMES = sorted(set(re.findall(r"\bnd\.([A-Za-z_]+)", PAGE)))
COMMANDS = typer.main.get_command(app()).commands


def test_there_are_some_forty_questions():
    assert len(ROWS) >= 40
    assert {len(row) for row in ROWS} <= {2, 3}


@pytest.mark.parametrize("line", LINES)
def test_a_command_line_is_understood(line):
    command, *words = shlex.split(line)[1:]
    with COMMANDS[command].make_context(command, words) as context:  # ends where an option is unknown
        assert context.params


@pytest.mark.parametrize("name", NAMES)
def test_a_name_is_public(name):
    assert hasattr(nd, name)
