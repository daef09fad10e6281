"""The gallery: every example is run when the site is built, and shown with what it prints and draws."""

from __future__ import annotations

import ast
import os
import re
import shutil
import subprocess
import sys
import tempfile
import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import ninedof as nd

DRAWING = threading.Lock()  # matplotlib is for one thread
PACKAGE = str(Path(nd.__file__).parents[1])  # the package that the reference describes, not another one
QUICK = ["--starts", "4"]  # of a study: the same optimum in less time


@dataclass
class Example:
    """An example with what it printed and drew."""

    name: str
    title: str
    command: str
    code: str
    printed: str
    figure: str | None

    def page(self) -> str:
        """Return the page of the example."""
        language = "python" if self.command.startswith("python") else "toml"
        picture = f"![{self.title}]({self.figure})\n\n" if self.figure else ""
        code = f"```{language}\n{self.code}\n```\n\n```bash\n{self.command}\n```\n"
        return f"# {self.title}\n\n{picture}{code}\nIt prints\n\n```text\n{self.printed}\n```\n"


def write(examples: Path, pages: Path) -> None:
    """Run every example and write its page and figure. An example that fails ends the build."""
    pages.mkdir(parents=True, exist_ok=True)
    paths = [path for path in sorted(examples.iterdir()) if path.is_file()]
    with ThreadPoolExecutor(2) as two:  # most of the time is spent in other processes
        for path, example in zip(paths, two.map(lambda path: run(path, pages), paths), strict=True):
            (pages / f"{path.stem}.md").write_text(example.page(), encoding="utf-8")


def run(path: Path, pages: Path) -> Example:
    """Run one example in a folder that is removed afterwards."""
    code = path.read_text(encoding="utf-8").strip()
    with tempfile.TemporaryDirectory() as folder:
        drawn = Path(folder) / "figure.png"
        arguments, command, status = call(path, code, drawn)
        done = subprocess.run(
            [sys.executable, *arguments],
            capture_output=True,
            text=True,
            cwd=folder,
            env=os.environ | {"COLUMNS": "100", "NO_COLOR": "1", "PYTHONPATH": PACKAGE},
        )
        if done.returncode not in status:
            raise RuntimeError(f"examples/{path.name} ended with {done.returncode}: {done.stderr.strip()}")
        robot = path if path.suffix == ".toml" and "evaluate" in command else Path(folder) / "run"
        if path.suffix == ".toml":
            draw(robot, drawn)
        kind = "robot" if path.suffix == ".toml" else "figure"
        figure = f"{kind}_{path.stem}.png" if drawn.is_file() else None
        if figure:
            shutil.copy(drawn, pages / figure)
    printed = re.sub(r"\n.*(run folder|figures?: ).*", "", done.stdout.replace(folder, "")).rstrip()
    return Example(path.stem, title(code), command, code, printed, figure)


def call(path: Path, code: str, drawn: Path) -> tuple[list[str], str, set[int]]:
    """Return the arguments of Python that run an example, the command a reader types, the statuses it may end with."""
    if path.suffix == ".py":
        return [str(path), *(["--figure", str(drawn)] if "--figure" in code else [])], f"python {path.name}", {0}
    if "[variables]" not in code and "family" not in code:
        return ["-m", "ninedof", "evaluate", str(path)], f"ninedof evaluate {path.name}", {0}
    arguments = ["-m", "ninedof", "optimize", str(path), "--out", "run", "--no-figures", *QUICK]
    return arguments, f"ninedof optimize {path.name}", {0, 3}


def draw(source: Path, file: Path) -> None:
    """Draw the robot of a design file or of a run folder; a study without a best design has no picture."""
    found = nd.load(source)
    if isinstance(found, nd.Result) and found.status != nd.Status.OPTIMAL:
        return
    kappa = float(nd.condition_number(found.geometry, found.configuration, found.characteristic_length))
    panel = nd.plot.Robot("", found.geometry, found.configuration, kappa)
    with DRAWING:
        nd.plot.mechanisms([panel]).savefig(file, dpi=110, bbox_inches="tight")


def title(code: str) -> str:
    """Return the first sentence of the docstring or of the first comment."""
    if code.startswith('"""'):
        words = ast.get_docstring(ast.parse(code)) or ""
    else:
        words = " ".join(line.lstrip("# ") for line in code.partition("\n\n")[0].splitlines() if line.startswith("#"))
    first = re.split(r"(?<!qs\.)(?<=[.?!])\s|:\s|, for `", " ".join(words.split()))[0]
    return first.rstrip(".").replace("`", "")


def cards(pages: Path) -> str:
    """Return the list of examples for the page of the gallery, those with a figure as pictures."""
    lines = ["", "", "````{container} gallery", ""]
    for path in sorted(pages.glob("*.md")):
        text = path.read_text(encoding="utf-8")
        name = text.partition("\n")[0].lstrip("# ")
        printed = text.partition("It prints\n\n```text\n")[2].splitlines()[:9]
        figures = sorted(path.parent.glob(f"*_{path.stem}.png"))
        seen = [f"![{name}](examples/{figure.name})" for figure in figures] or ["```text", *printed]
        seen += [] if figures or "```" in printed else ["```"]
        lines += [f"- [{name}](examples/{path.name})", "", *(f"  {line}" for line in seen), ""]
    return "\n".join([*lines, "````", ""])
