"""The folder "Save": every file it offers, and what it says of one that it cannot make."""

import csv
import io
from types import SimpleNamespace

import numpy as np
import pytest

import ninedof as nd
from ninedof.export.export import formats
from ninedof.support.extras import MissingExtra
from ninedof.viewer.folders import send

HOME = nd.Configuration.neutral(480.0, 320.0)
DESIGN = nd.Design(nd.Geometry.hexagonal(a1=0.0, a2=850.0, b1=290.0, b2=0.0), HOME, 150.0, "mm")


class Client:
    """Takes what the browser would."""

    def __init__(self):
        self.files = {}

    def send_file_download(self, name, content, save_immediately):
        assert save_immediately
        self.files[name] = content


@pytest.fixture
def viewer():
    pytest.importorskip("viser", reason="the viewer needs viser")
    with nd.view(DESIGN, port=0) as made:
        yield made


def saved(viewer, kind):
    client = Client()
    return client.files, send(viewer, kind, client)


def test_every_format_is_what_export_writes_of_the_pose_shown(viewer, tmp_path):
    with viewer.lock:
        viewer.state.set_pose(position=[20.0, -10.0, 500.0], turn_deg=(4.0, 0.0, 7.0))
        shown = viewer.design
    for name, row in formats().items():
        files, words = saved(viewer, f"{name} ({row.suffix})")
        assert f"machine{row.suffix}" in files
        assert f"Saved machine{row.suffix}" in words
        if name not in ("step", "dxf"):  # with the time at which they were written
            nd.export(shown, name, tmp_path / f"machine{row.suffix}")
            for file, content in files.items():
                assert content == (tmp_path / file).read_bytes()
    assert set(saved(viewer, "urdf (.urdf)")[0]) == {"machine.urdf", "machine.loops.json"}


def test_the_design_file_reads_back(viewer, tmp_path):
    with viewer.lock:
        viewer.state.set_pose(position=[20.0, -10.0, 500.0])
    files, _ = saved(viewer, "design file (.toml)")
    (tmp_path / "design.toml").write_bytes(files["design.toml"])
    again = nd.load(tmp_path / "design.toml")
    assert again.unit == "mm"
    assert again.configuration == viewer.design.configuration


def test_legs_along_the_path_that_is_open(viewer):
    kind = "legs along the path (.csv)"
    files, words = saved(viewer, kind)
    assert files == {}
    assert "Not saved: no path is open" in words
    path = nd.Trajectory.circle(HOME, radius=50.0, duration=2.0, points=21)
    with viewer.lock:
        viewer.state.open_path("circle", path)
    files, _ = saved(viewer, kind)
    head, *rows = csv.reader(io.StringIO(files["legs.csv"].decode()))
    assert head[:2] == ["t (s)", "l1 (mm)"]
    offset = HOME.internal_point - HOME.position  # carried: no turn on a circle
    for row, p in zip(rows, path.position, strict=True):
        expected = nd.leg_lengths(DESIGN.geometry, nd.Configuration(p, internal_point=p + offset))
        np.testing.assert_allclose([float(x) for x in row[1:10]], expected[[0, 1, 2, 3, 4, 5, 6, 7, 8]], rtol=1e-12)


def test_what_cannot_be_saved_is_one_line(viewer, monkeypatch):
    def missing(*_):
        raise MissingExtra("the drawing needs ezdxf: pip install 'ninedof[cad]'")

    monkeypatch.setattr("ninedof.viewer.folders.export", missing)
    files, words = saved(viewer, "dxf (.dxf)")
    assert files == {}
    assert "Not saved: the drawing needs ezdxf" in words


def test_a_simulator_is_told_of_an_unknown_unit():
    pytest.importorskip("viser", reason="the viewer needs viser")
    with nd.view(port=0) as viewer:
        assert "The unit is not known" in saved(viewer, "mjcf (.xml)")[1]
        assert "The unit is not known" not in saved(viewer, "csv (.csv)")[1]


def test_the_picture_is_a_png(viewer):
    client = Client()
    client.camera = SimpleNamespace(image_height=2, image_width=3)
    client.get_render = lambda height, width, transport_format: np.zeros((height, width, 4), dtype=np.uint8)
    send(viewer, "picture (.png)", client)
    assert client.files["ninedof.png"].startswith(b"\x89PNG")
