"""Files and numbers that are too large, or no files at all: one line at once."""

import errno
import json
import os
import re
import shlex
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import ninedof as nd
from ninedof.cli.app import main
from ninedof.runs import folder
from ninedof.support import reading
from ninedof.support.json import encode
from ninedof.support.reading import DEEPEST, deep_key, read_file, read_text
from ninedof.sweep.chunks import MOST_CHUNKS

POSIX = pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs pipes that have names")


@pytest.fixture(autouse=True)
def _in_a_folder_of_its_own(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def refused(capsys, line):
    with pytest.raises(SystemExit) as ended:
        main(shlex.split(line))
    said = capsys.readouterr()
    assert ended.value.code == 2, said.err
    assert said.out == ""
    assert said.err.count("\n") == 1
    assert len(said.err) < 500
    return said.err


READ = {  # command lines to what they read
    "optimize {}": "study.toml",
    "pareto {}": "study.toml",
    "evaluate {}": "design.toml",
    "sheet {} ": "design.csv",
    "workspace {}": "design.xml",
    "path {}": "poses.csv",
    "evaluate {} ": "record.json",
    "report {}": "record.json",
    "check {}": "optimum.certificate",
}


@POSIX
@pytest.mark.parametrize(("line", "name"), READ.items(), ids=READ)
def test_what_is_no_file_is_refused_at_once(capsys, line, name):
    os.mkfifo(name)
    assert name in refused(capsys, line.format(name))
    Path(name).unlink()
    Path(name).symlink_to("/dev/zero")
    assert name in refused(capsys, line.format(name))


@pytest.mark.parametrize(("line", "name"), READ.items(), ids=READ)
def test_a_file_that_is_too_large_is_refused(capsys, line, name):
    with Path(name).open("wb") as file:
        file.truncate(2**31 + 1)  # of zeros that take no place
    assert "2147483649 bytes, expected at most" in refused(capsys, line.format(name))


@POSIX
def test_kinds_of_files():
    os.mkfifo("pipe")
    Path("folder").mkdir()
    Path("file").write_bytes(b"\xef\xbb\xbfa\r\nb\rc")
    for name, words in (("pipe", "a pipe"), ("/dev/null", "a device"), ("a\0b", "null")):
        with pytest.raises(OSError, match=words) as raised:
            read_file(name, 100)
        assert raised.value.errno == errno.EINVAL
    with pytest.raises(IsADirectoryError):
        read_file("folder", 100)
    assert read_text("file", 100) == "a\nb\nc"
    assert len(read_file("file", 10)) == 9
    with pytest.raises(OSError, match="9 bytes, expected at most 8"):
        read_file("file", 8)
    with pytest.raises(FileNotFoundError):
        read_file("none", 8)


DEEP = {
    "key": ".".join(["a"] * 100_000) + " = 1",
    "spaced": " . ".join(["a"] * 100_000) + " = 1",
    "table": "[" + ".".join(["a"] * 100_000) + "]",
    "quoted": ".".join(['"b.c"', "'d'"] * 50_000) + " = 1",
    "inline": "x = {" + ".".join(["a"] * 100_000) + " = 1}",
    "after a string": 'x = """\n"" """\n' + ".".join(["a"] * 100_000) + " = 1",
}


@pytest.mark.parametrize("text", DEEP.values(), ids=DEEP)
def test_a_key_of_many_parts_is_refused(capsys, text):
    Path("study.toml").write_text(text)
    assert f"expected at most {DEEPEST} parts" in refused(capsys, "optimize study.toml")


def test_no_other_dots_are_parts_of_a_key():
    dots = ".".join(["a"] * 50)
    assert deep_key(f"x = \"{dots}\"\ny = '{dots}' # {dots}\nz = \"\"\"\n{dots}\"\"\"\nw = '''\n{dots}'''") == ""
    assert deep_key("x = [" + "1.5, -2.5e-3, " * 1000 + "]\n" + "[a.b]\nc.d = 1\n" * 1000) == ""
    assert deep_key(".".join(["a"] * DEEPEST) + "=1") == ""
    assert deep_key("\n".join(["a."] * 100)) == ""
    assert deep_key(".".join(["a"] * (DEEPEST + 1))) == ".".join(["a"] * (DEEPEST + 1))


@pytest.mark.parametrize("text", ["[" * 100_000, '{"a":' * 100_000, "x"], ids=["list", "object", "none"])
def test_json_that_is_nested_too_deep(capsys, text):
    Path("record.json").write_text(text)
    assert "record.json: not a JSON file" in refused(capsys, "evaluate record.json")


NUMBERS = {
    "optimize --starts 2147483647": "starts: got 2147483647, expected a whole number from 1 to 1000000",
    "optimize --threads 4096": "threads: got 4096, expected a whole number from 1 to 1024",
    "pareto --points 1000000": "points: got 1000000",
    "atlas --designs 1125899906842625": "designs: got 1125899906842625",
    "sweep --over x_p=-1:1:1000000000 --over y_p=-1:1:1000000000": "points, expected at most",
    "sweep --over x_p=-1:1:1000000000 --chunk 1": "chunk: got 1 of 1000000000 points, expected at least 239",
    "workspace --legs 1 6 --points 10000000000": "points: got 10000000000",
    "path --circle 0.1 --points 1000000000": "points: got 1000000000",
    "sweep figure-6 --points 10000000": "points: got 10000000",
}


@pytest.mark.parametrize(("line", "words"), NUMBERS.items(), ids=NUMBERS)
def test_a_number_that_is_too_large_is_refused(capsys, line, words):
    assert words in refused(capsys, line)


def test_the_same_of_python(published, neutral):
    with pytest.raises(ValueError, match="starts: got 2147483647, expected a whole number from 1 to 1000000"):
        replace(nd.Study.paper(), starts=2**31 - 1)
    with pytest.raises(ValueError, match="threads: got 4096"):
        nd.sweep(published, neutral, {"x_p": (-1.0, 1.0, 3)}, threads=4096)
    with pytest.raises(ValueError, match="samples: got 1099511627776"):
        nd.error_samples(published, neutral, 1e-3, samples=2**40)
    with pytest.raises(ValueError, match=f"expected at least {-(-(2**40) // MOST_CHUNKS)}"):
        nd.atlas(2**40, chunk=1)


def test_the_bounds_hold_what_the_library_writes(published, neutral):
    """Studies of the most poses, sweeps of millions of listed values, fronts of a hundred points, a million poses."""
    pose = json.dumps({"position": [0.1234567890123456] * 3, "theta_z_deg": 12.34567890123456})
    assert len(pose) * 10_000 < reading.TOML
    values = list(np.random.default_rng(0).random(1000))
    swept = nd.sweep(published, neutral, {"x_p": values, "y_p": values[:1]})
    assert len(encode(swept.attributes)) / 1000 * 10_000_000 < 2**29
    found = nd.optimize(nd.Study(objective={"poses": nd.poses.ball(0.2, 50)}), starts=2)
    assert len(encode(found.best.to_dict())) / 50 * 10_000 * 4 * 100 < 2**29
    row = ",".join([repr(-0.12345678901234567)] * 20)
    assert len(row) * 1_000_000 < reading.TABLE


def test_what_could_not_be_read_again_is_not_written(tmp_path, monkeypatch, capsys):
    found = nd.optimize(nd.Study.paper(), starts=2)
    monkeypatch.setattr(folder, "JSON", 1000)
    with pytest.raises(OSError, match=r"bytes, expected at most 1000.*record\.json"):
        nd.save(found, "run")
    assert not list(tmp_path.rglob("record.json"))
    with pytest.raises(SystemExit) as ended:
        main(shlex.split("optimize --starts 2 --out run-2 --no-figures"))
    said = capsys.readouterr()
    assert ended.value.code == 1
    assert "3.762659" in said.out
    assert re.fullmatch(r"ninedof: run-2/record\.json: \d+ bytes, expected at most 1000", said.err.splitlines()[-1])
