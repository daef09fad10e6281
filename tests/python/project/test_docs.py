"""Links of the documents lead somewhere; the tour runs as written. test_equations.py checks the tables."""

import ast
import importlib.util
import re
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
PAGES = [*sorted((ROOT / "docs").rglob("*.md")), *sorted(ROOT.glob("*.md"))]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page):
    for target in re.findall(r"\]\(([^)#\s]+)[^)]*\)", page.read_text(encoding="utf-8")):
        if "://" not in target:
            assert (page.parent / target).exists(), f"{page.name} links to {target}"


def test_the_tables_of_study_files_are_those_of_the_schema():
    spec = importlib.util.spec_from_file_location("study_tables", ROOT / "docs/builder/study_tables.py")
    study_tables = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(study_tables)
    assert study_tables.page() == study_tables.PAGE.read_text(encoding="utf-8"), "run docs/builder/study_tables.py"


@pytest.mark.parametrize("name", ["setup", "test"])
def test_the_readme_has_one_line_for_each_command(name):
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    (block,) = re.findall(rf"<!-- ci:{name} -->\n```\w*\n(.*?)```", text, flags=re.DOTALL)
    assert block.count("\n") == 1


SMALLER = {
    "1_000_000": "1_000",
    "201)": "5)",
    'objective={"poses": box})': 'objective={"poses": box}, starts=4)',
    "nd.check(result)": "nd.check(result, perturbations=300)",
}


def blocks(page, language):
    text = (ROOT / page).read_text(encoding="utf-8")
    return re.findall(rf"```{language}\n(.*?)```", text, flags=re.DOTALL)


def test_the_readme_is_short_and_its_python_is_of_the_tour():
    assert (ROOT / "README.md").read_text(encoding="utf-8").count("\n") < 120
    (code,) = blocks("README.md", "python")
    of_tour = "\n".join(blocks("docs/tour.md", "python")).split("\n")
    assert [line for line in code.split("\n") if line not in of_tour and "forward_position" not in line] == []


def test_the_study_of_the_readme_is_an_example():
    (text,) = blocks("README.md", "toml")
    example = tomllib.loads((ROOT / "examples" / "18_requirement.toml").read_text(encoding="utf-8"))
    assert tomllib.loads(text) == example


def test_the_python_of_the_tour_runs_as_written(capsys):
    """Block after block, as a reader would type them; only sizes are smaller."""
    found = blocks("docs/tour.md", "python")
    assert len(found) >= 9
    code = "\n".join(found)
    for large, small in SMALLER.items():
        assert large in code
        code = code.replace(large, small)
    known: dict[str, object] = {}
    exec(compile(code, "tour.md", "exec"), known)
    shown = capsys.readouterr().out
    assert "optimal" in shown
    assert round(known["found"].volume, 1) == 7.8
    assert round(known["result"].condition_number, 6) == 3.749827


@pytest.mark.slow(sanitized=True)
def test_the_page_of_figures_runs_as_written_and_leaves_out_none(tmp_path, monkeypatch):
    """What a new figure needs besides its file and its name is its example there."""
    from words import outside, overlaps

    from ninedof import plot
    from ninedof.paper import figures

    monkeypatch.chdir(tmp_path)
    text = (ROOT / "docs" / "figures.md").read_text(encoding="utf-8")
    code = "\n".join(re.findall(r"```python\n(.*?)```", text, flags=re.DOTALL))
    drawn, known = [], {}
    for statement in ast.parse(code).body:
        exec(compile(ast.Module([statement], []), "figures.md", "exec"), known)
        if ast.unparse(statement).startswith("figure = "):
            drawn.append(known["figure"])
    assert len(drawn) == code.count("\nfigure = ")
    with plot.style.settings():
        assert [pairs for figure in drawn[1:] if (pairs := overlaps(figure) + outside(figure))] == []
    assert sorted(path.name for path in (tmp_path / "figures").iterdir()) == [
        f"mechanisms.{kind}" for kind in ("pdf", "png", "svg")
    ]
    assert [name for name in plot.__all__ if f"nd.plot.{name}(" not in code] == []
    assert [name for name in figures.__all__[1:] if f"figures.{name}(" not in code] == []


def test_the_citation_is_complete_and_of_this_version():
    """What the README, the documentation and CITATION.cff say of the paper and of this software agrees."""
    cff = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    (version,) = re.findall(
        r"project\(\s*ninedof\s+VERSION\s+([\d.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    )
    keys = "cff-version message type title version abstract license authors keywords references".split()
    assert [key for key in keys if not re.search(rf"^{key}:", cff, flags=re.MULTILINE)] == []
    assert re.search(rf"^version: {re.escape(version)}$", cff, flags=re.MULTILINE)
    (title,) = re.findall(r'title: "(The Optimum .*)"', cff)
    for page in ("README.md", "docs/index.md"):
        text = " ".join((ROOT / page).read_text(encoding="utf-8").split())
        cited = text[text.index("Please cite") :]
        assert all(words in cited for words in (title, "Galfo", "Sinatra", f"version {version}", "CITATION.cff")), page
