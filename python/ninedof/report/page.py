"""The page itself: the skeleton with style, scripts and contents put in."""

from __future__ import annotations

import json
from base64 import b64encode
from collections.abc import Sequence
from hashlib import sha256
from importlib.resources import files
from pathlib import Path
from string import Template

from ninedof.report.figures import figures, image
from ninedof.report.markup import Html, Section, facts, joined, safe, tag
from ninedof.report.pages import Page

SCRIPTS = ("camera.js", "paint.js", "scene.js")
# Nothing is loaded; style and script are the ones written here, known by their hashes, and no text becomes code.
POLICY = (
    "default-src 'none'; img-src data:; style-src {style}; script-src {script}; base-uri 'none'; form-action 'none'"
)


def page(
    contents: Page, name: str, created: str, folder: Path, stems: Sequence[str], still: tuple[Path, str] | None
) -> str:
    """Return the HTML of a page.

    Parameters
    ----------
    contents : Page
    name : str
        Of the run.
    created : str
        When the run was written.
    folder, stems
        Where the figures are, and their names.
    still : (Path, str), optional
        Folder and name of the figure that stands for the view where scripts are off.

    """
    sections = list(contents.sections)
    if stems:
        sections.insert(_place_of_figures(sections), Section("figures", "Figures", figures(folder, stems)))
    parts = [_section(s, _view(still) if s.id == "machine" and contents.shown else Html()) for s in sections]
    style = f"\n{_file('style.css')}\n"
    script = f"\n{''.join(_file(name) for name in SCRIPTS)}\n" if contents.shown else ""
    return Template(_file("page.html")).substitute(
        policy=POLICY.format(style=_hash(style), script=_hash(script) if script else "'none'"),
        title=safe(f"{name}: {contents.headline}"),
        style=f"<style>{style}</style>",
        kind=safe(contents.kind),
        name=safe(name),
        created=safe(created.replace("T", " ").replace("+00:00", " UTC")),
        headline=safe(contents.headline),
        state="good" if contents.good else "poor",
        key_figures=facts(contents.figures),
        links=joined(*(tag("a", s.title, href=f"#{s.id}") for s in sections)),
        sections=joined(*parts),
        scene=_script_data(contents.shown),
        script=f"<script>{script}</script>" if script else "",
    )


def _place_of_figures(sections: Sequence[Section]) -> int:
    ids = [s.id for s in sections]
    return ids.index("proof") if "proof" in ids else len(ids) - 1


def _section(section: Section, before: Html) -> Html:
    return tag("section", tag("h2", section.title), before, section.body, id=section.id)


def _view(still: tuple[Path, str] | None) -> Html:
    picture = Html() if still is None else tag("noscript", tag("figure", image(*still)))
    return joined(Html(_file("view.html")), picture)


def _hash(text: str) -> str:
    """Return the name by which a policy knows a style or a script."""
    return f"'sha256-{b64encode(sha256(text.encode()).digest()).decode()}'"


def _script_data(shown: object) -> str:
    """Return JSON that cannot end its script element."""
    return json.dumps(shown, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c").replace("&", "\\u0026")


def _file(name: str) -> str:
    return (files("ninedof.report") / name).read_text(encoding="utf-8")
