"""What is shown of objects at a prompt and in a notebook: short, with Python's numbers, escaped."""

import xml.etree.ElementTree
from dataclasses import replace

import numpy as np
import pytest

import ninedof as nd
from ninedof.support.text import short
from ninedof.tables import Column, Table
from ninedof.tables.html import notebook

HOME = nd.Configuration.neutral(3.9828, 2.4432)
STACK = nd.Configuration.neutral(3.9828, np.linspace(1.0, 3.0, 201))
DOWN = [0, 0, 0, 0, 0, 0, 0, 0, -1.0]
LONGEST = 800  # characters


@pytest.fixture(scope="module")
def shown(published):
    """One of everything that a function returns, of 201 poses where it takes a stack."""
    study = nd.Study(constraints={"radius_ratio": (None, 2.0)}, starts=4)
    result = nd.optimize(study)
    line = nd.Trajectory.line(HOME, [0.3, 0.0, 0.0])
    path = np.stack([np.linspace(0.0, 1.0, 201), np.zeros(201), np.full(201, 3.98)], axis=1)
    space = nd.workspace(published, ([-1, -1, 3], [1, 1, 5]), criteria={"leg_limits": (2.5, 6.5)}, resolution=6)
    return {
        "Result": result,
        "Candidate": result.best,
        "Study": nd.Study("general"),
        "Study of a region": replace(study, objective={"region": {"box": [0.1, 0.1, 0.1]}}),
        "Objective": nd.Objective(poses=nd.poses.box((1, 1, 1))),
        "Pose": nd.Pose(),
        "DesignPoint": study.evaluate(result.variables),
        "Trace": nd.trace(study, result.variables),
        "Front": nd.pareto(study, "radius_ratio", values=[1.5, 2.0]),
        "WorkspaceMap": space,
        "WorkspaceCells": space.cells,
        "WorkspaceSlice": space.slice("z", 4.0),
        "WorkspaceField": space.field,
        "WorkspaceSurface": space.surface(),
        "SweepResult": nd.sweep(published, HOME, {"x_p": (-1, 1, 201)}, ["condition_number", "leg_lengths"]),
        "Sheet": result.sheet(),
        "Failure": nd.failure(result),
        "Design": nd.Design(published, HOME),
        "Trajectory": line,
        "Followed": nd.follow(published, line, HOME),
        "Configuration": STACK,
        "Tracked": nd.track(published, nd.leg_lengths(published, STACK), STACK[0]),
        "AssemblyModes": nd.forward_position(published, nd.leg_lengths(published, HOME)),
        "ModesCertificate": nd.forward_position(published, nd.leg_lengths(published, HOME), certify=True).certificate,
        "InternalPoint of a path": nd.best_internal_path(published, path),
        "InternalPoint": nd.best_internal_point(published, [0.8, 0.0, 4.0]),
        "InternalPointMap": nd.best_internal_map(published, path),
        "LegForces": nd.leg_forces(published, STACK, [0, 0, 0], [0, 0, 1]),
        "Payload": nd.largest_payload(nd.Design(published, HOME), 100.0),
        "PathPayload": nd.payload_along(nd.Design(published, HOME), nd.follow(published, line, HOME), 100.0),
        "InverseDynamics": nd.inverse_dynamics(published, STACK),
        "ErrorBounds": nd.error_bounds(published, HOME, 0.1),
        "SingularityDistance": nd.distance_to_singularity(published, HOME, DOWN, most=5.0),
        "SingularityDistance of a stack": nd.distance_to_singularity(published, STACK, DOWN, most=5.0),
        "Singularity": nd.singularity(published, HOME),
        "SingularityMargins": nd.singularity_margins(published, HOME),
        "Ellipsoid": nd.velocity_ellipsoid(published, STACK),
        "VelocityMatrices": nd.velocity_matrices(published, STACK),
        "Check": nd.check(result, perturbations=100),
        "LowerBound": nd.applicable_bounds(result)[0],
        "MachineCertificate": result.certify(),
        "AdmissibleSet": nd.admissible(result, {"a2": (5.0, 5.1)}, time_limit=0.1),
        "OptimumProof": nd.OptimumProof(3.7, 3.7, True, 100, 0, 1.0, certificate=b"bytes" * 1000),
        "PathLimits": nd.path_limits(study, nd.follow(published, line, HOME), HOME),
        "RegionReport": nd.optimize(replace(study, objective={"region": {"ball": 0.1}}), starts=1).region,
        "CertifiedWorkspace": nd.certified_workspace(
            published, ([-1, -1, 3], [1, 1, 5]), gap=0.5, criteria={"leg_limits": (2.5, 6.5)}
        ),
    }


