"""Links between Markdown files of the repository, as links of the site."""

from __future__ import annotations

import os
import re
from pathlib import Path

# Pages of files outside docs/. The folder `project` is made of such files.
OUTSIDE = {
    "README.md": "index",
    "CONTRIBUTING.md": "project/contributing",
    "SECURITY.md": "project/security",
    "bench/README.md": "project/benchmarks",
    "CHANGELOG.md": "project/changes",
    "examples": "gallery/index",
}
LINK = re.compile(r"(?<!!)\[([^\]]*)\]\((?!#|\w+:)([^)#\s]+)(#[^)\s]+)?\)")


def within_site(text: str, written: Path, shown: Path, docs: Path) -> str:
    """Return `text` with links for the site: a file that is no page of it becomes a download, a folder plain text.

    Parameters
    ----------
    text : str
        Markdown.
    written, shown : Path
        The folder of the file it was written in, and that of the page it is shown on.
    docs : Path
        The folder of the site's pages.
    """

    def link(match: re.Match[str]) -> str:
        path = Path(os.path.normpath(written / match[2]))
        outside = os.path.relpath(path, docs.parent)
        if path.parent == docs.parent / "examples" and path.is_file():
            path = docs / "gallery/examples" / f"{path.stem}.md"
        elif outside in OUTSIDE:
            path = docs / f"{OUTSIDE[outside]}.md"
        elif path.is_dir():
            return match[1]
        return f"[{match[1]}]({os.path.relpath(path, shown)}{match[3] or ''})"

    return LINK.sub(link, text)


def project_pages(root: Path) -> dict[str, str]:
    """Return the text of each page about the project, with links for the site."""
    pages = {}
    for file, page in OUTSIDE.items():
        folder, _, name = page.rpartition("/")
        if folder == "project":
            text = (root / file).read_text(encoding="utf-8")
            pages[name] = within_site(text, (root / file).parent, root / "docs/project", root / "docs")
    return pages
