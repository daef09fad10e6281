"""The layers of the code hold, and the checkers that say so can fail. The rules are in layering.py."""

from collections.abc import Iterable, Mapping
from pathlib import Path

import pytest
from layering import cpp_violations, included_headers, python_violations

ROOT = Path(__file__).resolve().parents[3]


def read_tree(folder: Path, patterns: Iterable[str]) -> dict[str, str]:
    paths = sorted(path for pattern in patterns for path in folder.glob(pattern))
    return {path.relative_to(folder).as_posix(): path.read_text(encoding="utf-8") for path in paths}


@pytest.fixture(scope="module")
def cpp_files() -> dict[str, str]:
    return read_tree(ROOT / "cpp", ["include/ninedof/**/*.hpp", "src/**/*.hpp", "src/**/*.cpp"])


@pytest.fixture(scope="module")
def python_files() -> dict[str, str]:
    return read_tree(ROOT / "python" / "ninedof", ["**/*.py"])


def test_cpp_layers(cpp_files):
    assert cpp_violations(cpp_files) == []


def test_python_layers(python_files):
    assert python_violations(python_files) == []


def test_the_whole_tree_is_read(cpp_files, python_files):
    assert {"include/ninedof/types.hpp", "src/optimize.cpp"} <= set(cpp_files)
    assert {"__init__.py", "kinematics.py", "cli.py"} <= set(python_files)
    assert "ninedof/legs" in included_headers(cpp_files["src/velocity.cpp"])


# --- The checkers catch what they are for -----------------------------------------------------------------------------


def plant(files: Mapping[str, str], lines: Mapping[str, str]) -> dict[str, str]:
    """The files with a line added to some of them, or with new files of that one line."""
    return {**files, **{path: f"{files.get(path, '')}\n{line}\n" for path, line in lines.items()}}


@pytest.mark.parametrize(
    ("lines", "expected"),
    [
        ({"include/ninedof/legs.hpp": '#include "ninedof/velocity.hpp"'}, "upward include/ninedof/velocity.hpp"),
        ({"src/geometry.cpp": "#include <ninedof/optimize.hpp>"}, "upward include/ninedof/optimize.hpp"),
        ({"src/conditioning.cpp": '#include "slsqp.hpp"'}, "upward src/slsqp.hpp"),
        ({"include/ninedof/types.hpp": '#include "ninedof/rotation.hpp"'}, "circular"),
        ({"src/symmetric.cpp": '#include "ninedof/velocity.hpp"'}, "src/symmetric.cpp: not independent of velocity"),
        ({"include/ninedof/symmetric.hpp": '#include "ninedof/legs.hpp"'}, "symmetric.cpp: not independent of legs"),
        ({"include/ninedof/optimize.hpp": '#include "slsqp.hpp"'}, "a public header includes the private src/slsqp"),
        ({"include/ninedof/optimize.hpp": "struct nlopt_opt_s;"}, "include/ninedof/optimize.hpp: mentions nlopt"),
        ({"src/optimize.cpp": "#include <nlopt.h>"}, "src/optimize.cpp: mentions nlopt"),
        ({"src/legs.cpp": "#include <iostream>"}, "mentions iostream"),
        ({"src/legs.cpp": '#include "ninedof/no_such_file.hpp"'}, "does not exist"),
        ({"include/ninedof/new_idea.hpp": "#pragma once"}, "include/ninedof/new_idea.hpp: no layer"),
    ],
)
def test_planted_include_is_caught(cpp_files, lines, expected):
    assert any(expected in violation for violation in cpp_violations(plant(cpp_files, lines)))


@pytest.mark.parametrize(
    "lines",
    [
        {"src/legs.cpp": '// #include "ninedof/optimize.hpp"'},
        {"include/ninedof/optimize.hpp": "/// Solved by NLopt."},
        {"src/new_helper.hpp": '#include "ninedof/optimize.hpp"'},
    ],
)
def test_harmless_cpp_line_passes(cpp_files, lines):
    assert cpp_violations(plant(cpp_files, lines)) == cpp_violations(cpp_files)


@pytest.mark.parametrize(
    ("lines", "expected"),
    [
        ({"kinematics.py": "from ninedof.optimize import optimize"}, "imports upward optimize"),
        ({"geometry.py": "from .study import Study"}, "imports upward study"),
        ({"study.py": "import ninedof.cli"}, "imports upward cli"),
        ({"study.py": "def late():\n    from ninedof import cli"}, "imports upward cli"),
        ({"study.py": "from ninedof import jacobian"}, "imports upward __init__"),
        ({"sweep.py": "import ninedof.workspace", "workspace.py": "import ninedof.sweep"}, "circular"),
        ({"paper.py": "from ninedof import _core"}, "paper.py: imports _core"),
        ({"plot/planted.py": "from .._core import jacobian"}, "plot/planted.py: imports _core"),
        ({"plot/planted.py": "from ninedof.optimize import trace"}, "plot/planted.py: must not use optimize"),
        ({"study.py": "import matplotlib.pyplot as plt"}, "study: loads matplotlib on `import ninedof`"),
        ({"new_idea.py": "import math"}, "new_idea.py: no layer"),
    ],
)
def test_planted_import_is_caught(python_files, lines, expected):
    assert any(expected in violation for violation in python_violations(plant(python_files, lines)))


@pytest.mark.parametrize(
    "lines",
    [
        {"plot/planted.py": "if TYPE_CHECKING:\n    from ninedof.optimize import Result"},
        {"plot/planted.py": "import matplotlib.pyplot as plt"},
        {"plot/planted.py": '"""from ninedof import _core"""'},
        {"study.py": "def late():\n    import matplotlib.pyplot as plt"},
    ],
)
def test_harmless_python_line_passes(python_files, lines):
    assert python_violations(plant(python_files, lines)) == python_violations(python_files)
