"""The paper's Figs. 6 and 7, the drawings of sweeps, and the command line that makes them."""

import json
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure
from sweep_work import HOME, G, finished

import ninedof as nd
from ninedof import plot
from ninedof.paper import published
from ninedof.paper.figures import figure_6, figure_7
from ninedof.paper.sweeps import ratio_study


@pytest.fixture(scope="module")
def six():
    return nd.sweep_figure("6")


@pytest.fixture(scope="module")
def seven():
    return nd.sweep_figure("7")


# --- Fig. 6 -----------------------------------------------------------------------------------------------------------


def test_figure_6_is_nine_sweeps_of_one_coordinate(six):
    home = nd.Configuration.neutral(published.ZP, published.published_zs()[2])
    assert six["coordinate"].tolist() == "x_p y_p z_p theta_x theta_y theta_z x_s y_s z_s".split()
    for k, name in enumerate(six["coordinate"].tolist()):
        alone = nd.sweep(published.published_geometry(), home, {name: (-1.0, 1.0, 201)})["condition_number"]
        np.testing.assert_allclose(six["condition_number"][k], alone, rtol=1e-12)


def test_figure_6_against_the_statements_of_the_paper(six):
    """On the axis is best: true for x and y of p and O. A yaw and a higher platform are better than neutral."""
    curves = dict(zip(six["coordinate"].tolist(), six["condition_number"], strict=True))
    middle = curves["x_p"][100]
    assert middle == pytest.approx(3.9070663, abs=5e-7)
    for name in ("x_p", "y_p", "x_s", "y_s", "z_s"):
        assert curves[name].argmin() == 100
    for name in ("theta_z", "z_p"):
        assert curves[name].min() < middle - 0.05
    x = six["displacement"]
    np.testing.assert_allclose(x, -x[::-1], atol=1e-15)
    assert x[100] == 0.0


# --- Fig. 7 -----------------------------------------------------------------------------------------------------------


def test_figure_7_is_symmetric_and_falls_above_1(seven):
    assert seven["sides"].tolist() == ["a1/a2", "b1/b2"]
    ratio, kappa = seven["ratio"], seven["condition_number"]
    assert (ratio[0], ratio[16], ratio[-1]) == (1 / 16, 1.0, 16.0)
    np.testing.assert_allclose(kappa, kappa[:, ::-1], rtol=1e-8)  # mirrored robots
    assert (np.diff(kappa[:, 16:]) < 0).all()  # what the paper says of Fig. 7
    assert (kappa > 3.762659).all()


def test_designs_of_figure_7_keep_ratio_limit_and_value(seven):
    """In units of l_c, though each was found with sides of 1 and l_c free."""
    study = nd.Study.paper()
    for side in range(2):
        for k in range(0, 33, 4):
            a1, a2, b1, b2, zp, zs = seven["design"][side, k].tolist()
            first, second = ((a1, a2), (b1, b2))[side]
            assert first / second == pytest.approx(seven["ratio"][k], rel=1e-12)
            point = study.evaluate({"a1": a1, "a2": a2, "b1": b1, "b2": b2, "zp": zp, "zs": zs})
            assert point.condition_number == pytest.approx(seven["condition_number"][side, k], rel=1e-9)
            assert point.margins["radius_ratio"] >= -1e-7


@pytest.mark.parametrize("side", [0, 1])
@pytest.mark.parametrize("k", [16, 20, 28])
def test_figure_7_against_a_scan(seven, side, k):
    """l_c = 1 and the size of the held pair scanned, then narrowed: no free length, no scaling argument."""
    first, second = (("a1", "a2"), ("b1", "b2"))[side]
    ratio = float(seven["ratio"][k])

    def least(size):
        study = nd.Study(
            variables={first: ratio * size, second: size}, constraints={"radius_ratio": (None, 2.0)}, starts=8
        )
        return nd.optimize(study).condition_number or np.inf

    low, high = 0.05, 12.0
    for _ in range(9):
        sizes = np.linspace(low, high, 7)
        best = int(np.argmin([least(float(s)) for s in sizes]))
        low, high = sizes[max(best - 1, 0)], sizes[min(best + 1, 6)]
    assert least(float(sizes[best])) == pytest.approx(seven["condition_number"][side, k], rel=1e-6)


