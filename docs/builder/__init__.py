"""What Sphinx calls: makes the pages that come from the sources, and completes those written by hand."""

from __future__ import annotations

import shutil
from pathlib import Path

from . import commands, contents, gallery, headers, links, public_names

MADE = ("reference/python", "reference/commands", "reference/cpp", "gallery/examples", "project")


def generate(docs: Path) -> None:
    """Write every page that is made, in folders of their own that git ignores; older ones are removed first."""
    root = docs.parent
    for folder in MADE:
        shutil.rmtree(docs / folder, ignore_errors=True)
    pages = {
        **{f"reference/python/{name}": text for name, text in public_names.pages().items()},
        **{f"reference/commands/{name}": text for name, text in commands.pages().items()},
        **{f"reference/cpp/{name}": text for name, text in headers.pages(root / "cpp/include/ninedof").items()},
        **{f"project/{name}": text for name, text in links.project_pages(root).items()},
    }
    for name, text in pages.items():
        path = docs / f"{name}.md"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    gallery.write(root / "examples", docs / "gallery/examples")


def complete(docs: Path, page: str, source: list[str]) -> None:
    """Change the text of a page in place: links that leave the site, then the list of pages below it."""
    here = (docs / page).parent
    text = links.within_site(source[0], here, here, docs)
    if page == "gallery/index":
        text += "\n" + (docs / "gallery/examples/cards.txt").read_text(encoding="utf-8")
    source[0] = fences(text) + contents.below(docs, page)


def fences(text: str) -> str:
    """Return `text` with a name for each fenced block without one, so that it is told from an indented formula."""
    lines, inside = text.split("\n"), False
    for k, line in enumerate(lines):
        if line.startswith("```"):
            inside = not inside
            if inside and line == "```":
                lines[k] = "```text"
    return "\n".join(lines)
