"""The viewer as a program: how it begins, how it ends, and a browser that uses it."""

import asyncio
import socket
import threading
import time
from importlib.util import find_spec
from types import SimpleNamespace

import chromium
import numpy as np
import pytest
from interrupts import until

import ninedof as nd
from ninedof.design.domains.region import region_lines
from ninedof.plot import style
from ninedof.viewer import shapes
from ninedof.viewer.body import Body
from ninedof.viewer.folders import open_path
from ninedof.viewer.scene import LEAST, PATH_COLOUR
from ninedof.viewer.state import ELLIPSOIDS

pytestmark = pytest.mark.skipif(find_spec("viser") is None, reason="the viewer needs viser")
LABELLED = "[...document.querySelectorAll('{}')].find(one => one.textContent.trim() === '{}')"
BOX = "(function near(e) { return e.querySelector('input[type=checkbox]') ?? near(e.parentElement) })"
NUMBER = "document.getElementById('ninedof-{}')?.textContent"


def free_of_threads(before):
    end = time.monotonic() + 10.0
    while time.monotonic() < end:
        left = [t for t in threading.enumerate() if t not in before and not t.name.startswith("asyncio")]
        if not left:
            return True
        time.sleep(0.05)
    return left


def test_a_port_in_use_is_one_line(run):
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        port = other.getsockname()[1]
        status, _, err = run(f"view --port {port}")
    assert status == 2
    assert err == f"ninedof: --port: got {port}, which is in use or reserved, expected a free one, or 0 for any\n"


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"host": "203.0.113.7"}, "host: got '203.0.113.7', expected an address of this machine"),
        ({"port": 70000}, "port: got 70000, expected a whole number from 0 to 65535"),
        ({"design": "nowhere.toml"}, "nowhere.toml"),
        ({"path": "nowhere.csv"}, "nowhere.csv"),
    ],
)
def test_bad_arguments_are_named_and_leave_nothing_running(options, words):
    before = set(threading.enumerate())
    with pytest.raises(ValueError, match=words):
        nd.view(**{"port": 0} | options)
    assert free_of_threads(before) is True


def test_it_listens_at_home_and_closes_cleanly(capfd):
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


def test_closing_ends_a_search_for_a_workspace():
    before = set(threading.enumerate())
    with nd.view(port=0) as viewer:
        viewer.submit("rule", lambda: viewer.state.set_rule("best"))
        viewer.submit("workspace", lambda: viewer.find_body(6.0))
        until(lambda: any(t.name.startswith("ninedof-viewer-workspace") for t in threading.enumerate()))
    assert free_of_threads(before) is True


def test_a_tool_is_drawn_and_the_sliders_are_said_to_be_of_its_point():
    tool = nd.Tool((0.0, 0.0, -1.0))
    g, c = tool.robot(nd.Geometry.hexagonal(0.0, 5.8124, 2.9062, 0.0), nd.Configuration.neutral(3.9828, 2.3745))
    with nd.view(nd.Design(g, c, 1.0, "", tool), port=0) as viewer, viewer.lock:
        viewer.update(settled=True)
        assert {"/tool", "/labels/tool"} <= set(viewer.scene.nodes)
        handles = viewer._server.gui._container_handle_from_uuid.values()
        folders = [getattr(one, "label", "") for one in handles]
    assert "Tool's point" in folders
    assert "Platform" not in folders


def test_only_what_changed_is_sent():
    with nd.view(port=0) as viewer, viewer.lock:
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


@pytest.mark.parametrize("error", [ValueError("no limits"), ZeroDivisionError("by nothing")])
def test_a_search_that_fails_is_told(monkeypatch, capfd, error):
    def fails(*_):
        raise error

    monkeypatch.setattr("ninedof.viewer.app.body_of", fails)
    with nd.view(port=0) as viewer:
        viewer.submit("workspace", lambda: viewer.find_body(6.0))
        until(lambda: f"Not found: {error}" in viewer.panel.widgets["workspace"].content)
    assert ("Traceback" in capfd.readouterr().err) != isinstance(error, ValueError)


