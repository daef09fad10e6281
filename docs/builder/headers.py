"""The reference of the C++ library: a page for each room, from the `///` comments and declarations of its headers."""

from __future__ import annotations

import re
from pathlib import Path

TITLES = {
    "math": "types, errors, rotations, dual numbers, intervals",
    "robot": "geometry, configuration, legs",
    "kinematics": "velocities and accelerations",
    "conditioning": "condition number and other indices",
    "families": "design families: from variables to a robot",
    "position": "direct position analysis",
    "singularity": "singularities",
    "statics": "forces, stiffness, accuracy",
    "dynamics": "leg forces of a machine in motion",
    "batch": "stacks",
    "limits": "what a design and its poses have to keep",
    "domains": "poses and regions",
    "sheet": "the numbers of a workshop",
    "redundancy": "the best internal point",
    "motion": "along a trajectory",
    "problem": "poses, objectives, constraints, the problem of a study",
    "proof": "certified numbers, the certified optimum",
    "optimize": "optimization",
    "workspace": "workspaces",
}

# Patterns of headers as clang-format writes them: what is outside of braces begins at the first column, and a body ends
# with a brace below the first letter of its declaration.
LEFT_OUT = {
    r"^namespace detail \{\n(?:.*\n)*?\}  // namespace detail\n": "",
    r"\n+ private:\n(?:.*\n)*?(?=\};)": "\n",
    r"^ *//(?!/).*\n": "",  # notes for who reads the source
    # Bodies of functions, and the initializers before them: behind names, arguments and what stands after them.
    r"^( *)((?![/ \n])(?:[^;{}]|= \{[^{}\n]*\})*?\)(?: const| noexcept| override| -> [\w:<>]+)*)"
    r"(?:\s+: [^;]*?)? \{(?:.*\}|\n(?:.*\n)*?\1\})(?=$| +//)": r"\1\2;",
}
BLOCK = re.compile(r"((?:^///.*\n)*)((?:^(?!///|\n).*\n|^\n(?=[ }\n]))*)", re.MULTILINE)


def pages(include: Path) -> dict[str, str]:
    """Return the Markdown of each page; the first digits of its name put it in its place."""
    rooms = sorted(
        (folder.name for folder in include.iterdir() if folder.is_dir()),
        key=lambda room: [*TITLES, room].index(room),
    )
    return {f"{k:02}-{room}": page(room, include) for k, room in enumerate(rooms, 1)}


def page(room: str, include: Path) -> str:
    """Return the page of a room: its headers one after the other, without what lies in `detail`."""
    parts = [f"# {room}: {TITLES.get(room, room)}\n"]
    for header in sorted((include / room).rglob("*.hpp")):
        name = header.relative_to(include.parent)
        introduction, declarations = read(header.read_text(encoding="utf-8"))
        parts.append(f"## {header.relative_to(include / room)}\n\n```cpp\n#include <{name}>\n```\n")
        parts.append(markdown(introduction))
        parts.extend(f"```cpp\n{code}\n```\n\n{markdown(comment)}" for comment, code in declarations)
    return "\n".join(parts)


def read(text: str) -> tuple[str, list[tuple[str, str]]]:
    """Return the comment at the head of a header, and its declarations: the comment before each and its code."""
    head, _, body = text.partition("\nnamespace ninedof {\n")
    introduction = "\n".join(line for line in head.splitlines() if line.startswith("///"))
    body = body.partition("}  // namespace ninedof")[0]
    for pattern, left in LEFT_OUT.items():
        body = re.sub(pattern, left, body, flags=re.MULTILINE)
    return introduction, [(comment.strip("\n"), code.strip("\n")) for comment, code in BLOCK.findall(body) if code]


def markdown(comment: str) -> str:
    """Return the words of a comment as Markdown: signs that Markdown would read are escaped."""
    lines = [re.sub(r"^/// ?", "", line) for line in comment.splitlines()]
    parts = re.split(r"(`[^`]*`)", "\n".join(lines))
    return "".join(p if p.startswith("`") else re.sub(r"([*<\[\]_#|])", r"\\\1", p) for p in parts) + "\n"
