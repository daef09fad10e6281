"""Files that people write, damaged in hundreds of ways: each loads, or is refused in one line that names it.

Files that ninedof keeps have a digest: see records/test_files.py.

NINEDOF_LONG=1 tries twenty times as many.
"""

import random
import tomllib
from collections import Counter

import entry_things as it
import numpy as np
import pytest
from entry_engine import bounded, fault_of
from memory import small
from mutants import csv_mutant, toml_mutant, torn
from sizes import size

import ninedof as nd


@pytest.fixture(scope="module", autouse=True)
def _memory():
    with small():
        yield


STUDY = """
unit = "mm"
[design]
family = "hexagonal"
characteristic_length = 150.0
[variables]
a1 = 0.0
a2 = [100.0, 850.0]
b1 = [50.0, 350.0]
b2 = 0.0
zp = [300.0, 700.0]
zs = [50.0, 650.0]
theta_z_deg = [-10.0, 10.0]
[constraints]
stroke_ratio = { max = 1.4 }
base_cone = { max_deg = 45.0, axis = [0.0, 0.0, 1.0] }
leg_clearance = { min = 20.0 }
leg_length = [{ min = 100.0 }, { max = 900.0, at = "neutral" }]
[objective]
index = "condition_number"
condition_limit = 10.0
poses = [{ position = [10.0, 0.0, 0.0], rotation_deg = [1.0, 0.0, 0.0], weight = 1.0 }]
[objective.region]
box = [60.0, 60.0, 40.0]
tilt_deg = 10.0
[solver]
starts = 4
seed = 1
"""


def path_load(path):
    return nd.Trajectory.load(path, it.c())


KINDS = {
    "study": ("study.toml", STUDY.encode, toml_mutant, nd.Study.load, 6),
    "design": ("design.toml", lambda: it.design_file().read_bytes(), toml_mutant, nd.load, 4),
    "path": ("path.csv", lambda: it.path_file().read_bytes(), csv_mutant, path_load, 4),
    "certificate of an optimum": (
        "optimum.certificate",
        lambda: it.proof_file().read_bytes(),
        torn,
        nd.check_certificate,
        2,
    ),
    "export as mjcf": ("robot.xml", lambda: exported("xml", "mjcf"), torn, nd.load, 2),
    "export as csv": ("robot.csv", lambda: exported("csv", "csv"), csv_mutant, nd.load, 2),
}
SHARE = size(10, 500)  # mutants for each unit of weight


def exported(suffix, form):
    return nd.export(it.design(), form, it.fresh(f".{suffix}"), unit="mm").read_bytes()


@pytest.mark.parametrize("kind", KINDS)
def test_damaged_files_load_or_are_refused_by_name(kind, tmp_path):
    name, seed, mutant, load, weight = KINDS[kind]
    data, pick, counts, failures = seed(), random.Random(kind), Counter(), []
    file = tmp_path / name
    file.write_bytes(data)
    with bounded():
        load(file)  # as it is
    for k in range(SHARE * weight):
        made = mutant(data, pick)
        file.write_bytes(made)
        try:
            with bounded(), np.errstate(all="ignore"):
                load(file)
            counts["loaded"] += 1
        except BaseException as error:  # one that hangs too
            fault = fault_of(error, {name, str(tmp_path)}) if isinstance(error, Exception) else repr(error)
            counts["refused" if not fault else "failed"] += 1
            if fault:
                failures.append(f"{kind} {k}: {fault}")
    print(f"{kind}: {SHARE * weight} mutants, {dict(counts)}")
    assert not failures, "\n".join([f"{len(failures)} of {SHARE * weight}:", *failures[:25]])


def test_the_study_of_these_tests_is_whole():
    assert nd.Study.from_dict(tomllib.loads(STUDY)).objective.region is not None
