"""What a workspace map says of sets that cells and corners easily miss: its error must cover the truth."""

import numpy as np
import pytest
from sizes import size

import ninedof as nd

BOX = ([-2.5, -2.5, 3.0], [2.5, 2.5, 7.0])
HOME = nd.Configuration.neutral(zp=4.8, zs=2.4)
LEGS = {"leg_limits": (2.5, 6.5)}


def shell(published, width):
    """Limits of l1 alone, and the volume between two spheres about a fixed point, by numpy."""
    low, high = np.zeros(9), np.full(9, np.inf)
    low[0], high[0] = 4.9, 4.9 + width
    joint = published.base_external[0] - published.platform_external[0]
    # Along z the shell is cut exactly; over x and y a midpoint rule.
    n = size(400, 1000)
    x = -2.5 + 5.0 * (np.arange(n) + 0.5) / n
    across = ((x - joint[0]) ** 2)[:, None] + ((x - joint[1]) ** 2)[None, :]

    def height(radius):
        return np.clip(joint[2] + np.sqrt(np.maximum(radius**2 - across, 0.0)), 3.0, 7.0)

    return {"leg_limits": (low, high)}, (height(4.9 + width) - height(4.9)).sum() * (5.0 / n) ** 2


@pytest.mark.slow
@pytest.mark.parametrize("width", [1e-1, 1e-2, 3e-3, 1e-3])
def test_thin_shells(published, width):
    criteria, truth = shell(published, width)
    found = nd.workspace(published, BOX, criteria=criteria, most_evaluations=size(500_000, 2_000_000))
    assert abs(found.volume - truth) <= found.error + found.unseen


@pytest.fixture(scope="module")
def expected(published):
    return nd.workspace(published, ([-10] * 3, [10] * 3), criteria=LEGS, home=HOME)


@pytest.mark.slow
@pytest.mark.parametrize("half", [30.0, 100.0, 160.0, 1000.0])
def test_boxes_much_larger_than_the_workspace(published, expected, half):
    box = ([-half] * 3, [half] * 3)
    found = nd.workspace(published, box, criteria=LEGS, home=HOME, tolerance=size(5e-3, 1e-3))
    assert found.home_allowed
    assert found.status == nd.WorkspaceStatus.CONVERGED or half > 500.0
    assert abs(found.volume - expected.volume) <= found.error + expected.error


@pytest.mark.parametrize(("method", "few"), [("grid", {"resolution": 8}), ("sample", {"points": 200})])
def test_nothing_found_is_not_nothing(published, method, few):
    criteria = {"condition_number": 4.003}
    found = nd.workspace(published, BOX, criteria=criteria, method=method, **few)
    assert found.status == nd.WorkspaceStatus.EMPTY
    assert found.unseen > 0.0
    assert found.error >= nd.workspace(published, BOX, criteria=criteria, home=HOME).volume


@pytest.mark.slow
def test_a_grid_errs_by_less_than_it_says(published):
    reference = nd.workspace(published, BOX, criteria=LEGS, tolerance=size(5e-4, 2e-4))
    for resolution in (16, 32, 48):
        found = nd.workspace(published, BOX, criteria=LEGS, method="grid", resolution=resolution)
        assert abs(found.volume - reference.volume) <= found.error


def test_a_grid_larger_than_allowed_is_refused(published):
    with pytest.raises(ValueError, match=r"resolution: got 64, expected a grid of at most most_evaluations"):
        nd.workspace(published, BOX, criteria=LEGS, method="grid", resolution=64, most_evaluations=100_000)


def test_every_pixel_of_a_slice_is_its_cell(published):
    found = nd.workspace(published, BOX, criteria=LEGS | {"condition_number": 5.0}, tolerance=0.02)
    c = found.cells
    for pixels in (50, 240, 241):
        s = found.slice("z", 4.81, pixels)
        x = -2.5 + 5.0 * (np.arange(pixels) + 0.5) / pixels
        at = np.array([[a, b, 4.81] for b in x[:: pixels // 25] for a in x[:: pixels // 25]])
        seen = s.state[:: pixels // 25, :: pixels // 25].ravel()
        for point, state in zip(at, seen, strict=True):
            away = np.abs(point - c.centre) - 0.5 * c.size
            around = (away <= 1e-9).all(axis=1)  # several on a face
            assert around.any()
            assert state in c.state[around], point
