"""Check the built site: `python docs/builder/check_links.py build/docs`.

Every link to a page, a file or a heading of the site must lead somewhere, and no page may load anything from a network.
"""

from __future__ import annotations

import os
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

LOADED = {"script": "src", "img": "src", "link": "href", "iframe": "src", "source": "src"}


class Page(HTMLParser):
    """What a page links to, what it loads, and the places in it that links may name."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: set[str] = set()
        self.loaded: set[str] = set()
        self.places: set[str] = set()
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note the attributes that matter."""
        attributes = dict(attrs)
        if place := attributes.get("id"):
            self.places.add(place)
        if tag == "a" and (target := attributes.get("href")):
            self.links.add(target)
        if target := attributes.get(LOADED.get(tag, "")):
            self.loaded.add(target)


def problems(site: Path) -> list[str]:
    """Return a line for each link that leads nowhere, and for each file that a page loads from a network."""
    pages = {path: Page(path.read_text(encoding="utf-8")) for path in sorted(site.rglob("*.html"))}
    lines = []
    for path, page in pages.items():
        name = path.relative_to(site)
        for target in sorted(page.links | page.loaded):
            if "//" in target:
                if target in page.loaded:
                    lines.append(f"{name}: loads {target}")
                continue
            if target.startswith(("mailto:", "data:")):
                continue
            file, _, place = target.partition("#")
            goal = Path(os.path.normpath(path.parent / unquote(file.partition("?")[0]))) if file else path
            if not goal.is_file():
                lines.append(f"{name}: {target} is not there")
            elif place and goal in pages and unquote(place) not in pages[goal].places:
                lines.append(f"{name}: {target}: the page has no such place")
    return lines


if __name__ == "__main__":
    site = Path(sys.argv[1])
    if not (site / "index.html").is_file():
        sys.exit(f"{site}: expected the folder of the built site, with index.html")
    lines = problems(site)
    print("\n".join(lines) or "every link of the site leads somewhere; nothing is loaded from a network")
    sys.exit(bool(lines))