def test_a_body_found_as_it_is_given_up_is_not_shown(monkeypatch):
    event = threading.Event()

    def body_of(*_):
        event.set()
        return Body("Volume about 4.2", shapes.ball())

    monkeypatch.setattr("ninedof.viewer.app.body_of", body_of)
    with nd.view(port=0) as viewer:
        viewer.submit("workspace", lambda: viewer.find_body(6.0))
        until(lambda: "/workspace" in viewer.scene.nodes)
        with viewer.lock:  # the thread that works waits
            event.clear()
            viewer.find_body(6.0)
            assert event.wait(10.0)
            viewer.remove_body()
        done = threading.Event()
        viewer.submit("done", done.set)
        viewer.submit("done again", lambda: None)
        assert done.wait(10.0)
        until(lambda: "/workspace" not in viewer.scene.nodes)
        until(lambda: viewer.panel.widgets["workspace"].content == "")  # drawn after the scene


@pytest.mark.parametrize(("unit", "duration"), [("mm", "duration 2 s<"), ("", "duration 2<")])
def test_names_and_errors_are_text_and_time_has_a_unit_where_lengths_have(unit, duration):
    g, home = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0), nd.Configuration.neutral(3.98, 2.44)
    with nd.view(nd.Design(g, home, unit=unit), port=0) as viewer:
        name = "<img src=x onerror=alert(1)> *a*.csv"
        path = nd.Trajectory.circle(home, radius=0.5, duration=2.0, points=21)
        viewer.submit("path", lambda: viewer.state.open_path(name, path))
        until(lambda: "21 poses" in viewer.panel.widgets["path"].content)
        assert (
            f"&lt;img src=x onerror=alert(1)&gt; *a*.csv: 21 poses, {duration}" in viewer.panel.widgets["path"].content
        )
        viewer.submit("workspace", lambda: setattr(viewer.state, "body", Body("Not found: <b>")))
        until(lambda: "Not found: &lt;b&gt;" in viewer.panel.widgets["workspace"].content)


def shifted_along_x(point, by):
    return point + np.array([by, 0.0, 0.0])


def test_a_handle_follows_again_when_its_client_leaves():
    with nd.view(port=0) as viewer:
        gizmo, home = viewer.scene.nodes["/platform gizmo"], viewer.state.variant.home.position
        (dragged,), (left,) = gizmo._impl_aux.update_cb, viewer._server._client_disconnect_cb
        until(lambda: np.allclose(gizmo.position, viewer.scene.scale * home))  # drawn for the first time
        gizmo._impl.position = viewer.scene.scale * shifted_along_x(home, 0.5)  # as a browser has moved it
        for client in (3, 4):
            asyncio.run(dragged(SimpleNamespace(target=gizmo, phase="update", client_id=client)))
        until(lambda: viewer.held == {"/platform gizmo": 4})
        until(lambda: abs(viewer.design.configuration.position[0] - 0.5) < 1e-9)
        asyncio.run(left(SimpleNamespace(client_id=3)))
        viewer.submit("pose", viewer.state.go_home)
        until(lambda: np.allclose(viewer.scene.nodes["/platform"].position, viewer.scene.scale * home))
        assert viewer.held == {"/platform gizmo": 4}
        assert not np.allclose(gizmo.position, viewer.scene.scale * home)
        asyncio.run(left(SimpleNamespace(client_id=4)))
        until(lambda: np.allclose(gizmo.position, viewer.scene.scale * home))


def test_the_first_view_fits_a_narrow_window_until_the_user_moves():
    g = nd.Geometry.hexagonal(a1=0.0, a2=850.0, b1=290.0, b2=0.0)
    design = nd.Design(g, nd.Configuration.neutral(zp=200.0, zs=100.0), 150.0, "mm")
    with nd.view(design, port=0) as viewer:
        first, updates = viewer._server.initial_camera, []
        camera = SimpleNamespace(position=first.position, look_at=first.look_at, aspect=1.6, on_update=updates.append)
        asyncio.run(viewer._server._client_connect_cb[-1](SimpleNamespace(camera=camera)))
        assert camera.position == pytest.approx(first.position)
        camera.aspect = 0.3  # the panel is docked, or the window made narrow
        asyncio.run(updates[0](camera))
        away = first.look_at - camera.position
        along = away / np.linalg.norm(away)
        right = np.cross(along, [0.0, 0.0, 1.0])
        right /= np.linalg.norm(right)
        for joint in viewer.scene.scale * np.concatenate([g.base_external, g.base_internal]):
            ray = joint - camera.position
            assert abs(ray @ right) < camera.aspect * np.tan(0.5 * first.fov) * (ray @ along)
        camera.position = own = camera.position + 1.0  # by the user
        camera.aspect = 0.5
        asyncio.run(updates[0](camera))
        assert camera.position is own


