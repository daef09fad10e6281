"""An argument by a name that nothing has: a ValueError with the nearest name, of functions and of what people make."""

import inspect

import pytest

import ninedof as nd

MADE = ("About", "Actuator", "Loads", "Masses", "Objective", "Pose", "Region", "Speeds", "Study", "Tolerances", "Tool")
FUNCTIONS = [name for name in nd.__all__ if inspect.isfunction(getattr(nd, name))]


@pytest.mark.parametrize("name", [*MADE, *FUNCTIONS])
def test_a_name_that_nothing_has_is_told(name):
    given = {
        one.name: None
        for one in inspect.signature(getattr(nd, name)).parameters.values()
        if one.default is one.empty and one.kind is one.POSITIONAL_OR_KEYWORD
    }
    with pytest.raises(ValueError, match=r"\w+: got"):
        getattr(nd, name)(**given, not_a_name=1)


def test_the_nearest_name_is_told(published, neutral):
    for call, nearest in (
        (lambda: nd.Study(constraint={}), "constraints"),
        (lambda: nd.failure(published, neutral, pair=True), "pairs"),
        (lambda: nd.stiffness(published, neutral, stiff=1.0), "leg_stiffness"),
        (lambda: nd.Region(tilts=0.1), "tilt"),
    ):
        with pytest.raises(ValueError, match=rf"got the entry '\w+', expected only .*\(did you mean '{nearest}'\?\)$"):
            call()
