"""A study as a TOML file: what is written is read back, and the example of the interface. Bad files are in
test_bad_entries.py."""

import math

import pytest

import ninedof as nd
from ninedof import poses

INF = math.inf


@pytest.fixture
def write(tmp_path):
    def to_file(text):
        path = tmp_path / "study.toml"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    return to_file


STUDIES = {
    "paper": nd.Study.paper(),
    "nothing": nd.Study(),
    "everything": nd.Study(
        variables={"a1": (0, INF), "a2": 3.0, "b1": (0.1, 0.3), "zs": (1e-12, 1e12), "theta_z": (-INF, 1 / 3)},
        constraints={"radius_ratio": (1, 2), "leg_ratio": (None, 3.3), "zs_fraction": (0.1, None)},
        characteristic_length=0.1 + 0.2,
        starts=3,
        seed=2**62,
    ),
    "every option": nd.Study(
        constraints={
            "stroke_ratio": (None, 1.7),
            "stroke": {"max": 0.3, "of": "zp"},
            "leg_length": {"min": 0.5, "max": 1.5, "of": "zp"},
            "external_length": (1.0, 9.0),
            "upper_length": (None, 9.0),
            "lower_length": (0.1, None),
            "height": (1.0, 5.0),
            "footprint": (None, 4.0),
            "joint_height": {"max": 0.2, "of": "radius"},
            "joint_spacing": {"min": 0.05, "of": "radius"},
            "leg_clearance": {"radius": 0.02, "of": "zp"},
            "base_cone": {"max_deg": 45, "axis": [0.1, 0.2, 1 / 3]},
            "platform_cone": {"max": 1 / 3},
            "singularity_free": {"min": 0.01, "steps": 7},
        },
        objective=nd.Objective(
            index="frobenius",
            aggregate="weighted",
            weight=1 / 3,
            condition_limit=12.5,
            neutral_condition_limit=4.5,
            poses=(
                nd.Pose(),
                nd.Pose(rotation=(1 / 3, 0, -0.1), unit="zp", internal_point="best"),
                nd.Pose(position=(0.1, 0.2, 0.1 + 0.2), internal_point=(0.0, 1e-9, 0.0)),
                *poses.box((0.1, 0.1, 0.0), tilt_deg=(10, 0, 7)),
                *poses.ball(0.1, points=9, unit="zp"),
                *poses.path([[0, 0, 0], [1, 0, 0], [1, 2, 0]], rotations_deg=[[0, 0, 0], [0, 10, 0], [0, 0, 33]]),
            ),
        ),
        characteristic_length=(0.3, 0.1 + 0.2 + 1.0),
    ),
    "length of a kind": nd.Study(characteristic_length="natural"),
    "six legs": nd.Study(objective=nd.Objective(index="six_legged")),
    "open constraint": nd.Study(constraints={"radius_ratio": (None, None), "leg_ratio": (None, INF)}),
    **{
        f"region {number}": nd.Study(objective={"region": region})
        for number, region in enumerate(
            (
                nd.Region(box=(0.1, 0.0, 0.3), tilt=0.3, yaw=0.2),
                nd.Region(ball=0.4, tilt=0.1, unit="zp", internal_point="held"),
                nd.Region(cylinder=(0.2, 0.1), yaw=1.0),
                nd.Region(path=((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 2.0, 0.0)), tilt=0.2),
                nd.Region(tilt=0.5, yaw=0.5),
                nd.Region(box=(0.1, 0.1, 0.0), tilt=0.1, internal_point="best"),
            )
        )
    },
}


@pytest.mark.parametrize("study", STUDIES.values(), ids=STUDIES.keys())
def test_round_trip(study, tmp_path):
    study.save(tmp_path / "study.toml")
    assert nd.Study.load(tmp_path / "study.toml") == study
    assert nd.Study.load(str(tmp_path / "study.toml")) == study
    assert nd.Study.from_dict(study.to_dict()) == study


def test_the_example_of_the_interface(write):
    text = """
        [design]
        family = "hexagonal"
        characteristic_length = 1.0
        [variables]
        a1 = [0.0, 60.0]
        a2 = [0, 60]
        theta_z = 0.0
        [constraints]
        radius_ratio = { max = 2.0 }
        leg_ratio = { max = 3.0 }
        zs_fraction = { min = 0.2, max = 0.9 }
        [objective]
        index = "condition_number"
        [solver]
        starts = 32
        seed = 5
    """
    limits = {"radius_ratio": (None, 2.0), "leg_ratio": (None, 3.0), "zs_fraction": (0.2, 0.9)}
    assert nd.Study.load(write(text)) == nd.Study(constraints=limits, starts=32, seed=5)


def test_a_byte_order_mark_is_ignored(write):
    text = "[solver]\nstarts = 3\n"
    assert nd.Study.load(write(b"\xef\xbb\xbf" + text.encode())) == nd.Study.load(write(text)) == nd.Study(starts=3)


def test_poses_of_a_file(write):
    text = """
        [objective]
        aggregate = "mean_inverse"
        unit = "zp"
        internal_point = "best"
        [[objective.poses]]
        position = [0.1, 0.0, 0.0]
        rotation_deg = [0, 10, 0]
        [[objective.poses]]
        internal_point = [0, 0, 0.5]
        unit = "length"
        [objective.box]
        half = [0.1, 0, 0]
        tilt_deg = [5, 0, 0]
        [objective.ball]
        radius = 0.2
        points = 4
        internal_point = "held"
        [objective.path]
        positions = [[0, 0, 0], [0, 0, 1]]
        points = 3
    """
    free = {"unit": "zp", "internal_point": "best"}
    expected = nd.Objective(
        aggregate="mean_inverse",
        poses=(
            nd.Pose(position=(0.1, 0, 0), rotation=(0, math.radians(10), 0), **free),
            nd.Pose(internal_point=(0, 0, 0.5)),
            *poses.box((0.1, 0, 0), tilt_deg=(5, 0, 0), **free),
            *poses.ball(0.2, points=4, unit="zp", internal_point="held"),
            *poses.path([[0, 0, 0], [0, 0, 1]], points=3, **free),
        ),
    )
    study = nd.Study.load(write(text))
    assert study.objective == expected
    assert len(expected.poses) == 2 + 5 + 4 + 3


def test_what_was_typed_in_degrees_is_written_in_degrees():
    study = nd.Study(
        constraints={"base_cone": {"max_deg": 45}, "platform_cone": (None, 0.123456789012345)},
        objective={"poses": [{"rotation_deg": [0, 10, -7.5]}, {"rotation": [0.1, 0, 0.123456789012345]}]},
    )
    data = study.to_dict()
    assert data["constraints"] == {"base_cone": {"max_deg": 45.0}, "platform_cone": {"max": 0.123456789012345}}
    assert data["objective"]["poses"][0] == {"rotation_deg": [0.0, 10.0, -7.5]}
    assert data["objective"]["poses"][1] == {"rotation": [0.1, 0.0, 0.123456789012345]}


def test_empty_file_is_the_study_without_constraints(write):
    assert nd.Study.load(write("")) == nd.Study()
    assert nd.Study.load(write("# nothing\r\n[design]\r\n")) == nd.Study()
