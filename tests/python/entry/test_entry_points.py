"""Every public name under attack: what a call gets in place of each argument is taken, or refused in one good line."""

import enum
import importlib
import inspect

import pytest
from entry_engine import attack
from entry_rows import ROWS
from sizes import LONG

import ninedof as nd
from ninedof import plot, poses
from ninedof.support.arguments import path_argument

for tables in ("entry_rows_design", "entry_rows_places", "entry_rows_figures"):
    importlib.import_module(tables)


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path, monkeypatch):
    """Texts are names of files too."""
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("name", ROWS)
def test_every_argument_is_taken_or_refused_by_name(name):
    tally = attack(name, ROWS[name], 0 if LONG else None)
    print(f"{name}: {tally.tried} tried, {tally.taken} taken, {len(tally.failures)} failures")
    assert not tally.failures, "\n".join([f"{len(tally.failures)} of {tally.tried}:", *tally.failures[:20]])
    assert tally.tried >= 0


# Made by the package, and handed to callers: their fields are what a call has returned, or, of a Design, judged by
# whatever takes it.
RESULTS = {
    *(
        "AssemblyModes",
        "Bounds",
        "Candidate",
        "CertifiedWorkspace",
        "Design",
        "DesignPoint",
        "DeterminantBounds",
        "Ellipsoid",
    ),
    *("ErrorBounds", "Followed", "Front", "InternalPoint", "InternalPointMap", "LegForces", "LimitBreak", "LimitProof"),
    *("LowerBound", "MachineCertificate", "MapAudit", "NearestSingularity", "OptimumProof", "PathLimits", "Result"),
    *("Sheet", "Singularity", "SingularityDistance", "SingularityMargins", "SweepResult", "Trace", "Tracked"),
    *("VelocityMatrices", "WorkspaceCells", "WorkspaceMap", "WorkspaceSlice"),
}


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
    """Every name that can be called: functions, classes that callers make, methods, names of `poses` and `plot`."""
    for name in nd.__all__:
        thing = getattr(nd, name)
        if not inspect.isclass(thing):
            yield name, thing
        elif not issubclass(thing, enum.Enum):
            if name not in RESULTS:
                yield name, thing
            for member in members(thing):
                yield f"{name}.{member}", getattr(thing, member)
    for module in (poses, plot):
        for name in module.__all__:
            if (thing := getattr(module, name)) is not getattr(nd, name, None):
                yield f"{module.__name__.rpartition('.')[2]}.{name}", thing


def parameters(thing):
    """The names of the arguments of a function; None where the compiled core does not tell."""
    try:
        found = inspect.signature(thing).parameters
    except ValueError:
        return set()
    return {n for n, p in found.items() if n != "self" and p.kind not in (p.VAR_KEYWORD, p.VAR_POSITIONAL)}


@pytest.mark.parametrize(("name", "thing"), list(names()), ids=[name for name, _ in names()])
def test_every_public_name_and_argument_has_a_row(name, thing):
    rows = [row for title, row in ROWS.items() if title.partition(":")[0] == name]
    assert rows, f"{name} has no row in tests/python/support/entry_rows*.py: add a good call of it"
    left = parameters(thing).difference(*(row.arguments() for row in rows))
    assert not left, f"the rows of {name} lack the arguments {', '.join(sorted(left))}"


def test_no_row_without_a_name():
    assert {title.partition(":")[0] for title in ROWS} == {name for name, _ in names()}
    assert set(nd.__all__) >= RESULTS


@pytest.mark.parametrize("place", [".", "..", "/", "a b/ü-名.toml", "../x", "y" * 255])
def test_ordinary_places_are_taken(place):
    assert str(path_argument("path", place)) == place


@pytest.mark.parametrize("place", ["", "a\0b", "a\nb", "\x1b[2J", "y" * 256, "a/" * 2000, "\ud800", b"x", 3, None])
def test_other_places_are_refused(place):
    with pytest.raises(ValueError, match=r"^path: got .{0,230}, expected a path[^\n]*$"):
        path_argument("path", place)
