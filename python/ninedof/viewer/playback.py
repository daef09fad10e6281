"""The folder of paths: open one, play it, or show it at a time."""

from __future__ import annotations

import os
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from ninedof.motion.trajectory import Trajectory
from ninedof.support.units import amount
from ninedof.viewer.controls import Slider
from ninedof.viewer.html import words_html
from ninedof.viewer.player import Player

LONGEST_STEP = 0.2  # seconds: a page that was not served for long does not jump
LARGEST = 50_000_000  # bytes of a path that the browser sends: some 400 000 poses


class Playback:
    """Builds the folder, and moves the state of a `Viewer` along a path."""

    def __init__(self, viewer: Any, gui: Any) -> None:
        self._viewer, self._gui = viewer, gui
        self.player: Player | None = None
        upload = gui.add_upload_button("Open CSV", icon="upload", mime_type=".csv", hint="Columns t, x, y, z and turns")
        upload.on_upload(lambda _: viewer.submit("path", lambda: self.read(upload.value)))
        self.text = gui.add_html(words_html("No path is open."))
        self._play = gui.add_button("Play", icon="player-play", disabled=True)
        self._play.on_click(lambda _: viewer.submit("play", self.toggle))
        speed = gui.add_slider("speed", 0.1, 5.0, 0.1, 1.0, hint="Times the path's own")
        speed.on_update(lambda _: viewer.submit("speed", lambda: self._set_speed(speed.value)))
        self._speed = speed
        self._time_at = gui.add_folder("Time")
        self._time: Slider | None = None

    @property
    def playing(self) -> bool:
        """Whether the path is played."""
        return self.player is not None and self.player.playing

    def load(self, path: str | os.PathLike[str]) -> Trajectory:
        """Read a path for the design shown."""
        return Trajectory.load(path, self._viewer.state.home, self._viewer.subject.unit)

    def read(self, file: Any) -> None:
        """Open a path that the browser has sent; its name is shown and opens nothing here."""
        if len(file.content) > LARGEST:
            raise ValueError(f"{file.name}: got {len(file.content)} bytes, expected {LARGEST} at most")
        with TemporaryDirectory() as folder:
            path = Path(folder) / "path.csv"
            path.write_bytes(file.content)
            try:
                found = self.load(path)
            except ValueError as error:
                raise ValueError(str(error).replace(str(path), file.name)) from None
        self.open(file.name, found)

    def open(self, name: str, found: Trajectory) -> None:
        """Show a path at its first pose, and make its controls."""
        player = self.player = Player(found, speed=self._speed.value)
        long = amount(f"{player.duration:g}", "s" if self._viewer.subject.unit else "")
        self.text.content = words_html(f"{name}: {len(found)} poses, duration {long}")
        self._play.disabled = False
        if self._time is not None:
            self._time.handle.remove()
        with self._time_at:
            self._time = Slider(self._gui, "t", 0.0, player.duration, 0.0, self._moved, "Time since the first pose")
        points = found.position
        self._viewer.scene.draw_lines("/path", np.stack([points[:-1], points[1:]], axis=1), "#AA3377")
        self.seek(0.0)

    def toggle(self) -> None:
        """Play or pause."""
        if self.player is not None:
            self.player.playing = not self.player.playing

    def seek(self, at: float) -> None:
        """Show the pose at a time."""
        if self.player is not None:
            self.player.time = at
            self._stand(self.player)

    def advance(self, seconds: float) -> None:
        """Let time pass."""
        if self.player is not None and seconds > 0.0:
            self.player.advance(min(seconds, LONGEST_STEP))
            self._stand(self.player)

    def refresh(self) -> None:
        """Bring the controls up to date."""
        if self.player is not None and self._time is not None:
            self._time.show(self.player.time)
            label = "Pause" if self.player.playing else "Play"
            if self._play.label != label:
                self._play.label = label

    def _moved(self, value: float) -> None:
        self._viewer.submit("time", lambda: self.seek(value))

    def _set_speed(self, speed: float) -> None:
        if self.player is not None:
            self.player.speed = speed

    def _stand(self, player: Player) -> None:
        p, q = player.pose()
        self._viewer.state.set_pose(position=p, rotation=q)
