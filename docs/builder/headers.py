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
    "batch": "stacks",
    "redundancy": "the best internal point",
    "problem": "poses, objectives, constraints, the problem of a study",
    "proof": "certified numbers, the certified optimum",
    "optimize": "optimization",
    "workspace": "workspaces",
}


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
    body = re.sub(r"\nnamespace detail \{.*?\n\}  // namespace detail\n", "\n", body, flags=re.DOTALL)
    body = body.partition("\n}  // namespace ninedof")[0]
    return introduction, [split for block in blocks(without_bodies(body)) if (split := comment_and_code(block))[1]]


def blocks(body: str) -> list[str]:
    """Return the parts of a header between blank lines outside of braces, and before each comment outside of them."""
    found, depth, in_comment = [""], 0, False
    for line in body.splitlines():
        is_comment = line.startswith("///")
        if depth == 0 and (not line.strip() or (is_comment and not in_comment)):
            found.append("")
        in_comment = is_comment
        found[-1] += line.rstrip() + "\n"
        code = line.partition("//")[0]
        depth += code.count("{") - code.count("}")
    return [block.strip("\n") for block in found if block.strip()]


def comment_and_code(block: str) -> tuple[str, str]:
    """Return the comment at the head of a block and the rest; private members and plain comments are left out."""
    lines = block.splitlines()
    count = next((k for k, line in enumerate(lines) if not line.startswith("///")), len(lines))
    code = re.sub(r"\n+ private:\n.*?(?=\n\};)", "", "\n".join(lines[count:]), flags=re.DOTALL)
    code = "\n".join(line for line in code.splitlines() if not re.match(r"\s*//(?!/)", line))
    return "\n".join(lines[:count]), code.strip("\n")


def without_bodies(text: str) -> str:
    """Return the text with a semicolon in the place of each function body and of the initializers before it."""
    out, at, start = "", 0, 0  # start: of the declaration, in `out`
    while at < len(text):
        if text.startswith("//", at):
            end = text.find("\n", at)
            end = len(text) if end < 0 else end
            out, at = out + text[at:end], end
            if out.rpartition("\n")[2].lstrip().startswith("//"):
                start = len(out)
            continue
        sign = text[at]
        declared = out[start:]
        if sign == "{" and re.search(r"\)\s*(const|noexcept|override|-> [\w:<>]+|\s)*$", before_initializers(declared)):
            if before_initializers(declared) != declared and not out.endswith((") ", "} ")):
                close = closing(text, at)  # an initializer in braces, not yet the body
                out, at = out + text[at:close], close
                continue
            out = out[:start] + before_initializers(declared).rstrip() + ";"
            at = closing(text, at)
            start = len(out)
            continue
        out, at = out + sign, at + 1
        if sign in ";}" or (sign == "{" and not re.search(r"[=(,]\s*\{$", out)):
            start = len(out)
    return out


def before_initializers(declared: str) -> str:
    """Return a declaration without the list of initializers of a constructor."""
    found = re.search(r"\)\s*:\s(?!:)", declared)
    return declared[: found.start() + 1] if found else declared


def closing(text: str, at: int) -> int:
    """Return the place after the brace that closes the one at `at`."""
    depth = 0
    for k in range(at, len(text)):
        depth += (text[k] == "{") - (text[k] == "}")
        if depth == 0:
            return k + 1
    return len(text)


def markdown(comment: str) -> str:
    """Return the words of a comment as Markdown: signs that Markdown would read are escaped."""
    lines = [re.sub(r"^/// ?", "", line) for line in comment.splitlines()]
    parts = re.split(r"(`[^`]*`)", "\n".join(lines))
    return "".join(p if p.startswith("`") else re.sub(r"([*<\[\]_#|])", r"\\\1", p) for p in parts) + "\n"
