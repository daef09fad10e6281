"""The viewer: a server, and one thread that makes the changes of the state and brings scene and panel up to date."""

from __future__ import annotations

import math
import threading
import time
import traceback
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, Self

import numpy as np

from ninedof.motion.rotations import from_quaternions
from ninedof.motion.trajectory import Trajectory
from ninedof.proof.admissible.result import AdmissibleSet
from ninedof.records.design_file import Design
from ninedof.viewer.body import Body, BodySearch, body_of, question_of
from ninedof.viewer.designs import DesignPicture
from ninedof.viewer.folders import build
from ninedof.viewer.machine import Machine
from ninedof.viewer.numbers import numbers_of
from ninedof.viewer.panel import Panel
from ninedof.viewer.scene import EXTENT, Scene
from ninedof.viewer.server import start, stop
from ninedof.viewer.state import State

BRAND = (0, 114, 178)
FRAME = 1.0 / 40.0  # seconds between two poses of a path that is played
SETTLED = 0.5  # seconds without a change after which all sliders are set to the state
LONGEST_STEP = 0.2  # seconds: a path does not jump after an update that took long


class Viewer:
    """A machine in a browser, until `close`. Made by `ninedof.view`."""

    def __init__(
        self, machine: Machine, host: str, port: int, dark: bool, designs: AdmissibleSet | None = None
    ) -> None:
        self.state = State(machine, dark)
        top = EXTENT / machine.size * float(self.state.variant.home.position[2])
        self.designs = None if designs is None else DesignPicture(designs, top)
        """The picture of a set of admissible designs, if there is one."""
        self.lock = threading.RLock()
        """Held while the state is changed or read."""
        self.held: dict[str, int] = {}
        """Handles in the hand of a user, by client: that browser knows best where they are."""
        self._pending: dict[str, Callable[[], object]] = {"first": lambda: None}
        self._wake = threading.Condition()
        self._closed = threading.Event()
        self._search = BodySearch(self._show_body)
        self._thread = threading.Thread(target=self._work, name="ninedof-viewer", daemon=True)
        self._server = start(host, port)
        self.host, self.port = host, int(self._server.get_port())
        try:
            self._build(dark)
        except BaseException:
            stop(self._server)
            raise
        self._thread.start()  # what a page has asked for meanwhile waits

    def _build(self, dark: bool) -> None:
        self.set_dark(dark)
        self._server.gui.main_panel.dock_right()
        self.scene = Scene(self._server, self.state.machine.size, self.designs)
        self.panel = Panel(self, self._server.gui)
        build(self.panel)
        for name in ("platform", "O"):
            self._listen(name)
        if self.designs is not None:
            self.scene.nodes["/designs"].on_click(self._clicked)

        async def left(client: Any) -> None:  # in order with the drags, of which the last then has no end
            number = client.client_id
            self.submit(f"left {number}", lambda: self._release(number))

        self._server.on_client_disconnect(left)
        middle = 0.5 * self.scene.scale * self.state.variant.home.position * np.array([0.0, 0.0, 1.0])
        camera = self._server.initial_camera
        if self.designs is not None:
            middle = middle + np.array([0.0, 0.0, 1.0])
        away = (1.55 if self.designs is None else 2.0) * EXTENT * np.array([0.42, -0.80, 0.36])
        camera.look_at = middle
        camera.position = middle + away
        camera.fov = math.radians(40.0)

        async def begin(client: Any) -> None:
            seen = 1.0

            async def fit(camera: Any) -> None:
                """Stand back where a window is narrow, until the user moves: the angle of view is the vertical one."""
                nonlocal seen
                if np.allclose(camera.position, middle + away / seen, atol=1e-3):
                    seen = min(1.0, max(camera.aspect, 0.1))
                    camera.position = middle + away / seen
                    camera.look_at = middle

            client.camera.on_update(fit)
            await fit(client.camera)

        self._server.on_client_connect(begin)

    # --- for Python ---------------------------------------------------------------------------------------------------

    @property
    def url(self) -> str:
        """The address to open in a browser."""
        host = {"0.0.0.0": "127.0.0.1", "::": "::1"}.get(self.host, self.host)  # noqa: S104 nothing listens here
        return f"http://[{host}]:{self.port}" if ":" in host else f"http://{host}:{self.port}"

    @property
    def design(self) -> Design:
        """The design shown; its neutral pose is the pose shown."""
        with self.lock:
            return self.state.design

    def play(self, path: Any) -> None:
        """Play a path: a Trajectory, or a CSV file of poses as `ninedof.Trajectory.load` reads it."""
        name, trajectory = "path", path
        if not isinstance(path, Trajectory):
            name, trajectory = Path(path).name, Trajectory.load(path, self.state.variant.home, self.state.machine.unit)
        self.submit("path", lambda: self.state.open_path(name, trajectory))

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
        self._thread.join()
        self._search.close()
        stop(self._server)

    def __enter__(self) -> Self:
        """Return the viewer."""
        return self

    def __exit__(self, *error: object) -> None:
        """Close the viewer."""
        self.close()

    def __repr__(self) -> str:
        """Show the address."""
        return f"<Viewer: closed, was {self.url}>" if self._closed.is_set() else f"<Viewer: {self.url}>"

    # --- for the controls ---------------------------------------------------------------------------------------------

    def submit(self, key: str, change: Callable[[], object]) -> None:
        """Let a change of the state be made soon; it replaces one of the same key that still waits."""
        with self._wake:
            self._pending.pop(key, None)
            self._pending[key] = change
            self._wake.notify()

    def set_dark(self, dark: bool) -> None:
        """Choose dark or light."""
        self.state.display.dark = dark
        self._server.gui.configure_theme(
            dark_mode=dark, control_width="large", show_logo=False, show_share_button=False, brand_color=BRAND
        )

    def find_body(self, condition_limit: float) -> None:
        """Search the workspace; one that is still searched is given up. A limit below 1 is none."""
        state = self.state
        limit = condition_limit if condition_limit >= 1.0 else math.inf
        variant, unit = state.variant, state.machine.unit
        question = question_of(variant, state.configuration, state.rule, state.machine.size, limit)
        state.body = replace(state.body, words="Computing ...")
        self._search.begin(lambda progress: body_of(variant, question, unit, progress))

    def remove_body(self) -> None:
        """Remove the workspace."""
        self._search.cancel()
        self.state.body = Body()

    # --- within -------------------------------------------------------------------------------------------------------

    def update(self, settled: bool = False) -> None:
        """Bring scene and panel up to date."""
        with self.lock:
            numbers = numbers_of(self.state.variant, self.state.configuration)
            with self._server.atomic():
                self.scene.draw(self.state, numbers, set(self.held))
                self.panel.refresh(numbers, settled)

    def _work(self) -> None:
        settled, last = False, time.monotonic()
        while True:
            playing = self.state.player is not None and self.state.player.playing
            with self._wake:  # what ends the wait changes under the same lock: no call is missed
                self._wake.wait_for(
                    lambda: bool(self._pending) or self._closed.is_set(),
                    FRAME if playing else None if settled else SETTLED,
                )
                changes, self._pending = list(self._pending.values()), {}
            if self._closed.is_set():
                return
            now = time.monotonic()
            if playing:
                changes.append(partial(self.state.advance, min(now - last, LONGEST_STEP)))
            last, settled = now, not changes
            with self.lock:
                notes = [self._attempt(change) for change in changes]
                self.state.note = next(filter(None, reversed(notes)), self.state.note)
                self._attempt(partial(self.update, settled))

    def _attempt(self, change: Callable[[], object]) -> str:
        """Make a change; return why that could not be, "" where it was."""
        try:
            change()
        except ValueError as error:
            return str(error)
        except Exception:  # the viewer goes on; a mistake of the program is shown where it was started
            traceback.print_exc()
        return ""

    def _show_body(self, number: int, body: Body) -> None:
        def show() -> None:  # in the thread in which a search begins and is given up
            if self._search.counts(number):
                self.state.body = body

        self.submit(f"body {number}", show)

    def _listen(self, name: str) -> None:
        """Let a drag of a handle in the scene move the state, and leave the handle alone meanwhile."""
        node = f"/{name} gizmo"

        async def dragged(event: Any) -> None:  # not in a pool of threads, so that drags keep their order
            client, is_held = event.client_id, event.phase != "end"
            position = np.asarray(event.target.position) / self.scene.scale
            turn = from_quaternions(np.asarray(event.target.wxyz, dtype=np.float64)[None])[0]
            hold, release = partial(self.held.update, {node: client}), partial(self._release, client)
            self.submit(f"hold {name} {client}", hold if is_held else release)
            if name == "O":
                self.submit("O", lambda: self.state.set_internal_point(position))
            else:
                self.submit("pose", lambda: self.state.set_pose(position=position, rotation=turn))

        self.scene.nodes[node].on_update(dragged)

    async def _clicked(self, event: Any) -> None:
        """Show the design of the picture where it was clicked."""
        if self.designs is not None:
            values = self.designs.design_at(event.ray_origin, event.ray_direction)
            if values is not None:
                self.submit("designs", lambda: self.state.set_variables(values))

    def _release(self, client: int) -> None:
        for node in [node for node, hand in self.held.items() if hand == client]:
            del self.held[node]
