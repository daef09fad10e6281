"""The viewer: a server, the scene and the panel, and one thread that brings both up to date."""

from __future__ import annotations

import math
import tempfile
import threading
import time
import traceback
import warnings
from collections.abc import Callable
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import numpy as np

from ninedof.motion.rotations import from_quaternions
from ninedof.motion.trajectory import Trajectory
from ninedof.runs.design_file import Design
from ninedof.viewer.body import Body
from ninedof.viewer.body_job import BodyJob
from ninedof.viewer.downloads import send_design, send_picture
from ninedof.viewer.html import number
from ninedof.viewer.panel import ELLIPSOIDS, Panel
from ninedof.viewer.player import Player
from ninedof.viewer.scene import EXTENT, Scene
from ninedof.viewer.server import started, stopped
from ninedof.viewer.state import State
from ninedof.viewer.subject import Subject

FRAME = 1.0 / 40.0  # seconds between two poses of a path that is played
SETTLED = 0.5  # seconds without a change after which all sliders are set to the model
PATIENCE = 10.0  # seconds that closing waits for the thread that works
BRAND = (0, 114, 178)


class Viewer:
    """A machine in a browser, until `close`. Made by `ninedof.view`."""

    def __init__(self, subject: Subject, host: str, port: int, dark: bool) -> None:
        self.subject = subject
        self.state = State(subject)
        self.player: Player | None = None
        self._pending: dict[str, Callable[[], object]] = {"first": lambda: None}
        self._wake = threading.Condition()
        self._lock = threading.RLock()
        self._closed = threading.Event()
        self._job = BodyJob(self._found_body, self._found_no_body)
        self._server = started(host, port)
        self.host, self.port = host, int(self._server.get_port())
        try:
            self._build(dark)
        except BaseException:
            stopped(self._server)
            raise
        self._worker = threading.Thread(target=self._work, name="ninedof-viewer", daemon=True)
        self._worker.start()

    def _build(self, dark: bool) -> None:
        self._theme(dark)
        self._server.gui.main_panel.dock_right()
        self.scene = Scene(self._server, self.subject.size, dark)
        self.panel = Panel(self, self._server.gui, dark)
        self._camera()
        for name in ("platform", "O"):
            self._server_handle(name)
        self._on_leaving()

    # --- for Python -----------------------------------------------------------------------------------------------

    @property
    def url(self) -> str:
        """The address to open in a browser."""
        host = {"0.0.0.0": "127.0.0.1", "::": "[::1]"}.get(
            self.host, f"[{self.host}]" if ":" in self.host else self.host
        )
        return f"http://{host}:{self.port}"

    @property
    def design(self) -> Design:
        """What is shown: a design whose neutral pose is the pose shown."""
        with self._lock:
            return self.state.design

    def play(self, path: Any) -> None:
        """Play a path: a Trajectory, or a CSV file of poses as `ninedof.Trajectory.load` reads it."""
        if isinstance(path, Trajectory):
            self.submit("path", lambda: self._open_path("path", path))
            return
        found = Trajectory.load(path, self.state.home, self.subject.unit)
        self.submit("path", lambda: self._open_path(Path(path).name, found))

    def wait(self) -> None:
        """Return when the viewer is closed; Ctrl-C interrupts it."""
        while not self._closed.wait(0.5):
            pass

    def close(self) -> None:
        """Stop the threads and the server. A second call does nothing."""
        with self._wake:
            if self._closed.is_set():
                return
            self._closed.set()
            self._wake.notify_all()
        if threading.current_thread() is not self._worker:
            self._worker.join(timeout=PATIENCE)
            if self._worker.is_alive():
                warnings.warn(
                    f"the viewer is closed, but its thread is still at work after {PATIENCE:g} s",
                    RuntimeWarning,
                    stacklevel=2,
                )
        self._job.close()
        stopped(self._server)

    def __enter__(self) -> Self:
        """Return the viewer."""
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        """Close the viewer."""
        self.close()

    def __repr__(self) -> str:
        """Show the address."""
        return f"<Viewer: closed, was {self.url}>" if self._closed.is_set() else f"<Viewer: {self.url}>"

    # --- changes, each by the thread that works ---------------------------------------------------------------------

    def submit(self, key: str, change: Callable[[], object]) -> None:
        """Let a change of the state be made soon; it replaces one of the same key that still waits."""
        with self._wake:
            self._pending.pop(key, None)
            self._pending[key] = change
            self._wake.notify()

    def move(self, axis: int, value: float) -> None:
        """Move the platform along one axis."""
        position = self.state.configuration.position.copy()
        position[axis] = value
        self.state.set_pose(position=position)

    def turn(self, axis: int, value: float) -> None:
        """Set one component of the rotation vector, degrees."""
        turn = list(self.state.turn_deg)
        turn[axis] = value
        self.state.set_pose(turn_deg=turn)

    def move_internal_point(self, axis: int, value: float) -> None:
        """Move O along one axis."""
        point = self.state.configuration.internal_point.copy()
        point[axis] = value
        self.state.set_internal_point(point)

    def find_modes(self) -> None:
        """List the assembly modes of the leg lengths shown."""
        found, kappa, status = self.state.modes()
        names = [f"{k}: condition number {number(value)}" for k, value in enumerate(kappa.tolist(), start=1)]
        here = self.state.configuration
        shown = 0
        if names:
            away = np.abs(found.position - here.position).max(axis=1) / self.subject.size
            away += np.abs(found.rotation - here.rotation).max(axis=(1, 2))
            shown = int(np.argmin(away + np.abs(found.internal_point - here.internal_point).max(axis=1)))
        self.panel.list_modes(names, f"none: {status}", shown)

    def show_mode(self, k: int) -> None:
        """Show one of the modes found."""
        listed = self.state.listed
        if listed is not None and k < len(listed):
            self.state.set_configuration(listed[k])

    def read_path(self, file: Any) -> None:
        """Open a path that the browser has sent."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "path.csv"
            path.write_bytes(file.content)
            try:
                found = Trajectory.load(path, self.state.home, self.subject.unit)
            except ValueError as error:
                raise ValueError(str(error).replace(str(path), file.name)) from None
        self._open_path(file.name, found)

    def _open_path(self, name: str, found: Trajectory) -> None:
        self.player = Player(found)
        self.panel.offer_path(name, self.player.duration, len(found))
        points = found.position
        self.scene.draw_line("/path", np.stack([points[:-1], points[1:]], axis=1), "#AA3377")
        self.seek(0.0)

    def toggle_play(self) -> None:
        """Play or pause the path."""
        if self.player is not None:
            self.player.playing = not self.player.playing

    def set_speed(self, speed: float) -> None:
        """Set how much faster than its own times the path is played."""
        if self.player is not None:
            self.player.speed = speed

    def seek(self, at: float) -> None:
        """Show the pose of the path at a time."""
        if self.player is not None:
            self.player.time = at
            p, q = self.player.pose()
            self.state.set_pose(position=p, rotation=q)

    # --- the workspace, in a thread of its own --------------------------------------------------------------------

    def compute_body(self, condition_limit: float) -> None:
        """Draw the workspace as soon as it is known; one that is still sought is given up."""
        with self._lock:
            self._job.begin(self.state.body_question(condition_limit if condition_limit >= 1.0 else math.inf))
            self.panel.tell_body("Computing ...")

    def remove_body(self) -> None:
        """Remove the workspace."""
        with self._lock:
            self._job.cancel()
            self.panel.tell_body("")
        self.submit("remove body", self.scene.remove_body)

    def _found_body(self, search: int, found: Body) -> None:
        def show() -> None:  # under the lock under which a search begins and is given up
            if self._job.counts(search):
                self.panel.tell_body(self.panel.body_words(found.volume, found.open))
                self.scene.draw_body(found.vertices, found.faces)

        self.submit(f"body {search}", show)

    def _found_no_body(self, search: int, why: str) -> None:
        def tell() -> None:
            if self._job.counts(search):
                self.panel.tell_body(f"Not found: {why}")

        self.submit(f"body {search}", tell)

    # --- what the browser asks for --------------------------------------------------------------------------------

    def show(self, part: str, visible: bool) -> None:
        """Show or hide a part of the scene."""
        self.submit(f"show {part}", lambda: self.scene.show(part, visible))

    def set_dark(self, dark: bool) -> None:
        """Choose dark or light."""
        self._theme(dark)
        self.submit("dark", lambda: self.scene.set_dark(dark))

    def send_design(self, event: Any) -> None:
        """Send the design file of what is shown."""
        send_design(event.client, self.design)

    def send_picture(self, event: Any) -> None:
        """Send the scene as a PNG."""
        send_picture(event.client)

    # --- within ---------------------------------------------------------------------------------------------------

    def update(self, settled: bool = False) -> None:
        """Bring scene and panel up to date."""
        with self._lock:
            state = self.state
            found = state.numbers()
            with self._server.atomic():
                self.scene.draw(state.geometry, state.configuration, found)
                if (kind := ELLIPSOIDS[self.panel.ellipsoid]) is None:
                    self.scene.hide_ellipsoid()
                else:
                    shape = kind[0](state.geometry, state.configuration, kind[1], state.yardstick.length)
                    self.scene.draw_ellipsoid(state.configuration, *shape)
                self.panel.refresh(found, settled)

    def _work(self) -> None:
        settled, last = True, time.monotonic()
        while not self._closed.is_set():
            playing = self.player is not None and self.player.playing
            with self._wake:  # what ends the wait changes under the same lock: no call is missed
                self._wake.wait_for(
                    lambda: bool(self._pending) or self._closed.is_set(),
                    FRAME if playing else None if settled else SETTLED,
                )
                changes, self._pending = list(self._pending.values()), {}
            now = time.monotonic()
            passed, last = now - last, now
            if self._closed.is_set() or (settled and not changes and not playing):
                continue
            try:
                self._apply(changes, passed if playing else 0.0)
                settled = not changes and not playing
                self.update(settled)
            except ValueError as error:
                self.state.note = str(error)
                settled = False
            except Exception:  # the viewer goes on; a mistake of the program is shown where it was started
                traceback.print_exc()
                settled = True

    def _apply(self, changes: list[Callable[[], object]], passed: float) -> None:
        with self._lock:
            wrong = ""
            for change in changes:
                try:
                    change()
                except ValueError as error:  # the others are made
                    wrong = str(error)
            if passed > 0.0 and self.player is not None:
                self.player.advance(min(passed, 0.2))
                p, q = self.player.pose()
                self.state.set_pose(position=p, rotation=q)
            if wrong:
                self.state.note = wrong

    def _server_handle(self, name: str) -> None:
        handle = self.scene.gizmo(name)

        async def dragged(event: Any) -> None:  # not in a pool of threads, so that drags keep their order
            position = np.asarray(event.target.position) / self.scene.scale
            turn = from_quaternions(np.asarray(event.target.wxyz, dtype=np.float64)[None])[0]
            client, is_held = event.client_id, event.phase != "end"
            self.submit(f"hold {name} {client}", lambda: self.scene.hold(name, client, is_held))
            if name == "O":
                self.submit("O", lambda: self.state.set_internal_point(position))
            else:
                self.submit("pose", lambda: self.state.set_pose(position=position, rotation=turn))

        handle.on_update(dragged)

    def _on_leaving(self) -> None:
        """Let the handles follow again that a client held when it left; its drag has no end."""

        async def left(client: Any) -> None:  # in order with the drags
            number = client.client_id
            self.submit(f"left {number}", lambda: self.scene.release_all(number))

        self._server.on_client_disconnect(left)

    def _theme(self, dark: bool) -> None:
        self._server.gui.configure_theme(
            dark_mode=dark,
            control_width="large",
            show_logo=False,
            show_share_button=False,
            brand_color=BRAND,
        )

    def _camera(self) -> None:
        middle = 0.5 * self.scene.scale * self.state.home.position * np.array([0.0, 0.0, 1.0])
        camera = self._server.initial_camera
        camera.look_at = middle
        camera.position = middle + 1.55 * EXTENT * np.array([0.42, -0.80, 0.36])
        camera.fov = math.radians(40.0)
