"""Variables of a robot in the families that can make it."""

import pytest
from sizes import size

import ninedof as nd
from ninedof import _core
from ninedof.design.variables import variables_of

WIDER = {
    "hexagonal": {"hexagonal", "general"},
    "symmetric": {"symmetric", "symmetric_nonplanar", "general"},
    "symmetric_nonplanar": {"symmetric_nonplanar", "general"},
    "general": {"general"},
}


@pytest.mark.parametrize("family", WIDER)
def test_random_designs_are_found_in_every_family_that_has_them(family):
    bounds = {}
    if family == "general":
        names = [one.name for one in _core.family_variables(family) if one.kind == "coordinate"]
        bounds = dict.fromkeys(names, (-5.0, 5.0)) | {"theta_z": (-3.0, 3.0)}
    study = nd.Study(family, bounds)
    names = study.problem().names
    for row in study.problem().starts(size(10, 300), 3):
        point = study.evaluate(dict(zip(names, row.tolist(), strict=True)))
        fits = set()
        for other in _core.design_family_names():
            found = variables_of(other, point.geometry, point.configuration)
            if found is None:
                continue
            fits.add(other)
            again = nd.Study(other, found).evaluate(found)
            assert again.condition_number == pytest.approx(point.condition_number, rel=1e-6)
        assert fits == WIDER[family]


def test_a_pose_off_the_axis_has_no_variables(published):
    assert variables_of("general", published, nd.Configuration([0.1, 0, 4.0], internal_point=[0, 0, 2])) is None
    tilted = nd.Configuration.neutral(4.0, 2.0).moved([0.1, 0, 0, 0, 0, 0, 0, 0, 0])
    assert variables_of("general", published, tilted) is None
