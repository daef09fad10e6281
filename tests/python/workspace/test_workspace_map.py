"""Around a workspace: arguments, ends of the range, slices, files, interruption, the command."""

import importlib
import json
import os
import re
import signal
import threading
from time import perf_counter

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

import ninedof as nd
from ninedof import plot
from ninedof.cli.app import main

BOX = ([-2.5, -2.5, 3.0], [2.5, 2.5, 7.0])
LEGS = {"leg_limits": (2.5, 6.5)}
HOME = nd.Configuration.neutral(zp=4.8, zs=2.4)


@pytest.fixture(scope="module")
def found(published):
    return nd.workspace(published, BOX, criteria=LEGS | {"condition_number": 5.0, "singularity_free": True}, home=HOME)


def test_cells_add_up_to_the_volume(found):
    c = found.cells
    assert_allclose(np.prod(c.size, axis=1).sum(), np.prod(found.high - found.low))
    counted = c.piece == 0
    assert_allclose((c.fraction * np.prod(c.size, axis=1))[counted].sum(), found.volume, rtol=2e-2)
    assert set(np.unique(c.state)) == {0, 1, 2}
    assert (c.fraction[c.state == 2] == 1.0).all()
    assert (c.fraction[c.state == 0] == 0.0).all()
    assert (c.limit[c.state == 2] == -1).all()
    assert (c.limit[(c.state == 0)] >= 0).all()


def test_limits_of_a_boundary_are_shares(found):
    limits = found.limits()
    assert_allclose(sum(limits.values()), 1.0)
    assert list(limits.values()) == sorted(limits.values(), reverse=True)
    grouped = found.limits(grouped=True)
    assert set(grouped) == {"leg_limits", "condition_number"}
    assert_allclose(grouped["condition_number"], limits["condition_number"])
    # The robot looks the same after a third of a turn: so do its limits.
    for end in ("high", "low"):
        shares = [limits.get(f"{leg}{k} {end}", 0.0) for leg in "lq" for k in (1, 2, 3)]
        assert np.ptp(shares[:3]) < 0.05
        assert np.ptp(shares[3:]) < 0.05


def test_the_limit_of_a_cell_is_the_margin_that_vanishes_there(published, found):
    c = found.cells
    names = np.array(found.limit_names)[c.limit]
    cells = np.flatnonzero((c.state == 1) & (c.fraction > 0.3) & (c.fraction < 0.7))
    at = nd.Configuration(c.centre[cells], None, 0.5 * c.centre[cells])
    lengths, kappa = nd.leg_lengths(published, at), nd.condition_number(published, at)
    diagonal = np.linalg.norm(c.size[cells], axis=1)
    order = ["l1", "l2", "l3", "q1", "q2", "q3", "r1", "r2", "r3"]
    for k, name in enumerate(names[cells]):
        if name == "condition_number":
            assert abs(kappa[k] - 5.0) < 0.2
        else:
            leg, end = name.split(" ")
            assert abs(lengths[k, order.index(leg)] - (2.5 if end == "low" else 6.5)) <= diagonal[k]


def test_a_slice_is_the_cells_it_cuts(found):
    s = found.slice("y", 0.3, pixels=160)
    assert s.axes == ("x", "z")
    assert s.state.shape == (160, 160)
    rng = np.random.default_rng(0)
    for _ in range(200):
        row, column = rng.integers(160, size=2)
        at = np.array([s.horizontal[column], 0.3, s.vertical[row]])
        c = found.cells
        inside = (np.abs(at - c.centre) <= 0.5 * c.size * (1 + 1e-9)).all(axis=1)
        assert s.state[row, column] in c.state[inside]
    area = (s.state == 2).mean() * 20.0
    assert 2.0 < area < 6.0
    edge = found.slice("z", 7.0)
    assert not edge.state.any()


@pytest.mark.parametrize(("axis", "at"), [("w", 0.0), ("x", 9.0), ("x", np.nan)])
def test_slices_beyond_the_map_are_refused(found, axis, at):
    with pytest.raises(ValueError, match=r"axis: got|at: got"):
        found.slice(axis, at)


