"""The folder "Save": what is shown as a picture, a design file, or a file of another program."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from ninedof.export.export import export
from ninedof.export.formats import FORMATS
from ninedof.motion.follow import follow
from ninedof.plot.files import picture
from ninedof.runs.design_file import save_design
from ninedof.runs.motion_folder import legs_csv
from ninedof.support.extras import MissingExtra
from ninedof.viewer.html import words_html

PICTURE, DESIGN, LEGS = "picture (.png)", "design file (.toml)", "legs along the path (.csv)"
WORDS = {
    PICTURE: "The scene as it is seen now.",
    DESIGN: "A design whose neutral pose is the pose shown; every command reads it.",
    LEGS: "Lengths, rates and accelerations of the legs along the path that is open.",
}
FILES = {f"{name} ({row.suffix})": name for name, row in FORMATS.items()}
IN_METRES = ("mjcf", "urdf", "sdf")


class Saving:
    """Builds the folder, and sends files of what a `Viewer` shows."""

    def __init__(self, viewer: Any, gui: Any) -> None:
        self._viewer = viewer
        words = WORDS | {
            kind: f"{FORMATS[name].words[0].upper()}{FORMATS[name].words[1:]}." for kind, name in FILES.items()
        }
        kind = gui.add_dropdown("file", list(words), hint="What is shown, as a file")
        save = gui.add_button("Save", icon="download")
        self.text = gui.add_html(words_html(words[kind.value]))

        def chosen(_: Any) -> None:
            self.text.content = words_html(words[kind.value])

        kind.on_update(chosen)
        save.on_click(lambda event: self.send(kind.value, event.client))

    def send(self, kind: str, client: Any) -> None:
        """Send the files of a kind to a browser; say what was sent, or why nothing was."""
        try:
            files = _picture(client) if kind == PICTURE else self.files(kind)
        except (ValueError, MissingExtra) as error:
            self.text.content = words_html(f"Not saved: {error}")
            return
        for name, content in files.items():
            client.send_file_download(name, content, save_immediately=True)
        if files:
            as_they_are = FILES.get(kind) in IN_METRES and not self._viewer.subject.unit
            more = " The unit is not known: its numbers stand as metres." if as_they_are else ""
            self.text.content = words_html(f"Saved {' and '.join(files)}.{more}")

    def files(self, kind: str) -> dict[str, bytes]:
        """Return the files of a kind, by name; the picture alone needs a browser.

        Raises
        ------
        ValueError
            If what is shown cannot be written so.
        MissingExtra
            If that needs a package that is not installed.

        """
        if kind == LEGS:
            return {"legs.csv": self._legs()}
        viewer = self._viewer
        with viewer.lock:
            design, unmoved = viewer.state.design, viewer.state.unmoved
        with TemporaryDirectory() as folder:
            if kind == DESIGN:
                save_design(design, Path(folder) / "design.toml")
            else:  # a run has the ranges of its legs; of a design that was moved none are known
                source = viewer.subject.result if unmoved else None
                export(source or design, FILES[kind], Path(folder) / f"machine{FORMATS[FILES[kind]].suffix}")
            return {file.name: file.read_bytes() for file in sorted(Path(folder).iterdir(), reverse=True)}

    def _legs(self) -> bytes:
        viewer = self._viewer
        with viewer.lock:
            player, state = viewer.playback.player, viewer.state
            design, rule, yard = state.design, state.rule, state.yardstick
        if player is None:
            raise ValueError("no path is open")
        g, shown, length, unit = design
        limits = yard.leg_low, yard.leg_high
        return legs_csv(follow(g, player.trajectory, shown, rule, limits, length, unit=unit))


def _picture(client: Any) -> dict[str, bytes]:
    """Return the scene as the client sees it."""
    height, width = client.camera.image_height, client.camera.image_width
    try:
        image = client.get_render(height=height, width=width, transport_format="png")
    except RuntimeError:  # the page was closed before it was drawn
        return {}
    return {"ninedof.png": picture(image)}
