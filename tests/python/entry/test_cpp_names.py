"""Every function of a public C++ header is in some C++ test."""

import re
from pathlib import Path

import pytest
from layering_cpp import without_comments

ROOT = Path(__file__).resolve().parents[3]
HEADERS = ROOT / "cpp/include/ninedof"
TESTS = ROOT / "tests/cpp"
# Called through what is tested, and by the Python tests through their bindings.
ELSEWHERE = set(
    """
    axis_condition_number_bounds format_interval from_sums
    hull leg_ends leg_row optimize_placed place_in_region placer require_sound_arithmetic
    search_region_placed singular_value_bounds slope_of_abs slope_of_root solver_version triangular_block
    vec3
    """.split()
)

if not HEADERS.is_dir():
    pytest.skip("the sources of the core are not here", allow_module_level=True)


def declared(text):
    """Names of functions at the outermost level of the namespace."""
    text = re.sub(r"\bnamespace detail \{.*?^\}", "", without_comments(text), flags=re.DOTALL | re.MULTILINE)
    functions = re.findall(
        r"^[A-Za-z][\w:<>,&*\[\] ]*? [*&]?(\w+)\((?!\))[^;{]*[;{]|^[A-Za-z][\w:<>,&*\[\] ]*? (\w+)\(\)",
        text,
        flags=re.M,
    )
    for names in functions:
        for name in names:
            if name and not name.startswith("operator") and name not in ("if", "for", "while", "requires"):
                yield name


def public():
    return sorted({name for header in HEADERS.rglob("*.hpp") for name in declared(header.read_text())})


def test_every_public_function_is_in_a_test():
    tests = "\n".join(without_comments(file.read_text()) for file in TESTS.rglob("*.[ch]pp"))
    words = set(re.findall(r"\w+", tests))
    assert len(public()) > 80
    missing = sorted(set(public()) - words - ELSEWHERE)
    assert not missing, f"no C++ test has {', '.join(missing)}"
    assert words.isdisjoint(ELSEWHERE), "those named in ELSEWHERE have a test now"