def test_save_and_load(found, tmp_path):
    path = found.save(tmp_path / "map.npz")
    again = nd.WorkspaceMap.load(path)
    assert str(again.to_dict()) == str(found.to_dict())
    for name, value in found.cells._asdict().items():
        assert_array_equal(getattr(again.cells, name), value)
    assert again.status is nd.WorkspaceStatus.CONVERGED
    assert_array_equal(again.slice("x", 0.1).state, found.slice("x", 0.1).state)
    assert found.save(tmp_path / "map") == path
    (tmp_path / "other.npz").write_bytes(b"nothing")
    with pytest.raises(ValueError, match=r"other\.npz"):
        nd.WorkspaceMap.load(tmp_path / "other.npz")
    with pytest.raises(ValueError, match=r"none\.npz"):
        nd.WorkspaceMap.load(tmp_path / "none.npz")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["map.npz", "other.npz"]


@pytest.mark.parametrize("kind", ["map", "sweep"])
def test_damaged_files_are_refused_by_name(published, found, tmp_path, kind):
    swept = nd.sweep(published, HOME, {"x_p": (0.0, 1.0, 5)})
    path = (found if kind == "map" else swept).save(tmp_path / "file")
    load = nd.WorkspaceMap.load if kind == "map" else nd.SweepResult.load
    whole = path.read_bytes()
    rng = np.random.default_rng(0)
    places = [*rng.integers(0, len(whole), 40).tolist(), *range(60), *range(len(whole) - 60, len(whole))]
    refused = 0
    for place in places:
        for damaged in (whole[:place], whole[:place] + bytes([whole[place] ^ 0xFF]) + whole[place + 1 :]):
            path.write_bytes(damaged)
            try:
                load(path)  # some bytes of a zip file mean nothing
            except ValueError as error:
                refused += 1
                assert str(error).startswith(f"{path}: ")  # noqa: PT017
    assert refused > 150


# --- Ends of the range ------------------------------------------------------------------------------------------------


def test_the_whole_box(published):
    small = ([-0.1, -0.1, 4.7], [0.1, 0.1, 4.9])
    whole = nd.workspace(published, small, criteria=LEGS)
    assert_allclose(whole.volume, 0.008)
    assert whole.box_limits
    assert whole.limits() == {"box": 1.0}
    assert_allclose(whole.ball_radius, 0.1)
    assert_allclose(whole.box_high - whole.box_low, 0.2)
    free = nd.workspace(published, BOX)
    assert_allclose(free.volume, 100.0)


def test_empty(published):
    empty = nd.workspace(published, BOX, criteria={"leg_limits": (0.0, 2.0)})
    assert (empty.status, empty.volume, empty.error, empty.unseen) == ("empty", 0.0, 0.0, 0.0)
    assert empty.ball_radius == 0.0
    assert np.isnan(empty.conditioning_index)
    assert np.isnan(empty.percentiles).all()
    assert empty.limits() == {}
    judged = nd.workspace(published, BOX, criteria={"condition_number": 1.0})
    assert judged.status == "empty"
    assert 0.0 < judged.unseen < 0.03


def test_open_limits_limit_nothing(published):
    low = np.zeros(9)
    high = np.full(9, np.inf)
    assert_allclose(nd.workspace(published, BOX, criteria={"leg_limits": (low, high)}).volume, 100.0)


def test_poses_run_out(published):
    limited = nd.workspace(published, BOX, criteria=LEGS, tolerance=1e-6, most_evaluations=60_000)
    assert limited.status == "limited"
    assert limited.evaluations <= 60_000
    assert limited.error > 1e-6 * limited.volume


