"""`ninedof certify`: what it prints and writes, and one line for anything wrong."""

import json
import shutil
import time
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace

import pytest

import ninedof as nd
from ninedof.cli.app import main
from ninedof.records.proofs import save_certificate

EXAMPLE = Path(__file__).resolve().parents[3] / "examples" / "18_requirement.toml"


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("runs") / "paper"
    nd.save(nd.optimize(nd.Study.paper(), starts=2), folder)
    return folder


def saved(folder, most):
    """The machine of the requirement with a limit of its leg forces, in a run folder."""
    loads = {"wrenches": [[0.0, 0.0, 0.0, 0.0, 0.0, -400.0]]}
    study = replace(nd.Study.load(EXAMPLE), loads=loads, constraints={"force": {"max": most}})
    nd.save(nd.optimize(study, starts=1), folder)
    return study


def without_time_for_limits(monkeypatch):
    for module in ("ninedof.proof.machine", "ninedof.cli.commands.runs.certify"):
        monkeypatch.setattr(import_module(module), "FOR_LIMITS", 0.0)


def main_status(*arguments):
    with pytest.raises(SystemExit) as end:
        main([*map(str, arguments)])
    return end.value.code


def status(*arguments):
    return main_status("certify", *arguments)


@pytest.mark.slow(sanitized=True)
def test_a_run_is_proved_and_its_certificate_comes_back(run, capsys):
    assert status(run) == 0
    out = " ".join(capsys.readouterr().out.split())
    assert "Proved: at every pose of the study, the neutral one" in out
    assert "the condition number is at most 3.76266." in out
    certificate = nd.load_certificate(run)
    assert certificate.proved
    assert certificate.condition[0] <= nd.load(run).condition_number * (1.0 + 1e-12)
    assert "the condition number is at most 3.76266." in nd.report(run, run / "page.html").read_text()
    assert certificate == nd.load_certificate(run / "certify.json")


def test_a_machine_is_written_for_the_checker(run, tmp_path, capsys):
    file = tmp_path / "machine.certificate"
    assert status(run, "--certificate", file) == 0
    assert f"certificate{file},for" in "".join(capsys.readouterr().out.split())  # the path may be wrapped
    assert main_status("check", file) == 0
    out, err = capsys.readouterr()
    assert "Proved: the machine keeps every limit at every pose" in out
    assert err.startswith("check: reading the certificate")
    assert len(err.splitlines()) == 1
    assert status(run, "--certificate", file, "--tolerance", "0.01") == 2
    words = " ".join(capsys.readouterr().err.split())
    assert main_status("check", file, "--time", 0) == 3
    said = " ".join(capsys.readouterr().out.split())
    assert said == (
        "Incomplete: not checked to its end, as the time is over: nothing wrong was found, and nothing is proved"
    )
    assert main_status("check", run) == 2
    words_of_folder = " ".join(capsys.readouterr().err.split())
    assert f"to write one, type: ninedof certify {run} --certificate FILE" in words_of_folder
    assert main_status("check", run / "certify.json") == 1
    said = " ".join(capsys.readouterr().out.split())
    assert "a file of `certify` or `admissible` with --certificate FILE" in said
    assert said.endswith("certify.json says what is proved of a machine, and not why.")
    assert "tolerance: got 0.01, expected 0: the file that is replayed is of the machine as it is drawn" in words
    assert "`--tolerance 0`" in words


@pytest.mark.slow(sanitized=True)
def test_a_run_may_be_called_as_its_certificate(run, tmp_path, capsys):
    named = tmp_path / "certify-1"
    shutil.copytree(run, named)
    assert status(named) == 0
    assert status(named) == 0
    assert nd.load_certificate(named) == nd.load_certificate(named / "certify.json")
    assert main_status("report", named) == 0


