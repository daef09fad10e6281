"""The public face: names, documentation, what importing costs, how a broken installation speaks."""

import ast
import doctest
import functools
import inspect
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from argument_names import argument_names

import ninedof as nd
from ninedof import _core

PACKAGE = Path(nd.__file__).parent
FUNCTIONS = [name for name in nd.__all__ if inspect.isfunction(getattr(nd, name))]
CLASSES = [name for name in nd.__all__ if inspect.isclass(getattr(nd, name))]

# Fixed in the notes on public names, as far as this stage of the project goes.
PROMISED = {
    "Configuration": "position rotation internal_point",
    "characteristic_length": "geometry configuration kind",
    "condition_number": "geometry configuration characteristic_length norm threads out",
    "forward_acceleration": "geometry configuration leg_rates leg_accelerations",
    "forward_velocity": "geometry configuration leg_rates",
    "internal_velocity": "geometry configuration omega pdot weights",
    "inverse_acceleration": "geometry configuration omega pdot sdot alpha pddot sddot",
    "inverse_velocity": "geometry configuration omega pdot sdot weights",
    "isotropy_residual": "geometry configuration characteristic_length",
    "jacobian": "geometry configuration characteristic_length",
    "jacobian_rate": "geometry configuration omega pdot sdot characteristic_length",
    "leg_lengths": "geometry configuration",
    "manipulability": "geometry configuration characteristic_length",
    "optimize": "study starts seed threads progress",
    "singular_values": "geometry configuration characteristic_length",
    "sweep": "geometry home over index",
    "velocity_matrices": "geometry configuration characteristic_length",
}


def run(code, **environment):
    """Run Python in a fresh interpreter; return its output."""
    path = os.pathsep.join([str(PACKAGE.parent), os.environ.get("PYTHONPATH", "")])
    return subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
        env=os.environ | {"PYTHONPATH": path} | environment,
    )


def test_every_public_name_is_there_and_no_other():
    assert sorted(nd.__all__) == list(nd.__all__)
    assert set(FUNCTIONS) | set(CLASSES) == set(nd.__all__)
    here = {"Geometry", "Study", "Status", "Result", *PROMISED}
    assert here <= set(nd.__all__)
    assert re.fullmatch(r"\d+\.\d+\.\d+.*", nd.__version__)


@pytest.mark.parametrize(("name", "parameters"), PROMISED.items(), ids=PROMISED.keys())
def test_promised_parameters_keep_name_and_order(name, parameters):
    found = list(inspect.signature(getattr(nd, name)).parameters)
    assert found[: len(parameters.split())] == parameters.split()


def test_promised_defaults():
    defaults = {n: p.default for n, p in inspect.signature(nd.condition_number).parameters.items()}
    assert (defaults["characteristic_length"], defaults["norm"], defaults["threads"], defaults["out"]) == (
        1.0,
        "2",
        None,
        None,
    )
    assert inspect.signature(nd.characteristic_length).parameters["kind"].default == "optimal"
    assert inspect.signature(nd.Configuration.neutral).parameters["theta_z"].default == 0.0
    assert [str(s) for s in nd.Status] == ["optimal", "unbounded", "infeasible", "stopped"]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_functions_document_every_parameter(name):
    function = getattr(nd, name)
    doc = inspect.getdoc(function)
    assert re.match(r"[A-Z].*[.:]\n?", doc)
    described = doc
    if borrowed := re.search(r"Parameters as in `(\w+)`", doc):
        described += inspect.getdoc(getattr(nd, borrowed.group(1)))
    else:
        assert "\nParameters\n----------\n" in doc
    for parameter in argument_names(function):
        assert re.search(rf"^[\w, ]*\b{parameter}\b[\w, ]* :|^{parameter}\b", described, flags=re.MULTILINE), parameter


