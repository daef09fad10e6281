"""The viewer as a program: what it says when something is missing, how it ends, and a browser that uses it."""

import asyncio
import socket
import sys
import threading
import time
from types import SimpleNamespace

import chromium
import numpy as np
import pytest

import ninedof as nd
from ninedof.cli.app import main
from ninedof.support.extras import MissingExtra
from ninedof.viewer import shapes
from ninedof.viewer.body import Body
from ninedof.viewer.panel import ELLIPSOIDS

NUMBER = "document.getElementById('ninedof-{}')?.textContent"


def free_of_threads(before):
    end = time.monotonic() + 10.0
    while time.monotonic() < end:
        left = [t for t in threading.enumerate() if t not in before and not t.name.startswith("asyncio")]
        if not left:
            return True
        time.sleep(0.05)
    return left


def test_without_viser_one_line_names_the_extra(monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "viser", None)
    with pytest.raises(MissingExtra, match=r"the viewer needs viser.*pip install 'ninedof\[viewer\]'"):
        nd.view()
    with pytest.raises(SystemExit) as ended:
        main(["view"])
    assert ended.value.code == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "ninedof[viewer]" in said


def test_a_port_in_use_is_one_line(capsys):
    pytest.importorskip("viser", reason="the viewer needs viser")
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        port = other.getsockname()[1]
        with pytest.raises(SystemExit) as ended:
            main(["view", "--port", str(port)])
    assert ended.value.code == 2
    assert capsys.readouterr().err == f"ninedof: port: got {port}, which is in use, expected a free one, or 0 for any\n"


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"host": "203.0.113.7"}, "host: got '203.0.113.7', expected an address of this machine"),
        ({"port": 70000}, "port: got 70000, expected a number from 0 to 65535"),
        ({"design": "nowhere.toml"}, "nowhere.toml"),
        ({"path": "nowhere.csv"}, "nowhere.csv"),
    ],
)
def test_bad_arguments_are_named_and_leave_nothing_running(options, words):
    pytest.importorskip("viser", reason="the viewer needs viser")
    before = set(threading.enumerate())
    with pytest.raises(ValueError, match=words):
        nd.view(**{"port": 0} | options)
    assert free_of_threads(before) is True


def test_it_listens_at_home_and_closes_cleanly(capfd):
    pytest.importorskip("viser", reason="the viewer needs viser")
    before = set(threading.enumerate())
    with nd.view(port=0) as viewer:
        assert viewer.url == f"http://127.0.0.1:{viewer.port}"
        viewer.submit("pose", lambda: viewer.state.set_pose(position=[0.5, 0.0, 3.98]))
        end = time.monotonic() + 10.0
        while viewer.design.configuration.position[0] != 0.5:
            assert time.monotonic() < end
            time.sleep(0.01)
        with socket.socket() as same, pytest.raises(OSError, match="in use"):
            same.bind(("127.0.0.1", viewer.port))
    viewer.close()  # a second time: nothing
    assert free_of_threads(before) is True
    assert repr(viewer).startswith("<Viewer: closed")
    with socket.socket() as same:
        same.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        same.bind(("127.0.0.1", viewer.port))
    assert capfd.readouterr() == ("", "")


class AskedJustBefore(threading.Event):
    """Not set when the worker asks before its sleep, and set before it goes on."""

    def __init__(self):
        super().__init__()
        self.armed, self.asked = threading.Event(), threading.Event()

    def is_set(self):
        answer = super().is_set()
        if self.armed.is_set() and threading.current_thread().name == "ninedof-viewer" and not self.asked.is_set():
            self.asked.set()
            self.wait(1.0)
        return answer


def test_closing_is_not_missed_between_a_look_and_the_sleep(monkeypatch):
    pytest.importorskip("viser", reason="the viewer needs viser")
    monkeypatch.setattr("ninedof.viewer.app.PATIENCE", 2.0)
    viewer = nd.view(port=0)
    closed, update = AskedJustBefore(), viewer.update
    viewer._closed = closed

    def last_before_the_sleep(settled=False):
        update(settled)
        if settled:
            closed.armed.set()

    viewer.update = last_before_the_sleep
    viewer.submit("once more", lambda: None)
    assert closed.asked.wait(10.0)
    viewer.close()
    assert not viewer._worker.is_alive()


