"""The gallery: every example is run when the site is built, and shown with what it prints and draws."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import ninedof as nd

DRAWING = threading.Lock()  # matplotlib is for one thread
PACKAGE = str(Path(nd.__file__).parents[1])  # the package that the reference describes, not another one
QUICK = ["--out", "run", "--no-figures", "--starts", "4"]  # of a study: the same optimum in less time


def write(examples: Path, pages: Path) -> None:
    """Run every example; write pages, figures and the cards of all. An example that fails ends the build."""
    pages.mkdir(parents=True, exist_ok=True)
    paths = sorted(path for path in examples.iterdir() if path.is_file())
    with ThreadPoolExecutor(2) as two:  # most of the time is spent in other processes
        cards = list(two.map(lambda path: example(path, pages), paths))
    text = "\n".join(["````{container} gallery\n", *cards, "````\n"])
    (pages / "cards.txt").write_text(text, encoding="utf-8")


def example(path: Path, pages: Path) -> str:
    """Run an example, write its page and figure, and return its card: its name over the figure or what it prints."""
    code = path.read_text(encoding="utf-8").strip()
    name, language = title(code), {".py": "python", ".toml": "toml"}[path.suffix]
    figure = pages / f"{'figure' if language == 'python' else 'robot'}_{path.stem}.png"
    with tempfile.TemporaryDirectory() as folder:
        if language == "python":
            command = "python"
            printed = run([str(path), *(["--figure", str(figure)] if "--figure" in code else [])], folder)
        else:
            command = "ninedof " + ("optimize" if "[variables]" in code else "evaluate")
            quick = QUICK if "optimize" in command else ()
            printed = run(["-m", *command.split(), str(path), *quick], folder, 3 if quick else 0)  # 3: no design
            draw(Path(folder, "run") if "optimize" in command else path, figure)
    picture = f"![{name}]({figure.name})\n\n" if figure.is_file() else ""
    code = f"```{language}\n{code}\n```\n\n```bash\n{command} {path.name}\n```\n\nIt prints\n\n"
    page = f"# {name}\n\n{picture}{code}```text\n{printed}\n```\n"
    (pages / f"{path.stem}.md").write_text(page, encoding="utf-8")
    seen = picture.replace("](", "](examples/") or "\n".join(["```text", *printed.splitlines()[:9], "```\n"])
    return f"- [{name}](examples/{path.stem}.md)\n\n" + re.sub("^(?=.)", "  ", seen, flags=re.MULTILINE)


def run(arguments: list[str], folder: str, status: int = 0) -> str:
    """Return what Python prints with these arguments, without the places of files; it may end with a status."""
    done = subprocess.run(
        [sys.executable, *arguments],
        capture_output=True,
        text=True,
        cwd=folder,
        env=os.environ | {"COLUMNS": "100", "NO_COLOR": "1", "PYTHONPATH": PACKAGE},
    )
    if done.returncode not in (0, status):
        raise RuntimeError(f"{' '.join(arguments)} ended with {done.returncode}: {done.stderr.strip()}")
    return re.sub(r"\n.*run folder .*", "", done.stdout.replace(folder, "")).rstrip()


def draw(source: Path, file: Path) -> None:
    """Draw the robot of a design file or of a run folder; a study without a best design has no picture."""
    machine = nd.load(source)
    if isinstance(machine, nd.Result) and machine.status != nd.Status.OPTIMAL:
        return
    panel = nd.plot.Robot("", machine.geometry, machine.configuration, float(nd.condition_number(machine)))
    with DRAWING:
        nd.plot.mechanisms([panel]).savefig(file, dpi=110, bbox_inches="tight")


def title(code: str) -> str:
    """Return the first sentence of the first paragraph, which is a docstring or a comment."""
    words = re.sub(r'^(?:"""|# )|"""$', "", code.partition("\n\n")[0], flags=re.MULTILINE)
    first = re.split(r"(?<!qs\.)(?<=[.?!])\s|:\s|, for `", " ".join(words.split()))[0]
    return first.rstrip(".").replace("`", "")
