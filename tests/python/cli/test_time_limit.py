"""`ninedof optimize --time`: the best design so far, and an exit status that says whether it can be used."""

import json
from dataclasses import replace

import ninedof as nd
from ninedof.cli.screen import DONE, INTERRUPTED, NO_RESULT, exit_status

STUDY = """
[variables]
a1 = 0.0
a2 = 5.8124
b1 = [2.0, 3.5]
b2 = 0.0
zp = 3.9828
zs = 2.4435
theta_z = 0.0
[objective.region]
box = [0.1, 0.1, 0.1]
[solver]
starts = 1
"""


def test_the_same_command_solves_what_the_time_ended(run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "study.toml").write_text(STUDY)
    line = "optimize study.toml --no-figures --json --out run"
    status, out, _ = run(f"{line} --time 1e-9")
    assert status in (DONE, NO_RESULT)  # by whether a start was quicker
    ended = json.loads(out)["optimization"]
    assert (ended["status"], ended["interrupted"]) == ("stopped", False)
    assert not list((tmp_path / "run" / "pieces").iterdir())
    status, out, _ = run(f"{line} --time 600")
    assert status == DONE
    assert json.loads(out)["optimization"]["status"] == "optimal"
    assert nd.load("run").status == nd.Status.OPTIMAL


def test_a_design_that_keeps_its_limits_is_a_result(tmp_path):
    file = tmp_path / "study.toml"
    file.write_text(STUDY)
    whole = nd.optimize(nd.Study.load(file))
    ended = replace(whole, status=nd.Status.STOPPED)
    assert exit_status(whole) == DONE
    assert exit_status(ended, timed=True) == DONE
    assert exit_status(ended) == NO_RESULT
    assert exit_status(replace(ended, interrupted=True), timed=True) == INTERRUPTED
    for worse in ({"margin": -1e-3}, {"looked_at": 4000}):
        assert exit_status(replace(ended, region=replace(whole.region, **worse)), timed=True) == NO_RESULT
