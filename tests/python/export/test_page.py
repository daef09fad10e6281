"""The page of exports: its Python runs as written, and no format of simulators is left out."""

import re
from pathlib import Path

import pytest

PAGE = Path(__file__).resolve().parents[3] / "docs" / "exports.md"


def section(name):
    return re.split(r"^## ", PAGE.read_text(encoding="utf-8").split(f"\n## {name}\n")[1], flags=re.MULTILINE)[0]


def test_the_python_of_mjcf_runs_as_written(tmp_path, monkeypatch):
    pytest.importorskip("mujoco")
    monkeypatch.chdir(tmp_path)
    (code,) = re.findall(r"```python\n(.*?)```", section("mjcf"), flags=re.DOTALL)
    known: dict[str, object] = {}
    exec(compile(code, "exports.md", "exec"), known)
    assert known["error"] < 1e-9


@pytest.mark.parametrize("name", ["mjcf", "urdf", "sdf"])
def test_formats_have_a_row_and_a_section(name):
    assert f"| [`{name}`](#{name}) |" in PAGE.read_text(encoding="utf-8")
    assert len(section(name)) > 500
