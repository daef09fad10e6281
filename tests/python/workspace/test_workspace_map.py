"""Maps of workspaces: cells, limits, sections, files, figures, and arguments."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import ninedof as nd

BOX = ([-2.5, -2.5, 3.0], [2.5, 2.5, 7.0])
LEGS = {"leg_limits": (2.5, 6.5)}
HOME = nd.Configuration.neutral(zp=4.8, zs=2.4)


@pytest.fixture(scope="module")
def found(published):
    return nd.workspace(published, BOX, criteria=LEGS | {"condition_number": 5.0, "singularity_free": True}, home=HOME)


def test_cells_add_up_to_the_volume(found):
    c = found.cells
    assert_allclose(np.prod(c.size, axis=1).sum(), np.prod(found.high - found.low))
    counted = c.piece == 0
    assert_allclose((c.fraction * np.prod(c.size, axis=1))[counted].sum(), found.volume, rtol=2e-2)
    assert set(np.unique(c.state)) == {0, 1, 2}
    assert (c.fraction[c.state == 2] == 1.0).all()
    assert (c.fraction[c.state == 0] == 0.0).all()
    assert (c.limit[c.state == 2] == -1).all()
    assert (c.limit[(c.state == 0)] >= 0).all()


def test_shares_of_the_limits_sum_to_one(found):
    limits = found.limits()
    assert_allclose(sum(limits.values()), 1.0)
    assert list(limits.values()) == sorted(limits.values(), reverse=True)
    grouped = found.limits(grouped=True)
    assert set(grouped) == {"leg_limits", "condition_number"}
    assert_allclose(grouped["condition_number"], limits["condition_number"])
    # The robot looks the same after a third of a turn: so do its limits.
    for end in ("high", "low"):
        shares = [limits.get(f"{leg}{k} {end}", 0.0) for leg in "lq" for k in (1, 2, 3)]
        assert np.ptp(shares[:3]) < 0.05
        assert np.ptp(shares[3:]) < 0.05


def test_the_limit_of_a_cell_is_a_margin_with_a_zero_there(published, found):
    c = found.cells
    names = np.array(found.limit_names)[c.limit]
    cells = np.flatnonzero((c.state == 1) & (c.fraction > 0.3) & (c.fraction < 0.7))
    at = nd.Configuration(c.centre[cells], None, 0.5 * c.centre[cells])
    lengths, kappa = nd.leg_lengths(published, at), nd.condition_number(published, at)
    diagonal = np.linalg.norm(c.size[cells], axis=1)
    order = ["l1", "l2", "l3", "q1", "q2", "q3", "r1", "r2", "r3"]
    for k, name in enumerate(names[cells]):
        if name == "condition_number":
            assert abs(kappa[k] - 5.0) < 0.2
        else:
            leg, end = name.split(" ")
            assert abs(lengths[k, order.index(leg)] - (2.5 if end == "low" else 6.5)) <= diagonal[k]


# --- Ends of the range ------------------------------------------------------------------------------------------------


def test_an_empty_workspace_has_no_numbers(published):
    empty = nd.workspace(published, BOX, criteria={"leg_limits": (0.0, 2.0)})
    assert np.isnan([empty.conditioning_index, *empty.percentiles]).all()
    assert empty.limits() == {}


def test_the_number_of_evaluations_is_limited(published):
    limited = nd.workspace(published, BOX, criteria=LEGS, tolerance=1e-6, most_evaluations=60_000)
    assert limited.status == "limited"
    assert limited.evaluations <= 60_000
    assert limited.error > 1e-6 * limited.volume


def test_a_section_shows_no_cell_without_an_allowed_part(published):
    """With the best O and singularities cells are left undecided, along the frame of the box and elsewhere."""
    found = nd.workspace(
        published,
        ([-4, -4, 0], [4, 4, 8]),
        criteria={"leg_limits": (1.5, 6.5), "singularity_free": True},
        home=nd.Configuration.neutral(3.9828, 2.4435),
        internal_point="best",
        resolution=4,
        tolerance=0.5,
    )
    cells = found.cells
    undecided = np.flatnonzero((cells.state == 1) & (cells.fraction == 0.0))
    assert undecided.size > 0
    for n in undecided[:: max(1, undecided.size // 10)]:
        section = found.slice("y", float(cells.centre[n, 1]))
        assert section.axes == ("x", "z")
        h = np.abs(section.horizontal - cells.centre[n, 0]).argmin()
        v = np.abs(section.vertical - cells.centre[n, 2]).argmin()
        assert section.state[v, h] == 0
        assert np.isnan(section.condition_number[v, h])
