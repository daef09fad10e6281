"""The page itself: the skeleton with style, scripts, figures and contents put in."""

from __future__ import annotations

import json
from base64 import b64encode
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from hashlib import sha256
from importlib.resources import files
from pathlib import Path
from string import Template
from typing import Any

from ninedof.design.study import Study
from ninedof.paper.published import FIGURES
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.tables.html import Html, facts, joined, safe, tag

BLANK = "\N{EM DASH}"
SCRIPTS = ("camera.js", "paint.js", "scene.js")
# Nothing is loaded; style and script are the ones written here, known by their hashes, and no text becomes code.
POLICY = (
    "default-src 'none'; img-src data:; style-src {style}; script-src {script}; base-uri 'none'; form-action 'none'"
)
IN_SCRIPT = str.maketrans({"<": "\\u003c", "&": "\\u0026"})
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
        # JSON that cannot end its script element.
        scene=json.dumps(contents.shown, separators=(",", ":"), allow_nan=False).translate(IN_SCRIPT),
        script=f"<script>{script}</script>" if script else "",
    )


def _hash(text: str) -> str:
    """Return the name by which a policy knows a style or a script."""
    return f"'sha256-{b64encode(sha256(text.encode()).digest()).decode()}'"


def _file(name: str) -> str:
    return (files("ninedof.report") / name).read_text(encoding="utf-8")


CAPTIONS = {
    "drawing": "Dimensions. E1 to E3 are joints of external legs (circles), I1 to I3 of internal legs (squares); all "
    "coordinates are in the sheet.",
    "mechanism": "The mechanism at its neutral pose.",
    "condition": "Along the height of O and along the twist, other variables as in the design: what the study asks "
    "for, at its poses or those that ruled its region; grey where a limit is violated there.",
    "region": "The region of the study: the worst condition number at each place, and the least margin of the limits "
    "at a pose. Those that compare poses have no margin there; theirs over the region are below.",
    "poses": "Condition number at each pose that was imposed, numbered as in the sheet.",
    "convergence": "Convergence of single starts, with the smooth minimax form and with the plain objective.",
    "front": "The least objective for each value of the limit, and designs from above.",
    "workspace": "Sections of the workspace, what ends it, and the spread of the condition number.",
    "certified_workspace": "What is proved of the workspace, each pixel at its middle, and the estimate on top.",
    "motion": "Leg lengths, condition number and margins along the path.",
    **{stem: f"{name}." for stem, name in FIGURES.items()},
}
ADMISSIBLE = (
    "proved to keep every limit at every pose; proved not to, in the colour of the limit that excludes them; and "
    "undecided, grey. Lines of the worst condition number are sampled, not proved."
)
OWN = ("drawing", "region")  # figures that are sections of the page
LARGEST = 20_000_000  # bytes of a figure
KINDS = {".svg": "image/svg+xml", ".png": "image/png"}


def stems(folder: Path) -> list[str]:
    """Return the names of the figures of a folder, known ones first."""
    names = {file.stem for kind in KINDS for file in folder.glob(f"*{kind}") if _own(file)}
    return sorted(names, key=lambda stem: ([*CAPTIONS, stem].index(stem), stem))


def figures(folder: Path) -> Html:
    """Return the figures of a folder with their captions."""
    return joined(*(figure(folder, stem) for stem in stems(folder) if stem not in OWN))


def figure(folder: Path, stem: str) -> Html:
    """Return a figure with its caption; its class is its name, as print leaves one out."""
    return tag("figure", image(folder, stem), tag("figcaption", _caption(stem)), class_=f"of-{safe(stem)}")


def image(folder: Path, stem: str) -> Html:
    """Return a figure as an element that holds its file: SVG or PNG, whichever is smaller."""
    smallest = min((p for kind in KINDS if _own(p := folder / f"{stem}{kind}")), key=lambda path: path.stat().st_size)
    data = b64encode(smallest.read_bytes()).decode()
    return Html(f'<img alt="{safe(_caption(stem))}" src="data:{KINDS[smallest.suffix]};base64,{data}">')


def _own(file: Path) -> bool:
    """Return whether a figure is a file of this folder: a page is sent by mail, so a link to elsewhere stays out."""
    return file.is_file() and file.resolve().parent == file.parent.resolve() and file.stat().st_size <= LARGEST


def _caption(stem: str) -> str:
    if stem.startswith("admissible-"):
        names = stem.split("-")[1:]
        return f"Designs in {', '.join(names)}: {ADMISSIBLE}"
    return CAPTIONS.get(stem, stem.replace("_", " ").replace("-", " ").capitalize() + ".")
