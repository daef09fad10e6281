"""Workspaces that cones limit: volumes by Monte Carlo in plain numpy, balls by the distance from a cone."""

import numpy as np
import pytest
import workspace_oracle as oracle
from scipy.spatial.transform import Rotation
from sizes import size

import ninedof as nd

BOX = ([-4.0, -4.0, 0.0], [4.0, 4.0, 8.0])
TILTED = Rotation.from_rotvec([0.15, -0.1, 0.2]).as_matrix()
HOME = nd.Configuration([0.0, 0.0, 4.0], TILTED, [0.0, 0.0, 2.0])
CRITERIA = {
    "base": {"base_cone": 0.17},
    "platform": {"platform_cone": 0.3},
    "both, one axis": {"base_cone": {"max": 0.8, "axis": [0.1, 0.0, 1.0]}, "platform_cone": 0.9},
    "obtuse": {"base_cone": {"max": 2.6, "axis": [0.0, 0.3, -1.0]}},
    "with legs": {"base_cone": 0.3, "leg_limits": (3.0, 6.5)},
}


def legs_of(g, p, q, platform):
    """Legs at the joints of a body, base frame, and seen from it: shapes (n, 6, 3)."""
    s = oracle.half_way(g, p, q)[:, None]
    upper, inner = (p[:, None] + t @ q.T for t in (g.platform_external, g.platform_internal))
    if platform:
        return np.concatenate([g.base_external - upper, s - inner], axis=1) @ q
    return np.concatenate([upper - g.base_external, s - g.base_internal], axis=1)


def margins(g, p, q, criteria):
    """Limit less angle of every leg, and its length, for each cone: shapes (n, 6)."""
    out = []
    for name, limit in criteria.items():
        if name == "leg_limits":
            continue
        legs = legs_of(g, p, q, name == "platform_cone")
        if isinstance(limit, dict):
            most, axes = limit["max"], np.broadcast_to(np.array(limit["axis"]), (6, 3))
        else:
            most, axes = limit, legs_of(g, HOME.position[None], HOME.rotation, name == "platform_cone")[0]
        axes = axes / np.linalg.norm(axes, axis=-1, keepdims=True)
        length = np.linalg.norm(legs, axis=-1)
        angle = np.arccos(np.clip(np.sum(legs * axes, axis=-1) / length, -1.0, 1.0))
        out.append((most - angle, length))
    return out


@pytest.mark.parametrize("kind", CRITERIA)
def test_cones_alone_are_decided_by_bounds(published, kind):
    """Every cell inside or outside is proved, so that no point of a sample contradicts one."""
    criteria = CRITERIA[kind]
    home = nd.Configuration(HOME.position, TILTED, oracle.half_way(published, HOME.position[None], TILTED)[0])
    found = nd.workspace(published, BOX, criteria=criteria, rotation=TILTED, home=home)
    assert found.status == "converged"
    assert found.evaluations < 300_000
    count, volume = size(100_000, 1_000_000), np.prod(found.high - found.low)
    p = found.low + np.random.default_rng(1).uniform(size=(count, 3)) * (found.high - found.low)
    allowed = np.logical_and.reduce([(m >= 0.0).all(axis=1) for m, _ in margins(published, p, TILTED, criteria)])
    if "leg_limits" in criteria:
        m = oracle.robots(published, p, TILTED, oracle.half_way(published, p, TILTED))
        allowed &= oracle.legs_allowed(m, *criteria["leg_limits"])
    share = allowed.mean()
    scatter = volume * np.sqrt(share * (1.0 - share) / count)
    assert abs(found.volume - share * volume) <= 4.0 * scatter + found.error
    state = oracle.states_at(found.cells, found.low, p)
    assert not (allowed & (state == 0)).any()
    assert not (~allowed & (state == 2)).any()
