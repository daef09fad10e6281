"""The page itself: the skeleton with style, scripts and contents put in."""

from __future__ import annotations

import json
from base64 import b64encode
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from hashlib import sha256
from importlib.resources import files
from string import Template
from typing import Any

from ninedof.design.study import Study
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.tables.html import Html, facts, joined, safe, tag

BLANK = "\N{EM DASH}"
SCRIPTS = ("camera.js", "paint.js", "scene.js")
# Nothing is loaded; style and script are the ones written here, known by their hashes, and no text becomes code.
POLICY = (
    "default-src 'none'; img-src data:; style-src {style}; script-src {script}; base-uri 'none'; form-action 'none'"
)
TITLES = {
    "question": "Question",
    "answer": "Answer",
    "machine": "Machine",
    "drawing": "Drawing",
    "region": "Region",
    "sheet": "Engineering sheet",
    "figures": "Figures",
    "proof": "What is proved, and what is searched",
    "again": "How to reproduce it",
}


@dataclass(frozen=True)
class Page:
    """The contents of a page."""

    kind: str
    headline: str
    figures: Sequence[tuple[object, object]]
    """Names and values under the headline."""
    sections: dict[str, Html]
    """By the names in TITLES; the section "machine" has the view and a sentence below it."""
    shown: Mapping[str, Any] | None = None
    """The contents of the view; None without a machine."""
    good: bool = True
    machine: tuple[Geometry, Configuration] | None = None
    """The machine of the drawing."""


def title_block(study: Study, name: str, created: str) -> Html:
    """Return the block of a drawing: project, author and revision of a study, lines to write on where it has none."""
    about = study.about
    rows = [
        ("project", about.project or BLANK),
        ("author", about.author or BLANK),
        ("revision", about.revision or BLANK),
        ("date", created[:10]),
        ("run", name),
    ]
    return facts([*rows, *([("lengths in", study.unit)] if study.unit else [])])


def page(contents: Page, name: str, created: str, drawn: Mapping[str, Html], study: Study) -> str:
    """Return the HTML of a page of a run.

    `drawn` has the sections made of figures, and as "still" what stands for the view where scripts are off.
    """
    bodies = {**contents.sections, **drawn}
    sections = {key: bodies[key] for key in TITLES if bodies.get(key) or key in contents.sections}
    view = (
        joined(Html(_file("view.html")), tag("noscript", tag("figure", drawn["still"]))) if contents.shown else Html()
    )
    parts = [
        tag("section", tag("h2", TITLES[key]), view if key == "machine" else Html(), body, id=key)
        for key, body in sections.items()
    ]
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
        block=title_block(study, name, created),
        state="good" if contents.good else "poor",
        key_figures=facts(contents.figures),
        links=joined(*(tag("a", TITLES[key], href=f"#{key}") for key in sections)),
        sections=joined(*parts),
        scene=_script_data(contents.shown),
        script=f"<script>{script}</script>" if script else "",
    )


def _hash(text: str) -> str:
    """Return the name by which a policy knows a style or a script."""
    return f"'sha256-{b64encode(sha256(text.encode()).digest()).decode()}'"


def _script_data(view: object) -> str:
    """Return JSON that cannot end its script element."""
    return json.dumps(view, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c").replace("&", "\\u0026")


def _file(name: str) -> str:
    return (files("ninedof.report") / name).read_text(encoding="utf-8")
