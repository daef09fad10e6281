"""The documentation as a site: the reference leaves out nothing, and what the guides print is what they show.

The site itself is built by `.ci/run`, which has Sphinx; these tests need what the pages are made from alone.
"""

import json
import re
import sys
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path

import pytest

import ninedof as nd

ROOT = Path(__file__).resolve().parents[3]
DOCS = ROOT / "docs"
GUIDES = sorted((DOCS / "guides").glob("*.md"))


@pytest.fixture(scope="module")
def builder():
    """The package that makes pages from the sources."""
    sys.path.insert(0, str(DOCS))
    import builder

    yield builder
    sys.path.remove(str(DOCS))
    for name in [name for name in sys.modules if name.partition(".")[0] == "builder"]:
        del sys.modules[name]


def test_every_public_name_is_in_the_reference_once(builder):
    text = "\n".join(builder.public_names.pages().values())
    assert sorted(re.findall(r"^\.\. auto(?:function|class):: ninedof\.(\w+)$", text, flags=re.MULTILINE)) == nd.__all__
    assert ".. automodule:: ninedof.plot" in text
    assert ".. automodule:: ninedof.poses" in text


def test_every_room_of_the_reference_has_a_title(builder):
    assert list(builder.public_names.by_room()) == list(builder.public_names.ROOMS)
    assert all(builder.public_names.by_room().values())


def test_every_command_and_option_is_in_the_reference(builder):
    pages = {name.partition("-")[2]: text for name, text in builder.commands.pages().items()}
    modules = (ROOT / "python/ninedof/cli/commands").glob("*/[a-z]*.py")
    assert sorted(pages) == sorted(path.stem for path in modules)
    for name, command in builder.commands.all_commands().items():
        assert pages[name].count("\n| `") == len(command.params), name
        for word in (word for parameter in command.params for word in parameter.opts if word.startswith("-")):
            assert f"`{word} " in pages[name] or f"`{word}`" in pages[name], (name, word)
        assert f"ninedof {name}" in pages[name].partition("## Examples")[2], name


def test_every_header_is_in_the_reference(builder):
    include = ROOT / "cpp/include/ninedof"
    text = "\n".join(builder.headers.pages(include).values())
    assert {room.name for room in include.iterdir() if room.is_dir()} == set(builder.headers.TITLES)
    for header in include.rglob("*.hpp"):
        assert f"#include <ninedof/{header.relative_to(include)}>" in text
    assert "double condition_number(const Geometry& g, const Configuration& c" in text
    assert "return {a.value + b.value" not in text  # bodies are left out
    assert "base_external_" not in text  # private members too


def test_every_page_has_its_place(builder):
    listed = {"index"}
    for page, lists in builder.contents.TREE.items():
        for pattern in " ".join(lists.values()).split():
            found = {str(path.relative_to(DOCS).with_suffix("")) for path in (DOCS / page).parent.glob(f"{pattern}.md")}
            assert found or pattern.endswith("*"), pattern
            listed |= found
            assert f"\n{pattern}\n" in builder.contents.below(page)
    assert {str(path.relative_to(DOCS).with_suffix("")) for path in DOCS.rglob("*.md")} == listed


def test_links_that_leave_the_site(builder):
    def link(text):
        return builder.links.within_site(text, DOCS / "theory", DOCS / "theory", DOCS)

    assert link("[a](../../CONTRIBUTING.md#rules)") == "[a](../project/contributing.md#rules)"
    assert link("[a](../../README.md)") == "[a](../index.md)"
    assert link("[a](../../examples/11_front.py)") == "[a](../gallery/examples/11_front.md)"
    assert link("[a](../values.md)") == "[a](../values.md)"
    assert link("[a](../../tests/outside)") == "a"
    assert link("[a](https://x.org)") == "[a](https://x.org)"
    assert link("[c](../../CITATION.cff)") == "[c](../../CITATION.cff)"


@pytest.mark.parametrize("page", GUIDES, ids=lambda page: page.stem)
def test_a_guide_shows_what_its_example_prints(page):
    text = page.read_text(encoding="utf-8")
    ((code, shown),) = re.findall(r"```python\n(.*?)```\n\n```text\n(.*?)```", text, flags=re.DOTALL)
    with redirect_stdout(StringIO()) as printed:
        exec(compile(code, page.name, "exec"), {})
    assert [line.rstrip() for line in printed.getvalue().splitlines()] == shown.splitlines()


def test_the_paper_reread_has_the_rows_of_the_command(run):
    status, out, _ = run("paper --json")
    assert status == 0
    text = (DOCS / "paper.md").read_text(encoding="utf-8").replace("`", "")
    for row in json.loads(out):
        assert f"| {row['where']} | {row['printed']} | {row['ours']} | {row['verdict']} |" in text


def test_the_first_study_is_solved(run, tmp_path):
    text = (DOCS / "first-design.md").read_text(encoding="utf-8")
    (study,) = re.findall(r"```toml\n(.*?)```", text, flags=re.DOTALL)
    (tmp_path / "mine.toml").write_text(study, encoding="utf-8")
    status, out, _ = run(f"optimize {tmp_path / 'mine.toml'} --out {tmp_path / 'mine'} --no-figures")
    assert status == 0
    assert "a2 (mm)" in out


def test_the_python_of_the_first_design_runs(tmp_path, monkeypatch, capsys):
    text = (DOCS / "first-design.md").read_text(encoding="utf-8")
    (code,) = re.findall(r"```python\n(.*?)```", text, flags=re.DOTALL)
    (study,) = re.findall(r"```toml\n(.*?)```", text, flags=re.DOTALL)
    (tmp_path / "mine.toml").write_text(study, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    known = {}
    exec(compile(code, "first-design.md", "exec"), known)
    assert "optimal" in capsys.readouterr().out
    assert nd.load("mine-again").variables == known["result"].variables