@pytest.mark.parametrize(
    ("name", "wrong"),
    [
        ("archetype", {"archetype": "dextrous"}),
        (r"box \(x\)", {"box": ([1, 0, 0], [0, 1, 1])}),
        (r"box \(z\)", {"box": ([0, 0, 0], [1, 1, np.nan])}),
        (r"box \(low\)", {"box": ([0, 0], [1, 1, 1])}),
        ("box", {"box": None}),
        ("criteria", {"criteria": {"leg_limit": (1, 2)}}),
        ("leg_limits", {"criteria": {"leg_limits": 3.0}}),
        (r"leg_limits \(l1\)", {"criteria": {"leg_limits": (3.0, 2.0)}}),
        (r"leg_limits \(l1\)", {"criteria": {"leg_limits": (np.nan, 2.0)}}),
        (r"leg_limits \(r2\)", {"criteria": {"leg_limits": (np.where(np.arange(9) == 7, np.inf, 0.0), np.inf)}}),
        ("condition_number", {"criteria": {"condition_number": True}}),
        ("leg_clearance", {"criteria": {"leg_clearance": True}}),
        ("platform_cone", {"criteria": {"platform_cone": True}}),
        ("orientations", {"archetype": "reachable", "orientations": np.zeros((0, 3, 3))}),
        ("orientations", {"archetype": "reachable", "orientations": []}),
        ("condition_number", {"criteria": {"condition_number": 0.5}}),
        ("base_cone", {"criteria": {"base_cone": -1.0}}),
        ("base_cone", {"criteria": {"base_cone": {"axis": [0, 0, 1]}}}),
        (r"platform_cone \(axis\)", {"criteria": {"platform_cone": {"max": 1.0, "axis": [0, 0, 0]}}}),
        ("leg_clearance", {"criteria": {"leg_clearance": 0.0}}),
        ("singularity_free", {"criteria": {"singularity_free": 1.5}}),
        ("method", {"method": "sample", "criteria": {"singularity_free": True}}),
        ("method", {"method": "tree"}),
        ("internal_point", {"internal_point": "worst"}),
        ("internal_point", {"internal_point": [1.0, 2.0]}),
        ("internal_point", {"internal_point": np.nan}),
        ("orientations", {"orientations": 5}),
        ("rotation", {"rotation": 2.0 * np.eye(3)}),
        ("position", {"position": [0, 0, 1]}),
        ("region", {"archetype": "orientation", "box": None, "position": [0, 0, 4]}),
        ("region", {"archetype": "orientation", "box": None, "position": [0, 0, 4], "region": {"tilt": 1.0}}),
        (
            r"region \(angle\)",
            {"archetype": "orientation", "box": None, "position": [0, 0, 4], "region": {"angle": 4.0}},
        ),
        ("home", {"home": nd.Configuration.neutral(zp=[1.0, 2.0], zs=1.0)}),
        ("tolerance", {"tolerance": 0.0}),
        ("resolution", {"resolution": 1}),
        ("resolution", {"resolution": 400}),
        ("threads", {"threads": 0}),
        ("progress", {"progress": 3}),
        ("characteristic_length", {"characteristic_length": -1.0}),
    ],
)
def test_wrong_arguments_are_named(published, name, wrong):
    with pytest.raises(ValueError, match=rf"^{name}: "):
        nd.workspace(published, **({"box": BOX, "criteria": LEGS} | wrong))


@pytest.mark.parametrize(("method", "most"), [("octree", 128), ("grid", 512)])
def test_the_greatest_resolution_is_said_at_once(published, method, most):
    with pytest.raises(ValueError, match=f"^resolution: got 600, expected a whole number from 2 to {most}$"):
        nd.workspace(published, BOX, criteria=LEGS, method=method, resolution=600)


# --- While it runs ----------------------------------------------------------------------------------------------------


def test_progress_counts_up(published):
    seen = []
    found = nd.workspace(published, BOX, criteria=LEGS, tolerance=1e-4, progress=lambda *news: seen.append(news))
    assert seen
    done = [news[0] for news in seen]
    assert done == sorted(done)
    assert done[-1] <= found.evaluations
    assert all(expected >= count for count, expected, _ in seen)


def test_an_exception_of_progress_reaches_the_caller(published):
    def stop(*_):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        nd.workspace(published, BOX, criteria=LEGS, tolerance=1e-6, progress=stop)