@pytest.mark.slow(sanitized=True)
def test_what_time_was_too_short_for_has_the_value_met_and_says_so(tmp_path, monkeypatch, capsys):
    saved(tmp_path / "run", 900.0)
    without_time_for_limits(monkeypatch)
    assert status(tmp_path / "run", "--time", 1e-9) == 3
    out, err = capsys.readouterr()
    assert err.endswith(f"to go on, type: ninedof certify {tmp_path / 'run'} --time 4e-09\n")  # a longer time
    (row,) = [line.split() for line in out.splitlines() if "force" in line and "undecided" in line]
    met = float(row[row.index("met") - 1])
    assert 0.0 < met <= max(one.value for one in nd.sheet(nd.load(tmp_path / "run")).limits)
    assert "∞" not in out
    said = " ".join(out.split())
    assert f"the worst value met so far is {met:.5g}" in said
    assert "and nothing bounds it yet." in said
    assert "Each limit had 1e-09 s, and begins anew: a longer --time may decide it." in said
    at = said.split("The worst condition number met is ")[1].split("° from neutral")[0]
    found, pose = at.split(", at p = (")
    p, o, turn = (part.split(")")[0] for part in pose.split("("))
    p, o, turn = (part.replace(",", "") for part in (p, o, turn))  # as the commands of a pose take it
    place = ["--position", *p.split(), "--internal-point", o, "--rotation-deg", *turn.split()]
    main_status("best", tmp_path / "run", *place, "--json")
    assert json.loads(capsys.readouterr().out)["now"] == pytest.approx([float(found)], rel=1e-5)


def test_a_bound_that_does_not_hold_is_said(run, capsys):
    assert status(run, "--condition", 3.7, "--json") == 3
    said = capsys.readouterr()
    assert json.loads(said.out)["limits"][-1]["answer"] == "violated"
    assert "Violated: condition number: 3.76265" in said.err


def test_an_interrupted_fit_of_a_rule_leaves_nothing(run, tmp_path, monkeypatch, capsys):
    def interrupted(*_, progress, **__):
        progress.phase("fitting a rule for O of degree 1")
        raise KeyboardInterrupt

    monkeypatch.setattr(import_module("ninedof.optimize.reserve"), "certify", interrupted)
    folder = tmp_path / "run"
    shutil.copytree(run, folder, ignore=shutil.ignore_patterns("certify.json"))
    before = sorted(folder.iterdir())
    assert status(folder) == 130
    assert sorted(folder.iterdir()) == before
    said = capsys.readouterr()
    assert "interrupted before the limits were proved: the run folder is as it was" in said.out
    assert "Traceback" not in said.err


@pytest.mark.parametrize(("proofs", "words"), [(1, "joints 0.0004975, legs 0.0004975"), (0, "none")])
def test_an_interrupted_search_for_tolerances_tells_the_largest_so_far(run, monkeypatch, capsys, proofs, words):
    asked = []

    def proved(*arguments, **_):
        asked.append(arguments[2])
        if len(asked) > proofs:
            raise KeyboardInterrupt
        return []

    monkeypatch.setattr(import_module("ninedof.optimize.reserve"), "open_limits", proved)
    assert status(run, "--tolerance", "max") == 130
    out = " ".join(capsys.readouterr().out.split())
    assert f"interrupted: the largest tolerances proved so far: {words}" in out
    assert asked[-1].joints == (4.0 if proofs else 1.0) * asked[0].joints


@pytest.mark.parametrize(
    ("most", "answer", "words"),
    [
        (0.01, "violated", "The largest tolerances that were proved, to 5 %: joints 0.009"),
        (0.01, "undecided", "joints 0.009"),
        (0.0, "undecided", "No tolerance was proved. The time ended the search: a longer --time may prove some."),
    ],
)
def test_a_search_for_tolerances_that_time_ended_says_so(run, tmp_path, monkeypatch, capsys, most, answer, words):
    def unproved(study, design, built, seconds, **_):
        time.sleep(seconds / 9.0)
        return [] if built.joints <= most else [SimpleNamespace(answer=answer)]

    monkeypatch.setattr(import_module("ninedof.optimize.reserve"), "open_limits", unproved)
    shutil.copytree(run, tmp_path / "run")
    status(tmp_path / "run", "--tolerance", "max", "--time", 0)
    out = " ".join(capsys.readouterr().out.split())
    assert words in out
    assert ("to 5 %" in out) == (answer == "violated")
    assert ("The time ended the search: a longer --time" in out) == (answer == "undecided")


def test_the_largest_tolerances_are_not_below_those_of_the_study(run, monkeypatch):
    """The first proof is of them, with the time that `certify` has."""
    built, proofs = nd.Tolerances(0.02, 0.01), []

    def proved(study, design, tolerances, seconds, **_):
        proofs.append((tolerances, seconds))
        return [] if tolerances.joints <= built.joints else [SimpleNamespace(answer="violated")]

    monkeypatch.setattr(import_module("ninedof.optimize.reserve"), "open_limits", proved)
    result = nd.load(run)
    result = replace(result, study=replace(result.study, tolerances=built))
    assert result.largest_tolerance(time_limit=24.0) == built
    assert proofs[0] == (built, 24.0)
    assert {seconds for _, seconds in proofs[1:]} == {2.0}


