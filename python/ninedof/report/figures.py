"""The figures of a run folder, inside the page."""

from __future__ import annotations

from base64 import b64encode
from pathlib import Path

from ninedof.paper.published import FIGURES
from ninedof.tables.html import Html, joined, safe, tag

CAPTIONS = {
    "drawing": "Dimensions. E1 to E3 are joints of external legs (circles), I1 to I3 of internal legs (squares); all "
    "coordinates are in the sheet. Each view has its own scale.",
    "mechanism": "The mechanism at its neutral pose.",
    "condition": "Along the height of O and along the twist, other variables as in the design: what the study asks "
    "for, at its poses or those that ruled its region; grey where a limit is passed there.",
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
