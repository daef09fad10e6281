"""The same bits in every run, for any number of threads, on every instruction set; a golden record of results."""

import json
import os
import subprocess
import sys
from pathlib import Path

import main_results
import numpy as np
import pytest

import ninedof as nd
from ninedof import _core

GOLDEN = Path(__file__).parents[2] / "data" / "golden.json"
"""Written by tests/python/support/main_results.py. A change of it is a change of results, for the release notes."""

LEVELS = ("base", "v3", "v4")


def printed(threads, level=""):
    """The results of a process of its own, None where the processor lacks the instruction set."""
    program = str(Path(main_results.__file__))
    environment = os.environ | {"NINEDOF_SIMD": level}
    done = subprocess.run([sys.executable, program, str(threads)], env=environment, capture_output=True, text=True)
    if "NINEDOF_SIMD" in done.stderr:
        return None
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.fixture(scope="module")
def here():
    results = {"batches": main_results.batches(1), "solvers": main_results.solvers(1)}
    return {
        "batches": main_results.digests(results["batches"]),
        "solvers": main_results.hexadecimal(results["solvers"]),
    }


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("level", LEVELS)
def test_every_instruction_set_gives_the_same_bits(here, level):
    found = printed(3, level)
    if found is None:
        pytest.skip(f"this processor has no {level}")
    assert found == here


def test_every_number_of_threads_gives_the_same_bits(here):
    for threads in (2, 7):
        assert main_results.digests(main_results.batches(threads)) == here["batches"]
        assert main_results.hexadecimal(main_results.solvers(threads)) == here["solvers"]


def test_batches_have_the_bits_of_the_golden_record(here):
    assert here["batches"] == json.loads(GOLDEN.read_text())["batches"]


def test_solvers_agree_with_the_golden_record(here):
    """To 1e-12: the C library decides about the last bits of logarithms and angles."""
    golden = json.loads(GOLDEN.read_text())["solvers"]
    assert golden.keys() == here["solvers"].keys()
    for name, values in golden.items():
        found, known = ([float.fromhex(x) for x in each] for each in (here["solvers"][name], values))
        size = np.abs(known).max()
        np.testing.assert_allclose(found, known, rtol=0.0, atol=size * TOLERANCE.get(name, 1e-12), err_msg=name)


TOLERANCE = {
    # Minimizers: where the objective is flat to rounding, they are known to its root only.
    "best_internal_point": 1e-7,
    "optimize": 1e-8,
}


def test_the_level_of_this_process_is_one_of_those_compared():
    assert _core.simd_level() in LEVELS
    assert nd.condition_number  # the package is the one whose core was asked
