"""The figure of a workspace: one colour scale for all sections."""

import numpy as np
import pytest

from ninedof.plot.workspace import Section, workspace
from ninedof.workspace import WorkspaceSlice


def section(kappa):
    ticks = np.linspace(0.0, 1.0, kappa.shape[0])
    state, limit = np.full(kappa.shape, 2, dtype=np.uint8), np.full(kappa.shape, -1, dtype=np.int16)
    return Section(WorkspaceSlice(("x", "z"), ("y", 0.0), ticks, ticks, state, limit, kappa))


@pytest.mark.parametrize(("worst", "top"), [(np.inf, 7.0), (1e9, 90.0), (12.0, 12.0)])
def test_sections_share_one_scale_of_colours_whatever_the_worst_value(worst, top):
    rng = np.random.default_rng(1)
    near, far = rng.uniform(3.0, 4.0, (8, 8)), rng.uniform(5.0, 7.0, (8, 8))
    far[0, 0] = worst
    percentiles = np.append(np.linspace(3.0, 7.0, 100), worst)
    figure = workspace([section(near), section(far)], [], {}, percentiles, np.empty((0, 4)))
    maps = [axes.images[0] for axes in figure.axes if len(axes.images) == 2]
    assert [image.get_clim() for image in maps] == [(3.0, top)] * 2
    assert not np.ma.getmaskarray(maps[1].get_array()).any()  # the infinite value has the last colour
    assert maps[1].to_rgba(maps[1].get_array())[0, 0].tolist() == list(maps[1].cmap(2.0))
