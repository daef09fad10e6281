"""A shell completes commands, options, and the values that the package knows; the protocol is that of click."""

import pytest

from ninedof.conditioning.characteristic_length import KINDS
from ninedof.design.duty import INTERNAL
from ninedof.export.export import formats
from ninedof.redundancy.rules import RULES
from ninedof.support.units import UNITS


@pytest.fixture
def completed(run, monkeypatch):
    def words(line):
        monkeypatch.setenv("_NINEDOF_COMPLETE", "complete_bash")
        monkeypatch.setenv("COMP_WORDS", line)
        monkeypatch.setenv("COMP_CWORD", str(line.count(" ")))
        status, out, err = run("")
        assert (status, err) == (0, "")
        return out.split()

    return words


@pytest.mark.parametrize(
    ("line", "values"),
    {
        "ninedof adm": ["admissible"],
        "ninedof study.toml --s": ["--starts", "--seed"],
        "ninedof --ce": ["--certify"],
        "ninedof --ver": ["--version"],
        "ninedof --certify --fig": ["--figures"],
        "ninedof admissible run --ar": ["--around"],
        "ninedof admissible run --vary b": ["b1", "b2", "base_internal_angle_deg", "base_external_height"],
        "ninedof admissible run --set theta": ["theta_z_deg"],
        "ninedof evaluate run --set a": ["a1", "a2"],
        "ninedof pareto run --against leg_r": ["leg_ratio"],
        "ninedof pareto run --against ": ["radius_ratio", "condition_limit", "tolerance"],
        "ninedof sweep --over x_": ["x_p", "x_s"],
        "ninedof sweep --index condition": ["condition_number"],
        "ninedof path run --internal-point ": RULES,
        "ninedof sheet run --internal ": INTERNAL,
        "ninedof workspace run --lc ": KINDS,
        "ninedof workspace run --archetype rea": ["reachable"],
        "ninedof export run --unit ": UNITS,
        "ninedof export run --to ": list(formats()),
    }.items(),
)
def test_values_are_completed(completed, line, values):
    words, typed = completed(line), line.split(" ")[-1]
    assert set(values) <= set(words)
    assert all(word.startswith(typed) for word in words)


def test_options_of_no_command_are_not_those_of_a_line_with_a_study_file(completed):
    assert completed("ninedof study.toml --ver") == []


def test_the_script_of_the_shell_is_printed(run, monkeypatch):
    monkeypatch.setattr("shellingham.detect_shell", lambda: ("bash", "/bin/bash"))
    status, out, err = run("--show-completion")
    assert (status, err) == (0, "")
    assert "_NINEDOF_COMPLETE=complete_bash" in out
