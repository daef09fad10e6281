"""Pages about the project: Markdown files that lie outside docs/."""

from __future__ import annotations

from pathlib import Path

from .links import OUTSIDE, within_site


def pages(root: Path) -> dict[str, str]:
    """Return the text of each page, with links for the site."""
    docs = root / "docs"
    return {
        name: within_site((root / file).read_text(encoding="utf-8"), (root / file).parent, docs / "project", docs)
        for name, file in OUTSIDE.items()
    }
