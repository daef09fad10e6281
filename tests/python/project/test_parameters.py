"""No function takes more than seven parameters: more of them are a struct."""

import ast
from pathlib import Path

import ninedof

MOST = 7
# Fixed as public names: the keywords of the workspace; robot, pose and the six vectors of an equation.
LONGER = {"workspace", "inverse_acceleration"}


def test_functions_take_at_most_seven_parameters():
    names = set()
    for file in Path(ninedof.__file__).parent.rglob("*.py"):
        for node in ast.walk(ast.parse(file.read_text())):
            if isinstance(node, ast.FunctionDef):
                own = [one for part in ("posonlyargs", "args", "kwonlyargs") for one in getattr(node.args, part)]
                if len([one for one in own if one.arg not in ("self", "cls")]) > MOST:
                    names.add(node.name)
    assert names == LONGER
