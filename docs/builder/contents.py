"""The tree of pages. The pages themselves stay plain Markdown: Sphinx gets its lists of pages from here."""

from __future__ import annotations

from pathlib import Path


def _listed(names: str, folder: str = "") -> list[str]:
    return [folder + name for name in names.split()]


CORE = "velocity conditioning closed-form position singularity statics dynamics redundancy"
THEORY = f"{CORE} kernels design minimax limits proof"
# Page: groups of (heading, pages). A pattern stands for all pages it matches, in the order of their names.
TREE = {
    "index": [
        ("Start", _listed("questions first-design requirement tour gallery/index")),
        ("Guides", _listed("characteristic-length regions reading-a-map assembly-modes confidence", "guides/")),
        (
            "Subjects",
            _listed("conventions kinematics workspace failure optimization certificate certify admissible actuators")
            + _listed("sweeps study-file figures viewer report exports"),
        ),
        ("The paper", _listed("paper values equations")),
        ("Theory and code", _listed("theory/index reference/index architecture extend testing wheels comparison")),
        ("Project", ["project/*"]),
    ],
    "theory/index": [("", _listed(f"{THEORY} proof-machine elementary admissible workspace", "theory/"))],
    "gallery/index": [("", ["gallery/examples/*"])],
    "reference/index": [
        ("Python", ["reference/python/*"]),
        ("Command line", ["reference/commands/*"]),
        ("C++", ["reference/cpp/*"]),
    ],
}


def below(docs: Path, page: str) -> str:
    """Return the lists of the pages below `page`, as Sphinx reads them; pages that do not exist are left out."""
    lists = []
    for heading, patterns in TREE.get(page, []):
        names = [
            str(path.relative_to(docs).with_suffix(""))
            for pattern in patterns
            for path in sorted(docs.glob(f"{pattern}.md"))
        ]
        shown = "hidden" if page in ("index", "gallery/index", "theory/index") else "titlesonly"
        lists.append(
            "\n".join(["\n\n```{toctree}", f":caption: {heading}", f":{shown}:", "", *(f"/{n}" for n in names), "```"])
        )
    return "".join(lists).replace(":caption: \n", "") + "\n"
