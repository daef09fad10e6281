"""The table of indices: a row works wherever indices are computed, and the pages list every row."""

import json
from pathlib import Path

import numpy as np
import pytest

import ninedof as nd
from ninedof.design.indices import INDICES, Index, computed, objectives
from ninedof.records.design_file import hexagonal_design, indices

DOCS = Path(__file__).parents[3] / "docs"
PUBLISHED = {"a1": 0.0, "a2": 5.8124, "b1": 2.9062, "b2": 0.0, "zp": 3.9828, "zs": 2.4435}


def height(geometry, configuration, length, threads=None):
    """The height of the platform in characteristic lengths."""
    return configuration.position[..., 2] / length


@pytest.fixture
def added(monkeypatch):
    monkeypatch.setitem(INDICES, "height", Index("height", height, title="height of the platform", objective="speed"))


def test_an_added_index_is_swept(added, published):
    home = nd.Configuration.neutral(3.9828, 2.4435)
    found = nd.sweep(published, home, {"z_p": [0.0, 0.5]}, ["height", "condition_number"], characteristic_length=2.0)
    np.testing.assert_allclose(found["height"], [1.9914, 2.2414])
    found = nd.sweep_designs({n: v for n, v in PUBLISHED.items() if n != "zp"}, {"zp": [3.0, 4.0]}, "height")
    assert found["height"].tolist() == [3.0, 4.0]


def test_an_added_index_is_evaluated(added, run):
    assert indices(hexagonal_design(PUBLISHED, 2.0))["height"] == 1.9914
    line = " ".join(["evaluate", *(f"--{name} {value}" for name, value in PUBLISHED.items())])
    assert "height of the platform" in run(line)[1]
    assert json.loads(run(f"{line} --json")[1])["height"] == 3.9828


def test_an_added_index_with_a_gradient_is_an_objective(added):
    objective = nd.Objective(index="height")
    assert objective.for_core().index == "speed"
    study = nd.Study(objective={"index": "height", "condition_limit": 5.0}, starts=4)
    same = nd.Study(objective={"index": "speed", "condition_limit": 5.0}, starts=4)
    assert nd.optimize(study).objective == nd.optimize(same).objective


def test_an_index_without_a_gradient_is_no_objective():
    for name in ("manipulability", "leg_lengths"):
        assert name not in objectives()
        with pytest.raises(ValueError, match=rf"index: got '{name}', expected one of condition_number"):
            nd.Objective(index=name)


def test_frobenius_has_one_meaning_under_both_names():
    assert nd.Objective(index="condition_number_frobenius") == nd.Objective(index="frobenius")


def test_the_pages_list_every_index():
    swept, studies = ((DOCS / name).read_text(encoding="utf-8") for name in ("sweeps.md", "study-file.md"))
    assert [name for name in computed() if f"`{name}`" not in swept] == []
    assert [i.objective for i in INDICES.values() if i.objective and f'`"{i.objective}"`' not in studies] == []
