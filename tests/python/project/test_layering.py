"""The rooms of the code hold, and the checkers that say so can fail. The rules are in layering.py."""

from collections.abc import Mapping
from pathlib import Path

import pytest
from layering_cpp import TREES, cpp_violations, included_headers
from layering_python import misplaced_tests, python_violations

ROOT = Path(__file__).resolve().parents[3]
RESULT = "optimize/result.py"
FOR_THE_CHECKER = "if TYPE_CHECKING:\n    from ninedof.optimize.result import Result"
LEGS, SYMMETRIC = "include/ninedof/robot/legs.hpp", "conditioning/symmetric"


def read_tree(folder: str, *patterns: str, root: Path) -> dict[str, str]:
    paths = sorted(path for pattern in patterns for path in (ROOT / folder).rglob(pattern))
    return {path.relative_to(root).as_posix(): path.read_text(encoding="utf-8") for path in paths}


@pytest.fixture(scope="module")
def cpp_files() -> dict[str, str]:
    files: dict[str, str] = {}
    for tree in TREES:
        files |= read_tree(tree, "*.hpp", "*.cpp", root=ROOT)
    return files


@pytest.fixture(scope="module")
def python_files() -> dict[str, str]:
    """The files of the package; the public names of its stub are imports of `__init__`, but for `plot`."""
    root = ROOT / "python" / "ninedof"
    names = (root / "__init__.pyi").read_text("utf-8").replace("from . import plot as plot\n", "")
    files = read_tree("python/ninedof", "*.py", root=root)
    return files | {"__init__.py": files["__init__.py"] + names}


def test_cpp_rooms(cpp_files):
    assert cpp_violations(cpp_files) == []


def test_python_rooms(python_files):
    assert python_violations(python_files) == []


def test_rooms_of_the_python_tests():
    tests = ROOT / "tests" / "python"
    names = [path.relative_to(tests).as_posix() for path in tests.rglob("test_*.py")]
    assert len(names) > 50
    assert misplaced_tests(names) == []
    assert misplaced_tests(["test_new.py", "idea/test_new.py", "robot/test_new.py"]) == [
        "test_new.py: in no room",
        "idea/test_new.py: in no room",
    ]


def test_the_whole_tree_is_read(cpp_files, python_files):
    assert {f"cpp/{LEGS}", "cpp/src/optimize/optimize.cpp", "cpp/bindings/module.cpp"} <= set(cpp_files)
    assert {"tests/cpp/robot/legs.cpp", "bench/cpp/robot/legs.cpp"} <= set(cpp_files)
    assert {"__init__.py", "kinematics/kinematics.py", "cli/commands/runs/sweep.py"} <= set(python_files)
    assert "ninedof/robot/legs.hpp" in included_headers(cpp_files["cpp/src/kinematics/velocity.cpp"])


# --- The checkers catch what they are for -----------------------------------------------------------------------------


def plant(files: Mapping[str, str], lines: Mapping[str, str]) -> dict[str, str]:
    """The files with a line added to some of them, or with new files of that one line."""
    return {**files, **{path: f"{files.get(path, '')}\n{line}\n" for path, line in lines.items()}}


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize(
    ("path", "line", "expected"),
    [
        (LEGS, '#include "ninedof/kinematics/velocity.hpp"', "upward cpp/include/ninedof/kinematics/velocity.hpp"),
        ("src/robot/geometry.cpp", "#include <ninedof/workspace/workspace.hpp>", "upward cpp/include/ninedof/work"),
        ("src/conditioning/conditioning.cpp", '#include "optimize/minimax/subproblem.hpp"', "upward cpp/src/optimize"),
        ("include/ninedof/math/types.hpp", '#include "ninedof/math/rotation.hpp"', "circular"),
        (f"src/{SYMMETRIC}.cpp", '#include "ninedof/kinematics/velocity.hpp"', "cpp: not independent of velocity"),
        (f"include/ninedof/{SYMMETRIC}.hpp", '#include "ninedof/robot/legs.hpp"', ".cpp: not independent of legs"),
        ("src/proof/checker/blocks.cpp", '#include "ninedof/math/interval.hpp"', "cpp: not independent of interval"),
        (LEGS, '#include "robot/leg_pairs.hpp"', "a public header includes the private cpp/src/robot/leg_pairs.hpp"),
        (LEGS, "struct nlopt_opt_s;", f"cpp/{LEGS}: mentions nlopt"),
        ("src/optimize/optimize.cpp", "#include <nlopt.h>", "cpp/src/optimize/optimize.cpp: mentions nlopt"),
        ("src/robot/legs.cpp", "#include <iostream>", "mentions iostream"),
        ("src/robot/legs.cpp", '#include "ninedof/robot/no_such_file.hpp"', "does not exist"),
        ("src/robot/legs.cpp", '#include "leg_pairs.hpp"', "leg_pairs.hpp, which does not exist"),
        ("include/ninedof/new_idea.hpp", "#pragma once", "include/ninedof/new_idea.hpp: in no room"),
        ("src/idea/new_idea.hpp", "#pragma once", "src/idea/new_idea.hpp: in no room"),
        ("src/support/new_idea.hpp", "#pragma once", "src/support/new_idea.hpp: in no room"),
        ("bindings/new_idea.cpp", "int x;", "bindings/new_idea.cpp: in no room"),
        ("../tests/cpp/new_idea.cpp", "int x;", "tests/cpp/new_idea.cpp: in no room"),
        ("src/robot/new_idea.hpp", "namespace ninedof {\nstruct Limit {", "hpp: defines ninedof::Limit, as cpp"),
        ("src/robot/new_idea.cpp", "int x;", "new_idea.cpp: no header of its name"),
        ("src/robot/new_idea.cpp", "// Declared in robot/nowhere.hpp.", "new_idea.cpp: no header of its name"),
        ("src/robot/new_idea.cpp", "int x;\n// Declared in ninedof/robot/legs.hpp.", "cpp: no header of its name"),
    ],
)
def test_planted_include_is_caught(cpp_files, path, line, expected):
    planted = plant(cpp_files, {f"cpp/{path}".replace("cpp/../", ""): line})
    assert any(expected in violation for violation in cpp_violations(planted))