@pytest.mark.slow(sanitized=True)
def test_a_report_takes_no_certificate_of_another_machine_nor_a_changed_one(run, tmp_path):
    found = nd.load(run)
    ours, other = tmp_path / "ours", tmp_path / "other"
    nd.save(found, ours)
    nd.save(nd.optimize(nd.Study(constraints={"radius_ratio": (None, 1.5)}), starts=2), other)
    assert status(ours) == 0
    assert found.is_certified_by(nd.load_certificate(ours))
    assert "condition number is at most 3.76266." in nd.report(ours).read_text()
    shutil.copy(ours / "certify.json", other)
    assert not nd.load(other).is_certified_by(nd.load_certificate(other))
    with pytest.raises(ValueError, match=r"certify\.json: got a certificate of another machine"):
        nd.report(other)
    assert status(other) == 2
    text = (ours / "certify.json").read_text()
    (ours / "certify.json").write_text(text.replace('"which": "det N"', '"which": "det B"'))
    with pytest.raises(ValueError, match=r"certify\.json: got no file as ninedof wrote it"):
        nd.report(ours)
    assert status(ours) == 2


@pytest.mark.slow(sanitized=True)
def test_other_tolerances_are_proved_anew_and_the_largest_are_found(run, capsys):
    assert status(run) == 0
    capsys.readouterr()
    assert status(run, "--tolerance", 1e-4) == 3  # its optimum lies on its limits
    said = " ".join(capsys.readouterr().out.split())
    assert "As built: every joint centre within 0.0001 and every leg length within 0.0001 of the drawing." in said
    assert "With the lengths of the drawing p is off by at most" in said
    assert nd.load_certificate(run).tolerances == nd.Tolerances(1e-4, 1e-4)
    assert "As built: every joint centre" in nd.report(run, run / "page.html").read_text()
    assert status(run, "--tolerance", "max") == 0
    assert "No tolerance was proved: radius ratio leaves no reserve." in " ".join(capsys.readouterr().out.split())
    assert not nd.load_certificate(run).tolerances


def test_a_run_with_a_reserve_says_so_and_its_tolerances_are_proved(tmp_path, capsys):
    folder, file = tmp_path / "built", tmp_path / "built.toml"
    replace(nd.Study.paper(), tolerances=nd.Tolerances(joints=0.0001)).save(file)
    assert main_status("optimize", file, "--starts", 2, "--out", folder, "--no-figures") == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "reserve for the tolerances: the greatest radius ratio" in said
    assert "proved of every machine within the tolerances" in said
    page = nd.report(folder, folder / "page.html").read_text()  # beside what is searched, nothing said so
    assert "Proved: every machine within the tolerances keeps the limits at every pose." in page
    assert status(folder) == 0
    assert status(folder, "--tolerance", "max") == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "The largest tolerances that were proved, to 5 %: joints 0.0001" in said
    assert nd.load_certificate(folder).leg_tolerance == 0.0


def test_the_report_names_the_certificate_for_other_tolerances_that_is_kept(tmp_path):
    """After `certify --tolerance 0` it had no word on the proof of the machine as built."""
    folder = tmp_path / "built"
    nd.save(nd.optimize(replace(nd.Study.paper(), tolerances=nd.Tolerances(joints=0.0001)), starts=2), folder)
    assert status(folder) == 0
    assert status(folder, "--tolerance", 0) == 0
    page = nd.report(folder).read_text()
    kept = "a certificate for tolerances of 0.0001 for joint centres and 0 for leg lengths"
    assert f"Kept in certify-earlier.json: {kept}, by which every limit is proved." in page
    assert "Proved: every machine within the tolerances keeps the limits at every pose." in page
    assert status(folder) == 0
    page = nd.report(folder).read_text()
    assert "Kept in certify-earlier-2.json: a certificate of the machine as it is drawn, by which every limit" in page
    assert "Kept in certify-earlier.json" not in page
    assert "Proved: every machine within the tolerances" not in page  # the certificate itself says more

    def not_every_limit(file):
        first, *rest = nd.load_certificate(file).limits
        return replace(nd.load_certificate(file), limits=(replace(first, answer="undecided"), *rest))

    earlier = folder / "certify-earlier-2.json"
    save_certificate(not_every_limit(earlier), earlier)
    assert "as it is drawn, by which not every limit is proved." in nd.report(folder).read_text()
    save_certificate(replace(nd.load_certificate(earlier), machine="another"), earlier)
    assert "Kept in" not in nd.report(folder).read_text()


