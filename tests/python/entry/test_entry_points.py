"""Every public name under attack: what a call gets in place of each argument is taken, or refused in one good line."""

import enum
import importlib
import inspect
from collections.abc import Iterator

import entry_things as it
import numpy as np
import pytest
from argument_names import argument_names
from entry_engine import attack, bounded
from entry_rows import ROWS
from entry_rows_design import THINGS
from memory import small
from sizes import LONG

import ninedof as nd
from ninedof import poses
from ninedof.support.arguments import path_argument

importlib.import_module("entry_rows_places")  # adds its rows


@pytest.fixture(scope="module", autouse=True)
def _memory():
    with small():
        yield


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path, monkeypatch):
    """Texts are names of files too."""
    monkeypatch.chdir(tmp_path)


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("name", ROWS)
def test_every_argument_is_taken_or_refused_by_name(name):
    tally = attack(name, ROWS[name], LONG)
    print(f"{name}: {tally.tried} tried, {tally.taken} taken, {len(tally.failures)} failures")
    assert not tally.failures, "\n".join([f"{len(tally.failures)} of {tally.tried}:", *tally.failures[:20]])
    assert tally.tried or name == "Study.paper"


# Made by the package, and handed to callers: their fields are what a call has returned, or, of a Design, judged by
# whatever takes it.
RESULTS = set(
    "ArchitectureSingularity AssemblyModes Bounds Candidate CertifiedWorkspace Design DesignPoint DeterminantBounds "
    "Ellipsoid ErrorBounds Followed Front InternalPoint InternalPointMap InverseDynamics LegForces LimitBreak "
    "LimitProof PathPayload Payload Comparison Failure RegionMap AdmissibleRow AdmissibleRows AdmissibleSet LowerBound "
    "MachineCertificate MapAudit NearestSingularity OptimumProof PathLimits Result Sheet Singularity "
    "SingularityDistance SingularityMargins SweepResult Trace Tracked ModesCertificate VelocityMatrices "
    "WorkspaceCells WorkspaceMap WorkspaceSlice".split()
)


def members(cls):
    """Public methods that a class has of its own, or of a base without a public name."""
    for base in cls.__mro__:
        if base in (object, tuple) or (base is not cls and base.__name__ in nd.__all__):
            continue
        for name, thing in vars(base).items():
            # pybind11's static methods are found on the instance alone
            if not name.startswith("_") and callable(getattr(cls, name)) and not inspect.isclass(thing):
                yield name


def names():
    """Every name that can be called: functions, classes that callers make, methods, names of `poses`."""
    for name in nd.__all__:
        thing = getattr(nd, name)
        if not inspect.isclass(thing):
            yield name, thing
        elif not issubclass(thing, enum.Enum):
            if name not in RESULTS:
                yield name, thing
            for member in members(thing):
                yield f"{name}.{member}", getattr(thing, member)
    for name in sorted(set(poses.__all__) - set(nd.__all__)):  # the same order in every worker
        yield f"poses.{name}", getattr(poses, name)


def parameters(thing):
    """The names of the arguments of a function; none where the compiled core does not tell."""
    try:
        return set(argument_names(thing)) - {"self"}
    except ValueError:
        return set()


WITHOUT_ARGUMENTS = [name for name, thing in names() if name not in ROWS and name.partition(".")[0] in THINGS]


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("name", WITHOUT_ARGUMENTS)
def test_a_method_without_arguments_returns(name):
    thing, _, method = name.partition(".")
    with bounded():
        result = getattr(THINGS[thing](), method)()
        assert result is None or len(str(list(result) if isinstance(result, Iterator) else result)) > 0


@pytest.mark.parametrize(("name", "thing"), list(names()), ids=[name for name, _ in names()])
def test_every_public_name_and_argument_has_a_row(name, thing):
    rows = [row for title, row in ROWS.items() if title.partition(":")[0] == name]
    assert rows or name in WITHOUT_ARGUMENTS, (
        f"{name} has no row in tests/python/support/entry_rows*.py: add a good call of it"
    )
    left = parameters(thing).difference(*(row.arguments() for row in rows))
    assert not left, f"the rows of {name} lack the arguments {', '.join(sorted(left))}"


def test_no_row_without_a_name():
    assert {*(title.partition(":")[0] for title in ROWS), *WITHOUT_ARGUMENTS} == {name for name, _ in names()}
    assert set(THINGS) == {name.partition(".")[0] for name in WITHOUT_ARGUMENTS}
    assert set(nd.__all__) >= RESULTS


@pytest.mark.parametrize("place", [".", "..", "/", "a b/ü-名.toml", "../x", "y" * 255])
def test_ordinary_places_are_taken(place):
    assert str(path_argument("path", place)) == place


@pytest.mark.parametrize("place", ["", "a\0b", "a\nb", "\x1b[2J", "y" * 256, "a/" * 2000, "\ud800", b"x", 3, None])
def test_other_places_are_refused(place):
    with pytest.raises(ValueError, match=r"^path: got .{0,230}, expected a path[^\n]*$"):
        path_argument("path", place)


# Rows whose good calls return, at the top or further in, a thing of every class in RESULTS.
RETURNING = (
    "forward_position track velocity_matrices condition_number_bounds determinant_bounds velocity_ellipsoid "
    "error_bounds leg_forces inverse_dynamics best_internal_point best_internal_map singularity singularity_margins "
    "distance_to_singularity nearest_singularity architecture_singularity compare follow path_limits failure "
    "region_map sheet largest_payload payload_along sweep trace Study.evaluate check applicable_bounds "
    "WorkspaceMap.slice"
).split()


def read(thing, seen):
    """Read every property of a public thing and of what it holds; note the classes."""
    if isinstance(thing, list | tuple) and not hasattr(thing, "_fields"):
        for entry in thing[:2]:
            read(entry, seen)
    elif isinstance(thing, dict):
        read(list(thing.values()), seen)
    elif type(thing).__name__ in RESULTS:
        assert len(repr(thing)) > 0
        if hasattr(thing, "_repr_html_"):
            assert isinstance(thing._repr_html_(), str)
        for name in dir(thing):
            if not name.startswith("_") and not callable(value := getattr(thing, name)):
                seen.setdefault(type(thing).__name__, set()).add(name)
                read(value, seen)


def test_every_property_of_every_result_can_be_read():
    seen = {}
    things = [it.result(), it.region_result(), it.certificate(), it.proof(), it.front(), it.workspace(), it.certified()]
    things += [it.admissible_set(), it.admissible_rows()]
    things += [it.design(), nd.follow(it.g(), it.trajectory(), it.c(), limits=(np.zeros(9), np.full(9, 2.0)))]
    for thing in (*things, *(ROWS[name].call(**ROWS[name].arguments()) for name in RETURNING)):
        read(thing, seen)
    assert set(seen) == RESULTS
    print(sum(len(names) for names in seen.values()), "properties")
