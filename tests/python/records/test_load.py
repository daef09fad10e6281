"""`nd.load` and `nd.save`: every object comes back equal, with one name for each."""

from dataclasses import fields, replace

import numpy as np
import pytest

import ninedof as nd
from ninedof.motion import Followed
from ninedof.records.load import split
from ninedof.workspace.cells import IndexStatistics

STUDY = nd.Study(starts=3, constraints={"radius_ratio": (None, 2.0)}, characteristic_length="mean_leg")
HOME = nd.Configuration.neutral(3.9828, 2.4432, 0.1)
BOX = ([-1, -1, 3], [1, 1, 5])
ANY = nd.Study("general", {"zp": (2.0, 6.0), "zs": (0.5, 4.0)}, characteristic_length="optimal", starts=1)
TWO = nd.Study(
    constraints={"leg_ratio": [{"max": 3.0}, {"max": 2.0, "at": "neutral"}]},
    objective={"poses": [{"position": [0.2, 0, 0]}, {"internal_point": "best"}]},
    starts=4,
)
TURNED = nd.Study(
    "symmetric",
    constraints={"radius_ratio": (None, 2.0), "base_cone": {"max_deg": 45, "axis": [0, 0, 1]}},
    objective={"poses": [{}, {"position": [0.1, 0, 0], "unit": "zp"}]},
    starts=4,
)


def same(a, b):
    """Whether two values are the same to the last bit, NaN equal to NaN."""
    if isinstance(a, np.ndarray):
        return isinstance(b, np.ndarray) and a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()
    if isinstance(a, nd.Front | nd.WorkspaceMap | nd.SweepResult | Followed | nd.Trajectory | IndexStatistics):
        return type(a) is type(b) and all(same(getattr(a, f.name), getattr(b, f.name)) for f in fields(a))
    if isinstance(a, tuple):
        return type(a) is type(b) and len(a) == len(b) and all(map(same, a, b))
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(same(a[key], b[key]) for key in a)
    if isinstance(a, str):
        return type(a) is type(b) and a == b
    return bool(a == b) or (a != a and b != b)


def runs(published):
    weight = ([0.0, 0.0, -9.81], None)
    line = nd.Trajectory.line(HOME, [0.3, 0.0, 0.1], 2.0, 41)
    in_metres = nd.Trajectory(line.time, line.position, line.rotation, "m")
    none = nd.Study(constraints={"leg_ratio": (None, 0.5)}, starts=4)
    return {
        "optimum": lambda: nd.optimize(STUDY),
        "optimum of any joints": lambda: nd.optimize(ANY),
        "optimum with two limits of a name": lambda: nd.optimize(TWO),
        "optimum of a catalogue": lambda: nd.optimize(replace(STUDY, actuators=[nd.Actuator("A", 0.1, 90.0)])),
        "front": lambda: nd.pareto(STUDY, "radius_ratio", values=[0.01, 1.5, 2.0]),
        "front in degrees": lambda: nd.pareto(TURNED, "base_cone_deg", values=[35, 38.05]),
        "front without designs": lambda: nd.pareto(none, "radius_ratio"),
        "workspace": lambda: nd.workspace(
            published, BOX, criteria={"leg_limits": (2.5, 6.5)}, index=["leg_ratio", "leg_lengths"], resolution=6
        ),
        "sweep": lambda: nd.sweep(published, HOME, {"x_p": (-1.0, 1.0, 3)}, ["condition_number", "leg_lengths"]),
        "atlas": lambda: nd.atlas(1000),
        "path": lambda: nd.follow(published, line, HOME, limits=(0.0, 5.0), load=weight),
        "path in newtons": lambda: nd.follow(published, in_metres, HOME, masses=nd.Masses(platform=2.0)),
        "path without a load, O best": lambda: nd.follow(published, line, HOME, "best"),
        "design": lambda: nd.Design(published, HOME, "optimal"),
        "design of a number": lambda: nd.Design(published, HOME, 0.1 + 0.2),
    }


@pytest.mark.parametrize("kind", runs(None))
def test_what_was_saved_is_loaded(kind, published, tmp_path):
    run = runs(published)[kind]()
    place = tmp_path / ("design.toml" if kind.startswith("design") else "a new folder")
    written = nd.save(run, place)
    for path in (place, str(place), written):
        found = nd.load(path)
        assert type(found) is type(run)
        assert same(found, run)