def test_everything_prints_short(shown):
    for name, thing in shown.items():
        for text in (repr(thing), *[str(thing)] * (type(thing).__str__ is object.__str__)):  # else sentences
            assert "np." not in text, name
            assert "\n" not in text, name
            assert len(text) <= LONGEST, name
            assert name.split()[0] in text.replace("assembly modes", "AssemblyModes"), name


def test_what_matters_is_said(shown):
    assert (
        repr(shown["Result"]) == "<Result: optimal, condition number = 3.762659, limits reached: a1, b2, radius_ratio>"
    )
    front = "<Front: 2 limits of radius_ratio, 1.5 to 2; condition number = 3.941177 to 3.762659>"
    assert repr(shown["Front"]) == front
    assert "volume 3.36" in repr(shown["WorkspaceMap"])
    assert repr(shown["Pose"]) == "Pose()"
    assert repr(nd.Pose(position=(1, 0, 0))) == "Pose(position=(1, 0, 0))"
    assert "30 more" in repr(shown["Study"])
    assert repr(shown["SingularityDistance"]).startswith(
        "SingularityDistance(distance=2.4432, mechanism='b', each=[inf,"
    )
    none = nd.optimize(nd.Study(constraints={"leg_ratio": (None, 0.5)}, starts=4))
    assert repr(none) == "<Result: infeasible, causes: leg_ratio>"


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (np.float64(0.1), "0.1"),
        (np.array(2.5), "2.5"),
        (np.arange(9.0), "[0, 1, 2, 3, 4, 5, 6, 7, 8]"),
        (np.arange(10.0), "<array 10, 0 to 9>"),
        (np.full((4, 5), np.nan), "<array 4x5, all NaN>"),
        (np.where(np.arange(12) < 3, np.nan, np.arange(12)), "<array 12, 3 to 11, 3 NaN>"),
        (np.array([True] * 12), "<array 12>"),
        (np.zeros(0), "[]"),
        ({f"x{k}": k for k in range(11)}, "{" + ", ".join(f"x{k}: {k}" for k in range(9)) + ", ... 2 more}"),
        ((1.0,), "(1,)"),
        (tuple(range(12)), "(0, 1, 2, 3, 4, 5, 6, 7, 8, ... 3 more)"),
        (nd.poses.box((1, 1, 1)), "<27 x Pose>"),
        (None, "None"),
    ],
)
def test_values(value, text):
    assert short(value) == text


@pytest.mark.parametrize("name", ["Result", "Front", "WorkspaceMap", "SweepResult", "Sheet", "Followed", "Study"])
def test_tables_of_a_notebook(shown, name):
    text = shown[name]._repr_html_()
    root = xml.etree.ElementTree.fromstring(text.replace("&times;", "x"))
    assert len(text) < 12_000
    assert "np." not in text
    tables = root.findall("table")
    assert tables
    for table in tables:
        rows = table.findall("tbody/tr")
        head = table.find("thead/tr")
        assert {len(row) for row in rows} == {len(rows[0] if head is None else head)}


@pytest.mark.parametrize(
    "name", ["CertifiedWorkspace", "MachineCertificate", "OptimumProof", "Payload", "AdmissibleSet"]
)
def test_sentences_of_a_notebook(shown, name):
    root = xml.etree.ElementTree.fromstring(shown[name]._repr_html_())
    thing = shown[name]
    sentences = list(thing.sentences()) if hasattr(thing, "sentences") else [thing.words]
    assert [part.text for part in root.findall("p")] == sentences


def test_tables_show_the_numbers(shown):
    assert ">3.762659</td>" in shown["Result"]._repr_html_()
    assert ">3.941177</td>" in shown["Front"]._repr_html_()
    assert ">201 x_p x 9 leg</td>" in shown["SweepResult"]._repr_html_()
    assert nd.optimize(nd.Study(constraints={"leg_ratio": (None, 0.5)}, starts=4))._repr_html_().count("<tr>") == 0


def test_tables_are_escaped(shown):
    assert "<b>" not in notebook("<b>", Table("<b>", [Column("<b>"), Column("x")], [("<b>", "&")], ["<b>"]))
    named = nd.SweepResult({"<i>": np.zeros(2)}, {"<i>": ("a&b",)}, {"a&b": np.arange(2.0)})
    assert "<i>" not in named._repr_html_()
    assert "a&amp;b = 0" in named._repr_html_()
    hostile = replace(shown["Result"], reason="<script>")
    assert "<script>" not in hostile._repr_html_()
