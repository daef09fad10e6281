"""At most seven parameters a function, twelve files a folder of the package, 120 columns a line."""

import ast
from collections import Counter
from pathlib import Path

import ninedof

MOST = 7
# Fixed as public names: the keywords of the workspace; robot, pose and the six vectors of an equation.
LONGER = {"workspace", "inverse_acceleration"}
ROOT = Path(__file__).parents[3]
FILES = 12
COLUMNS = 120


def test_functions_take_at_most_seven_parameters():
    names = set()
    for file in Path(ninedof.__file__).parent.rglob("*.py"):
        for node in ast.walk(ast.parse(file.read_text())):
            if isinstance(node, ast.FunctionDef):
                own = [one for part in ("posonlyargs", "args", "kwonlyargs") for one in getattr(node.args, part)]
                if len([one for one in own if one.arg not in ("self", "cls")]) > MOST:
                    names.add(node.name)
    assert names == LONGER


def test_a_full_room_has_rooms_inside():
    counts = Counter(file.parent for file in Path(ninedof.__file__).parent.rglob("*.py"))
    assert len(counts) > 25
    assert [folder.name for folder, count in counts.items() if count > FILES] == []


def test_lines_of_the_core_end_at_column_120():
    """Those of Python are the linter's, code of the core the formatter's, which leaves comments as they are."""
    files = [file for room in ("cpp", "tests/cpp", "bench/cpp") for file in (ROOT / room).rglob("*.[ch]pp")]
    assert len(files) > 500
    lines = ((file.name, line) for file in files for line in file.read_text(encoding="utf-8").splitlines())
    assert not [(name, line) for name, line in lines if len(line) > COLUMNS]
