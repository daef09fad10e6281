"""docs/equations.md and docs/architecture.md name what exists: files, symbols in them, public names, tests, rooms."""

import re
from pathlib import Path

import pytest
from layering import CPP_ROOMS, PYTHON_ROOMS

import ninedof as nd

ROOT = Path(__file__).resolve().parents[3]
EQUATIONS, ARCHITECTURE = ROOT / "docs" / "equations.md", ROOT / "docs" / "architecture.md"


def table_rows(page: Path, column: str) -> list[dict[str, str]]:
    """Rows of all tables of a page that have the column, by column name."""
    rows: list[dict[str, str]] = []
    head: list[str] = []
    for line in page.read_text(encoding="utf-8").splitlines():
        if not line.startswith("|"):
            head = []
            continue
        cells = [cell.strip() for cell in line.strip("|").split(" |")]
        if not head:
            head = cells
        elif column in head and not cells[0].startswith("---"):
            rows.append(dict(zip(head, cells, strict=True)))
    return rows


def names(cell: str) -> list[str]:
    return re.findall(r"`([^`]+)`", cell)


def mentions(text: str, part: str) -> bool:
    return re.search(rf"\b{part}\b", text) is not None


def sources(cell: str) -> dict[str, str]:
    """The files of a cell, with their texts."""
    paths = names(cell)
    assert paths
    missing = [path for path in paths if not (ROOT / path).is_file()]
    assert not missing, f"no {missing}"
    return {path: (ROOT / path).read_text(encoding="utf-8") for path in paths}


ROWS = table_rows(EQUATIONS, "tests")
QUANTITIES = table_rows(ARCHITECTURE, "file")
HEADERS = "\n".join(path.read_text(encoding="utf-8") for path in (ROOT / "cpp/include/ninedof").rglob("*.hpp"))


def row_id(row: dict[str, str]) -> str:
    return next(iter(row.values())).split(" ")[0]


def test_equations_are_found():
    assert len(ROWS) > 30
    assert len(QUANTITIES) > 15
    assert any("jacobian" in row["C++"] for row in ROWS)


@pytest.mark.parametrize("row", ROWS, ids=row_id)
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


@pytest.mark.parametrize("row", ROWS, ids=row_id)
def test_the_files_of_a_row_contain_its_names(row):
    files = sources(row["file"])
    core = [text for path, text in files.items() if path.startswith(("cpp/src/", "cpp/include/"))]
    package = [text for path, text in files.items() if path.startswith(("python/ninedof/", "cpp/bindings/"))]
    assert len(core) + len(package) == len(files)
    parts: set[str] = set()
    for column, separator, texts in (("symbol", "::", core), ("C++", "::", core), ("Python", ".", package)):
        for name in names(row[column]):
            own = name.split(separator)
            parts.update(own)
            for part in own:
                assert any(mentions(text, part) for text in texts), f"{name} is in none of {[*files]}"
    for path, text in files.items():
        assert any(mentions(text, part) for part in parts), f"{path} contains no name of the row"


@pytest.mark.parametrize("row", QUANTITIES, ids=row_id)
def test_a_quantity_lives_where_the_architecture_page_says(row):
    files = sources(row["file"])
    for name in names(row["names"]):
        assert any(mentions(text, name) for text in files.values()), f"{name} is in none of {[*files]}"


def test_paths_of_the_architecture_page_exist():
    paths = re.findall(r"`((?:cpp|python|tests|bench|docs)/[\w./-]+)`", ARCHITECTURE.read_text(encoding="utf-8"))
    assert len(paths) > 20
    assert not [path for path in paths if not (ROOT / path).exists()]


def test_the_architecture_page_lists_the_rooms_in_their_order():
    rooms = [name for row in table_rows(ARCHITECTURE, "room") for name in names(row["room"])]
    assert rooms == [*CPP_ROOMS, *(room for room in PYTHON_ROOMS if not room.startswith("__"))]
