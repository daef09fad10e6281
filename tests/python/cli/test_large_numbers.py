"""Numbers that are too large: one line at once."""

import os
import shlex
from dataclasses import replace

import pytest

import ninedof as nd
from ninedof.cli.app import main
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
