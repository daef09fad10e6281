"""Every file in examples/ runs and ends as its first lines say."""

import json
import math
from pathlib import Path

import pytest
from sizes import size

EXAMPLES = Path(__file__).parents[3] / "examples"
STATUS = {
    "01_paper.toml": 0,
    "02_twist_and_legs.toml": 0,
    "03_eqs_8_9_alone.toml": 3,
    "06_twist.toml": 0,
    "08_machine.toml": 0,
    "09_near_isotropic.toml": 0,
    "10_robust.toml": 0,
    "18_requirement.toml": 0,
    "20_tool.toml": 0,
    "22_actuators.toml": 0,
}
SCRIPTS = {  # what each must print
    "05_indices.py": ["4851 poses"],
    "07_families.py": ["triangles 3.749827", "hexagons 3.749827", "free triples 2.343092"],
    "11_front.py": ["base radius", "3.762659"],
    "12_six_legs.py": ["nine legs 3.762659", "1.414214"],
    "13_internal_point.py": ["does not notice: 3", "best, smooth"],
    "16_atlas.py": ["1,000,000 designs", "optimizer, at 2: 3.762659"],
    "14_assembly_modes.py": ["32 configurations", "6 3.1532 117.5", "tracked 200 of 200"],
    "17_best_map.py": ["14641 poses", "best 4.0790"],
    "19_moving_picture.py": ["O at its best: condition number 4.111 to 4.778"],
    "21_admissible.py": ["of the designs keep every limit", "excluded by stroke_ratio", "all at once"],
    "15_workspace.py": ["converged: volume 7.80", "ball of radius 0.87", "leg_limits 84", "of SO(3)"],
}
SMALLER = {  # for a quick run: what is put in the place of what, in the script and in what it prints
    "17_best_map.py": {"121)": "61)", "14641 poses": "3721 poses", "best 4.0790": "best 4.0827"},
}
FEW_STARTS = {  # find the same optimum
    "08_machine.toml": ["--starts", "3"],
    "09_near_isotropic.toml": ["--starts", "4"],
    "10_robust.toml": ["--starts", "2"],
    "18_requirement.toml": ["--starts", "1"],
    "20_tool.toml": ["--starts", "1"],
    "22_actuators.toml": ["--starts", "2"],
}
AT_MOST = {  # of the objective: of searches that share nothing with ours, of the theory notes, of 64 starts (08)
    "01_paper.toml": 3.762660,
    "06_twist.toml": 3.749828,
    "08_machine.toml": 3.404722,
    "09_near_isotropic.toml": 1.402043,
    "10_robust.toml": 1.5819,
    "18_requirement.toml": 4.02343,
    "20_tool.toml": 4.06111,
    "22_actuators.toml": 3.98357,
}


def test_no_example_is_left_out():
    assert {p.name for p in EXAMPLES.iterdir() if p.is_file()} == {*STATUS, *SCRIPTS, "04_design.toml"}


@pytest.mark.slow
@pytest.mark.parametrize("name", STATUS)
def test_study(name, run, tmp_path):
    starts = " ".join(size(FEW_STARTS.get(name, []), []))
    status, out, _ = run(f"optimize {EXAMPLES / name} --no-figures --json --out {tmp_path / 'run'} {starts}")
    assert status == STATUS[name]
    best = json.loads(out)["optimization"]["candidates"][0]
    assert best["objective"] <= AT_MOST.get(name, math.inf)


def test_design(run):
    status, out, _ = run(f"evaluate {EXAMPLES / '04_design.toml'} --json")
    assert status == 0
    assert json.loads(out)["condition_number"] == pytest.approx(3.9070663, abs=5e-7)


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("name", SCRIPTS)
def test_script(name, capsys, tmp_path, monkeypatch):
    figure = tmp_path / "figure.png"
    monkeypatch.setattr("sys.argv", [name, "--figure", str(figure)])
    text, expected = (EXAMPLES / name).read_text(), "\n".join(SCRIPTS[name])
    for large, small in size(SMALLER, {}).get(name, {}).items():
        assert large in text + expected
        text, expected = text.replace(large, small), expected.replace(large, small)
    exec(compile(text, name, "exec"), {"__name__": "__main__", "__file__": str(EXAMPLES / name)})
    printed = " ".join(capsys.readouterr().out.split())
    assert [words for words in expected.splitlines() if words not in printed] == []
    assert figure.exists() == ("--figure" in text)
