"""The atlas: its sequence, its histogram, its best designs; none of them is better than the proved optimum."""

from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction

import design_oracle as designs
import numpy as np
import numpy_model as model
import pytest

import ninedof as nd
from ninedof.conditioning.hexagonal import HEXAGONAL
from ninedof.sweep.atlas import BLOCK, CHUNK, AtlasWork
from ninedof.sweep.survey import (
    BOUNDS,
    STEPS,
    Sample,
    Tally,
    closed_form,
    condition_edges,
    ratio_edges,
    squared_radius_ratio,
)

RATIO_EDGES, CONDITION_EDGES = ratio_edges(), condition_edges()
OPTIMUM = 3.762659  # of the paper's study, proved in the theory notes


def oracle(x):
    """Condition numbers by LAPACK, joints and J' assembled from their equations."""
    v = dict(zip(HEXAGONAL, np.asarray(x).T, strict=True))
    zero = np.zeros(len(x))
    m = model.Robot(
        *designs.joints("hexagonal", v),
        np.stack([zero, zero, v["zp"]], -1),
        np.broadcast_to(np.eye(3), (len(x), 3, 3)),
        np.stack([zero, zero, v["zs"]], -1),
    )
    sigma = model.singular_values(m)
    return sigma[:, 0] / sigma[:, -1]


@pytest.fixture(scope="module")
def survey():
    return nd.atlas(40_000, seed=3)


@pytest.fixture(scope="module")
def all_designs():
    return Sample(3).designs(0, 40_000)


@pytest.fixture(scope="module")
def kappas(all_designs):
    return oracle(all_designs)


def test_the_closed_form_against_lapack(all_designs, kappas):
    """At 40 000 designs; LAPACK loses digits with the condition number."""
    np.testing.assert_allclose(closed_form(all_designs) / kappas, 1.0, rtol=0.0, atol=1e-8)


def test_every_design_is_counted_in_its_bin(survey, all_designs, kappas):
    ratio = np.sqrt(squared_radius_ratio(all_designs))
    rows = np.searchsorted(RATIO_EDGES, ratio, side="right") - 1
    columns = np.searchsorted(CONDITION_EDGES, kappas, side="right") - 1
    counts = np.zeros_like(survey["histogram"])
    np.add.at(counts, (rows, columns), 1)
    # Rounding moves a design across an edge that it is on to the last digits; none of these is.
    assert np.abs(ratio[:, None] / RATIO_EDGES[1:] - 1.0).min() > 1e-12
    assert np.abs(kappas[:, None] / CONDITION_EDGES - 1.0).min() > 1e-12
    np.testing.assert_array_equal(survey["histogram"], counts)
    for row in range(len(RATIO_EDGES)):
        mine = np.flatnonzero(rows == row)
        if not mine.size:
            assert np.isnan(survey["best"][row])
            assert survey["number"][row] == -1
            assert np.isnan(survey["design"][row]).all()
            continue
        best = mine[np.argmin(kappas[mine])]
        assert survey["number"][row] == best
        assert survey["best"][row] == pytest.approx(kappas[best], rel=1e-9)
        assert survey["design"][row].tolist() == all_designs[best].tolist()


def test_the_radius_ratio_is_that_of_the_studies(all_designs):
    study = nd.Study(constraints={"radius_ratio": (None, 2.0)})
    for x, squared in zip(all_designs[:50], squared_radius_ratio(all_designs[:50]), strict=True):
        point = study.evaluate(dict(zip(HEXAGONAL, x.tolist(), strict=True)))
        assert 2.0 * (1.0 - point.margins["radius_ratio"]) == pytest.approx(np.sqrt(squared), rel=1e-12)
        radii = [np.linalg.norm(t[0]) for t in (point.geometry.base_external, point.geometry.platform_external)]
        assert radii[0] / radii[1] == pytest.approx(np.sqrt(squared), rel=1e-12)


def test_no_design_is_better_than_the_proved_optimum():
    survey = nd.atlas(2_000_000, seed=1)
    up_to_two = survey["best"][: int(np.searchsorted(RATIO_EDGES, 2.0))]
    assert OPTIMUM < np.nanmin(up_to_two) < 1.1 * OPTIMUM
    narrow = {"a1": (0.0, 0.01), "a2": (5.9, 6.1), "b1": (2.95, 3.05), "b2": (0.0, 0.01), "zp": (4.9, 5.0)}
    near = nd.atlas(200_000, bounds={**narrow, "zs_fraction": (0.63, 0.65)})
    up_to_two = near["best"][: int(np.searchsorted(RATIO_EDGES, 2.0))]
    assert OPTIMUM < np.nanmin(up_to_two) < 1.005 * OPTIMUM


# --- The sequence -----------------------------------------------------------------------------------------------------


def test_steps_are_powers_of_the_root():
    low, high = Fraction(1), Fraction(2)
    for _ in range(140):
        middle = (low + high) / 2
        low, high = (middle, high) if middle**7 < middle + 1 else (low, middle)
    for k, step in enumerate(STEPS):
        assert abs(step - 2**64 / low ** (k + 1)) <= 1


