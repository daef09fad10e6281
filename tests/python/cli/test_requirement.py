"""From a requirement to a machine in five commands, as docs/requirement.md has them, for a smaller machine."""

import json

import pytest

MACHINE = """
[design]
family = "hexagonal"
characteristic_length = 150.0
[variables]
a1 = 0.0
a2 = 850.0
b1 = [200.0, 350.0]
b2 = 0.0
zp = [400.0, 560.0]
zs = 320.0
theta_z = 0.0
[constraints]
stroke_ratio = { max = 1.217 }
base_cone = { max_deg = 45.0 }
leg_clearance = { min = 20.0 }
[objective.region]
box = [40.0, 40.0, 20.0]
tilt_deg = 5.0
[solver]
starts = 1
"""
COMMANDS = (
    "optimize machine.toml --out machine",
    "sheet machine --mass 5",
    "path machine --circle 40",
    "workspace machine --tolerance 0.02 --resolution 8",
    "pareto machine --value 1.22",
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("fresh")


@pytest.mark.slow
def test_five_commands(run, folder, monkeypatch):
    monkeypatch.chdir(folder)
    monkeypatch.setenv("COLUMNS", "120")
    (folder / "machine.toml").write_text(MACHINE)
    printed, data = [], []
    for line in COMMANDS:
        figures = "" if line.startswith(("sheet", "optimize")) else f"--out {line.split()[0]}"
        quick = "--no-figures" if line.startswith(("optimize", "pareto")) else ""
        status, out, err = run(f"{line} {figures} {quick} --json")
        assert status == 0, (line, err)
        printed.append(" ".join(err.split()))
        data.append(json.loads(out))
    optimum, sheet, path, reach, front = data
    best = optimum["optimization"]["candidates"][0]
    # the sheet agrees with the run
    assert sheet["condition_number"]["value"] == pytest.approx(best["objective"], rel=1e-8)
    assert sheet["region"]["looked_at"] > 20_000
    assert min(row["margin"] for row in sheet["limits"]) > -1e-6
    assert "Poses looked at:" in printed[1]
    # a path in the region breaks nothing, and its lengths are within those of the sheet
    assert path["motion"]["breaks"] == []
    for leg in sheet["legs"]:
        along = path["motion"]["legs"][leg["leg"]]
        assert leg["shortest"] * (1.0 - 1e-9) <= along["shortest"]
        assert along["longest"] <= leg["longest"] * (1.0 + 1e-9)
    # the workspace holds the region
    assert reach["region"]["share"] == 1.0
    assert reach["region"]["passed"] == []
    assert "100 % of it within these limits" in printed[3]
    assert "legs as the study has them: l1 " in printed[3]
    assert reach["workspace"]["volume"] > 80.0 * 80.0 * 40.0
    # the front is against the limit that is reached, and a looser limit is better
    assert front["front"]["against"] == "stroke_ratio"
    assert front["front"]["rows"][0]["objective"] < best["objective"]
    assert (folder / "path" / "motion.png").exists()
    assert (folder / "workspace" / "workspace.png").exists()


def test_a_run_without_a_limit_of_price_needs_against(run, folder, monkeypatch):
    monkeypatch.chdir(folder)
    loose = MACHINE.replace("max = 1.217", "max = 2.0")
    (folder / "loose.toml").write_text(loose)
    assert run("optimize loose.toml --no-figures --out loose")[0] == 0
    status, _, err = run("pareto loose --out front")
    assert status == 2
    assert "--against: got none" in err


def test_o_in_the_workspace_of_a_region(run, folder, monkeypatch):
    monkeypatch.chdir(folder)
    if not (folder / "machine").exists():
        (folder / "machine.toml").write_text(MACHINE)
        run("optimize machine.toml --no-figures --out machine")
    quick = "--no-figures --resolution 4 --tolerance 0.2"
    for line, words in (
        (f"workspace machine {quick}", "of its frame; without turns as shifted"),
        (f"workspace machine --archetype orientation --angle-deg 20 {quick}", "O: held in the base, at (0, 0, "),
        (f"workspace machine --internal-point held {quick}", "O: held in the base, at (0, 0, "),
        (f"workspace machine --legs 100 900 {quick}", "limit: all legs 100 to 900"),
    ):
        assert words in " ".join(run(line)[1].split())