def test_a_path_is_played_and_every_control_works(tmp_path, capfd):
    home = nd.Configuration.neutral(3.98, 2.44)
    with nd.view(port=0, path=nd.Trajectory.circle(home, radius=0.5, duration=2.0, points=21), dark=True) as viewer:
        viewer.submit("play", viewer.state.toggle)
        until(lambda: viewer.state.player is not None and viewer.state.player.time > 0.05)
        p = viewer.design.configuration.position
        assert np.hypot(*(p - home.position)[:2]) > 0.0
        viewer.submit("play", viewer.state.toggle)
        viewer.submit("modes", viewer.state.find_modes)
        for kind in ELLIPSOIDS:
            viewer.submit("ellipsoid", lambda kind=kind: setattr(viewer.state.display, "ellipsoid", kind))
            until(lambda kind=kind: viewer.scene.nodes["/ellipsoid"].visible == (kind != "none"))
        mode = viewer.panel.widgets["Mode"]
        until(lambda: mode.options[0].startswith("1: condition number"))
        viewer.submit("variable", lambda: viewer.state.set_variables({"a1": 0.3}))
        viewer.submit("late", lambda: viewer.state.show_mode(1))
        until(lambda: mode.value == "not searched")
        assert mode.disabled
        assert viewer.state.variables["a1"] == 0.3
        for part in ("labels", "handles", "axes"):
            viewer.submit(part, lambda part=part: viewer.state.display.show(part, False))
        viewer.submit("dark", lambda: viewer.set_dark(False))
        viewer.submit("workspace", lambda: viewer.find_body(6.0))
        until(lambda: "Volume about" in viewer.panel.widgets["workspace"].content)
        viewer.submit("workspace", viewer.remove_body)
        bad = SimpleNamespace(name="mine.csv", content=b"t,x,y\n")
        viewer.submit("path", lambda: open_path(viewer.state, bad))
        until(lambda: viewer.state.note.startswith("mine.csv"))
    assert capfd.readouterr() == ("", "")


def test_the_button_shows_pause_while_a_path_is_played_and_lines_have_a_key():
    study = nd.Study(objective={"region": {"box": [0.3, 0.2, 0.1]}}, variables={"a1": 0.0, "b2": 0.0})
    with nd.view(nd.optimize(study, starts=1), port=0) as viewer, viewer.lock:
        play, legend = (viewer.panel.widgets[name] for name in ("play", "legend"))
        viewer.update()
        assert (play.label, play.icon) == ("Play", "player-play")
        assert "region of the study" in legend.content
        assert style.REGION in legend.content
        assert PATH_COLOUR not in legend.content
        home = viewer.state.variant.home
        viewer.state.open_path("<b>.csv", nd.Trajectory.line(home, [0.1, 0.0, 0.0], duration=5.0, points=11))
        for icon in ("player-pause", "player-play"):
            if viewer.state.player.playing == (icon == "player-play"):
                viewer.state.toggle()
            viewer.update()
            assert play.icon == icon
        assert PATH_COLOUR in legend.content
        assert "<b>" not in legend.content
        viewer.state.display.show("region", False)
        viewer.update()
        assert "region of the study" not in legend.content


@pytest.mark.parametrize("zs", [0.3, 2.4, 3.6, 3.97])
def test_handles_are_apart(zs):
    g, home = nd.Geometry.hexagonal(a1=0.0, a2=5.8, b1=2.9, b2=0.0), nd.Configuration.neutral(3.98, zs)
    with nd.view(nd.Design(g, home), port=0) as viewer, viewer.lock:
        viewer.update()
        nodes, scale = viewer.scene.nodes, viewer.scene.scale
        sizes = [nodes[f"/{name} gizmo"].scale for name in ("platform", "O")]
        assert sum(sizes) <= scale * (3.98 - zs) + 1e-9 or min(sizes) == LEAST
        assert min(sizes) >= LEAST


def test_the_mode_shown_is_the_one_chosen():
    g, home = nd.Geometry.hexagonal(a1=0.0, a2=850.0, b1=290.0, b2=0.0), nd.Configuration.neutral(480.0, 320.0)
    with nd.view(nd.Design(g, home, 150.0, "mm"), port=0) as viewer, viewer.lock:
        mode = viewer.panel.widgets["Mode"]
        for k in range(len(viewer.state.find_modes().condition_numbers)):
            viewer.state.show_mode(k)
            listed = viewer.state.find_modes().configurations
            viewer.update()
            chosen = listed[mode.options.index(mode.value)]
            shown = viewer.state.configuration
            np.testing.assert_allclose(chosen.internal_point, shown.internal_point, atol=1e-6)
            np.testing.assert_allclose(chosen.rotation, shown.rotation, atol=1e-9)


