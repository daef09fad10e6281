"""What Sphinx calls: makes the pages that come from the sources, and completes those written by hand."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

from . import commands, contents, gallery, headers, links, public_names


def generate(docs: Path) -> None:
    """Write every page that is made, in folders of their own that git ignores; older ones are removed first."""
    root = docs.parent
    pages = {
        "reference/python": public_names.pages(),
        "reference/commands": commands.pages(),
        "reference/cpp": headers.pages(root / "cpp/include/ninedof"),
        "project": links.project_pages(root),
    }
    for folder, texts in pages.items():
        shutil.rmtree(docs / folder, ignore_errors=True)
        (docs / folder).mkdir()
        for name, text in texts.items():
            (docs / folder / f"{name}.md").write_text(text, encoding="utf-8")
    shutil.rmtree(docs / "gallery/examples", ignore_errors=True)
    gallery.write(root / "examples", docs / "gallery/examples")


def complete(docs: Path, page: str, source: list[str]) -> None:
    """Change the text of a page in place: links that leave the site, names of blocks, the list of pages below it."""
    here = (docs / page).parent
    text = links.within_site(source[0], here, here, docs)
    # A fenced block without a name gets one, so that it is told from an indented formula.
    text = re.sub(r"^```(\S*)(\n.*?^```)$", lambda block: f"```{block[1] or 'text'}{block[2]}", text, flags=re.M | re.S)
    if page == "gallery/index":
        text += "\n" + (docs / "gallery/examples/cards.txt").read_text(encoding="utf-8")
    source[0] = text + contents.below(page)
