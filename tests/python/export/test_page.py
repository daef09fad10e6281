"""The page of exports: its Python runs as written, and no format is left out."""

import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from written_designs import HEXAGON

import ninedof as nd
from ninedof.export.export import formats

PAGE = Path(__file__).resolve().parents[3] / "docs" / "exports.md"


def section(name):
    return re.split(r"^## ", PAGE.read_text(encoding="utf-8").split(f"\n## {name}\n")[1], flags=re.MULTILINE)[0]


def test_the_python_of_mjcf_runs_as_written(tmp_path, monkeypatch):
    pytest.importorskip("mujoco")
    monkeypatch.chdir(tmp_path)
    settled, path = re.findall(r"```python\n(.*?)```", section("mjcf"), flags=re.DOTALL)
    namespace: dict[str, Any] = {}
    exec(compile(settled, "exports.md", "exec"), namespace)
    assert namespace["error"] < 1e-9
    exec(compile(path, "exports.md", "exec"), namespace)
    assert max(namespace["errors"]) == pytest.approx(0.07, abs=0.005)
    exec(compile(path.replace(" + 0.015 * rates", ""), "exports.md", "exec"), namespace)
    assert max(namespace["errors"]) == pytest.approx(2.3, abs=0.05)
    fastest = np.linalg.norm(namespace["motion"].velocity[:, 3:6], axis=1).max()
    assert fastest == pytest.approx(155, abs=1)


@pytest.mark.parametrize("name", formats())
def test_formats_have_a_row_and_a_section(name):
    assert f"| [`{name}`](#{name}) |" in PAGE.read_text(encoding="utf-8")
    assert len(section(name)) > 400


def test_the_csv_file_by_hand_is_read(tmp_path):
    (text,) = re.findall(r"```text\n(.*?)```", section("csv"), flags=re.DOTALL)
    (tmp_path / "machine.csv").write_text(text)
    assert nd.load(tmp_path / "machine.csv").configuration == nd.Configuration.neutral(400.0, 250.0)


@pytest.mark.skipif(shutil.which("cc") is None, reason="no C compiler (cc)")
def test_the_program_in_c_runs_as_written(tmp_path):
    (code,) = re.findall(r"```c\n(.*?)```", section("c"), flags=re.DOTALL)
    (tmp_path / "main.c").write_text(code)
    nd.export(HEXAGON, "c", tmp_path / "machine.h")
    subprocess.run(["cc", "-std=c99", "-Wall", "main.c", "-o", "main", "-lm"], cwd=tmp_path, check=True)
    shown = subprocess.run([tmp_path / "main"], capture_output=True, text=True, check=True).stdout
    raised = HEXAGON.configuration.moved([0, 0, 0, 0, 0, 10.0, 0, 0, 0])
    assert shown == f"l1 = {nd.leg_lengths(HEXAGON.geometry, raised)[0]:.6f} mm\n"