def test_a_region_is_drawn_about_the_neutral_pose_and_can_be_hidden():
    study = nd.Study(
        family="symmetric", constraints={"stroke_ratio": (None, 1.6)}, objective={"region": {"box": [0.3, 0.2, 0.1]}}
    )
    result = nd.optimize(study, starts=1, seed=1)
    with nd.view(result, port=0) as viewer:
        until(lambda: "/region" in viewer.scene.nodes)

        def box():
            points = viewer.scene.nodes["/region"].points.reshape(-1, 3) / viewer.scene.scale
            return points.min(axis=0), points.max(axis=0)

        home = viewer.state.variant.home.position
        for end, half in zip(box(), (-1.0, 1.0), strict=True):
            np.testing.assert_allclose(end, home + half * np.array([0.3, 0.2, 0.1]), atol=1e-5)
        viewer.submit("region", lambda: viewer.state.display.show("region", False))
        until(lambda: not viewer.scene.nodes["/region"].visible)
        viewer.submit("variable", lambda: viewer.state.set_variables({"zp": 1.1 * home[2]}))
        until(
            lambda: viewer.state.variant.home.position[2] != home[2] and abs(box()[1][2] - 1.1 * home[2] - 0.1) < 1e-5
        )
        assert not viewer.scene.nodes["/region"].visible
    assert region_lines(nd.Region(tilt=0.1), result.best.configuration) == []  # of turns alone


def test_requests_that_are_no_page_print_nothing(capfd, caplog):
    with nd.view(port=0) as viewer:
        for request in (b"HEAD / HTTP/1.1\r\nHost: x\r\n\r\n", b"\x16\x03\x01 no words\r\n\r\n", b"GET / HT", b""):
            with socket.create_connection((viewer.host, viewer.port)) as caller:
                caller.sendall(request)
                caller.shutdown(socket.SHUT_WR)
                caller.settimeout(10.0)
                assert caller.recv(100) == b""
    assert capfd.readouterr() == ("", "")
    assert caplog.records == []


@pytest.mark.slow
@pytest.mark.skipif(chromium.PROGRAM is None, reason="needs the program chromium")
def test_a_browser_moves_a_slider_and_the_number_changes(tmp_path):
    with (
        nd.view(port=0) as viewer,
        chromium.page(f"{viewer.url}/?fixedDpr=0.3", tmp_path / "profile", 400, 300) as page,
    ):
        assert page.wait_for(NUMBER.format("condition-number")) == "3.9071"
        leg = page.run(NUMBER.format("leg-l1"))
        page.wait_for("document.querySelectorAll('[role=slider]').length >= 9")
        page.run("document.querySelectorAll('[role=slider]')[0].focus()")
        for step in (1, 2, 3):  # each seen before the next: a slow browser gets back what it sent before
            page.key("ArrowRight")
            until(lambda at=0.01 * step: abs(viewer.design.configuration.position[0] - at) < 1e-9)
        page.wait_for(NUMBER.format("condition-number") + " !== '3.9071'")
        c = viewer.design.configuration
        expected = f"{nd.condition_number(viewer.design.geometry, c):.4f}"
        page.wait_for(NUMBER.format("condition-number") + f" === '{expected}'")
        assert page.run(NUMBER.format("leg-l1")) == f"{nd.leg_lengths(viewer.design.geometry, c)[0]:.4f}" != leg
        page.run(f"{BOX}({LABELLED.format('label', 'labels')}).click()")
        until(lambda: not viewer.scene.nodes["/labels/l1"].visible)
        page.run(f"{LABELLED.format('button', 'Find all')}.click()")
        until(lambda: viewer.panel.widgets["Mode"].options[0].startswith("1: condition number"))
        carried, _, held, _ = viewer.panel.widgets["O is"].options
        page.run(f"[...document.querySelectorAll('input')].find(one => one.value === '{carried}').click()")
        option = LABELLED.format("[role=option]", held)
        page.wait_for(f"{option} !== undefined")
        page.run(f"{option}.click()")
        until(lambda: viewer.state.rule == "held")
        assert [error for error in page.errors if "unsafe-eval" not in error] == []  # of what draws splats: none here
