"""What is said of the package in several places agrees: versions, requirements, interpreters, licences."""

import re
import tomllib
from pathlib import Path

import numpy as np
import pytest

import ninedof as nd

ROOT = Path(__file__).parents[3]
SETTINGS = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
RECIPE = (ROOT / "packaging/conda/meta.yaml").read_text(encoding="utf-8")


def pairs(requirements):
    """Names and versions of requirements, without what conda calls otherwise and without markers."""
    cleaned = (re.sub(r"[;#].*", "", text).strip() for text in requirements)
    found = (re.fullmatch(r"([A-Za-z0-9_-]+)(?:\[.*?\])?\s*(.*)", text).groups() for text in cleaned)
    return {name.removesuffix("-base"): version.replace(" ", "") for name, version in found}


def listed(section):
    """The requirements under `section:` of the recipe."""
    (block,) = re.findall(rf"^  {section}:\n((?:    .*\n)+)", RECIPE, flags=re.MULTILINE)
    return [line.strip().removeprefix("- ") for line in block.splitlines()]


def test_the_recipe_has_the_version_and_the_requirements_of_the_package():
    (version,) = re.findall(r'set version = "(.*)"', RECIPE)
    assert f"VERSION {version} " in (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    needed = pairs(listed("run"))
    assert needed.pop("python") == ""
    assert needed == pairs(SETTINGS["project"]["dependencies"])
    built = pairs(listed("host"))
    for name, wanted in pairs(SETTINGS["build-system"]["requires"]).items():
        if name != "cmeel-eigen":
            assert built[name] == wanted, name


def test_every_interpreter_of_the_classifiers_gets_a_wheel():
    named = re.findall(r":: 3\.(\d+)", "\n".join(SETTINGS["project"]["classifiers"]))
    assert SETTINGS["tool"]["cibuildwheel"]["build"].split() == [f"cp3{minor}-*" for minor in named]
    assert SETTINGS["project"]["requires-python"] == f">=3.{named[0]}"


def test_what_a_wheel_carries_has_its_licence_in_the_wheel():
    """The table of licenses/README.md names each text, and NLopt and Eigen in the versions that are built with."""
    patterns = SETTINGS["project"]["license-files"]
    taken = {path.name for pattern in patterns for path in ROOT.glob(pattern)}
    table = (ROOT / "licenses/README.md").read_text(encoding="utf-8")
    assert taken - {"README.md"} == set(re.findall(r"`([A-Za-z0-9]+\.txt|LICENSE)`", table))
    (nlopt,) = re.findall(r"^version=(.*)$", (ROOT / "packaging/nlopt.sh").read_text(encoding="utf-8"), flags=re.M)
    assert f"| {nlopt} | linked statically" in table
    (eigen,) = (text for text in SETTINGS["build-system"]["requires"] if text.startswith("cmeel-eigen"))
    assert f"| {eigen.partition('==')[2]} | headers | MPL 2.0" in table
    assert "Dieter Kraft" in (ROOT / "licenses/NLopt.txt").read_text(encoding="utf-8")


def test_every_requirement_has_a_lower_bound():
    wanted = SETTINGS["project"]["dependencies"] + SETTINGS["build-system"]["requires"]
    for name in ("cad", "cluster", "sweep", "viewer"):
        wanted = wanted + SETTINGS["project"]["optional-dependencies"][name]
    assert [text for text in wanted if not re.search(r">=|==", text)] == []


@pytest.mark.parametrize("script", sorted(path.name for path in (ROOT / "packaging").glob("*.sh")))
def test_scripts_stop_at_the_first_failure_and_say_how_they_are_called(script):
    text = (ROOT / "packaging" / script).read_text(encoding="utf-8")
    assert "\nset -euo pipefail\n" in text
    assert f"packaging/{script}" in text.split("\nset ")[0]


def test_main_results_are_those_that_every_build_must_give():
    """`packaging/agree.py` compares builds in these numbers; the known ones of them are what is known."""
    import runpy

    numbers = runpy.run_path(str(ROOT / "packaging/agree.py"))["main_results"](nd)
    assert all(np.isfinite(value) for value in numbers.values())
    assert numbers["optimum, base at most twice the platform"] == pytest.approx(3.76265907859605, rel=1e-9)
    assert numbers["published design at zs 2.3745"] == pytest.approx(3.9110, abs=5e-5)
