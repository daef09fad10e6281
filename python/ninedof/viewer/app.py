"""The viewer: a server, the scene and the panel, and one thread that brings both up to date."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import numpy as np

from ninedof.motion.trajectory import Trajectory
from ninedof.runs.design_file import Design
from ninedof.viewer.handles import Handles
from ninedof.viewer.panel import ELLIPSOIDS, Panel
from ninedof.viewer.parts import EXTENT
from ninedof.viewer.playback import Playback
from ninedof.viewer.scene import Scene
from ninedof.viewer.server import started, stopped
from ninedof.viewer.state import State
from ninedof.viewer.subject import Subject
from ninedof.viewer.worker import Change, Worker

BRAND = (0, 114, 178)


class Viewer:
    """A machine in a browser, until `close`. Made by `ninedof.view`."""

    def __init__(self, subject: Subject, host: str, port: int, dark: bool) -> None:
        self.subject = subject
        self.state = State(subject)
        self.lock = threading.RLock()
        """Held while the state is changed or looked at."""
        self.worker = Worker(
            self._apply, lambda settled: self.update(settled), self._note, lambda: self.playback.playing
        )
        self._server = started(host, port)
        self.host, self.port = host, int(self._server.get_port())
        try:
            self._build(dark)
        except BaseException:
            stopped(self._server)
            raise
        self.worker.start()  # what a page has asked for meanwhile waits

    def _build(self, dark: bool) -> None:
        self._theme(dark)
        self._server.gui.main_panel.dock_right()
        self.scene = Scene(self._server, self.subject.size, dark)
        self.panel = Panel(self, self._server.gui, dark)
        self.handles = Handles(self, self._server)
        middle = 0.5 * self.scene.scale * self.state.home.position * np.array([0.0, 0.0, 1.0])
        camera = self._server.initial_camera
        camera.look_at = middle
        camera.position = middle + 1.55 * EXTENT * np.array([0.42, -0.80, 0.36])
        camera.fov = math.radians(40.0)

    # --- for Python -----------------------------------------------------------------------------------------------

    @property
    def url(self) -> str:
        """The address to open in a browser."""
        host = {"0.0.0.0": "127.0.0.1", "::": "[::1]"}.get(  # noqa: S104 nothing listens here
            self.host, f"[{self.host}]" if ":" in self.host else self.host
        )
        return f"http://{host}:{self.port}"

    @property
    def design(self) -> Design:
        """What is shown: a design whose neutral pose is the pose shown."""
        with self.lock:
            return self.state.design

    @property
    def playback(self) -> Playback:
        """The path that is open."""
        return self.panel.playback

    def play(self, path: Any) -> None:
        """Play a path: a Trajectory, or a CSV file of poses as `ninedof.Trajectory.load` reads it."""
        name, found = ("path", path) if isinstance(path, Trajectory) else (Path(path).name, self.playback.load(path))
        self.submit("path", lambda: self.playback.open(name, found))

    def wait(self) -> None:
        """Return when the viewer is closed; Ctrl-C interrupts it."""
        while not self.worker.closed.wait(0.5):
            pass

    def close(self) -> None:
        """Stop the threads and the server. A second call does nothing."""
        if self.worker.close():
            self.panel.body.close()
            stopped(self._server)

    def __enter__(self) -> Self:
        """Return the viewer."""
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        """Close the viewer."""
        self.close()

    def __repr__(self) -> str:
        """Show the address."""
        return f"<Viewer: closed, was {self.url}>" if self.worker.closed.is_set() else f"<Viewer: {self.url}>"

    # --- for the controls -----------------------------------------------------------------------------------------

    def submit(self, key: str, change: Callable[[], object]) -> None:
        """Let a change of the state be made soon; it replaces one of the same key that still waits."""
        self.worker.submit(key, change)

    def show(self, part: str, visible: bool) -> None:
        """Show or hide a part of the scene."""
        self.submit(f"show {part}", lambda: self.scene.show(part, visible))

    def set_dark(self, dark: bool) -> None:
        """Choose dark or light."""
        self._theme(dark)
        self.submit("dark", lambda: self.scene.set_dark(dark))

    # --- within, by the thread that works -------------------------------------------------------------------------

    def update(self, settled: bool = False) -> None:
        """Bring scene and panel up to date."""
        with self.lock:
            state = self.state
            found = state.numbers()
            with self._server.atomic():
                self.scene.draw(state.geometry, state.configuration, found, self.handles.names)
                self.scene.draw_region(self.subject.region, state.home)
                if (kind := ELLIPSOIDS[self.panel.ellipsoid]) is None:
                    self.scene.hide_ellipsoid()
                else:
                    shape = kind[0](state.geometry, state.configuration, kind[1], state.yardstick.length)
                    self.scene.draw_ellipsoid(state.configuration, *shape)
                self.panel.refresh(found, settled)

    def _apply(self, changes: list[Change], passed: float) -> None:
        with self.lock:
            wrong = ""
            for change in changes:
                try:
                    change()
                except ValueError as error:  # the others are made
                    wrong = str(error)
            self.playback.advance(passed)
            if wrong:
                self._note(wrong)

    def _note(self, words: str) -> None:
        self.state.note = words

    def _theme(self, dark: bool) -> None:
        self._server.gui.configure_theme(
            dark_mode=dark,
            control_width="large",
            show_logo=False,
            show_share_button=False,
            brand_color=BRAND,
        )
