"""Progress where standard error is a pipe or a log: a plain line now and then; on a terminal none."""

import re
from threading import Event

import pytest

from ninedof.cli.screen import Screen


def lines_of(capsys, kind, reports, terminal=False, total=500):
    """What a bar prints before its end, for reports (second, done, value) by a fake clock."""
    now = 0.0
    screen = Screen(json=False)
    console = screen.progress_console
    console.get_time, console._force_terminal = (lambda: now), terminal
    with screen.bar(kind, "study.toml") as bar:
        for now, done, value in reports:  # noqa: B007 the clock reads it
            bar(done, total, value)
        lines = capsys.readouterr().err.splitlines()
    return lines


def test_lines_come_at_growing_spacing_and_then_every_five_minutes(capsys):
    lines = lines_of(capsys, "starts", [(float(t), t // 10, 5.0) for t in range(1500)])
    assert [re.findall(r"\d:\d\d:\d\d", line)[0] for line in lines] == [
        "0:00:10", "0:00:20", "0:00:40", "0:01:20", "0:02:40", "0:05:20", "0:10:20", "0:15:20", "0:20:20",
    ]  # fmt: skip
    assert lines[0] == "study.toml  1/500  best 5.000000  0:00:10"
    assert re.fullmatch(r"study.toml  8/500  best 5.000000  0:01:20  \d:\d\d:\d\d to go", lines[3])


@pytest.mark.parametrize(
    ("kind", "line"),
    [
        ("starts", "study.toml  120/500  best 2.500000  0:00:12"),
        ("limits", "study.toml  120/500  2.500000"),
        ("points", "study.toml  24 %  0:00:12"),
        ("poses", "study.toml  120 poses, volume 2.5"),
        ("boxes", "study.toml  120 boxes  0:00:12"),
    ],
)
def test_a_line_has_the_words_of_the_bar(capsys, kind, line):
    assert lines_of(capsys, kind, [(12.0, 120, 2.5)]) == [line]


def test_boxes_of_a_proof_have_no_total_and_no_best(capsys):
    assert lines_of(capsys, "starts", [(12.0, 46_871, 0.128)], total=0) == ["study.toml  46871/?  0:00:12"]


def test_short_work_prints_no_line(capsys):
    assert lines_of(capsys, "starts", [(9.9, 499, 2.5)]) == []


@pytest.mark.parametrize("kind", ["starts", "points", "boxes"])
def test_the_time_goes_on_when_all_that_is_known_is_done(capsys, kind):
    """Boxes are as many as there are so far: the time of the first report stood to the end."""
    lines = lines_of(capsys, kind, [(0.0, 500, 2.5), (12.0, 500, 2.5), (44.0, 500, 2.5)])
    assert [line.split()[-1] for line in lines] == ["0:00:12", "0:00:44"]


def test_a_terminal_has_the_bar_alone(capsys):
    assert not any(
        line.startswith("study.toml  1") for line in lines_of(capsys, "starts", [(12.0, 120, 2.5)], terminal=True)
    )


def test_a_phase_is_named(capsys):
    now = 0.0
    screen = Screen(json=False)
    screen.progress_console.get_time = lambda: now
    with screen.bar("boxes", "certify") as bar:
        now = 15.0
        bar.phase("proving the limits")
        assert capsys.readouterr().err == "certify: proving the limits  0:00:15\n"


def test_lines_come_where_nothing_is_reported(capsys, monkeypatch):
    """A certificate of a machine is one box, which takes minutes."""
    now, printed = 0.0, Event()
    screen = Screen(json=False)
    console = screen.progress_console
    console.get_time = lambda: now
    monkeypatch.setattr(console, "print", lambda *parts, **_: (lines.extend(parts), printed.set()))
    lines = []
    with screen.bar("points", "reading the certificate") as bar:
        now = 15.0
        assert not printed.wait(0.1)  # nothing is shown yet
        now = 0.0
        bar.phase("within a box no progress is known")
        for now in (15.0, 31.0):  # noqa: B007 the clock reads it
            assert printed.wait(30.0)
            printed.clear()
    assert [line.split()[-1] for line in lines[:2]] == ["0:00:15", "0:00:31"]
    assert lines[0].startswith("reading the certificate: within a box no progress is known")
