"""Tables of docs/study-file.md, from the classes and functions that read a study file.

The page is read without Sphinx too, so the tables stand in it: `python docs/builder/study_tables.py` writes them anew,
and tests/python/project/test_docs.py compares them.
"""

from __future__ import annotations

import inspect
import math
import re
from pathlib import Path
from typing import Any

import ninedof as nd
from ninedof.design.duty import DUTIES
from ninedof.support.structs import StudyTable, keys
from ninedof.support.units import DEG

PAGE = Path(__file__).resolve().parents[1] / "study-file.md"
SOURCES = {
    "Objective": nd.Objective,
    "Region": nd.Region,
    "Pose": nd.Pose,
    "poses.box": nd.poses.box,
    "poses.ball": nd.poses.ball,
    "poses.path": nd.poses.path,
    **{kind.__name__: kind for kind in DUTIES.values()},
    "Actuator": nd.Actuator,
}
SPELLED = {  # of docstrings, as a file has them
    "sequence of (3,) floats": "[[x, y, z], …]",
    "sequence of (6,) floats": "[[six numbers], …]",
    "sequence of Pose or mappings": "tables",
    "Region or mapping": "table",
    "(3,) floats": "[x, y, z]",
    "(6,) floats": "[six numbers]",
    "(2,) floats": "[a, b]",
    "float": "number",
    "int": "integer",
    "str": "word",
}


def page() -> str:
    """Return the page with its tables made anew, each between two comments."""
    text = PAGE.read_text(encoding="utf-8")
    for name, source in SOURCES.items():
        pattern = rf"(<!-- table: {re.escape(name)} -->\n).*?(<!-- end -->)"
        text = re.sub(pattern, lambda m, source=source: m[1] + table(source) + m[2], text, flags=re.DOTALL)
    return text


def table(source: Any) -> str:
    """Return the table of a class or function: a row for each parameter of its docstring."""
    defaults = {name: p.default for name, p in inspect.signature(source).parameters.items()}
    known = keys(source) if isinstance(source, type) and issubclass(source, StudyTable) else list(defaults)
    lines = ["| key | value | if left out | meaning |", "| --- | --- | --- | --- |"]
    for names, kind, words in parameters(source):
        every = dict.fromkeys(key for name in names for key in (name, name + DEG) if key in known)
        default = ", ".join(dict.fromkeys(shown(defaults[name]) for name in names))
        cells = (", ".join(f"`{key}`" for key in every), kind, default, words)
        lines.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
    return "\n".join([*lines, ""])


def parameters(source: Any) -> list[tuple[list[str], str, str]]:
    """Return names, kind and meaning of the parameters of a docstring."""
    section = re.search(r"Parameters\n-+\n(.*?)\n\n\w+\n-+\n", inspect.getdoc(source) or "", flags=re.DOTALL)
    assert section is not None, source
    entries = re.findall(r"^(\w[\w, ]*?)(?: : (.*))?\n((?:    .*\n?|\n)+)", section[1] + "\n", flags=re.MULTILINE)
    return [(names.split(", "), spelled(kind), quoted(" ".join(words.split()))) for names, kind, words in entries]


def spelled(kind: str) -> str:
    """Return the kind of a value in the words of a file."""
    kind = kind.removesuffix(", optional").strip("{}")
    for word, other in SPELLED.items():
        kind = kind.replace(word, other)
    return quoted(kind)


def quoted(text: str) -> str:
    """Return text with words in quotes as code, without the defaults that have a column."""
    text = re.sub(r" (None|Zero|Without limit|Unknown) by default\.|[;,] [\w.]+ by default", "", text)
    return re.sub(r'(?<!`)("\w+")', r"`\1`", text)


def shown(default: Any) -> str:
    """Return a default as a file has it."""
    if default is None or default is inspect.Parameter.empty or default in ((), math.inf):
        return "" if default is inspect.Parameter.empty else "none"
    if isinstance(default, tuple):
        return f"[{', '.join(f'{x:g}' for x in default)}]"
    return f'`"{default}"`' if isinstance(default, str) else f"{default:g}"


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
