"""The documents keep to the code: names, tests and links they mention exist."""

import re
from pathlib import Path

import pytest

import ninedof as nd

ROOT = Path(__file__).resolve().parents[3]
PAGES = [*sorted((ROOT / "docs").glob("*.md")), *sorted(ROOT.glob("*.md"))]


def table_rows(page: Path) -> list[dict[str, str]]:
    """Rows of all tables of a page whose head has a column of tests, by column name."""
    rows: list[dict[str, str]] = []
    head: list[str] = []
    for line in page.read_text(encoding="utf-8").splitlines():
        if not line.startswith("|"):
            head = []
            continue
        cells = [cell.strip() for cell in line.strip("|").split(" |")]
        if not head:
            head = cells
        elif "tests" in head and not cells[0].startswith("---"):
            rows.append(dict(zip(head, cells, strict=True)))
    return rows


ROWS = table_rows(ROOT / "docs" / "equations.md")
HEADERS = "\n".join(path.read_text(encoding="utf-8") for path in (ROOT / "cpp/include/ninedof").rglob("*.hpp"))


def names(cell: str) -> list[str]:
    return re.findall(r"`([^`]+)`", cell)


def test_equations_are_found():
    assert len(ROWS) > 30
    assert any("jacobian" in row["C++"] for row in ROWS)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row["symbol"].split(" ")[0])
def test_a_row_of_the_equation_table_names_what_exists(row):
    for name in names(row["C++"]):
        for part in name.split("::"):
            assert re.search(rf"\b{part}\b", HEADERS), f"{name} is in no public header"
    for name in names(row["Python"]):
        first, *rest = name.split(".")
        assert first in nd.__all__
        thing = getattr(nd, first)
        for part in rest:
            assert hasattr(thing, part), f"no {name} in ninedof"
    assert names(row["tests"])
    for name in names(row["tests"]):
        folder, file = ("python", f"{name}.py") if name.startswith("test_") else ("cpp", f"{name}.cpp")
        assert [*(ROOT / "tests" / folder).rglob(file)], f"no {file} in tests/{folder}"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page):
    for target in re.findall(r"\]\(([^)#\s]+)[^)]*\)", page.read_text(encoding="utf-8")):
        if "://" not in target:
            assert (page.parent / target).exists(), f"{page.name} links to {target}"


@pytest.mark.parametrize("name", ["setup", "test"])
def test_the_readme_has_one_line_for_each_command(name):
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    (block,) = re.findall(rf"<!-- ci:{name} -->\n```\w*\n(.*?)```", text, flags=re.DOTALL)
    assert block.count("\n") == 1


SMALLER = {"1_000_000": "1_000", "201)": "5)"}


def test_the_python_of_the_readme_runs_as_written(capsys):
    """Block after block, as a reader would type them; only sizes are smaller."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    blocks = re.findall(r"```python\n(.*?)```", text, flags=re.DOTALL)
    assert len(blocks) >= 9
    code = "\n".join(blocks)
    for large, small in SMALLER.items():
        assert large in code
        code = code.replace(large, small)
    known: dict[str, object] = {}
    exec(compile(code, "README.md", "exec"), known)
    shown = capsys.readouterr().out
    assert "optimal" in shown
    assert round(known["found"].volume, 1) == 7.8
    assert round(known["result"].condition_number, 6) == 3.749827
