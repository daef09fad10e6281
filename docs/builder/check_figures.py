"""Check the figures of the pages: `python docs/builder/check_figures.py [PAGE...]`, four minutes for all.

The commands and the Python of a page run as a reader would type them, and every line that the page shows must be
printed, figure for figure. A figure of five digits or more between the blocks must be printed on some page, or stand in
a test, a benchmark or an example of this repository, or its paragraph or the one before says where it comes from.
"""

from __future__ import annotations

import ast
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
MADE = ("values.md", "comparison.md")  # printed by bench/python

REQUIREMENT = (ROOT / "examples/18_requirement.toml").read_text(encoding="utf-8")
ACTUATORS = (ROOT / "examples/22_actuators.toml").read_text(encoding="utf-8")
PLACED = REQUIREMENT.replace("tilt_deg = 10.0", 'tilt_deg = 10.0\ninternal_point = "best"')
BUILT = REQUIREMENT + "\n[tolerances]\njoints = 0.05\nlegs = 0.05\n"
FILES = {
    "actuators.md": {"examples/22_actuators.toml": ACTUATORS},
    "admissible.md": {"examples/18_requirement.toml": REQUIREMENT},
    "certificate.md": {"examples/18_requirement.toml": REQUIREMENT},
    "certify.md": {"examples/18_requirement.toml": REQUIREMENT, "built.toml": BUILT, "placed.toml": PLACED},
    "first-design.md": {},
    "guides/assembly-modes.md": {},
    "guides/characteristic-length.md": {},
    "guides/confidence.md": {},
    "guides/reading-a-map.md": {},
    "guides/regions.md": {},
    "index.md": {},
    "optimization.md": {},
    "requirement.md": {"machine.toml": REQUIREMENT},
    "study-file.md": {},
    "workspace.md": {"examples/18_requirement.toml": REQUIREMENT},
}
"""The pages that run, and the files that their reader has."""