@pytest.mark.parametrize(
    ("path", "line"),
    [
        ("src/robot/legs.cpp", '// #include "ninedof/workspace/workspace.hpp"'),
        (LEGS, "/// Solved by NLopt."),
        ("src/optimize/new_helper.hpp", '#include "ninedof/families/design_family.hpp"'),
        ("src/robot/legs.cpp", "namespace ninedof {\nnamespace {\nstruct Limit {"),
        ("src/robot/new_idea.cpp", "/// Another way to\n/// the legs. Declared in ninedof/robot/legs.hpp."),
    ],
)
def test_harmless_cpp_line_passes(cpp_files, path, line):
    assert cpp_violations(plant(cpp_files, {f"cpp/{path}": line})) == cpp_violations(cpp_files)


@pytest.mark.parametrize(
    ("lines", "expected"),
    [
        ({"kinematics/kinematics.py": "from ninedof.optimize.optimize import optimize"}, "upward optimize/optimize"),
        ({"robot/geometry.py": "from ..design.study import Study"}, "imports upward design/study"),
        ({"design/study.py": "import ninedof.cli.app"}, "imports upward cli/app"),
        ({"design/study.py": "def late():\n    from ninedof.cli import app"}, "imports upward cli/app"),
        ({"design/study.py": "from ninedof import jacobian"}, "imports upward __init__"),
        ({"design/study.py": FOR_THE_CHECKER}, "imports upward optimize/result"),
        ({RESULT: "def late():\n    from ninedof.optimize.pieces import Warm"}, "circular: optimize/result"),
        ({RESULT: "if TYPE_CHECKING:\n    from .bounds import LowerBound"}, "circular: optimize/result"),
        ({"sweep/axis.py": "from ninedof.sweep import grid"}, "circular: sweep/axis"),
        ({"paper/published.py": "from ninedof import _core"}, "paper/published.py: imports _core"),
        ({"plot/planted.py": "from .._core import jacobian"}, "plot/planted.py: imports _core"),
        ({"plot/planted.py": "from ninedof.optimize.optimize import trace"}, "plot/planted.py: must not use optimize"),
        ({"design/study.py": "import matplotlib.pyplot as plt"}, "design/study: loads matplotlib with public names"),
        ({"sweep/__init__.py": "import dask"}, "sweep/__init__: loads dask with public names"),
        ({"new_idea.py": "import math"}, "new_idea.py: in no room"),
        ({"idea/new_idea.py": "import math"}, "idea/new_idea.py: in no room"),
    ],
)
def test_planted_import_is_caught(python_files, lines, expected):
    assert any(expected in violation for violation in python_violations(plant(python_files, lines)))


@pytest.mark.parametrize(
    "lines",
    [
        {"plot/planted.py": FOR_THE_CHECKER},
        {"plot/planted.py": "import matplotlib.pyplot as plt"},
        {"plot/planted.py": '"""from ninedof import _core"""'},
        {"design/study.py": "def late():\n    import matplotlib.pyplot as plt"},
        {"robot/new_room/planted.py": "from ninedof.support.arrays import Floats"},
    ],
)
def test_harmless_python_line_passes(python_files, lines):
    assert python_violations(plant(python_files, lines)) == python_violations(python_files)
