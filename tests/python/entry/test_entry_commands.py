"""Every option and argument of every command gets bad values: one message, a status, never a traceback."""

import random
import sys

import pytest
import typer.main
from entry_commands import BAD, DEAR, LINES, NOT_TRIED, filled
from entry_engine import bounded
from sizes import LONG

from ninedof.cli.app import app, main

COMMANDS = typer.main.get_command(app()).commands
STATUSES = {0, 1, 2, 3}
FEW = {True: 1, False: 3}  # values of an option in a short run, of commands that work long and of others


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path, monkeypatch):
    (tmp_path / "binary.toml").write_bytes(bytes(range(256)))
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "200")


def options(command):
    """The options that take a value."""
    return {
        max(p.opts, key=len) for p in COMMANDS[command].params if p.param_type_name == "option" and not p.is_flag
    } - NOT_TRIED


def several(command):
    """The options that take more than one value."""
    return {option for p in COMMANDS[command].params if p.nargs > 1 for option in p.opts}


def arguments(command):
    return [p for p in COMMANDS[command].params if p.param_type_name == "argument"]


def test_every_command_and_option_has_a_line():
    assert set(LINES) == set(COMMANDS), "add a line for the command to tests/python/support/entry_commands.py"
    for command, lines in LINES.items():
        given = {word for line in lines for word in line.split() if word.startswith("--")}
        assert options(command) <= given, f"{command} lacks {options(command) - given}"
        assert not arguments(command) or any(not line.startswith("--") for line in lines)


def test_what_a_command_needs_is_required():
    needed = {(name, p.name) for name, command in COMMANDS.items() for p in command.params if p.required}
    assert needed >= {("forces", "design"), ("stiffness", "leg_stiffness"), ("certify", "run")}
    assert needed >= {(name, "design") for name in ("sheet", "export", "accuracy", "best", "modes", "singularity")}


@pytest.mark.parametrize("command", ["sheet", "accuracy", "forces", "modes", "stiffness", "best"])
def test_a_line_without_a_bad_value_is_answered(command, capsys):
    for line in LINES[command]:
        with pytest.raises(SystemExit) as end:
            main([command, *filled(line, several(command))])
        assert not end.value.code, line
        capsys.readouterr()


def attacks(command):
    """Command lines with one bad value, the option that has it, and what it is."""
    pick = random.Random(command)
    for line in LINES[command]:
        words = line.split()
        values = [k for k, word in enumerate(words) if not word.startswith("--")]
        for k in values:
            option = words[k - 1] if k and words[k - 1].startswith("--") else "argument"
            if option.startswith("--no-"):
                option = "argument"
            labels = list(BAD) if LONG else pick.sample(list(BAD), FEW[command in DEAR])
            for label in labels:
                if command == "view" and label == "zero":
                    continue  # any free port: it shows the design until Ctrl-C
                yield [command, *filled(line, several(command), (k, BAD[label]))], option, label


def fault_of(status, out, err):
    if status not in STATUSES:
        return f"status {status!r}"
    if "\x1b]" in out + err or "\u202e" in out + err:
        return "writes escapes as they were given"
    if "Traceback" in out + err:
        return "prints a traceback"
    if status in (1, 2) and not (out + err).strip():
        return "says nothing"
    return f"writes {len(err)} characters" if len(err) > 12_000 else ""


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("command", LINES)
def test_bad_values_end_in_a_message(command, capsys, monkeypatch):
    failures, tried = [], 0
    for words, option, label in attacks(command):
        tried += 1
        try:
            with bounded(quiet=False):
                try:
                    main(words)
                    status = 0
                except SystemExit as end:
                    status = end.code or 0
            captured = capsys.readouterr()
            fault = fault_of(status, captured.out, captured.err)
        except BaseException as error:
            capsys.readouterr()
            fault = f"{type(error).__name__}: {str(error)[:200]!r}"
        if fault:
            failures.append(f"{command} {option} is {label}: {fault}")
    sys.stdout.write(f"{command}: {tried} lines, {len(failures)} failures\n")
    assert not failures, "\n".join([f"{len(failures)} of {tried}:", *failures[:30]])