BLOCK = re.compile(r"^```(\w*)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
COMMAND = re.compile(r"^(?:\$ )?ninedof (.*)$", re.MULTILINE)
NUMBER = re.compile(r"(?<![\w.])\d+(?:\.\d+)?(?:e[+-]?\d+)?")
OF_A_MACHINE = re.compile(r"\d(\.\d+)?e-1\d|\b\d+(\.\d+)? s\b")  # rounding and times
FRAME = re.compile(r"[\s━─│┃┏┓┗┛┡┩└┘├┤┬┴┼╇╈┳┻╋]+")
ORIGIN = re.compile(r"\bmeasured|\(numerical\)|tests/|bench/|paper prints", re.IGNORECASE)
LONG = 5  # digits of a figure that is looked for

RUN = """
try:
    ninedof(shlex.split({0!r}))
except SystemExit as end:
    assert end.code == 0, "exit status %s of ninedof " % end.code + {0!r}
"""


def program(text: str) -> str:
    """Return the page as a Python program that prints what a session would show."""
    lines = ["import shlex", "from pathlib import Path", "from ninedof.cli.app import main as ninedof"]
    for language, block in BLOCK.findall(text):
        if language == "toml" and (name := re.match(r"# (\S+\.toml)\n", block)):
            lines.append(f"Path({name[1]!r}).write_text({block!r})")
        elif language == "python":
            for statement in ast.parse(block).body:
                code = ast.unparse(statement)
                shown = isinstance(statement, ast.Expr) and not code.startswith("print(")
                lines.append(f"print(repr({code}))" if shown else code)
        elif language in ("bash", "text"):
            lines += [RUN.format(command) for command in COMMAND.findall(block)]
    return "\n".join(lines)


def printed_by(page: str, text: str) -> str:
    """Return what the page prints in a new folder, on as many columns as it shows."""
    wide = any(
        len(line) > 80 for language, block in BLOCK.findall(text) if language == "text" for line in block.split("\n")
    )
    with tempfile.TemporaryDirectory() as folder:
        for name, content in FILES[page].items():
            path = Path(folder, name)
            path.parent.mkdir(exist_ok=True)
            path.write_text(content, encoding="utf-8")
        done = subprocess.run(
            [sys.executable, "-c", program(text)],
            cwd=folder,
            env={**os.environ, "COLUMNS": "100" if wide else "80", "MPLBACKEND": "agg"},
            capture_output=True,
            text=True,
            check=False,
        )
    if done.returncode:
        raise SystemExit(f"{page}: its commands or its Python failed\n{done.stderr}")
    return done.stdout + done.stderr


def figures(line: str) -> list[str]:
    """Return the numbers of a line that every machine prints."""
    return NUMBER.findall(OF_A_MACHINE.sub("", line))


def words(line: str) -> str:
    """Return a line without numbers, spaces and frames."""
    return FRAME.sub(" ", NUMBER.sub("#", OF_A_MACHINE.sub("#", line))).strip()


def same(shown: str, printed: str) -> bool:
    """Tell whether a figure is the one printed, rounded or cut to its digits. Counts may depend on the machine."""
    if "." not in shown:
        return True
    mantissa, _, power = shown.partition("e")
    return abs(float(shown) - float(printed)) <= 1.001 * 10.0 ** (int(power or 0) - len(mantissa.partition(".")[2]))


def not_printed(text: str, printed: str) -> list[str]:
    """Return the lines and the commented figures of the blocks that are not printed."""
    lines: dict[str, list[str]] = {}
    for line in printed.splitlines():
        lines.setdefault(words(line), []).append(line)
    numbers = long_figures(printed, 1)
    missing = []
    for language, block in BLOCK.findall(text):
        for line in block.splitlines():
            if language == "text" and not line.startswith(("$", "...")) and figures(line):
                shown, alike = figures(line), map(figures, lines.get(words(line), []))
                # What is rounding on one side only makes the numbers differ.
                if not any(len(a) == len(shown) and all(map(same, shown, a)) for a in alike):
                    missing.append(line)
            elif language == "python" and "  # " in line:
                shown = long_figures(line.partition("  # ")[2], 1)
                missing += [f"{a} in: {line}" for a in shown if not any(same(a, b) for b in numbers)]
    return missing


def long_figures(text: str, digits: int = LONG) -> list[str]:
    """Return the numbers with a decimal point and so many digits or more."""
    return [
        n for n in NUMBER.findall(text) if "." in n and len(n.partition("e")[0].replace(".", "").lstrip("0")) >= digits
    ]


def without_origin(text: str, known: list[str]) -> list[str]:
    """Return the figures between the blocks that are not known and of which nothing says where they come from."""
    missing, before = [], ""
    for paragraph in re.split(r"\n\s*\n", BLOCK.sub("\n", text)):
        if not ORIGIN.search(before + paragraph):
            unknown = [n for n in long_figures(paragraph) if not any(same(n, other) for other in known)]
            missing += [f"{n} in: {' '.join(paragraph.split())[:90]}" for n in unknown]
        before = paragraph
    return missing


def main(wanted: list[str]) -> int:
    """Check the pages that are named, or all; return 1 where a figure is wrong."""
    pages = {str(path.relative_to(DOCS)): path.read_text(encoding="utf-8") for path in sorted(DOCS.rglob("*.md"))}
    pages = {page: text for page, text in pages.items() if not page.startswith(("reference/", "gallery/", "project/"))}
    pages["README.md"] = (ROOT / "README.md").read_text(encoding="utf-8")
    known = long_figures(pages["values.md"])
    for folder in ("tests", "bench", "examples"):
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in (".py", ".cpp", ".hpp", ".toml"):
                known += long_figures(path.read_text(encoding="utf-8"))
    problems = []
    for page in wanted or pages:
        if page in FILES:
            printed = printed_by(page, pages[page])
            known += long_figures(printed)
            problems += [f"{page}: not printed: {line}" for line in not_printed(pages[page], printed)]
    for page in wanted or pages:
        if page not in MADE:
            problems += [f"{page}: from nowhere: {figure}" for figure in without_origin(pages[page], known)]
    print("\n".join(problems) or "every figure of the pages is printed, tested, or says where it comes from")
    return int(bool(problems))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