def test_designs_by_number_do_not_depend_on_the_chunk():
    drawn = Sample(7)
    whole = drawn.designs(10**11, 10**11 + 1000)
    parts = [drawn.designs(10**11 + k, 10**11 + min(k + 77, 1000)) for k in range(0, 1000, 77)]
    assert np.concatenate(parts).tobytes() == whole.tobytes()
    numbers = np.array([10**11 + 5, 10**11, 10**11 + 999], dtype=np.uint64)
    assert drawn.at(numbers).tobytes() == whole[[5, 0, 999]].tobytes()


@pytest.mark.parametrize("first", [0, 10**12])
def test_designs_fill_their_bounds_evenly(first):
    """In every variable and every pair, closer to uniform than random numbers, also at large numbers."""
    bounds = {"a1": (1.0, 3.0), "zp": (2.0, 4.0), "zs_fraction": (0.25, 0.75)}
    x = Sample(0, tuple((BOUNDS | bounds).values())).designs(first, first + 65536)
    unit = np.stack(
        [(x[:, 0] - 1) / 2, *(x[:, k] / 10 for k in (1, 2, 3)), (x[:, 4] - 2) / 2, (x[:, 5] / x[:, 4] - 0.25) * 2]
    )
    assert unit.min() >= 0.0
    assert unit.max() <= 1.0
    for row in unit:
        assert np.abs(np.sort(row) - (np.arange(65536) + 0.5) / 65536).max() < 2e-3  # by chance 4e-3
    for j in range(6):
        for k in range(j):
            counts = np.histogram2d(unit[j], unit[k], bins=16, range=[[0, 1], [0, 1]])[0]
            assert np.abs(counts / 256 - 1.0).max() < 0.15  # by chance 0.19


def test_seeds_differ():
    one, other = (Sample(seed).designs(0, 100) for seed in (0, 1))
    assert not np.isin(one, other).any()


# --- Chunks -----------------------------------------------------------------------------------------------------------


def same(one, other):
    for name in one:
        assert one[name].tobytes() == other[name].tobytes(), name


@pytest.mark.parametrize("options", [{"chunk": 999}, {"chunk": 7000}, {"chunk": 10**7}])
def test_chunks_change_nothing(survey, options):
    same(nd.atlas(40_000, seed=3, **options), survey)


def test_an_executor_changes_nothing(survey):
    with ThreadPoolExecutor(3) as pool:
        same(nd.atlas(40_000, seed=3, chunk=1000, executor=pool), survey)


def test_tallies_add_up_in_any_order_and_ties_go_to_the_first():
    order = np.random.default_rng(0).permutation(8)
    parts = []
    for k in range(8):
        tally = Tally()
        tally.add(100 * k, np.full(100, 2.0), np.full(100, 5.0 + (k == 3)))
        parts.append(tally)
    total = Tally()
    for k in order:
        total = total.plus(parts[k])
    row = int(np.flatnonzero(total.number >= 0)[0])
    assert (total.number[row], total.best[row], total.histogram.sum()) == (0, 5.0, 800)


def test_values_out_of_range_are_counted_in_the_outermost_bins():
    tally = Tally()
    squared = np.array([0.0, 1e-9, 1e9, np.inf, np.nan, 1.0, 1.0])
    kappa = np.array([1.0, 2.0, 3.0, 4.0, np.inf, np.inf, np.nan])
    tally.add(0, squared, kappa)
    assert tally.histogram.sum() == 7
    assert tally.histogram[0].sum() == 2
    assert tally.histogram[-1].sum() == 3
    assert tally.histogram[:, -1].sum() == 3
    assert tally.number[[0, -1]].tolist() == [0, 2]
    assert tally.number[64 + 1] == -1, "nothing singular is best"


def test_fewer_designs_than_asked_are_an_error(monkeypatch):
    real = AtlasWork.values
    monkeypatch.setattr(AtlasWork, "values", lambda self, first, last: real(self, first, last - 1))
    with pytest.raises(RuntimeError, match="got 39990 designs, expected 40000"):
        nd.atlas(40_000, seed=3, chunk=4000)


def test_memory_does_not_grow_with_the_number(monkeypatch):
    """Peak of what numpy and Python allocate, for one million designs and for four."""
    import tracemalloc

    peaks = []
    for count in (1_000_000, 4_000_000):
        tracemalloc.start()
        nd.atlas(count)
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert peaks[1] < 1.2 * peaks[0]
    assert peaks[1] < 64e6


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("flat", ["a1 a2", "b1 b2", "a1 a2 b1 b2", "zp", "a1 a2 b1 b2 zp"])
def test_plates_of_size_0_are_counted_without_a_warning(flat):
    survey = nd.atlas(1000, bounds=dict.fromkeys(flat.split(), (0.0, 0.0)))
    assert survey["histogram"].sum() == 1000


@pytest.mark.filterwarnings("error")
def test_enormous_plates_are_counted_too():
    assert nd.atlas(100, bounds={"a1": (1e300, 1e300)})["histogram"][-1].sum() == 100


def test_progress():
    seen = []
    nd.atlas(10_000, chunk=1000, progress=lambda *a: seen.append(a))
    assert [done for done, *_ in seen] == list(range(0, 11_000, 1000))
    assert BLOCK < CHUNK
