"""Lines that commands say of a machine of a study: what its loads, speeds and fixed variables mean for the answer."""

import json
import re
from dataclasses import replace

import pytest
from tooled import solved_in, tooled

import ninedof as nd

pytestmark = pytest.mark.usefixtures("few_samples")

STUDY = tooled(
    constraints={"leg_length": (1.0, 900.0), "radius_ratio": (None, 4.0)},
    loads={"wrenches": [[0.0, 0.0, 0.0, 0.0, 0.0, 90.0]]},
    speeds={"linear": 30.0, "angular_deg": 20.0},
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return solved_in(tmp_path_factory.mktemp("remarks"), STUDY)


@pytest.fixture
def words(run, folder):
    """The words that a command prints; the command has the folder in place of a dot."""

    def of(line):
        _, out, errors = run(line.replace("./", f"{folder}/"))
        return " ".join((out + errors).split())

    return of


def test_a_load_that_carries_the_payload_is_told(words, run):
    out = words("payload ./run --force 300")
    assert "without the loads" in out
    alone = float(out.partition("without the loads ")[2].split(";")[0])
    assert alone < float(out.partition("largest payload ")[2].split(",")[0])
    assert "without the loads" not in words("payload ./run --force 300 --load 0,0,0,0,0,-90")


def test_masses_of_options_and_of_the_study_are_told_apart(words, folder, run):
    """With --mass a path named [loads] alone, though the masses of the legs were still those of the study."""
    legs = {"platform": 3.0, "cylinder": 0.4}
    nd.save(nd.optimize(replace(STUDY, masses=legs)), folder / "legs")
    path = "path {} --line 5 0 0 --points 51 --no-figures --no-report --out ./of_mass_{}"
    assert "from the study: [loads], [masses] but the platform's mass" in words(path.format("./legs --mass 9", 1))
    assert "from the study: [loads], [masses] run folder" in words(path.format("./legs", 2))
    assert "from the study: [loads] run folder" in words(path.format("./run --mass 9", 3))
    plain = words(path.format("./run", 4))
    assert "poses from t = 0 to 1 s; O:" in plain
    assert "from the study: [loads] run folder" in plain
    load = "acting: load 1: moment (0, 0, 0) {0}, force (0, 0, 90){1}"
    assert load.format("force mm", " from the study") in plain
    line = words(path.format("./legs --mass 9 --centre 0 0 5", 5))
    weight = "; the weight of a mass of 9 kg, centre (0, 0, 5) in the frame of the plate, gravity (0, 0, -9.81) m/s²; "
    assert load.format("N mm", f" N{weight}the weights of the legs and of O; inertia too") in line
    out = words("forces ./run --mass 9 --centre 0 0 5")
    assert "each with the weight of a mass of 9 kg, centre (0, 0, 5) in the frame of the plate" in out
    assert "from the study: [loads] Forces (N)" in out
    assert "[masses] but the platform's mass" in words("forces ./legs --mass 9")
    nd.save(nd.optimize(replace(STUDY, masses={"platform": 9.0})), folder / "nine")
    given, stated = (
        json.loads(run(f"forces {folder}/{line} --json")[1])["forces"] for line in ("run --mass 9", "nine")
    )
    assert given == stated


def test_a_path_faster_than_the_speeds_of_the_study_is_told(words):
    slow = words("path ./run --line 5 0 0 --points 51 --duration 10 --no-figures --no-report --out ./slow")
    assert "faster than the study" not in slow
    fast = words("path ./run --line 5 0 0 --points 51 --duration 0.1 --no-figures --no-report --out ./fast")
    assert "faster than the study: linear speed 93." in fast
    assert "mm/s, [speeds] has 30 mm/s" in fast
    assert "angular speed" not in fast


def test_a_fixed_design_has_no_starts_that_agree_and_its_bounds_are_of_the_neutral_pose(words):
    out = words("optimize ./study.toml --no-figures --no-report --out ./again")
    assert "no variable is free: this is the design of the study" in out
    assert "95 %" not in out
    assert "at the neutral pose: no" in out


def test_what_is_refused_names_the_way(words):
    assert "(--force at the terminal): the study has no limit of force at its poses" in words("payload ./run")
    out = words("sweep ./run --over a2=500:600:3 --out ./swept")
    assert "which has a [tool], expected coordinates of the configuration; a changed design" in out
    assert "`ninedof evaluate RUN --set`" in out
    assert "--set: got 'zp=abc', expected NAME=VALUE with a number, or NAME=+10%" in words(
        "evaluate ./run --set zp=abc"
    )
    assert "expected NAME=VALUE without a plus" in words("evaluate ./run --set zp=+5")


def test_a_front_without_a_limit_names_those_of_the_study(words, folder):
    out = words("pareto ./run --no-figures --no-report --out ./no-price")
    assert "no limit with a max has a price in this run; with a max its study has " in out
    assert "leg_length, radius_ratio" in out
    assert "--against: got none" in out


def test_a_front_says_which_limit_it_is_against_where_it_was_not_told(words):
    out = words("pareto ./study.toml --value 3 --no-figures --no-report --out ./front")
    assert out.startswith("--against is not given: the front is against radius_ratio at 3")


QUIET = "--no-figures --no-report"
OF_WEIGHTS = {  # what the commands say of the machine with masses and limits
    "sheet ./heavy": [
        *("(W)", "200000 N mm/s", "1 W is 1000 N mm/s", "700 N", "load 1: moment (0, 0, 0) N mm, force (0, 0, 90) N"),
    ],
    "sheet ./heavy --leg-stiffness 1e4 --mass 5 --centre 0 0 20": [
        "a mass of 5 kg, centre (0, 0, 20) in the frame of the plate",
        "stiffness: of each leg 10000 N/mm, as given",
    ],
    "forces ./heavy": ["N mm", "a mass of 3 kg", "Forces (N), + pushes"],
    f"path ./heavy --line 1 0 0 --points 51 {QUIET} --out ./heavier": [
        *("200000 N mm/s", "700 N", "reaches its force of 700 N at t = "),
    ],
    "export ./heavy --to latex --out ./t.tex": ["t.tex"],
    "payload ./heavy": [
        *(" kg: ", "gravity (0, 0, -9.81) m/s²; beside it", "reaches its limit of 700 N ("),
        *("Leg forces (N) there, with the payload", "from the study: force at most 700 N"),
    ],
    "stiffness ./heavy --leg-stiffness 1e4": [
        *("moment (N mm) and force (N) for a turn", "leg stiffness 10000 N/mm, each leg"),
    ],
    "failure ./heavy --no-pairs": ["(N)", "force (0, 0, 90) N"],
    "certify ./heavy --time 0.1": ["force (N)", "power (N mm/s)"],
    f"workspace ./heavy --tolerance 0.5 --resolution 6 --points 500 {QUIET} --out ./space": [
        *("force at most 700 N, of the study", "power at most 200000 N mm/s"),
    ],
}  # fmt: skip


def test_forces_are_newtons_and_powers_watts_where_masses_are_stated(words, folder):
    """The sheet had power in force mm/s, the path of the same machine in W, and forces had no unit."""
    limits = {**STUDY.constraints, "power": {"max": 2e5}, "force": {"max": 700.0}}
    nd.save(nd.optimize(replace(STUDY, masses={"platform": 3.0}, constraints=limits, objective={})), folder / "heavy")
    said = {line: words(line) for line in OF_WEIGHTS}
    missing = [(line, part) for line, parts in OF_WEIGHTS.items() for part in parts if part not in said[line]]
    assert missing == []
    assert not [line for line in said if "force/mm" in said[line] or "force mm" in said[line]]
    sheet = nd.load(folder / "heavy").sheet()
    assert f" {1e-3 * max(leg.power for leg in sheet.legs):.5g} " in said["sheet ./heavy"]
    laden = words(f"path ./heavy --line 1 0 0 --points 51 --mass 300 {QUIET} --out ./laden")
    assert re.search(r"limit breaks: force \w+ max, from t = \S+ to \S+ s, at worst [\d.]+ N at \S+ s", laden)
    assert "N mm/s" in (folder / "t.tex").read_text()
    head = sheet.to_csv().partition("\n")[0]
    assert "power (N mm/s),force_largest (N),force_1_min (N),force_1_max (N),platform_speed (mm/s)" in head
    units = sheet.to_dict()["units"]
    assert (units["force"], units["power"], units["moment"], units["stiffness"]) == ("N", "N mm/s", "N mm", "N/mm")
    plain = words("sheet ./run")
    assert "force mm" in plain
    assert "N mm" not in plain


def test_lengths_that_poses_need_and_that_limits_permit_have_two_names_in_files(folder, words):
    for name, parts in {
        "c": ("_permitted_shortest[9]", "_permitted_longest[9]", "those that the poses of the study need"),
        "csv": (",shortest (mm),longest (mm),permitted shortest (mm),permitted longest (mm)\n", "1.0,900.0"),
        "latex": ("needs from & needs to & stroke & permitted from & permitted to",),
    }.items():
        words(f"export ./run --to {name} --out ./file.{name}")
        text = (folder / f"file.{name}").read_text()
        assert not [part for part in parts if part not in text]


def test_an_undecided_design_and_tolerances_that_are_not_looked_at_are_told(folder, words, monkeypatch):
    free = replace(STUDY, variables={**STUDY.variables, "zp": (300.0, 500.0)}, starts=2)
    nd.save(nd.optimize(free), folder / "free")
    line = "admissible ./free --vary zp --time 0"
    said = words(line)
    assert "The time ended the search: a longer --time may decide more." in said
    assert "The design of the run is not decided itself yet." in said
    assert said.endswith(f"the time is over; to go on, type: ninedof {line.replace('./', f'{folder}/')}")
    real = nd.admissible
    monkeypatch.setattr(nd, "admissible", lambda *of, **how: replace(real(*of, **how), interrupted=True))
    said = words(line)
    assert "The design of the run is not decided itself yet." in said
    assert "interrupted; to go on" in said
    monkeypatch.undo()
    rows = [nd.Actuator("A", 100.0, 900.0)]
    replace(free, actuators=rows, constraints={}, tolerances={"legs": 0.01}).save(folder / "rows.toml")
    remark = "Of machines as they are drawn: the tolerances of the study are not looked at"
    assert remark in words("admissible ./rows.toml --vary zp --time 0.1")
    nd.save(nd.optimize(replace(free, tolerances={"legs": 0.01})), folder / "built")
    assert remark in words("admissible ./built --around")
    assert remark in words("certify ./built --tolerance 0 --time 0.1")
    assert remark not in words("certify ./built --time 0.1")


@pytest.mark.parametrize(
    "line",
    [
        "evaluate ./{} --set zp=+1%",
        "payload ./{} --force 300",
        "path ./{} --line 5 0 0 --points 51 --no-figures --no-report --out ./path-{}",
        "workspace ./{} --method sample --points 500 --no-figures --no-report --out ./space-{}",
    ],
)
def test_commands_about_the_machine_as_it_is_drawn_say_that_tolerances_are_not_looked_at(folder, words, line):
    for name, built in (("exact", {}), ("rough", {"legs": 0.01})):
        if not (folder / name).exists():
            nd.save(nd.optimize(replace(STUDY, objective={}, tolerances=built)), folder / name)
        remark = "Of machines as they are drawn: the tolerances of the study are not looked at."
        assert words(line.format(name, name)).count(remark) == len(built)


@pytest.mark.parametrize(
    "line",
    [
        "evaluate {}",
        "evaluate {} --set zp=+1%",
        "export {} --to csv --out ./x.csv",
        "payload {} --force 300",
        "sheet {}",
        "compare {} ./run",
        "failure {} --no-pairs",
    ],
)
def test_commands_that_search_a_region_show_that_they_do(folder, words, line):
    """On standard error, where a pipe has the last line of the bar; they said nothing for seconds."""
    name = line.partition(" ")[0]
    assert f"{name}: searching the region 0:" in words(line.format("./run"))
    if not (folder / "one-pose").exists():
        nd.save(nd.optimize(replace(STUDY, objective={})), folder / "one-pose")
    assert ("searching" in words(line.format("./one-pose"))) == (name == "compare")