def test_ctrl_c_keeps_what_is_known(published):
    timer = threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    try:
        found = nd.workspace(
            published,
            BOX,
            archetype="inclusive",
            orientations=400,
            region={"angle": 0.2},
            criteria=LEGS | {"condition_number": 6.0},
            tolerance=1e-6,
            most_evaluations=10**9,
        )
    finally:
        timer.cancel()
    assert found.interrupted
    assert found.status == "stopped"


def test_an_interruption_at_the_very_end_is_heard(published):
    """Of a run that has nothing left to do: its map is whole, so that only the exception can tell."""

    def stop(*_):
        raise KeyboardInterrupt

    for _ in range(5):
        try:
            heard = nd.workspace(published, BOX, criteria=LEGS, method="grid", resolution=8, progress=stop).interrupted
        except KeyboardInterrupt:
            heard = True
        assert heard


# --- The command ------------------------------------------------------------------------------------------------------


def run(arguments, capsys):
    with pytest.raises(SystemExit) as end:
        main(["workspace", *arguments])
    return end.value.code, capsys.readouterr()


def test_the_command_leaves_a_run_folder(tmp_path, capsys, published):
    box = ["--x", "-2.5", "2.5", "--y", "-2.5", "2.5", "--z", "3", "7"]
    code, out = run(
        ["--legs", "2.5", "6.5", "--condition", "5", *box, "--json", "--out", str(tmp_path / "run")], capsys
    )
    assert code == 0
    numbers = json.loads(out.out)["workspace"]
    expected = nd.workspace(published, BOX, criteria=LEGS | {"condition_number": 5.0})
    assert_allclose(numbers["volume"], expected.volume, rtol=1e-12)
    assert {p.name for p in (tmp_path / "run").iterdir()} == {
        "record.json",
        "map.npz",
        "workspace.png",
        "workspace.svg",
    }
    record = json.loads((tmp_path / "run" / "record.json").read_text())
    assert record["workspace"]["volume"] == numbers["volume"]
    assert record["asked"]["criteria"]["leg_limits"] == [2.5, 6.5]
    assert nd.WorkspaceMap.load(tmp_path / "run" / "map.npz").volume == numbers["volume"]


def test_the_command_on_orientations_and_on_nothing(tmp_path, capsys):
    region = ["--archetype", "orientation", "--tilt-deg", "40", "--torsion-deg", "30"]
    code, out = run([*region, "--legs", "2", "6.5", "--no-figures", "--out", str(tmp_path / "a")], capsys)
    assert code == 0
    assert "volume" in out.out
    code, out = run(["--legs", "0", "1", "--no-figures", "--out", str(tmp_path / "b")], capsys)
    assert code == 3
    assert "no allowed pose" in out.out
    code, out = run(["--out", str(tmp_path / "c")], capsys)
    assert code == 2
    assert "expected at least one" in out.err
    assert not (tmp_path / "c").exists()


def test_the_command_passes_on_position_length_and_sample(tmp_path, capsys, published):
    at = ["--archetype", "orientation", "--angle-deg", "40", "--position", "0.5", "0", "4", "--lc", "2"]
    code, out = run(
        [*at, "--legs", "2", "6.5", "--condition", "6", "--json", "--no-figures", "--out", str(tmp_path / "a")], capsys
    )
    assert code == 0
    expected = nd.workspace(
        published,
        archetype="orientation",
        position=(0.5, 0.0, 4.0),
        region={"angle": np.radians(40.0)},
        criteria={"leg_limits": (2.0, 6.5), "condition_number": 6.0},
        characteristic_length=2.0,
    )
    assert json.loads(out.out)["workspace"]["volume"] == expected.volume
    sample = ["--method", "sample", "--points", "500", "--seed", "3", "--legs", "2.5", "6.5"]
    box = ["--x", "-2.5", "2.5", "--y", "-2.5", "2.5", "--z", "3", "7"]
    code, out = run([*sample, *box, "--json", "--out", str(tmp_path / "b")], capsys)
    expected = nd.workspace(published, BOX, criteria=LEGS, method="sample", points=500, seed=3)
    assert json.loads(out.out)["workspace"]["volume"] == expected.volume


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (
            ["--position", "0", "0", "4"],
            r"--position: got \(0.0, 0.0, 4.0\), expected none but for --archetype orientation",
        ),
        (["--lc", "long"], "--lc: got 'long', expected a number or one of"),
        (["--points", "0"], "points: got 0, expected"),
        (["--seed", "-1"], "seed: got -1, expected"),
        (["--method", "grid", "--points", "5"], "--points: got 5, expected none with --method grid"),
    ],
)
def test_the_command_names_what_it_refuses(tmp_path, capsys, arguments, words):
    code, out = run(["--legs", "2.5", "6.5", *arguments, "--out", str(tmp_path / "run")], capsys)
    assert code == 2
    assert re.search(words, out.err)
    assert out.err.count("\n") == 1


