"""The outline of a region in space and in a plane, against its shape in closed form."""

import numpy as np
import pytest

import ninedof as nd
from ninedof.design.domains.region import region_lines, section_outline

HOME = nd.Configuration.neutral(zp=5.0, zs=3.0)


@pytest.mark.parametrize(
    ("region", "lines"),
    [({"box": [0.3, 0.2, 0.1]}, 6), ({"ball": 0.3}, 3), ({"cylinder": [0.3, 0.1]}, 6)],
)
def test_the_lines_of_a_region_lie_on_its_surface(region, lines):
    found = region_lines(nd.Region(**region), HOME)
    assert len(found) == lines
    at = np.concatenate(found) - HOME.position
    if "ball" in region:
        assert np.linalg.norm(at, axis=1) == pytest.approx(0.3)
    elif "box" in region:
        assert np.abs(at) == pytest.approx(np.broadcast_to([0.3, 0.2, 0.1], at.shape))
    else:
        assert np.hypot(at[:, 0], at[:, 1]) == pytest.approx(0.3)
        assert np.abs(at[:, 2]) == pytest.approx(0.1)


@pytest.mark.parametrize(
    ("region", "reach"),
    [
        (nd.Region(ball=2.0), (2.0, 2.0, 2.0)),
        (nd.Region(cylinder=(2.0, 3.0)), (2.0, 2.0, 3.0)),
        (nd.Region(box=(0.1, 0.2, 0.3), unit="zp"), (0.5, 1.0, 1.5)),
        (nd.Region(path=[[0, 0, 0], [1, 2, 3]]), (0.5, 1.0, 1.5)),
    ],
)
def test_a_region_is_outlined_at_its_size(region, reach):
    points = np.vstack(region_lines(region, HOME))
    assert 0.5 * np.ptp(points, axis=0) == pytest.approx(reach, rel=1e-12)
    for fixed in range(3):
        section = section_outline(region, HOME, fixed, float(HOME.position[fixed]))
        drawn = [k for k in range(3) if k != fixed]
        assert 0.5 * np.ptp(section, axis=0) == pytest.approx([reach[k] for k in drawn], rel=1e-3)
    if region.path is None:
        assert section_outline(region, HOME, 2, 9.0) is None


def test_a_region_of_turns_alone_has_no_outline():
    assert region_lines(nd.Region(tilt=0.1), HOME) == []
