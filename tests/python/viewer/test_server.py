"""Strangers at the door of the viewer: other sites, other names of this machine, messages that nobody should send."""

import re
import socket
import sys
import time
from types import SimpleNamespace

import pytest

import ninedof as nd
from ninedof.cli.app import main
from ninedof.support.extras import MissingExtra
from ninedof.viewer.folders import open_path
from ninedof.viewer.machine import machine_of
from ninedof.viewer.server import loopback, refusal, start
from ninedof.viewer.state import State


def test_without_viser_one_line_names_the_extra(run, monkeypatch):
    monkeypatch.setitem(sys.modules, "viser", None)
    with pytest.raises(MissingExtra, match=r"the viewer needs viser.*pip install 'ninedof\[viewer\]'"):
        nd.view()
    status, _, err = run("view")
    assert status == 2
    assert err.count("\n") == 1
    assert "ninedof[viewer]" in err


class Headers:
    """As those of websockets: names without case, each as often as it came."""

    def __init__(self, **values):
        self._values = {name: [value] if isinstance(value, str) else value for name, value in values.items()}

    def get_all(self, name):
        return self._values.get(name.lower(), [])


@pytest.mark.parametrize(
    ("headers", "host", "refused"),
    [
        ({"host": "127.0.0.1:8080"}, "127.0.0.1", ""),
        ({"host": "127.0.0.1:8080", "origin": "http://127.0.0.1:8080"}, "127.0.0.1", ""),
        ({"host": "localhost:8080", "origin": "http://LOCALHOST:8080"}, "127.0.0.1", ""),
        ({"host": "localhost:9000", "origin": "http://localhost:9000"}, "127.0.0.1", ""),  # through a tunnel of ssh
        ({"host": "[::1]:8080", "origin": "http://[::1]:8080"}, "::1", ""),
        ({"host": "192.0.2.7:8080", "origin": "http://192.0.2.7:8080"}, "0.0.0.0", ""),
        ({"host": f"{socket.gethostname()}:8080"}, "0.0.0.0", ""),
        ({"host": "lab.example", "origin": "https://lab.example"}, "lab.example", ""),
        ({"host": "127.0.0.1:8080", "origin": "http://evil.example"}, "127.0.0.1", "Origin"),
        ({"host": "127.0.0.1:8080", "origin": "http://127.0.0.1:8081"}, "127.0.0.1", "Origin"),
        ({"host": "127.0.0.1:8080", "origin": "http://127.0.0.1:8080.evil.example"}, "127.0.0.1", "Origin"),
        ({"host": "127.0.0.1:8080", "origin": "http://localhost:8080"}, "127.0.0.1", "Origin"),
        ({"host": "127.0.0.1:8080", "origin": "null"}, "127.0.0.1", "Origin"),  # a file, a frame without rights
        ({"host": "127.0.0.1:8080", "origin": ""}, "127.0.0.1", "Origin"),
        ({"host": "a", "origin": ["http://a", "http://evil.example"]}, "a", "Origin"),
        ({"host": "evil.example:8080", "origin": "http://evil.example:8080"}, "127.0.0.1", "Host"),  # rebound
        ({"host": "evil.example:8080"}, "0.0.0.0", "Host"),
        ({"host": "localhost.evil.example"}, "127.0.0.1", "Host"),
        ({"host": "127.0.0.1.evil.example"}, "127.0.0.1", "Host"),
        ({"host": "127.0.0.1:8080@evil.example"}, "127.0.0.1", "Host"),
        ({"host": "127.0.0.1; script-src *"}, "127.0.0.1", "Host"),
        ({"host": "localhost\n"}, "127.0.0.1", "Host"),
        ({"host": ["127.0.0.1", "evil.example"]}, "127.0.0.1", "Host"),
        ({}, "127.0.0.1", "Host"),
    ],
)
def test_only_the_page_of_the_viewer_is_served(headers, host, refused):
    why = refusal(Headers(**headers), host)
    assert bool(why) == bool(refused)
    assert why.startswith(refused)


@pytest.mark.parametrize(
    ("host", "own"),
    [
        *((own, True) for own in ("127.0.0.1", "127.9.9.9", "::1", "localhost")),
        *((other, False) for other in ("0.0.0.0", "::", "192.0.2.7", "evil.example", "")),
    ],
)
def test_what_is_reached_from_this_machine_alone(host, own):
    assert loopback(host) is own