@pytest.mark.timing
def test_ctrl_c_ends_the_finest_levels(published):
    """Where millions of cells are numbered and judged: what is kept is summed up, a second for a million cells."""
    sent = []

    def interrupt():
        sent.append(perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(4.0, interrupt)
    timer.start()
    try:
        found = nd.workspace(published, BOX, criteria=LEGS, tolerance=1e-7, most_evaluations=10**9)
    finally:
        timer.cancel()
    assert found.status == "stopped"
    assert perf_counter() - sent[0] < 12.0


def test_the_figure_shows_what_it_is_given(found):
    figure = plot.workspace(
        [plot.Section(found.slice("y", 0.0)), plot.Section(found.slice("z", 4.8), ((0.0, 0.0), 0.8))],
        found.limit_names,
        found.limits(),
        found.percentiles,
        found.levels,
        "m",
    )
    titles = [axes.get_title(loc="left") for axes in figure.axes]
    assert titles[:2] == ["y = 0", "z = 4.8"]
    assert figure.axes[0].get_xlabel() == "x (m)"
    words = [text.get_text() for text in figure.legends[0].get_texts()]
    assert set(words) == {"external legs", "upper internal legs", "condition number"}
    with pytest.raises(ValueError, match="sections: got 0"):
        plot.workspace([], found.limit_names, found.limits(), found.percentiles, found.levels)


def test_ctrl_c_before_the_first_level_is_said_and_kept(tmp_path, capsys, monkeypatch):
    """Nothing is known then: every number is NaN, and the command ends as after any other interruption."""
    search = nd.workspace

    def interrupted(*arguments, **options):
        threading.Timer(0.05, os.kill, (os.getpid(), signal.SIGINT)).start()
        return search(*arguments, **options | {"resolution": 128, "most_evaluations": 10**9})

    monkeypatch.setattr(importlib.import_module("ninedof.cli.commands.workspace"), "find_workspace", interrupted)
    code, out = run(["--condition", "6", "--internal-point", "best", "--json", "--out", str(tmp_path / "run")], capsys)
    assert code == 130
    numbers = json.loads(out.out)["workspace"]
    assert numbers["status"] == "stopped"
    assert numbers["levels"] == []
    again = nd.WorkspaceMap.load(tmp_path / "run" / "map.npz")
    assert again.percentiles.shape == (101,)
    assert np.isnan(again.percentiles).all()
    assert "interrupted" in out.err


def test_the_command_starts_from_the_published_design_at_its_best(tmp_path, capsys):
    code, _ = run(["--legs", "0", "1", "--json", "--no-figures", "--out", str(tmp_path / "run")], capsys)
    assert code == 3
    asked = json.loads((tmp_path / "run" / "record.json").read_text())["asked"]
    zs = asked["home"]["internal_point"][2]
    heights = nd.Configuration.neutral(asked["home"]["position"][2], zs + np.array([-1e-4, 0.0, 1e-4]))
    around = nd.condition_number(nd.Geometry(**asked["geometry"]), heights)
    assert around.argmin() == 1