def test_closing_tells_of_a_thread_that_does_not_end(monkeypatch):
    pytest.importorskip("viser", reason="the viewer needs viser")
    monkeypatch.setattr("ninedof.viewer.app.PATIENCE", 0.05)
    before, begun, go_on = set(threading.enumerate()), threading.Event(), threading.Event()
    viewer = nd.view(port=0)
    viewer.submit("long", lambda: begun.set() or go_on.wait(10.0))
    assert begun.wait(10.0)
    with pytest.warns(RuntimeWarning, match=r"still at work after 0\.05 s"):
        viewer.close()
    go_on.set()
    assert free_of_threads(before) is True


def test_closing_ends_a_search_for_a_workspace():
    pytest.importorskip("viser", reason="the viewer needs viser")
    before = set(threading.enumerate())
    with nd.view(port=0) as viewer:
        with viewer._lock:
            viewer.state.set_rule("best")
        viewer.compute_body(6.0)
        assert any(t.name == "ninedof-viewer-workspace" for t in threading.enumerate())
    assert free_of_threads(before) is True


def test_only_what_changed_is_sent():
    pytest.importorskip("viser", reason="the viewer needs viser")
    with nd.view(port=0) as viewer, viewer._lock:
        viewer.update(settled=True)
        sent = []
        interface = viewer._server._websock_server
        queue, interface.queue_message = interface.queue_message, sent.append
        try:
            viewer.update(settled=True)
            assert sent == []
            viewer.state.set_internal_point(viewer.state.configuration.internal_point + np.array([0.0, 0.0, 0.1]))
            viewer.update(settled=True)
        finally:
            interface.queue_message = queue
    named = {getattr(one, "name", "") for one in sent}
    assert {"/legs", "/O"} <= named
    assert not named & {"/base", "/platform", "/labels/l1", "/labels/l2", "/ground"}


@pytest.mark.parametrize("error", [ValueError("no limits"), MemoryError(), ZeroDivisionError("by nothing")])
def test_a_search_that_fails_is_told(monkeypatch, capfd, error):
    pytest.importorskip("viser", reason="the viewer needs viser")

    def fails(question, stopped):
        raise error

    monkeypatch.setattr("ninedof.viewer.body_job.body", fails)
    with nd.view(port=0) as viewer:
        viewer.compute_body(6.0)
        until(lambda: f"Not found: {error or type(error).__name__}" in viewer.panel._body.content)
    assert ("Traceback" in capfd.readouterr().err) != isinstance(error, ValueError)


def test_a_body_found_as_it_is_given_up_is_not_shown(monkeypatch):
    pytest.importorskip("viser", reason="the viewer needs viser")
    ball = shapes.ball()
    made = Body(ball[0].astype(np.float64), ball[1], 4.2, False)
    monkeypatch.setattr("ninedof.viewer.body_job.body", lambda question, stopped: made)
    with nd.view(port=0) as viewer:
        shown = "/workspace"
        viewer.compute_body(6.0)
        until(lambda: shown in viewer.scene._nodes)
        with viewer._lock:  # the thread that works waits
            viewer.compute_body(6.0)
            until(lambda: not [t for t in threading.enumerate() if t.name == "ninedof-viewer-workspace"])
            viewer.remove_body()
        done = threading.Event()
        viewer.submit("done", done.set)
        assert done.wait(10.0)
        assert shown not in viewer.scene._nodes
        assert "Volume" not in viewer.panel._body.content


@pytest.mark.parametrize(("unit", "duration"), [("mm", "duration 2 s<"), ("", "duration 2<")])
def test_names_and_errors_are_text_and_time_has_a_unit_where_lengths_have(unit, duration):
    pytest.importorskip("viser", reason="the viewer needs viser")
    g, home = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0), nd.Configuration.neutral(3.98, 2.44)
    with nd.view(nd.Design(g, home, unit=unit), port=0) as viewer:
        name = "<img src=x onerror=alert(1)> *a*.csv"
        path = nd.Trajectory.circle(home, radius=0.5, duration=2.0, points=21)
        viewer.submit("path", lambda: viewer._open_path(name, path))
        until(lambda: "21 poses" in viewer.panel._path_text.content)
        assert f"&lt;img src=x onerror=alert(1)&gt; *a*.csv: 21 poses, {duration}" in viewer.panel._path_text.content
        viewer.panel.tell_body("Not found: <b>")
        assert "Not found: &lt;b&gt;" in viewer.panel._body.content
        viewer.panel.tell_body("")
        assert viewer.panel._body.content == ""


def shifted_along_x(point, by):
    return point + np.array([by, 0.0, 0.0])