def status(viewer, *lines):
    """Return the status of the answer to a request for the page."""
    with socket.create_connection(("127.0.0.1", viewer.port), timeout=20.0) as caller:
        caller.sendall(("\r\n".join(["GET / HTTP/1.1", *lines]) + "\r\n\r\n").encode())
        return int(caller.recv(12).split()[1])


SOCKET = [
    "Upgrade: websocket",
    "Connection: Upgrade",
    "Sec-WebSocket-Version: 13",
    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==",
]


def test_a_foreign_page_gets_neither_the_page_nor_the_socket(capfd, caplog):
    pytest.importorskip("viser", reason="the viewer needs viser")
    with nd.view(port=0) as viewer:
        own = f"127.0.0.1:{viewer.port}"
        for more in ([], SOCKET):
            for host, origin in ((own, "http://evil.example"), ("evil.example", "http://evil.example"), (own, "null")):
                assert status(viewer, f"Host: {host}", f"Origin: {origin}", *more) == 403
        assert status(viewer, f"Host: {own}") == 200
        assert status(viewer, f"Host: {own}", f"Origin: http://{own}", *SOCKET) == 101
    assert "Traceback" not in "".join(capfd.readouterr())


def test_no_message_of_a_page_hands_the_viewer_to_the_world(monkeypatch):
    viser = pytest.importorskip("viser", reason="the viewer needs viser")
    msgspec = pytest.importorskip("msgspec")
    from viser import _messages, _viser
    from websockets.sync.client import connect

    tunnels = []
    monkeypatch.setattr(_viser, "ViserTunnel", lambda *at: tunnels.append(at) or SimpleNamespace())
    with nd.view(port=0) as viewer:
        protocol = f"viser-v{viser.__version__}"
        with connect(viewer.url.replace("http", "ws"), subprotocols=[protocol], max_size=None) as page:
            file = viewer.panel.widgets["file"]
            seen = _messages.GuiUpdateMessage(file._impl.uuid, {"value": "dxf (.dxf)"})
            for message in (_messages.ShareUrlRequest(), _messages.ShareUrlDisconnect(), seen):
                page.send(msgspec.msgpack.encode(message.as_serializable_dict([])))
            begun = time.monotonic()
            while file.value != "dxf (.dxf)":  # the one after them was
                assert time.monotonic() < begun + 20.0
                time.sleep(0.01)
            assert viewer._server._thread_executor.submit(lambda: "done").result(20.0) == "done"
        assert tunnels == []
        assert viewer._server.request_share_url() is None
    assert tunnels == []


def test_a_viser_whose_requests_are_not_guarded_is_not_started(monkeypatch):
    viser = pytest.importorskip("viser", reason="the viewer needs viser")
    ended = []
    other = SimpleNamespace(stop=lambda: ended.append(True), get_port=lambda: 1)
    monkeypatch.setattr(viser, "ViserServer", lambda **_: other)
    with pytest.raises(ValueError, match=r"viser: got \d.*whose requests are not guarded"):
        start("127.0.0.1", 0)
    assert ended == [True]


def test_a_host_that_the_network_reaches_is_warned_of(monkeypatch, capsys):
    pytest.importorskip("viser", reason="the viewer needs viser")
    said = "host: 0.0.0.0 is reached from the network, by everyone there: nothing asks for a password"
    with pytest.warns(RuntimeWarning, match=re.escape(said)), nd.view(host="0.0.0.0", port=0):
        pass
    monkeypatch.setattr("ninedof.viewer.app.Viewer.wait", lambda viewer: None)
    for host, warned in (("0.0.0.0", f"ninedof: {said}\n"), ("127.0.0.1", "")):
        with pytest.raises(SystemExit) as left:
            main(["view", "--host", host, "--port", "0"])
        assert left.value.code == 0
        assert capsys.readouterr().err == warned


def test_the_name_of_an_upload_opens_nothing(tmp_path):
    (tmp_path / "mine.csv").write_text("mine")
    state = State(machine_of())
    for name in (str(tmp_path / "mine.csv"), "../mine.csv", "\x00", "a\nb"):
        with pytest.raises(ValueError, match="t") as refused:
            open_path(state, SimpleNamespace(name=name, content=b"t,x,y\n"))
        assert str(refused.value).startswith(name)
    assert (tmp_path / "mine.csv").read_text() == "mine"
