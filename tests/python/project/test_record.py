"""Results of every loop over limits against tests/data/record.npz, before the core was rebuilt: what may move, how far.

Bits are not compared: the C library decides about the last ones of logarithms and angles.
"""

from pathlib import Path

import numpy as np
import pytest
import record

KNOWN = dict(np.load(Path(__file__).parents[2] / "data" / "record.npz"))
NO_WORSE = {
    "optimum": (1.0, 1e-9),
    "shortest legs": (1.0, 1e-7),
    "longest legs": (-1.0, 1e-7),
    "margins": (1.0, 1e-7),
    "least margin": (1.0, 1e-7),
    "nearest singularity": (1.0, 1e-9),
    "best O": (1.0, 1e-9),
}
"""Found by searches: they may become better, that is smaller or larger by the sign, and worse by so much at most."""
TOLERANCE = {"certificate": 1e-5, "gradients": 2e-12}
"""Of what follows from an optimum: one to 1e-10 leaves its design to the root of that. Of gradients: since the record
they are summed in another order, and near a singularity that is 1.4e-12 of the largest. Else 1e-12."""


def parts(name):
    subject, _, what = name.partition(": ")
    return subject, what or subject


def compare(found):
    for name, values in found.items():
        known = KNOWN[name]
        subject, what = parts(name)
        size = np.abs(known[np.isfinite(known)]).max(initial=1e-300)
        if "margin" in what:
            size = max(size, 1.0)  # at a limit a margin is rounding
        if "O best" in subject and what in ("lengths", "limits", "condition"):
            # Where several places of O are as good, rounding decides between them, and with it on what depends on O.
            np.testing.assert_allclose(values, known, rtol=5e-3, atol=1e-6, err_msg=name)
            continue
        searched = next((t for word, t in NO_WORSE.items() if what.startswith(word) and "design" not in subject), None)
        if searched is not None:
            sign, worse = searched
            if subject.startswith("region "):  # over which a design may be worse by 1e-7 than at the poses that rule
                worse = max(worse, 1e-7)
            if "O best" in subject and "margin" in what:  # of a design that the optimum leaves to the root of its error
                worse = max(worse, 1e-6)
            if "O best" in subject and "legs" in what:
                assert (abs(values - known)[3:] <= 0.02 * size).all(), (name, values - known)
                values, known = values[:3], known[:3]
            assert values.shape == known.shape, name
            assert (sign * (values - known) <= worse * size).all(), (name, values - known)
        else:
            tolerance = next((t for word, t in TOLERANCE.items() if word in name), 1e-12)
            np.testing.assert_allclose(values, known, rtol=0.0, atol=tolerance * size, err_msg=name)


@pytest.mark.parametrize("part", ["designs", "workspaces", "paths", "optimum"])
def test_results_are_those_of_the_record(part):
    compare(record.arrays(getattr(record, part)()))


@pytest.mark.slow
@pytest.mark.parametrize("name", record.REGIONS)
def test_region_studies_are_those_of_the_record(name):
    compare(record.arrays(record.region(name)))


@pytest.mark.slow(sanitized=True)
def test_the_record_is_of_limits_that_there_are():
    """Limits that were made after it are held by the oracles alone."""
    from ninedof.design import limits

    assert {*record.LIMITS, *record.LATER} <= set(limits.ROWS)
    made = {name for part in (record.designs, record.workspaces, record.paths, record.optimum) for name in part()}
    assert {name for name in KNOWN if not name.startswith("region ")} == made
    assert {name.partition(": ")[0] for name in KNOWN if name.startswith("region ")} == {
        f"region {name}" for name in record.REGIONS
    }