def test_no_certificate_is_lost_and_the_one_for_the_same_tolerances_goes_on(run, tmp_path, capsys):
    """A third one took the place of the first, which was complete, and the first was begun anew."""
    folder = tmp_path / "run"
    shutil.copytree(run, folder, ignore=shutil.ignore_patterns("certify*"))
    files = [folder / name for name in ("certify.json", "certify-earlier.json", "certify-earlier-2.json")]
    for tolerance in (0.001, 0, 0.002, 0.001, 0):
        assert status(folder, "--tolerance", tolerance) in (0, 3)  # a limit of an optimum has no room
    assert [nd.load_certificate(file).joint_tolerance for file in files] == [0.0, 0.001, 0.0]
    assert not (folder / "certify-earlier-4.json").exists()
    assert nd.load_certificate(folder / "certify-earlier-3.json").joint_tolerance == 0.002
    boxes = nd.load_certificate(files[0]).condition_boxes
    assert nd.load_certificate(files[2]).condition_boxes == boxes  # it went on, with nothing left to do
    files[1].write_text("{}")
    assert status(folder, "--tolerance", 0.001) == 3
    assert (
        "Kept in certify-earlier-2.json: a certificate of the machine as it is drawn" in nd.report(folder).read_text()
    )
    capsys.readouterr()


@pytest.mark.slow(sanitized=True)
def test_less_time_takes_no_proof_away(tmp_path, monkeypatch):
    """Limits began anew with every call, and a hurried one took the place of what had been proved."""
    folder = tmp_path / "run"
    study = saved(folder, 1200.0)
    assert status(folder) == 0
    whole = nd.load_certificate(folder)
    without_time_for_limits(monkeypatch)
    assert status(folder, "--time", 1e-9) == 0
    assert nd.load_certificate(folder).limits == whole.limits
    heavier = replace(study, loads={"wrenches": [[0.0, 0.0, 0.0, 0.0, 0.0, -4000.0]]})
    other = replace(nd.load(folder), study=heavier).certify(time_limit=1e-9, resume=whole)
    assert "proved" not in {one.answer for one in other.limits if one.name == "force"}
    assert status(folder, "--time", 1e-9, "--slack", 0.0) == 3  # another question
    assert status(folder, "--time", 1e-9, "--tolerance", 0.01) == 3
    assert not nd.load_certificate(folder / "certify-earlier.json").proved
    save_certificate(whole, folder / "certify.json")
    assert status(folder, "--time", 1e-9, "--tolerance", 0.01) == 3
    assert nd.load_certificate(folder / "certify-earlier-2.json").limits == whole.limits
    assert status(folder, "--time", 1e-9, "--condition", 1.000001 * whole.condition[0]) == 3
    assert nd.load_certificate(folder).limits[:-1] == whole.limits


@pytest.mark.slow(sanitized=True)
def test_what_no_longer_time_decides_is_said(tmp_path, monkeypatch, capsys):
    """It asked for four times the time, again and again."""
    saved(tmp_path / "run", 900.0)
    real = nd.Result.certify

    def ended(self, **options):
        return replace(real(self, **options), limits_timed=False)

    without_time_for_limits(monkeypatch)
    monkeypatch.setattr(nd.Result, "certify", ended)
    assert status(tmp_path / "run", "--time", 1e-9, "--gap", 9) == 3
    out, err = capsys.readouterr()
    said = " ".join(out.split())
    assert "No longer --time decides what is undecided: its search came to an end; a narrower region may." in said
    assert "to go on" not in err
    assert status(tmp_path / "run", "--time", 1e-9, "--gap", 9, "--condition", 3.9) == 3
    out, err = capsys.readouterr()
    assert ("No longer --time" in " ".join(out.split())) != ("to go on" in err)
    monkeypatch.setattr(nd.Result, "certify", real)
    assert status(tmp_path / "run", "--time", 1e-9, "--certificate", tmp_path / "file") == 2
    _, err = capsys.readouterr()
    assert " undecided, expected one in which every limit is proved" in " ".join(err.split())
    assert f"to go on, type: ninedof certify {tmp_path / 'run'} --certificate {tmp_path / 'file'} --time 4e-09" in err
