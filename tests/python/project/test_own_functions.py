"""What is proved rests on functions of the project: no room of proofs calls those of the C library."""

import re
from pathlib import Path

import pytest

CPP = Path(__file__).parents[3] / "cpp"
ROOMS = ["proof", "limits", "position/certified", "workspace/certified", "conditioning/forms", "math/roots"]
FILES = ["include/ninedof/math/interval.hpp", "src/math/interval.cpp", "src/math/form.hpp", "src/math/form.cpp"]
FILES += ["src/math/elementary.hpp", "src/math/elementary.cpp", "src/math/box_share.cpp"]
SOURCES = sorted({CPP / name for name in FILES} | {f for room in ROOMS for f in (CPP / "src" / room).rglob("*.?pp")})
CALL = re.compile(r"\bstd::(a?(?:sin|cos|tan)h?|atan2|exp2?|expm1|log(?:2|10|1p)?|pow|cbrt|hypot|fma|fmod|remainder)\(")
NOT_PROVED = {"joint_cone.cpp": ["sin"], "margins.cpp": ["log", "log", "exp", "exp", "expm1", "exp"]}
"""For the optimizer: the slope of an angle, and margins as logarithms."""


def calls(text):
    return CALL.findall(text)


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: f"{path.parent.name}-{path.name}")
def test_no_proof_calls_functions_of_the_c_library(path):
    assert calls(path.read_text(encoding="utf-8")) == NOT_PROVED.get(path.name, [])


def test_a_call_would_be_found():
    assert len(SOURCES) > 100
    assert calls("x = std::acos(y) + std::exp2(std::fma(a, b, c)) - std::sqrt(z) + sin(of_an_interval)") == [
        "acos",
        "exp2",
        "fma",
    ]
