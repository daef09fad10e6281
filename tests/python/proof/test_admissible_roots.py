"""Admissible designs by an executor: the same set whatever the workers are, and never one that contradicts another."""

import math
from concurrent.futures import Executor, Future, ThreadPoolExecutor

import numpy as np
import pytest

import ninedof as nd
from ninedof.proof.admissible.admissible import ROOTS

SIZES = {"a1": 0.0, "a2": (2.0, 10.0), "b1": (1.0, 5.0), "b2": 0.0, "zp": (2.0, 8.0), "zs": (1.0, 6.0)}
AT = {"zp": 5.0, "zs": 3.0}
LIMITS = {
    "radius_ratio": (1.2, 3.0),
    "stroke_ratio": (None, 1.55),
    "leg_length": (1.3, 7.0),
    "base_cone": {"max_deg": 60, "axis": (0, 0, 1)},
    "leg_clearance": (0.12, None),
}
STUDY = nd.Study(variables=SIZES, constraints=LIMITS, objective={"region": {"box": (0.4, 0.4, 0.3), "tilt": 0.12}})
CONDITION = nd.Study(variables=SIZES, constraints={"radius_ratio": (None, 2.5)})
ASKED = {
    "two variables": (STUDY, ("a2", "b1"), {"at": AT, "resolution": 0.04}),
    "three variables": (
        CONDITION,
        ("a2", "b1", "zp"),
        {"at": {"zs": 3.0}, "condition_number": 4.0, "resolution": 0.05},
    ),
    "one variable": (STUDY, ("a2",), {"at": AT | {"b1": 2.5}, "resolution": 0.002}),
    "condition number": (CONDITION, ("a2", "b1"), {"at": AT, "condition_number": 4.0, "resolution": 0.02}),
    "coarser than the roots": (STUDY, ("a2", "b1"), {"at": AT, "resolution": 0.3}),
}


def same(one, two):
    for name in ("low", "high", "state", "demand", "poses"):
        np.testing.assert_array_equal(getattr(one, name), getattr(two, name))
    assert one.shares == two.shares
    assert (one.demands, one.designs, one.boxes) == (two.demands, two.designs, two.boxes)


def is_a_partition(found):
    volume = np.prod(found.high - found.low, axis=1)
    whole = math.prod(high - low for low, high in found.of.ranges)
    assert volume.sum() == pytest.approx(whole, rel=1e-9)
    for state, name in enumerate(("inside", "outside", "undecided")):
        assert volume[found.state == state].sum() / whole == pytest.approx(found.shares[name], abs=1e-9)


class Here(Executor):
    """Performs each task at once; `fails` is the number of one that raises."""

    def __init__(self, fails=-1):
        self.count, self.fails = 0, fails

    def submit(self, function, /, *arguments, **_):
        future, self.count = Future(), self.count + 1
        if self.count - 1 == self.fails:
            future.set_exception(ArithmeticError("of a root"))
        else:
            future.set_result(function(*arguments))
        return future


@pytest.mark.slow
@pytest.mark.parametrize("name", ASKED, ids=[name.replace(" ", "-") for name in ASKED])
def test_the_set_does_not_depend_on_the_workers_and_contradicts_no_other(name):
    study, vary, options = ASKED[name]
    told = []
    with ThreadPoolExecutor(1) as one, ThreadPoolExecutor(3) as three:
        found = nd.admissible(study, vary, **options, executor=one, progress=lambda *a: told.append(a))
        same(found, nd.admissible(study, vary, **options, executor=three, threads=2))
    roots = told[-1][1]
    assert told[-1] == (roots, roots, None)
    assert roots == ROOTS or name == "coarser than the roots"
    is_a_partition(found)
    assert found.boxes > found.designs >= roots + (name == "condition number")  # of all workers
    alone = nd.admissible(study, vary, **options)
    assert found.shares["undecided"] <= 1.2 * alone.shares["undecided"] + 1e-3
    ends = np.array(found.of.ranges)
    x = np.random.default_rng(1).uniform(ends[:, 0], ends[:, 1], (2000, len(ends)))
    pairs = set(zip(found.state_of(x), alone.state_of(x), strict=True))
    assert not pairs & {("inside", "outside"), ("outside", "inside")}
    assert {"inside", "outside"} & {one for one, _ in pairs}


def test_its_certificate_is_confirmed_by_the_checker(tmp_path):
    study, vary, options = ASKED["two variables"]
    found = nd.admissible(study, vary, **options, executor=Here())
    checked = nd.check_certificate(found.save_certificate(tmp_path / "designs.certificate"))
    assert checked.proved, checked.words
    assert checked.boxes == len(found.state)


def test_an_interruption_keeps_what_has_come_and_the_next_call_goes_on():
    study, vary, options = ASKED["two variables"]

    def stop(done, total, value):
        if done == 20:
            raise KeyboardInterrupt

    with ThreadPoolExecutor(1) as pool:
        some = nd.admissible(study, vary, **options, executor=pool, progress=stop)
    assert some.interrupted
    is_a_partition(some)
    assert 0.3 < some.shares["undecided"] < 0.8
    whole = nd.admissible(study, vary, **options, executor=Here())
    on = nd.admissible(study, vary, **options, executor=Here(), resume=some)
    assert not on.interrupted
    is_a_partition(on)
    assert on.designs > some.designs
    assert on.shares == pytest.approx(whole.shares, abs=0.01)
    again = nd.admissible(study, vary, **options, resume=some)  # on one machine too
    assert again.shares == pytest.approx(whole.shares, abs=0.01)
    ended = nd.admissible(study, vary, **options, executor=Here(), resume=whole)
    assert ended.shares == pytest.approx(whole.shares, abs=1e-3)
    with pytest.raises(ValueError, match="resume: got the designs of another question"):
        nd.admissible(study, vary, **options | {"condition_number": 9.0}, executor=Here(), resume=some)


def test_a_set_from_its_file_is_gone_on_with(tmp_path):
    study, vary, options = ASKED["two variables"]
    coarse = nd.admissible(study, vary, **options | {"resolution": 0.2})
    loaded = nd.AdmissibleSet.load(coarse.save(tmp_path / "set"))
    same(loaded, coarse)
    assert loaded.of == coarse.of
    assert loaded.of.digest == coarse.of.digest
    fine = {"resolution": 0.05, "threads": 1}
    same(*(nd.admissible(study, vary, **options | fine, resume=one) for one in (loaded, coarse)))


def test_the_error_of_a_root_is_raised():
    study, vary, options = ASKED["two variables"]
    with pytest.raises(ArithmeticError, match="of a root"):
        nd.admissible(study, vary, **options, executor=Here(fails=7))


def test_a_bad_question_is_refused_before_anything_is_sent():
    executor = Here()
    study = nd.Study(variables=SIZES, constraints={"leg_ratio": (1.2, None)})
    with pytest.raises(ValueError, match="leg_ratio: got a least value"):
        nd.admissible(study, ("a2", "b1"), at=AT, executor=executor)
    assert executor.count == 0