def test_the_free_optimum_is_the_end_of_figure_7():
    end = nd.optimize(ratio_study("b", 1e9))
    assert end.condition_number == pytest.approx(3.762659078596, rel=1e-6)


def test_figures_are_kept_and_computed_by_executors(tmp_path):
    seven = nd.sweep_figure("7", 9)
    with ThreadPoolExecutor(2) as pool:
        result = nd.sweep_figure("7", 9, executor=pool, out=tmp_path)
    assert result["condition_number"].tobytes() == seven["condition_number"].tobytes()
    assert result["design"].tobytes() == seven["design"].tobytes()
    assert len(finished(tmp_path)) == 18


# --- Drawings ---------------------------------------------------------------------------------------------------------


def lines(figure):
    return [line for axes in figure.axes for line in axes.lines]


def test_figure_6_draws_its_numbers(six):
    figure = figure_6(six)
    drawn = [line.get_ydata() for line in lines(figure)]
    assert len(drawn) == 9
    for row, curve in zip(six["condition_number"], drawn, strict=True):
        np.testing.assert_array_equal(curve, np.where(np.isfinite(row), row, np.nan))
    labels = [text.get_text() for axes in figure.axes for text in axes.get_legend().get_texts()]
    assert labels == six["coordinate"].tolist()


def test_figure_7_draws_its_numbers(seven):
    first, second = lines(figure_7(seven))
    np.testing.assert_array_equal(first.get_ydata(), seven["condition_number"][0])
    np.testing.assert_array_equal(second.get_ydata(), seven["condition_number"][1])


@pytest.mark.parametrize("name", ["condition_number", "leg_lengths"])
@pytest.mark.parametrize("axes", [1, 2, 3])
def test_sweeps_are_drawn(axes, name, tmp_path):
    over = dict(zip(("theta_z", "x_p", "z_s"), ((-1.2, 1.2, 9), (-2.0, 2.0, 11), (-2.5, 0.3, 8)), strict=True))
    result = nd.sweep(G, HOME, dict(list(over.items())[:axes]), name)
    figure = plot.sweep(result)
    assert isinstance(figure, Figure)
    if axes == 2 and name == "condition_number":
        assert len(plot.save(figure, tmp_path, "sweep")) == 3
    else:  # a file costs more than all the rest
        figure.draw_without_rendering()
    if axes == 1:
        assert len(lines(figure)) == (9 if name == "leg_lengths" else 1)
    else:
        values = result[name] if name == "condition_number" else result[name][..., 0]
        maps = [a for a in figure.axes if a.collections and a.get_xlabel() + a.get_title(loc="left")]
        assert len(maps) == (6 if axes == 3 else 9 if name == "leg_lengths" else 1)
        first = values if axes == 2 else values[0]
        drawn = maps[0].collections[0]
        if np.isfinite(values).all():  # bands between round values
            bands = drawn.levels
            assert bands[0] <= values.min()
            assert values.max() <= bands[-1] or drawn.extend == "max"
        else:
            shown = ~np.ma.getmaskarray(drawn.get_array()).reshape(first.T.shape)
            np.testing.assert_array_equal(
                np.ma.getdata(drawn.get_array()).reshape(first.T.shape)[shown], first.T[shown]
            )
            np.testing.assert_array_equal(shown, np.isfinite(first.T))


def test_a_sweep_that_is_singular_everywhere_is_drawn_without_values():
    """A map of grey cells only, and a curve of NaN."""
    result = nd.sweep(G, HOME, {"z_s": [-2.4435], "z_p": [-0.5, 0.0, 0.5]})
    assert np.isinf(result["condition_number"]).all()
    drawn = plot.sweep(result).axes[0].collections[0].get_array()
    assert drawn.shape == (3, 1)
    assert np.ma.getmaskarray(drawn).all()
    (curve,) = lines(plot.sweep(nd.sweep(G, HOME, {"z_s": [-2.4435]})))
    assert np.isnan(curve.get_ydata()).all()


