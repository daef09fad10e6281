"""The errands of docs/extend.md name files that exist, and need no more of them than was promised."""

import re
from pathlib import Path

import pytest

from ninedof.design.limits import ROWS

ROOT = Path(__file__).resolve().parents[3]
SECTIONS = dict(
    re.findall(r"^## Add an? (.*)\n\n((?:(?!^## ).*\n)+)", (ROOT / "docs/extend.md").read_text("utf-8"), re.MULTILINE)
)
CONSTRAINT = 5
MOST = {
    "index": 3,
    "constraint": CONSTRAINT,
    "design family": 5,
    "command": 3,
    "figure": 3,
    "file format": 3,
}
PATTERNS = {  # of files that are new, one that exists
    "cpp/src/limits/<name>.cpp": "joint_cone",
    "cpp/include/ninedof/families/<name>_family.hpp": "symmetric",
    "python/ninedof/cli/commands/poses/<name>.py": "modes",
    "python/ninedof/plot/<name>.py": "front",
    "python/ninedof/export/<name>.py": "mjcf",
    "tests/python/export/test_<name>.py": "mjcf",
}
WORDS = {"Three": 3, "Five": 5}
OTHER_THINGS = {"stroke", "height", "force", "rate", "power"}  # limits whose names are those of quantities too


def steps(section):
    """The part that lists files: from "Three files" to the end of the list, or of the sentence."""
    (count, rest) = re.search(r"\b(Three|Five) files(.*)", section, re.DOTALL).groups()
    rest = rest.replace("and its line in `CHANGELOG.md`", "")  # as every change has
    numbered = re.findall(r"^\d\. .*\n(?:   .*\n)*", rest, re.MULTILINE)
    return WORDS[count], "".join(numbered) or rest.partition("\n\n")[0]


@pytest.mark.parametrize("errand", MOST)
def test_an_errand_names_its_files_and_needs_no_more(errand):
    count, text = steps(SECTIONS[errand])
    paths = set(re.findall(r"`((?:cpp|python|tests|docs)/[\w/<>.-]+\.\w+)`", text))
    paths -= {"tests/cpp/limits/law.cpp"}  # named for what it needs not
    missing = [path for path in paths if not (ROOT / path.replace("<name>", PATTERNS.get(path, ""))).is_file()]
    assert missing == []
    assert len(paths) == count <= MOST[errand], paths


def test_a_criterion_of_workspaces_is_at_most_one_file_more_than_a_constraint():
    named = re.findall(r"`\w+/[\w/.]+`", SECTIONS["criterion of workspaces"])
    assert "the files of a constraint" in SECTIONS["criterion of workspaces"]
    assert len(named) <= 1


def test_few_files_name_a_limit():
    """The table, the checker, which shares nothing with it, and what explains limits to people."""
    texts = [path.read_text("utf-8") for path in (*(ROOT / "cpp").rglob("*.?pp"), *(ROOT / "python").rglob("*.py"))]
    for name in ROWS.keys() - OTHER_THINGS:
        most = 8 if name == "radius_ratio" else 5  # the paper's limit is that of examples, and of every class
        assert sum(f'"{name}"' in text for text in texts) <= most, name


def test_families_are_listed_by_the_core_alone():
    """A new family needs no list of names in Python."""
    texts = {path: path.read_text("utf-8") for path in (ROOT / "python").rglob("*.py")}
    assert [
        str(path) for path, text in texts.items() if re.search(r'"symmetric_nonplanar", "general"[)\]}]', text)
    ] == []
