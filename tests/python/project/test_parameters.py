"""No function takes more than seven parameters: more of them are a struct."""

import ast
from pathlib import Path

import ninedof

MOST = 7
# The workspace keeps its keywords; the others are public and have equations or solver settings as parameters.
LONGER = {"workspace", "optimize", "inverse_acceleration", "inverse_dynamics", "follow", "hexagonal_condition_number"}


def test_functions_take_at_most_seven_parameters():
    names = set()
    for file in Path(ninedof.__file__).parent.rglob("*.py"):
        for node in ast.walk(ast.parse(file.read_text())):
            if isinstance(node, ast.FunctionDef):
                own = [one for part in ("posonlyargs", "args", "kwonlyargs") for one in getattr(node.args, part)]
                if len([one for one in own if one.arg not in ("self", "cls")]) > MOST:
                    names.add(node.name)
    assert names <= LONGER