def test_a_handle_follows_again_when_its_client_leaves():
    pytest.importorskip("viser", reason="the viewer needs viser")
    with nd.view(port=0) as viewer:
        gizmo, home = viewer.scene.gizmo("platform"), viewer.state.home.position
        (dragged,), (left,) = gizmo._impl_aux.update_cb, viewer._server._client_disconnect_cb
        until(lambda: np.allclose(gizmo.position, viewer.scene.scale * home))  # drawn for the first time
        gizmo._impl.position = viewer.scene.scale * shifted_along_x(home, 0.5)  # as a browser has moved it
        for client in (3, 4):
            asyncio.run(dragged(SimpleNamespace(target=gizmo, phase="update", client_id=client)))
        until(lambda: len(viewer.scene.held) == 2)
        until(lambda: abs(viewer.design.configuration.position[0] - 0.5) < 1e-9)
        asyncio.run(left(SimpleNamespace(client_id=3)))
        until(lambda: viewer.scene.held == {("/platform gizmo", 4)})
        asyncio.run(left(SimpleNamespace(client_id=4)))
        viewer.submit("pose", viewer.state.go_home)
        until(lambda: np.allclose(gizmo.position, viewer.scene.scale * home))


def until(condition, seconds=20.0):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.01)


def test_a_path_is_played_and_every_control_works(tmp_path, capfd):
    pytest.importorskip("viser", reason="the viewer needs viser")
    home = nd.Configuration.neutral(3.98, 2.44)
    with nd.view(port=0, path=nd.Trajectory.circle(home, radius=0.5, duration=2.0, points=21), dark=True) as viewer:
        viewer.submit("play", viewer.toggle_play)
        until(lambda: viewer.player is not None and viewer.player.time > 0.05)
        p = viewer.design.configuration.position
        assert np.hypot(*(p - home.position)[:2]) > 0.0
        viewer.submit("play", viewer.toggle_play)
        viewer.submit("modes", viewer.find_modes)
        viewer.submit("mode", lambda: viewer.show_mode(1))
        for kind in ELLIPSOIDS:
            viewer.panel.ellipsoid = kind
            viewer.submit(kind, lambda: None)
        until(lambda: viewer.panel._mode.options[0].startswith("1: condition number"))
        viewer.submit("variable", lambda: viewer.state.set_variables({"a1": 0.3}))
        viewer.submit("late", lambda: viewer.show_mode(1))
        until(lambda: viewer.panel._mode.value == "not searched")
        assert viewer.panel._mode.disabled
        assert viewer.state.variables["a1"] == 0.3
        for part in ("labels", "handles", "axes"):
            viewer.show(part, False)
        viewer.set_dark(False)
        viewer.compute_body(6.0)
        until(lambda: "Volume about" in viewer.panel._body.content)
        viewer.remove_body()
        bad = SimpleNamespace(name="mine.csv", content=b"t,x,y\n")
        viewer.submit("path", lambda: viewer.read_path(bad))
        until(lambda: viewer.state.note.startswith("mine.csv"))
    assert capfd.readouterr() == ("", "")


@pytest.mark.slow
@pytest.mark.skipif(chromium.PROGRAM is None, reason="needs the program chromium")
def test_a_browser_moves_a_slider_and_the_number_changes(tmp_path):
    pytest.importorskip("viser", reason="the viewer needs viser")
    with nd.view(port=0) as viewer, chromium.page(viewer.url, tmp_path / "profile", 400, 300) as page:
        assert page.wait_for(NUMBER.format("condition-number")) == "3.9071"
        leg = page.run(NUMBER.format("leg-l1"))
        page.wait_for("document.querySelectorAll('[role=slider]').length >= 9")
        page.run("document.querySelectorAll('[role=slider]')[0].focus()")
        page.key("ArrowRight", times=5)
        page.wait_for(NUMBER.format("condition-number") + " !== '3.9071'")
        end = time.monotonic() + 20.0
        while abs(viewer.design.configuration.position[0] - 0.05) > 1e-9:  # five steps of 0.01
            assert time.monotonic() < end
            time.sleep(0.02)
        c = viewer.design.configuration
        expected = f"{nd.condition_number(viewer.design.geometry, c):.4f}"
        page.wait_for(NUMBER.format("condition-number") + f" === '{expected}'")
        assert page.run(NUMBER.format("leg-l1")) == f"{nd.leg_lengths(viewer.design.geometry, c)[0]:.4f}" != leg
        assert page.errors == []