def test_points_of_a_front_are_counted_from_one(tmp_path):
    front = nd.pareto(STUDY, "leg_ratio", values=[0.5, 2.0, 2.5])
    nd.save(front, tmp_path / "front")
    for k, result in enumerate(front.results, start=1):
        for name in (f"{tmp_path}/front#{k}", f"{tmp_path}/front/record.json#{k}", tmp_path / f"front#{k}"):
            found = nd.load(name)
            assert found == result
            assert found.study.constraints["leg_ratio"] == result.study.constraints["leg_ratio"]
    assert nd.load(f"{tmp_path}/front#1").best is None
    worst = nd.load(f"{tmp_path}/front#2").sheet().condition_number.value
    assert worst == pytest.approx(front.results[1].condition_number, rel=1e-13)


def test_the_next_best_optimum_of_a_run(tmp_path):
    result = nd.optimize(nd.Study(family="symmetric", starts=8, constraints={"leg_ratio": (None, 2.0)}))
    assert len(result.candidates) > 1
    nd.save(result, tmp_path / "run")
    assert nd.load(tmp_path / "run#1") == result
    assert nd.load(tmp_path / "run#2").best == result.candidates[1]


def test_a_folder_may_have_a_number_sign_in_its_name(tmp_path):
    result = nd.optimize(STUDY)
    nd.save(result, tmp_path / "try#2")
    assert nd.load(tmp_path / "try#2") == result
    assert nd.load(tmp_path / "try#2#1") == result
    assert split("#7")[1] == ""


def test_a_run_is_never_written_over_another(tmp_path):
    (tmp_path / "mine.txt").write_text("kept")
    with pytest.raises(ValueError, match="not an empty folder"):
        nd.save(nd.optimize(STUDY), tmp_path)
    with pytest.raises(ValueError, match="run: got 3"):
        nd.save(3, tmp_path / "new")
    assert [path.name for path in tmp_path.iterdir()] == ["mine.txt"]


@pytest.mark.parametrize("name", ["sweep#1", "design.toml#1", "none#1", "none", "none.toml", "front#4", "front#-1"])
def test_what_is_not_there_is_named(name, published, tmp_path):
    nd.save(nd.sweep(published, HOME, {"x_p": [0.0]}), tmp_path / "sweep")
    nd.save(nd.Design(published, HOME), tmp_path / "design.toml")
    nd.save(nd.pareto(STUDY, "radius_ratio", values=[1.5]), tmp_path / "front")
    with pytest.raises(ValueError, match=str(tmp_path / name.split("#")[0])):
        nd.load(tmp_path / name)


def test_a_design_of_a_run_has_the_characteristic_length_of_the_run(tmp_path):
    """In millimetres the default of 1 is far from the length of the run; a design file, MJCF and CSV keep it."""
    study = nd.Study(
        variables={"a1": (0, 900), "a2": (0, 900), "b1": (0, 450), "b2": (0, 450), "zp": (300, 700), "zs": (50, 650)},
        constraints={"radius_ratio": (None, 2.0)},
        characteristic_length=150.0,
        starts=2,
        unit="mm",
    )
    run = nd.load(nd.save(nd.optimize(study), tmp_path / "run"))
    design = nd.Design(run.geometry, run.configuration, run.characteristic_length, "mm")
    files = [nd.save(design, tmp_path / "design.toml"), nd.export(run, "csv", tmp_path / "a.csv")]
    for found in (run, *map(nd.load, [*files, nd.export(run, "mjcf", tmp_path / "a.xml")])):
        scale = 1e3 if found.geometry.base_external.max() < 10.0 else 1.0  # MJCF is in metres
        assert found.characteristic_length * scale == pytest.approx(150.0, rel=1e-12)
        assert found.condition_number == pytest.approx(run.condition_number, rel=1e-9)
        own = {"characteristic_length": found.characteristic_length}
        assert nd.condition_number(found.geometry, found.configuration, **own) == pytest.approx(found.condition_number)
        swept = nd.sweep(found.geometry, found.configuration, {"theta_z": [0.0]}, **own)
        assert swept["condition_number"][0] == pytest.approx(found.condition_number, rel=1e-12)
        assert nd.sheet(found).condition_number.value == pytest.approx(found.condition_number, rel=1e-12)
