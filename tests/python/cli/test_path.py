"""`ninedof path`: table, files, limits of a run, bad input."""

import csv
import json

import numpy as np
import pytest

import ninedof as nd


@pytest.fixture(autouse=True)
def _in_a_folder_of_its_own(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "200")


def test_a_circle_of_the_published_design(run, tmp_path):
    status, out, _ = run("path --circle 0.5 --points 101 --duration 2 --legs 2 5.2 --force 0 0 -9 --out run")
    assert status == 3
    assert "limit breaks: l1 high, from t = 0.159" in out
    assert "never move: q1, q2, q3" in out
    assert "tracked back from the leg lengths, every step proved" in out
    files = {"record.json", "legs.csv", "poses.csv", "motion.npz", "motion.png", "motion.svg", "motion.pdf"}
    files.add("report.html")
    assert {file.name for file in (tmp_path / "run").iterdir()} == files | {"question.json", "pieces"}
    record = json.loads((tmp_path / "run" / "record.json").read_text())
    assert record["kind"] == "motion"
    assert {*record["files"], "record.json"} == files
    assert record["question"]["circle"] == 0.5
    with (tmp_path / "run" / "legs.csv").open(newline="") as file:
        header, *rows = csv.reader(file)
    legs = "l1 l2 l3 q1 q2 q3 r1 r2 r3".split()
    expected = ["t", *legs, *(f"{leg}_rate" for leg in legs), *(f"{leg}_acceleration" for leg in legs)]
    assert header == [*expected, *(f"{leg}_force" for leg in legs), *(f"{leg}_power" for leg in legs)]
    home = nd.Configuration(**{name: np.array(values) for name, values in record["question"]["home"].items()})
    geometry = nd.Geometry(**record["question"]["geometry"])
    found = nd.follow(geometry, nd.Trajectory.circle(home, 0.5, 2.0, 101), home, load=([0.0, 0.0, -9.0], None))
    table = np.array(rows, dtype=float)
    columns = [found.time[:, None], found.leg_lengths, found.leg_rates, found.leg_accelerations, found.leg_forces]
    columns.append(found.leg_powers)
    assert (table == np.concatenate(columns, axis=1)).all()


REGION = """
[design]
family = "symmetric"
characteristic_length = 1.5
[variables]
base_external_radius = 5.0
base_internal_radius = 3.0
base_internal_angle = 0.5
platform_external_radius = 2.0
platform_external_angle = 1.0
platform_internal_radius = 1.2
platform_internal_angle = 0.7
zp = 4.0
zs = [2.2, 2.4]
[constraints]
base_cone = { max_deg = 9.0 }
leg_clearance = { radius = 0.05 }
[objective]
condition_limit = 30.0
[objective.region]
box = [0.3, 0.3, 0.3]
tilt_deg = 5.0
[solver]
starts = 2
"""


def test_a_path_of_few_poses_says_that_nothing_is_looked_at_between_them(run):
    words = "at {} poses only: between them nothing is looked at"
    for count in (4, 49, 50):
        _, out, _ = run(f"path --line 0.1 0 0.1 --points {count} --no-figures --out {count}")
        assert (words.format(count) in " ".join(out.split())) is (count < 50)


@pytest.mark.slow(sanitized=True)
def test_every_limit_of_a_run(run, tmp_path):
    with open("machine.toml", "w") as file:
        file.write(REGION)
    assert run("optimize machine.toml --no-figures --out machine")[0] == 0
    line = "path machine --points 201 --mass 2 --centre 0.1 0 0 --out along"
    status, out, _ = run(f"{line} --line 0.3 0.3 -0.3 --json")
    motion = json.loads(out)["motion"]
    assert (status, motion["breaks"], motion["internal_point"]) == (0, [], "shifted")
    rows = {row["name"]: row for row in motion["limits"]}
    assert set(rows) == {"base_cone", "leg_clearance", "condition_limit"}
    assert rows["base_cone"]["limit_deg"] == pytest.approx(9.0)
    assert rows["base_cone"]["value_deg"] <= 9.0
    assert motion["legs"]["r1"]["push"] > 0.0
    with (tmp_path / "along" / "poses.csv").open(newline="") as file:
        table = list(csv.DictReader(file))
    assert min(float(row["margin_base_cone"]) for row in table) == pytest.approx(rows["base_cone"]["margin"])
    status, out, _ = run(f"{line}2 --line 1 0 0 --no-figures")
    assert status == 3
    assert "limit breaks: base_cone l" in out
    assert "°" in out


def test_the_weight_of_a_slow_path_is_that_of_a_force(run):
    line = "path --circle 0.3 --points 21 --duration 1e8 --no-figures --json"
    heavy = json.loads(run(f"{line} --mass 2 --gravity 0 0 -10 --moment 0 1 0")[1])["motion"]["legs"]
    forced = json.loads(run(f"{line} --force 0 0 -20 --moment 0 1 0")[1])["motion"]["legs"]
    assert all(heavy[leg]["push"] == pytest.approx(forced[leg]["push"], abs=1e-12) for leg in forced)
