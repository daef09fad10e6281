"""docs/values.md is what bench/python/values.py prints, and nothing known is missed."""

import runpy
from pathlib import Path

import pytest
from sizes import size

import ninedof as nd

ROOT = Path(__file__).parents[3]


@pytest.fixture(scope="module")
def printed():
    from contextlib import redirect_stdout
    from io import StringIO

    load = nd.Study.load

    def with_few_starts(path):
        study = load(path)
        return study.with_solver(size(min(study.starts, 16), study.starts))

    values = runpy.run_path(str(ROOT / "bench/python/values.py"))
    with pytest.MonkeyPatch.context() as patch, redirect_stdout(StringIO()) as out:
        patch.setattr(nd.Study, "load", with_few_starts)
        missed = values["main"]()
    return missed, out.getvalue()


def rows(text):
    """What a row is about, the known value and the study; designs that are not isolated differ from build to build."""
    cells = [[cell.strip() for cell in line.strip("|").split(" | ")] for line in text.splitlines() if line[:1] == "|"]
    return [(row[0], row[1], row[-1]) for row in cells]


def test_no_value_is_missed(printed):
    assert printed[0] == 0


def test_the_page_has_the_rows_printed(printed):
    assert rows((ROOT / "docs/values.md").read_text(encoding="utf-8")) == rows(printed[1])


def test_every_study_is_in_the_table(printed):
    assert [p.name for p in (ROOT / "examples/values").iterdir() if f"values/{p.name})" not in printed[1]] == []
