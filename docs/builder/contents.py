"""The tree of pages. The pages themselves stay plain Markdown: Sphinx gets its lists of pages from here."""

from __future__ import annotations

# Page: heading and pages, as names or patterns that stand for all pages they match, in the order of their names.
TREE = {
    "index": {
        "Start": "questions first-design requirement tour gallery/index",
        "Guides": "guides/characteristic-length guides/regions guides/reading-a-map guides/assembly-modes "
        "guides/confidence",
        "Subjects": "conventions kinematics workspace failure optimization certificate certify admissible actuators "
        "sweeps study-file figures viewer report exports",
        "The paper": "paper values equations",
        "Theory and code": "theory/index reference/index architecture extend testing wheels comparison",
        "Project": "project/*",
    },
    "theory/index": {
        "": "velocity conditioning closed-form position singularity statics dynamics redundancy kernels design minimax "
        "limits proof proof-machine elementary admissible workspace"
    },
    "gallery/index": {"": "examples/*"},
    "reference/index": {"Python": "python/*", "Command line": "commands/*", "C++": "cpp/*"},
}


def below(page: str) -> str:
    """Return the lists of the pages below `page`, as Sphinx reads them."""
    shown = "titlesonly" if page == "reference/index" else "hidden"
    lists = []
    for heading, pages in TREE.get(page, {}).items():
        caption = [f":caption: {heading}"] if heading else []
        lists.append("\n".join(["\n\n```{toctree}", *caption, f":{shown}:", ":glob:", "", *pages.split(), "```\n"]))
    return "".join(lists)
