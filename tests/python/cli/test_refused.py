"""Command lines that are refused: one line that names what was typed, nothing on standard output, no file.

What no command does with any value is in entry/test_entry_commands.py; entries of calls are in entry/test_refused.py.
"""

import shlex
from pathlib import Path

import entry_things as it
import pytest

import ninedof as nd
from ninedof.cli.app import main

POSES = "t,x,y,z,yaw_deg\n" + "".join(f"{k / 10},{0.01 * k},0,3.6,0\n" for k in range(11))
LINES = {
    # numbers
    "optimize --starts 0": "starts: got 0",
    "--threads 0": "threads: got 0",
    "--seed -1": "seed: got -1",
    **{f"optimize --time={seconds}": "--time: got" for seconds in ("0", "-1", "inf", "nan")},
    "pareto --points 1": "points: got 1",
    "pareto --points 1000000": "points: got 1000000",
    **{
        f"pareto --value 2 --value={value}": f"--value: got {value}, expected a finite number above 0"
        for value in ("-3", "0", "nan", "inf")
    },
    "certify run --time -1": "--time: got -1.0, expected a finite number at least 0",
    "certify run --condition 0.5": "--condition: got 0.5, expected a finite number at least 1",
    "certify run --gap 0": "--gap: got 0.0, expected a finite number at least 1e-09",
    "certify run --slack=1": "--slack: got 1.0",
    "certify run --threads=-1": "--threads: got -1",
    "certify run --tolerance=9": "--tolerance: got 9",
    "certify run --tolerance max --gap=0": "--gap: got 0.0",
    "certify run --tolerance max --time=-1": "--time: got -1.0",
    "certify run --tolerance=much": "--tolerance: got 'much', expected a length from 0 on, or \"max\"",
    **{f"certify run --tolerance={x}": f"--tolerance: got '{x}', expected a length from" for x in ("-1", "inf", "nan")},
    "atlas --designs 1125899906842625": "designs: got 1125899906842625",
    "sweep --over x_p=-1:1:1000000000 --over y_p=-1:1:1000000000": "points, expected at most",
    "sweep --over x_p=-1:1:1099511627776 --chunk 1": "chunk: got 1 of 1099511627776 points, expected at least 262144",
    "sweep figure-6 --points 10000000": "points: got 10000000",
    "workspace --legs 1 6 --points 10000000000": "points: got 10000000000",
    "workspace --legs 1 6 --points 0": "points: got 0, expected",
    "path --circle 0.1 --points 1000000000": "points: got 1000000000",
    "path --circle 1 --points 2": "points: got 2",
    "path --line 1": "--line",
    "sweep --over x_p=0:1:3 --chunk 0": "--chunk: got 0",
    "path --circle 1 --duration 0": "duration: got 0",
    "best run --lc nan": "--lc: got nan",
    "best run --position nan 0 1": "--position: got nan",
    "best run --legs nan 3": "limits",
    "forces run --load '0 0 0 0 0 1' --rotation-deg 0 inf 0": "--rotation-deg: got inf",
    "forces run --load '0 0 0 0 0 inf'": "--load: got '0 0 0 0 0 inf'",
    "singularity run --direction '0 0 1 0 0 0 0 0 0' --most nan": "most: got nan",
    "accuracy run --leg-error 1 --samples -1": "samples: got -1",
    "accuracy run --leg-error nan": "--leg-error: got nan",
    "accuracy run --joint-error -1": "--joint-error: got -1",
    "stiffness run --leg-stiffness nan": "--leg-stiffness: got nan",
    "modes run --lengths '1 1 1 1 1 1 1 1 -1'": "--lengths: got",
    "accuracy run --within-deg -1": "--within-deg: got -1",
    "export design.toml --to mjcf --leg-mass 0": "--leg-mass: got 0, expected a mass above 0",
    "evaluate --a1 -1 --a2 1 --b1 1 --b2 1 --zp 2 --zs 1": "a1: got -1",
    "evaluate --a1 0 --a2 0 --b1 1 --b2 1 --zp 2 --zs 1": "--a1, --a2: got 0 and 0",
    "evaluate --a1 0 --a2 1 --b1 1 --b2 0 --zp nan --zs 1": "zp: got nan",
    # one variable of an option that names variables
    "evaluate run --set zs=-1": "--set zs: got -1.0",
    "evaluate run --set=zs=inf": "--set zs: got inf",
    "evaluate run --set zp=+5% --set zs=9": "--set zp, --set zs: got zs = 9, expected 0 < zs < zp",
    "evaluate run --set theta_z_deg=nan": "--set theta_z_deg: got nan",
    "evaluate run --set height=1": "--set: got 'height', expected one of a1, a2",
    "admissible run --vary zp=nan:5": "--vary zp: got nan",
    "admissible run --vary theta_z_deg=10:5": "--vary theta_z_deg: got (10, 5), expected low < high",
    "admissible run --vary a2 --around --proportions a2=nan": "--proportions a2: got nan",
    "sweep run --over x_p=nan": "--over x_p: got",
    "sweep --over x_p=0:1:3 --a1 0 --a2 5 --b1 3 --b2 0 --zp 4 --zs 2 --theta-z-deg nan": "--theta-z-deg: got nan",
    "path --circle nan": "--circle: got nan",
    "check none.certificate": "none.certificate: cannot be read",
    # files whose names begin as an argument does
    "check at.certificate": "at.certificate: cannot be read",
    "sheet load.toml --load '0 0 0 0 0 1'": "load.toml: cannot be read",
    "optimize time_limit.toml --time 5": "time_limit.toml: cannot be read",
    # lists of numbers
    "forces run --load '1 2'": "--load: got '1 2', expected 6 numbers",
    "singularity run --direction '0 1'": "--direction: got '0 1', expected 9 numbers",
    "modes run --lengths '1 1'": "--lengths: got '1 1', expected 9 numbers",
    # angles, in degrees as they are typed
    "sweep design.toml --over theta_z=0:1:3 --over theta_z_deg=0:30:3": "over: got both theta_z and theta_z_deg",
    "pareto study.toml --against base_cone --value 400": "400 degrees",
    "pareto study.toml --against footprint_deg": "against: got 'footprint_deg'",
    "workspace design.toml --legs 1 900 --archetype orientation --angle-deg 400": "--angle-deg: got 400",
    "workspace design.toml --base-cone-deg 200": "--base-cone-deg: got 200",
    "sheet design.toml --turn-deg -5": "--turn-deg: got -5",
    # words
    "optimise": "optimise",
    "optimize --start 3": "--start",
    "pareto --against foo": "against: got 'foo'",
    "evaluate --a1 wide": "a1",
    "best run --criterion fast": "criterion: got 'fast'",
    "path --circle 1 --internal-point stay": "--internal-point: got 'stay', expected carried, shifted, held",
    "workspace --legs 1 6 --lc long": "--lc: got 'long', expected a number or one of",
    "sheet design.toml --internal fast": "internal: got 'fast'",
    "export design.toml --to mjfc": "--to: got 'mjfc', expected one of",
    "export design.toml --to mjcf --unit mile": "--unit: got 'mile'",
    # places
    "optimize nowhere.toml": "nowhere.toml: cannot be read",
    "best nothing": "nothing: cannot be read",
    "best front": "front: got a front, expected one of its points: front#1 to front#2",
    "best front#3": "front#3: got 3 of a front, expected a number from 1 to 2",
    "best front#0": "front#0: got 0 of a front",
    "best front#x": "front#x: got x of a front",
    "best design.toml#1": "design.toml#1: got a point of a design file",
    "sheet .": "record.json",
    "certify .": "record.json: cannot be read",
    "certify design.toml": "got no design of a study, expected a run of `ninedof optimize`",
    f"optimize --out {300 * 'a'}": "--out: got 'aaa",
    "sheet none.toml --csv .": "--csv: got ., which exists and was not written by ninedof",  # before the work
    "sheet none.toml --csv poses.csv": "--csv: got poses.csv, which exists and was not written by ninedof",
    "sheet none.toml --csv none/s.csv": "--csv: got none/s.csv, expected a file in a folder that exists",
    "path none.csv": "none.csv: cannot be read",
    "path poses.csv": "poses.csv: line 1: got yaw_deg as rotation",
    "export design.toml --out a.stl": "--out: got a.stl, expected --to with a format, or a file that ends in .h, .csv",
    "export design.toml --out none/a.xml": "--out: got none/a.xml, expected a file in a folder that exists",
    # sweeps
    "sweep": "sweep: got no --over",
    "sweep figure-6 --over x_p=0:1:3": "--over: got x_p=0:1:3, expected none with figure-6",
    "sweep figure-6 --lc 2": "--lc: got 2, expected none with figure-6",
    "sweep figure-6 --absolute": "--absolute: got it, expected none with figure-6",
    "sweep figure-7 --chunk 5": "--chunk: got 5, expected none with figure-7",
    "sweep figure-9": "sweep: got figure-9, expected one of figure-6, figure-7, or a design",
    "sweep --over x_p=0:1:3 --points 3": "--points: got 3, expected none with --over",
    "sweep --over a1=0:1:3 --absolute": "--absolute: got it, expected none in a sweep over designs",
    "sweep --over a1=0:1:3 --internal-point best": "--internal-point: got best, expected none in a sweep over designs",
    "sweep --over a1=0:1:3 --lc 0": "--lc: got 0.0",
    "sweep --over x_p": "--over: got 'x_p', expected NAME=LOW:HIGH:COUNT",
    "sweep --over x_p=0:1:2.5": "expected NAME=LOW:HIGH:COUNT",
    "sweep --over x_p=a,b": "expected NAME=LOW:HIGH:COUNT",
    "sweep --over x_p=0:1:3 --over x_p=0:1:3": "expected different names",
    "sweep --over x_p=0:1:3 --index kappa": "index: got 'kappa'",
    "sweep --over x_p=0:1:3 --a1 1": "--a2",
    "sweep nothing.toml --a1 3 --over a2=0:1:3": "design: got nothing.toml and a1, expected one of the two",
    "sweep --over base_external_radius=0:1:3": "expected a DESIGN whose family has it",
    "sweep --over x_p=0:1:3 --index six_legged": "index: got 'six_legged', which is for the neutral pose",
    "sweep --over zs=1:2:3 --index six_legged --lc optimal": "--lc: got 'optimal'",
    "sweep --a1 3 --over a1=0:1:3": "--over: got a1, which --a1 holds",
    "workspace --legs 3 2": "--legs: got 3 to 2",
    "workspace --legs 2 3 --resolution 1": "resolution: got 1",
    "sweep --over xp=-1:1:5": "(did you mean 'x_p'?)",
    "sweep --over x_p=-1:1:5 --over a1=0:1:5": "--over: got x_p, a1, expected coordinates of the configuration or",
    # options apart
    "path": "path: got none, expected one of a CSV file, --circle, --line and --spiral",
    "path --circle 1 --line 1 0 0": "path: got --circle and --line, expected one",
    "path poses.csv --points 7": "--points: got 7, expected none with a file",
    "path --circle 1 --internal-point best --legs 1 2": "no position of O is allowed at t = 0",
    "best design.toml --all-poses": "--all-poses: got a design without a study",
    "best run --all-poses --position 0 0 1": "--position: got 0 0 1, expected none beside --all-poses",
    "accuracy run": "accuracy: got neither --leg-error nor --joint-error",
    "accuracy run --leg-error 0.1 --all-poses --samples 9": "--samples: got it with --all-poses",
    "modes run --lengths '1 1 1 1 1 1 1 1 1' --position 0 0 1": "--position: got 0 0 1, expected none beside",
    "evaluate --a1 1": "--a2",
    "export design.toml": "--to: got nothing, expected one of c, csv, dxf, latex, mjcf, sdf, step, urdf",
    "export design.toml --to sdf --gravity 9": "--gravity: got 9 with --to sdf, which takes --leg-mass",
    "export design.toml --to csv --gravity 1": "--gravity: got 1 with --to csv, which takes no option",
    "workspace --legs 1 6 --position 0 0 4": "--position: got 0 0 4, expected none but for --archetype",
    "workspace --legs 1 6 --method grid --points 5": "--points: got 5, expected none with --method grid",
    "workspace --legs 1 6 --time 5": "--time: got 5, expected none without --certify",
    "workspace --legs 1 6 --certify --internal-point best": "--internal-point: got 'best', expected carried, shifted",
    "workspace --legs 1 6 --certify --archetype orientation --angle-deg 20": "archetype: got 'orientation'",
    "workspace --legs 1 6 --certify --gap 2": "--gap: got 2",
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("refused")
    nd.save(it.result(), folder / "run")
    nd.save(it.front(), folder / "front")
    nd.save(it.design(), folder / "design.toml")
    (folder / "poses.csv").write_text(POSES)
    (folder / "study.toml").write_text('unit = "mm"\n[design]\ncharacteristic_length = 150.0\n')
    return folder


@pytest.mark.parametrize(("line", "words"), LINES.items(), ids=LINES)
def test_a_line_is_refused(folder, monkeypatch, capsys, line, words):
    monkeypatch.chdir(folder)
    before = sorted(Path().rglob("*"))
    with pytest.raises(SystemExit) as end:
        main(shlex.split(line))
    said = capsys.readouterr()
    assert (end.value.code, said.out) == (2, "")
    assert words in said.err
    assert said.err.count("\n") == 1
    assert len(said.err) < 600
    assert sorted(file for file in Path().rglob("*") if file.is_file()) == [file for file in before if file.is_file()]
