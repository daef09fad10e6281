"""What `optimize`, `evaluate` and `certify` say of designs that are singular at every pose, or nearly."""

import pytest

import ninedof as nd

HEXAGONS = {"a1": 1.0, "a2": 2.0, "b1": 0.5, "zp": 1.6, "zs": 0.7}
COINCIDENT = {
    f"{plate}_external_{leg}_{axis}": 1.0 for plate in ("base", "platform") for leg in (1, 2) for axis in "xy"
}
FLAT = {f"base_internal_{i}_y": 0.0 for i in (1, 2, 3)}
HEIGHTS = {"zp": 4.0, "zs": 2.0}


def study(family, values):
    return nd.Study(family=family, variables=values, starts=1)


def design_file(folder, base_internal):
    file, good = folder / "design.toml", "[[2, 0, 0], [-1, 2, 0], [-1, -2, 0]]"
    turned = "[[-1, -2, 0], [2, 0, 0], [-1, 2, 0]]"
    file.write_text(
        f'unit = "mm"\n[geometry]\nbase_external = {good}\nbase_internal = {base_internal}\n'
        f"platform_external = {turned}\nplatform_internal = {good}\n[configuration]\nzp = 4.0\nzs = 2.0\n"
    )
    return file


def words(text):
    return " ".join(text.split())


@pytest.mark.parametrize(
    ("family", "values", "named"),
    [
        (
            "hexagonal",
            HEXAGONS | {"b2": 1.0},
            "its external triangles are similar and, at the orientation of the pose, parallel: det N is 0",
        ),
        (
            "general",
            HEIGHTS | COINCIDENT,
            "base_external, platform_external: got external legs 1 and 2 with the same joints",
        ),
        ("general", HEIGHTS | FLAT, "base_internal: got collinear joints (height / longest side = 0): det B is 0"),
    ],
)
def test_a_study_of_an_architecture_singularity_is_infeasible_by_name(run, tmp_path, family, values, named):
    file, folder = tmp_path / "study.toml", tmp_path / "run"
    study(family, values).save(file)
    status, out, err = run(f"optimize {file} --out {folder} --no-figures --no-report")
    assert status == 3, err
    assert f"by its architecture: {named}" in words(out)
    status, _, err = run(f"certify {folder}")
    assert status == 2
    assert named in words(err)


@pytest.mark.parametrize(
    ("family", "values", "said"),
    [
        (
            "hexagonal",
            HEXAGONS | {"b2": 1.01},
            "similar and parallel within 0.25 %: at this orientation det N is nearly 0",
        ),
        (
            "general",
            HEIGHTS | FLAT | {"base_internal_1_y": 0.01},
            "with its lower internal joints on one line (det B = 0).",
        ),
    ],
)
def test_what_is_near_is_named_by_all_three(run, tmp_path, family, values, said):
    file, folder = tmp_path / "study.toml", tmp_path / "run"
    study(family, values).save(file)
    for line in (f"optimize {file} --out {folder} --no-figures --no-report", f"evaluate {folder}", f"certify {folder}"):
        assert said in words(run(line)[1])


def test_how_near_is_in_the_unit_of_the_design(run, tmp_path):
    file = design_file(tmp_path, "[[0, 0, 0], [3, 0, 0], [1, 0.008, 0]]")
    assert "joints moved by 0.004 mm give a machine" in words(run(f"evaluate {file}")[1])


def test_a_design_file_of_an_architecture_singularity_is_refused_in_a_line(run, tmp_path):
    status, _, err = run(f"evaluate {design_file(tmp_path, '[[0, 0, 0], [1, 1, 0], [2, 2, 0]]')}")
    assert status == 2
    assert "base_internal: got collinear joints" in words(err)
    assert "det B is 0 at every pose" in words(err)