@pytest.mark.parametrize("name", CLASSES)
def test_classes_document_every_public_member(name):
    cls = getattr(nd, name)
    assert inspect.getdoc(cls)
    members = [
        n
        for n in vars(cls)
        if not n.startswith("_") and (callable(getattr(cls, n)) or isinstance(vars(cls)[n], property))
    ]
    for member in members:
        assert inspect.getdoc(inspect.getattr_static(cls, member)), f"{name}.{member}"


@functools.cache
def examples():
    """Every docstring with examples, those of compiled classes and of private modules too."""
    modules = [m for n, m in sorted(sys.modules.items()) if n == "ninedof" or n.startswith("ninedof.")]
    parser, seen = doctest.DocTestParser(), {}
    for module in modules:
        for name, thing in [("", module), *inspect.getmembers(module)]:
            # The docstrings of matplotlib's and numpy's objects have examples too: not ours to run.
            if type(thing).__module__.startswith(("matplotlib", "mpl_toolkits", "numpy")):
                continue
            ours = inspect.isclass(thing) and thing.__module__.startswith("ninedof")
            members = inspect.getmembers(thing) if ours else []
            for label, item in [(name, thing), *((f"{name}.{n}", x) for n, x in members)]:
                doc = getattr(item, "__doc__", None)
                origin = getattr(item, "__module__", None) or module.__name__
                if isinstance(doc, str) and ">>>" in doc and str(origin).startswith("ninedof"):
                    seen[doc] = parser.get_doctest(doc, {}, f"{module.__name__}.{label}", None, 0)
    return list(seen.values())


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("test", examples(), ids=lambda test: test.name)
def test_examples_in_docstrings(test):
    runner = doctest.DocTestRunner(verbose=False)
    report = []
    runner.run(test, out=report.append)
    assert runner.summarize(verbose=False).failed == 0, "".join(report)


def test_the_examples_are_found():
    names = " ".join(test.name for test in examples())
    for name in ("Geometry", "Configuration", "Study", "condition_number", "leg_lengths", "optimize"):
        assert name in names


# --- Importing --------------------------------------------------------------------------------------------------------


IN_TURN = """
import sys
def loaded():
    return sorted(m for m in sys.modules if sys.modules[m] is not None)
def tell(name, value):
    print(name, repr(value), sep="=", flush=True)
import numpy
tell("numpy", loaded())
import ninedof as nd
tell("own", sorted(m for m in loaded() if m.startswith("ninedof.")))
tell("listed", "plot" in dir(nd))
before = {name: getattr(nd, name) for name in nd.__all__}
tell("imported", loaded())
tell("callable", all(callable(thing) for thing in before.values()))

optional = {"matplotlib", "rich", "typer", "scipy", "xarray", "distributed"} - set(sys.modules)
sys.modules |= dict.fromkeys(optional)
tell("main job", nd.optimize(nd.Study.paper()).status.value)
for name in optional:
    del sys.modules[name]

tell("with figures", (nd.plot.__name__, callable(nd.plot.front), loaded()))

import importlib
for module in MODULES:
    importlib.import_module(module)
import ninedof.optimize.result
from ninedof import paper, plot, poses
tell("rooms", callable(poses.box) and callable(plot.save))
tell("hidden", [name for name in before if getattr(nd, name) is not before[name]])
"""


@pytest.fixture(scope="module")
def told():
    """What an interpreter says that imports first the package, then figures, then all modules."""
    modules = [
        ".".join(["ninedof", *path.relative_to(PACKAGE).with_suffix("").parts]).removesuffix(".__init__")
        for path in sorted(PACKAGE.rglob("*.py"))
        if path.name != "__main__.py"
    ]
    assert {"ninedof.optimize.result", "ninedof.support.kept.store", "ninedof.cli.app"} <= set(modules)
    result = run(f"MODULES = {modules!r}\n{IN_TURN}")
    assert result.stderr == ""
    return {
        name: ast.literal_eval(value) for name, value in (line.split("=", 1) for line in result.stdout.splitlines())
    }