@pytest.mark.parametrize("count", [49, 50])
def test_no_line_of_a_map_is_a_bead_of_its_grid(count):
    """With O at the platform the condition number has no bound: no grid tells how far a line there goes."""
    result = nd.sweep(G, HOME, {"z_s": np.linspace(0.5, 6.5, count), "z_p": np.linspace(1.0, 6.0, count)})
    assert result["condition_number"].max() > 100.0
    (drawn,) = [one for one in plot.sweep(result).axes[0].collections if hasattr(one, "levels") and not one.filled]
    low, high, count = np.array([0.5, 1.0]), np.array([6.5, 6.0]), 0
    for inverse, path in zip(drawn.levels, drawn.get_paths(), strict=True):
        for part in path.to_polygons(closed_only=False) if inverse < 0.15 else ():  # beside the ridge
            assert (abs(part[[0, -1], None] - [low, high]).min(axis=(1, 2)) < 1e-9).all()  # from edge to edge
            count += 1
    assert count > 4


def test_the_atlas_is_drawn():
    result = nd.atlas(20_000)
    figure = plot.atlas(result, (2.0, 3.762659))
    star = next(line for line in lines(figure) if line.get_marker() == "*")
    assert (star.get_xdata()[0], star.get_ydata()[0]) == (2.0, 3.762659)
    assert "20,000 designs" in figure.axes[0].get_title(loc="left")


# --- The command ------------------------------------------------------------------------------------------------------


KEPT = {"pieces", "question.json", "record.json", "report.html"}


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "120")
    return tmp_path


def test_sweep_over_poses(here, run):
    status, out, _ = run("sweep --over x_p=-1:1:5 --over theta_z_deg=-30,0,30 --index leg_ratio --out run")
    assert status == 0
    assert "leg ratio" in out
    names = {p.name for p in (here / "run").iterdir()}
    assert names == KEPT | {f"sweep.{kind}" for kind in ("npz", "png", "svg", "pdf")}
    result = nd.SweepResult.load("run/sweep.npz")
    home = nd.Configuration.neutral(published.ZP, published.published_zs()[2])
    degrees = np.radians([-30.0, 0.0, 30.0])
    expected = nd.sweep(published.published_geometry(), home, {"x_p": (-1.0, 1.0, 5), "theta_z": degrees}, "leg_ratio")
    assert result["leg_ratio"].tobytes() == expected["leg_ratio"].tobytes()


def test_sweep_prints_json(here, run):
    status, out, err = run("sweep --over x_p=-1:1:5 --json --no-figures --out run")
    assert status == 0
    data = json.loads(out)
    summary = data["sweep"]["indices"]["condition_number"]
    assert summary["least"]["at"] == {"x_p": 0.0}
    assert summary["points"] == 5
    assert data["sweep"]["arrays"]["condition_number"][2] == summary["least"]["value"]
    assert Path(data["record"]).is_file()
    assert "condition number" in err


def test_sweep_of_a_design_file_and_of_designs(here, run):
    Path("design.toml").write_text(
        "characteristic_length = 2.0\n[geometry]\na1 = 0.0\na2 = 6.0\nb1 = 3.0\nb2 = 0.0\n"
        "[configuration]\nzp = 4.0\nzs = 2.5\n"
    )
    line = "sweep design.toml --over z_s=2.0,2.5 --absolute --internal-point held --no-figures --json --out one"
    data = json.loads(run(line)[1])
    g, c = nd.Geometry.hexagonal(0.0, 6.0, 3.0, 0.0), nd.Configuration.neutral(4.0, [2.0, 2.5])
    assert data["sweep"]["arrays"]["condition_number"] == nd.condition_number(g, c, 2.0).tolist()
    line = "sweep --a1 0 --a2 6 --b1 3 --zp 4 --zs 2.5 --over b2=0:1:3 --no-figures --json --out two"
    data = json.loads(run(line)[1])
    assert data["sweep"]["coords"]["b2"] == [0.0, 0.5, 1.0]
    data = json.loads(run("sweep --over a1=0:1:3 --over b2=0:1:3 --no-figures --json --out three")[1])
    assert data["sweep"]["indices"]["condition_number"]["least"]["at"] == {"a1": 0.0, "b2": 0.0}


