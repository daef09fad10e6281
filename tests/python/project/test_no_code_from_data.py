"""The package turns no text into code, and reads no format that can hold code. Ruff's rules S look at the same."""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3] / "python" / "ninedof"
FILES = sorted(ROOT.rglob("*.py"))
CALLS = {"eval", "exec", "compile", "__import__", "execfile"}
MODULES = set(
    "pickle cPickle dill cloudpickle joblib marshal shelve code codeop runpy yaml subprocess pty telnetlib xmlrpc "
    "http.server urllib.request requests".split()
)
ATTRIBUTES = {"system", "popen", "mktemp", "spawnl", "spawnv", "request_share_url"}
LOADS = {"load", "loadtxt", "genfromtxt", "fromfile", "memmap"}  # of numpy
SCRIPTS = re.compile(r"\beval\b|new Function|innerHTML|outerHTML|insertAdjacentHTML|document\.write|https?:|import\(")


def found(text):
    """What is not allowed in a source."""
    for node in ast.walk(ast.parse(text)):
        names = []
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and not node.level:
            names = [node.module, *(f"{node.module}.{alias.name}" for alias in node.names)]
        yield from (name for name in names if name in MODULES or name.split(".")[0] in MODULES)
        if not isinstance(node, ast.Call):
            continue
        if isinstance(node.func, ast.Name) and node.func.id in CALLS:
            yield node.func.id
        if isinstance(node.func, ast.Attribute):
            name, of = node.func.attr, ast.unparse(node.func.value)
            if name in ATTRIBUTES:
                yield name
            options = {keyword.arg: ast.unparse(keyword.value) for keyword in node.keywords}
            if of == "np" and name in LOADS and options.get("allow_pickle", "False") != "False":
                yield "allow_pickle"
            if options.get("shell", "False") != "False":
                yield "shell"


def test_no_source_makes_code_of_data():
    assert len(FILES) > 200
    assert {str(file.relative_to(ROOT)): list(found(file.read_text())) for file in FILES} == {
        str(file.relative_to(ROOT)): [] for file in FILES
    }


def test_scripts_of_the_report_make_no_code_and_no_html_of_data():
    scripts = sorted((ROOT / "report").glob("*.js")) + sorted((ROOT / "report").glob("*.html"))
    assert len(scripts) >= 5
    for file in scripts:
        assert not SCRIPTS.search(file.read_text()), file.name
        if file.suffix == ".html":
            assert not re.search(r"\son\w+=|javascript:", file.read_text()), file.name


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("eval('1')", "eval"),
        ("import pickle", "pickle"),
        ("from urllib.request import urlopen", "urllib.request"),
        ("from urllib import request", "urllib.request"),
        ("np.load(x, allow_pickle=True)", "allow_pickle"),
        ("run(x, shell=True) or a.run(x, shell=y)", "shell"),
        ("os.system('x')", "system"),
        ("server.request_share_url()", "request_share_url"),
        ("import subprocess as s", "subprocess"),
    ],
)
def test_what_is_not_allowed_is_found(text, named):
    assert named in list(found(text))