def test_import_is_light(told):
    """A name is loaded when it is used: figures, tables and the command line with none; scipy is never needed."""
    assert told["own"] == ["ninedof._core", "ninedof.support", "ninedof.support.starting"]
    loaded = {module.partition(".")[0] for module in told["imported"]}
    assert {"ninedof", "numpy"} <= loaded
    assert not {"matplotlib", "rich", "typer", "scipy", "xarray", "dask", "tomli_w", "hypothesis", "pytest"} & loaded


LATE = """ast asyncio base64 bz2 concurrent.futures csv decimal email hashlib hmac html importlib.metadata
importlib.resources inspect logging lzma mmap multiprocessing pkgutil random secrets shlex shutil socket ssl subprocess
tempfile tomllib unittest zipfile ninedof.cli.app ninedof.export.model ninedof.paper.comparison ninedof.plot
ninedof.records.record ninedof.report.page ninedof.viewer.app""".split()


def test_import_leaves_out_what_a_call_may_need_later(told):
    """With all public names loaded. The time of `import ninedof` over numpy, 0.01 s, is kept by the list above."""
    assert sorted(set(LATE) & set(told["imported"]) - set(told["numpy"])) == []


def test_bound_classes_and_their_attributes_have_docstrings():
    classes = {name: kind for name, kind in vars(_core).items() if inspect.isclass(kind)}
    parts = {f"{name}.{of}": one for name, kind in classes.items() for of, one in vars(kind).items()}
    attributes = {name: one for name, one in parts.items() if isinstance(one, property)}
    assert len(attributes) > 250
    assert [name for name, thing in (classes | attributes).items() if not inspect.getdoc(thing)] == []


def test_figures_need_no_pyplot(told):
    name, drawn, loaded = told["with figures"]
    assert (name, drawn) == ("ninedof.plot", True)
    assert "matplotlib.figure" in loaded
    assert "matplotlib.pyplot" not in loaded


def test_figures_are_an_attribute_that_is_loaded_late(told):
    assert told["listed"]
    assert "ninedof.plot" not in told["imported"]
    with pytest.raises(AttributeError, match="no attribute 'plott'"):
        _ = nd.plott


def test_a_function_of_a_script_that_names_the_package_goes_to_another_process():
    """As Dask sends it: cloudpickle looks modules up by their type."""
    pytest.importorskip("cloudpickle")
    code = """
import cloudpickle, pickle, sys, ninedof as nd
def index(g, c):
    return nd.condition_number(g, c)
assert pickle.loads(cloudpickle.dumps(index)).__globals__["nd"] is nd
print("the same")
"""
    result = run(code)
    assert result.stdout == "the same\n", result.stderr


def test_the_main_job_without_optional_packages(told):
    assert told["main job"] == "optimal"


def test_no_module_hides_a_public_name_however_late_it_is_imported(told):
    """Rooms have names of functions, such as optimize: an import of a module sets the room as attribute of ninedof."""
    assert told["callable"]
    assert told["rooms"]
    assert told["hidden"] == []


def test_missing_compiled_part_says_what_to_do(tmp_path):
    shutil.copytree(PACKAGE, tmp_path / "ninedof", ignore=shutil.ignore_patterns("_core*.so", "__pycache__"))
    assert not list((tmp_path / "ninedof").glob("_core*.so"))
    result = run(f"import sys; sys.path.insert(0, {str(tmp_path)!r})\nimport ninedof")
    assert result.returncode == 1
    last = result.stderr.strip().splitlines()[-1]
    assert last.startswith("ImportError: the compiled part of ninedof")
    assert "pip install" in last


def test_types_are_shipped():
    assert (PACKAGE / "py.typed").is_file()
    assert list(PACKAGE.glob("_core*.pyi")) or (PACKAGE / "_core" / "__init__.pyi").is_file()
