"""An entry by a name that a study and its tables do not have: a ValueError with the nearest name."""

import inspect

import pytest

import ninedof as nd

MADE = ("About", "Actuator", "Loads", "Masses", "Objective", "Pose", "Region", "Speeds", "Study", "Tolerances", "Tool")


@pytest.mark.parametrize("name", MADE)
def test_a_name_that_nothing_has_is_told(name):
    given = {
        one.name: None
        for one in inspect.signature(getattr(nd, name)).parameters.values()
        if one.default is one.empty and one.kind is one.POSITIONAL_OR_KEYWORD
    }
    with pytest.raises(ValueError, match=r"\w+: got"):
        getattr(nd, name)(**given, not_a_name=1)


def test_the_nearest_name_is_told():
    for call, nearest in (
        (lambda: nd.Study(constraint={}), "constraints"),
        (lambda: nd.Region(tilts=0.1), "tilt"),
    ):
        with pytest.raises(ValueError, match=rf"got the entry '\w+', expected only .*\(did you mean '{nearest}'\?\)$"):
            call()
