"""No text of a file or an argument is markup, moves the cursor or forges a line; no message is as long as its cause."""

import json
import os
import shlex
from pathlib import Path

import pytest
from rich.console import Console

from ninedof.cli.app import main
from ninedof.cli.screen import Screen, bold
from ninedof.support.arguments import cleaned
from ninedof.support.text import MOST, escaped, one_line

EVIL = "\x1b]0;title\x07\nninedof: all is well\x9b2J\u202e\u2028[/b][bold]:smile:"


@pytest.fixture(autouse=True)
def _in_a_folder_of_its_own(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def run(capsys, *words):
    with pytest.raises(SystemExit) as ended:
        main(words)
    said = capsys.readouterr()
    return ended.value.code, said.out, said.err


def is_harmless(text):
    return escaped(text) == text


@pytest.mark.parametrize("name", ["[/foo]", "a[bold]b", "a b'c", ":smile:"])
def test_the_name_of_a_run_folder_is_no_markup(capsys, monkeypatch, name):
    monkeypatch.setenv("COLUMNS", "300")
    status, out, err = run(capsys, "sweep", "--over", "x_p=-1:1:3", "--no-figures", "--out", name)
    assert (status, Path(name, "record.json").is_file()) == (0, True)
    assert f"run folder {escaped(name)}: record.json" in out
    assert is_harmless(out + err)


def test_a_folder_with_an_escape_in_its_name_is_refused_in_one_line(capsys):
    status, out, err = run(capsys, "sweep", "--over", "x_p=-1:1:3", "--no-figures", "--out", "e\x1b[31mf")
    assert (status, out, err.count("\n")) == (2, "", 1)
    assert is_harmless(err)


def test_the_line_to_go_on_is_one_for_a_shell(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "300")

    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr("ninedof.sweep", interrupted)
    status, _, err = run(capsys, "sweep", "--over", "x_p=-1:1:3", "--out", "a [bold]b")
    assert status == 130
    line = ["ninedof", "sweep", "--over", "x_p=-1:1:3", "--out", "a [bold]b"]
    assert shlex.split(err.split("type: ")[1]) == line


LONG = "k" * 100_000
TABLES = ("design", "variables", "constraints", "objective", "solver", "constraints.stroke")
ENTRIES = ("design.family", "unit", "objective.index", "variables.a1", "constraints.stroke.max")
FORMS = ("{} = 1", *(f"[{name}]\n{{}} = 1" for name in TABLES), *(f"{name} = {{}}" for name in ENTRIES))
STUDIES = [form.format(word) for word in map(json.dumps, (EVIL, LONG)) for form in FORMS]
LINES = (
    ("evaluate", EVIL),
    ("evaluate", "--a1", EVIL),
    ("optimize", f"--{EVIL}"),
    ("optimize", "--seed", EVIL),
    (EVIL,),
    ("sweep", "--over", EVIL),
    ("pareto", "--against", EVIL),
    ("workspace", "--archetype", EVIL),
    ("report", EVIL),
    ("check", EVIL),
    ("certify", EVIL),
    ("optimize", LONG),
    ("optimize", "--scheduler", LONG),
)
CASES = [*((("optimize", "study.toml"), text) for text in STUDIES), *((words, "") for words in LINES)]


@pytest.mark.parametrize(("words", "study"), CASES, ids=range(len(CASES)))
def test_no_argument_and_no_entry_of_a_study_forges_a_line(capsys, words, study):
    Path("study.toml").write_text(study)
    status, out, err = run(capsys, *words)
    assert status in ((2,) if study else (1, 2))
    assert out == ""
    assert err.startswith("ninedof: ")
    assert err.count("\n") == 1
    assert len(err) < (1000 if study else MOST + 200)
    assert is_harmless(err)


def test_all_that_consoles_print_is_text(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")  # what is folded cannot be searched for
    screen = Screen(False)
    screen.print(EVIL)
    screen.print(bold(EVIL, EVIL))
    with screen.bar("points", EVIL) as bar:
        bar.show(1, 1, None)
        bar.phase(EVIL)
    said = capsys.readouterr()
    assert is_harmless(said.out + said.err)
    assert "[/b][bold]:smile:" in said.out
    assert "[/b][bold]:smile:" in said.err


def test_our_bold_words_are_bold():
    console = Console(force_terminal=True, color_system="standard", file=open(os.devnull, "w"))  # noqa: SIM115
    with console.capture() as taken:
        console.print(bold("word", ": rest"))
    assert taken.get() == "\x1b[1mword\x1b[0m: rest\n"
    console.file.close()


def test_a_line_is_one_line_and_short():
    assert one_line("a\nb\tc") == r"a\nb\tc"
    assert escaped("l_c³ °\n") == "l_c³ °\n"
    assert escaped("\ud800") == r"\ud800"
    assert one_line("x" * 10**6).count(" ... ") == 1
    assert not {chr(code) for code in (*range(9), *range(11, 32), *range(127, 160), *range(0x202A, 0x202F))} & set(
        escaped("".join(map(chr, range(0x10000))))
    )


def test_text_of_a_file_in_a_message_is_escaped_as_on_a_terminal_and_cut():
    assert cleaned("a\x1b]0;b\nc\u202ed") == "a\\x1b]0;b\\nc\\u202ed"
    assert cleaned("x" * 10_000) == "x" * 200 + "..."