@pytest.mark.parametrize("figure", ["6", "7"])
def test_the_named_figures(here, run, figure):
    status, out, _ = run(f"sweep figure-{figure} --points 9 --out run")
    assert status == 0
    assert f"Fig. {figure}" in out
    assert nd.SweepResult.load("run/sweep.npz").attributes["figure"] == figure
    assert Path("run/sweep.svg").is_file()


def test_the_atlas_command(here, run, monkeypatch):
    marked = []
    draw = plot.atlas
    monkeypatch.setattr(plot, "atlas", lambda result, optimum: marked.append(optimum) or draw(result, optimum))
    status, out, _ = run("atlas --designs 50000 --out run")
    assert status == 0
    assert "Best of all designs" in out
    names = {p.name for p in (here / "run").iterdir()}
    assert names == KEPT | {f"atlas.{kind}" for kind in ("npz", "png", "svg", "pdf")}
    np.testing.assert_allclose(marked, [(2.0, 3.762659078596)], rtol=1e-9)  # docs/values.md
    data = json.loads(run("atlas --designs 50000 --seed 1 --no-figures --json --out other")[1])
    assert data["atlas"]["designs"] == 50000
    assert {"radius_ratio", "condition_number", "design"} == set(data["atlas"]["best"][0])


def test_the_bar_shows_the_time_to_go(capsys):
    """At the pace of the last points: 10 of 100 every 10 s, so 80 s after 20 of them."""
    from ninedof.cli.screen import Screen

    screen, now = Screen(False), [0.0]
    screen.progress_console.get_time = lambda: now[0]
    with screen.bar("points", "over x_p") as bar:
        for now[0], done in ((0.0, 0), (10.0, 10), (20.0, 20)):
            bar.show(done, 100, None)
    shown = capsys.readouterr().err
    assert "over x_p" in shown
    assert "20 %" in shown
    assert "0:01:20 to go" in shown


def test_without_dask_the_error_says_what_to_install(here, run, monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    status, _, err = run("sweep --over x_p=0:1:3 --scheduler tcp://127.0.0.1:1 --out run")
    assert status == 2
    assert "pip install 'ninedof[cluster]'" in " ".join(err.split())


# --- What the command says and draws ----------------------------------------------------------------------------------


def test_figure_6_says_which_curve_it_cuts_off(six):
    figure = figure_6(six)
    rows = dict(zip(six["coordinate"].tolist(), six["condition_number"], strict=True))
    top = figure.axes[0].get_ylim()[1]
    words = [text.get_text() for axes in figure.axes for text in axes.texts]
    cut = [name for name, row in rows.items() if row.max() > top]
    assert cut == ["theta_z"]
    assert words == [f"theta_z is cut off: it reaches {rows['theta_z'].max():.4g}"]


@pytest.mark.slow(sanitized=True)
def test_every_index_of_a_sweep_is_drawn(run, tmp_path):
    indices = ["leg_lengths", "leg_ratio", "singularity_margins"]
    options = " ".join(f"--index {name}" for name in indices)
    status, out, _ = run(f"sweep --over x_p=-1:1:5 {options} --json --out {tmp_path / 'run'}")
    assert status == 0
    figures = {f"sweep_{name}.png" for name in indices}
    assert {file.name for file in (tmp_path / "run").glob("*.png")} == figures
    files = json.loads((tmp_path / "run" / "record.json").read_text())["files"]
    assert figures < set(files)
    margins = json.loads(out)["sweep"]["indices"]["singularity_margins"]
    values = nd.sweep(
        published.published_geometry(),
        nd.Configuration.neutral(published.ZP, published.published_zs()[2]),
        {"x_p": (-1.0, 1.0, 5)},
        "singularity_margins",
    )
    sizes = np.abs(values["singularity_margins"])
    assert abs(margins["least"]["value"]) == sizes.min()
    assert abs(margins["greatest"]["value"]) == sizes.max()
    assert abs(values.least("singularity_margins")[0]) == sizes.min()
    assert sizes.min() > 0.5  # the signed least is near -1
