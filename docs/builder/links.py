"""Links between Markdown files of the repository, as links of the site."""

from __future__ import annotations

import os
import re
from pathlib import Path

# Pages of the folder `project`: files that lie outside docs/.
OUTSIDE = {
    "contributing": "CONTRIBUTING.md",
    "security": "SECURITY.md",
    "benchmarks": "bench/README.md",
    "changes": "CHANGELOG.md",
}
LINK = re.compile(r"(?<!!)\[([^\]]*)\]\(([^)\s]+)\)")


def within_site(text: str, written: Path, shown: Path, docs: Path) -> str:
    """Return `text` with links for the site.

    A file that is no page of the site becomes a download, a folder plain text.

    Parameters
    ----------
    text : str
        Markdown.
    written, shown : Path
        The folder of the file it was written in, and that of the page it is shown on.
    docs : Path
        The folder of the site's pages.
    """
    root = docs.parent
    other = {root / file: docs / "project" / f"{name}.md" for name, file in OUTSIDE.items()}
    other[root / "README.md"] = docs / "index.md"

    def link(match: re.Match[str]) -> str:
        words, (target, _, part) = match[1], match[2].partition("#")
        if "://" in target or not target:
            return match[0]
        path = Path(os.path.normpath(written / target))
        there = path.is_file()
        if path.parent == root / "examples" and there:
            path = docs / "gallery/examples" / f"{path.stem}.md"
        elif path == root / "examples":
            path, there = docs / "gallery/index.md", True
        path = other.get(path, path)
        if not there:
            return words
        return f"[{words}]({os.path.relpath(path, shown)}{'#' * bool(part)}{part})"

    return LINK.sub(link, text)


def project_pages(root: Path) -> dict[str, str]:
    """Return the text of each page about the project, with links for the site."""
    docs = root / "docs"
    return {
        name: within_site((root / file).read_text(encoding="utf-8"), (root / file).parent, docs / "project", docs)
        for name, file in OUTSIDE.items()
    }
