"""LaTeX: tables of equal rows that a LaTeX program sets, where there is one."""

import re
import shutil
import subprocess

import numpy as np
import pytest
from written_designs import HEXAGON, PAPER, general, limited, text_of

import ninedof as nd
from ninedof.export import latex

PROGRAM = next(filter(None, map(shutil.which, ("pdflatex", "tectonic"))), None)
CASES = {"paper": PAPER, "hexagon": HEXAGON, "general": general()}
JOINTS, POSE = "Joints in the frame of their plate", "Neutral pose in the base frame"
DOCUMENT = r"""\documentclass{article}
\usepackage{booktabs}
\begin{document}\small
\input{robot.tex}
\end{document}
"""


def tables(text):
    """The rows of each table by its title, without rules."""
    result = {}
    for title, columns, body in re.findall(
        r"% ([^\n]*)\n\\begin\{tabular\}\{(\w+)\}\n(.*?)\\end\{tabular\}", text, re.DOTALL
    ):
        rows = [line.removesuffix(r" \\").split(" & ") for line in body.splitlines() if line.endswith(r" \\")]
        assert all(len(row) == len(columns) for row in rows)
        result[title] = rows
    return result


@pytest.mark.parametrize("name", CASES)
def test_the_tables_hold_the_design(name):
    design = CASES[name]
    result = tables(text_of(latex, design))
    assert list(result) == [JOINTS, POSE, "Legs: lengths"]
    joints, upper = result[JOINTS][1:], result[POSE][1:]
    assert len(joints) == 12
    rows = [[float(x.strip("$")) for x in row[1:4]] for row in joints]
    size = max(abs(x) for row in rows for x in row)
    assert rows[9] == pytest.approx(design.geometry.platform_internal[0].tolist(), abs=1e-5 * size)
    p, q = design.configuration.position, design.configuration.rotation
    at = np.array([[float(x.strip("$")) for x in row[1:]] for row in upper])
    expected = [p, design.configuration.internal_point, *(p + design.geometry.platform_external @ q.T)]
    np.testing.assert_allclose(at[:5], expected, atol=1e-5 * np.abs(expected).max())
    np.testing.assert_allclose(at[8:], q, atol=1e-5)
    legs = [float(row[3].strip("$")) for row in result["Legs: lengths"][1:]]
    assert legs == pytest.approx(nd.leg_lengths(design.geometry, design.configuration).tolist(), rel=1e-4)
    assert not re.search(r"\$-0\.0*\$", text_of(latex, design))


def test_limits_and_ranges_of_a_result():
    result = tables(text_of(latex, limited()))
    assert result[JOINTS][0][0] == "joint (mm)"
    assert result["Legs: lengths"][1][4:] == ["$1.00000$", "$9.00000$", "$8.00000$"]
    limits = {(row[0], row[1]): row[2:] for row in result["Limits of the study"][1:]}
    assert limits[r"leg\_length", r"$\leq$"][0] == "$9$ mm"
    assert limits[r"radius\_ratio", r"$\leq$"] == ["$2$", "$2$", r"$0.00\,\%$"]


def test_special_characters_are_escaped():
    assert latex.escape("50 % of a_1 & {b} $c^2$ ~ #\\") == (
        r"50 \% of a\_1 \& \{b\} \$c\textasciicircum{}2\$ \textasciitilde{} \#\textbackslash{}"
    )


@pytest.mark.skipif(PROGRAM is None, reason="no LaTeX program (pdflatex or tectonic)")
def test_a_latex_program_sets_the_tables(tmp_path):
    (tmp_path / "robot.tex").write_text(text_of(latex, limited()))
    (tmp_path / "main.tex").write_text(DOCUMENT)
    options = ["-interaction=nonstopmode", "-halt-on-error"] if PROGRAM.endswith("pdflatex") else []
    done = subprocess.run([PROGRAM, *options, "main.tex"], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[-2000:]
    assert (tmp_path / "main.pdf").stat().st_size > 5000
    assert "Overfull" not in done.stdout
