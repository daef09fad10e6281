"""Files that people write, damaged in hundreds of ways: each loads, or is refused in one line that names it.

Files that ninedof keeps have a digest: see records/test_files.py.

NINEDOF_LONG=1 tries twenty times as many.
"""

import random
from collections import Counter
from pathlib import Path

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


EXAMPLES = Path(__file__).parents[3] / "examples"


def path_load(path):
    return nd.Trajectory.load(path, it.c())


KINDS = {
    "study of a region": ("study.toml", (EXAMPLES / "18_requirement.toml").read_bytes, toml_mutant, nd.Study.load, 3),
    "study of poses": ("study.toml", (EXAMPLES / "10_robust.toml").read_bytes, toml_mutant, nd.Study.load, 3),
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
