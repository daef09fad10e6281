"""The controls beside the scene, in folders ordered by use."""

from __future__ import annotations

import math
from typing import Any

from ninedof.motion.internal_point import RULES
from ninedof.statics.ellipsoid import force_ellipsoid, velocity_ellipsoid
from ninedof.support.units import amount, with_unit
from ninedof.viewer.controls import Slider
from ninedof.viewer.html import limits_html, numbers_html, words_html
from ninedof.viewer.numbers import Numbers

TURN = 60.0  # degrees: end of the sliders of the rotation
NOT_SEARCHED = "not searched"
REACH = 0.35  # of the size of the machine: end of the sliders of positions, from home
RULE_WORDS = {
    "carried": "carried with the platform",
    "shifted": "shifted with the platform",
    "held": "held in the base",
    "best": "best for each pose",
}
ELLIPSOIDS = {
    "none": None,
    "velocity": (velocity_ellipsoid, "translation"),
    "angular velocity": (velocity_ellipsoid, "rotation"),
    "force": (force_ellipsoid, "translation"),
    "moment": (force_ellipsoid, "rotation"),
}


class Panel:
    """Builds the controls of a `Viewer`, and shows the numbers of its state."""

    def __init__(self, viewer: Any, gui: Any, dark: bool) -> None:
        self._viewer, self._gui, self._state = viewer, gui, viewer.state
        self._unit = viewer.subject.unit
        self._numbers = gui.add_html("")
        self.ellipsoid = "none"
        with gui.add_folder("Platform"):
            self._platform()
        with gui.add_folder("Internal point O"):
            self._internal_point()
        with gui.add_folder("Limits"):
            self._limits = gui.add_html("")
        self._variables: dict[str, Slider] = {}
        if viewer.subject.sliders:
            with gui.add_folder(f"Design: {viewer.subject.family.replace('_', ' ')}", expand_by_default=False):
                self._design()
        with gui.add_folder("Assembly modes", expand_by_default=False):
            self._modes()
        with gui.add_folder("Workspace", expand_by_default=False):
            self._workspace()
        with gui.add_folder("Path", expand_by_default=False):
            self._path()
        with gui.add_folder("View", expand_by_default=False):
            self._view(dark)
        with gui.add_folder("Save", expand_by_default=False):
            self._save()

    # --- refreshed ------------------------------------------------------------------------------------------------

    def refresh(self, found: Numbers, settled: bool) -> None:
        """Show the numbers of the state, and set the sliders to it."""
        state = self._state
        _write(self._numbers, "content", numbers_html(found, self._unit, state.note))
        _write(self._limits, "content", limits_html(found, self._unit))
        c = state.configuration
        values = (*c.position.tolist(), *state.turn_deg, *c.internal_point.tolist())
        for slider, value in zip(self._pose, values, strict=True):
            slider.show(value, settled)
        for name, slider in self._variables.items():
            value = state.variables[name]
            slider.show(math.degrees(value) if name in self._angles else value, settled)
        _write(self._rule, "value", RULE_WORDS[state.rule])
        if state.listed is None and self._mode.options != (NOT_SEARCHED,):  # they were those of another design
            self.list_modes([], NOT_SEARCHED, 0)
        if (player := self._viewer.player) is not None:
            self._time.show(player.time)
            _write(self._play, "label", "Pause" if player.playing else "Play")

    # --- folders --------------------------------------------------------------------------------------------------

    def _platform(self) -> None:
        state, gui, viewer = self._state, self._gui, self._viewer
        p, reach = state.home.position.tolist(), REACH * viewer.subject.size
        self._pose: list[Slider] = []
        for k, axis in enumerate("xyz"):

            def moved(value: float, k: int = k) -> None:
                viewer.submit(f"position {k}", lambda: viewer.move(k, value))

            label = with_unit(axis, self._unit)
            hint = "Position of the platform's origin, base frame"
            self._pose.append(Slider(gui, label, p[k] - reach, p[k] + reach, p[k], moved, hint))
        for k, axis in enumerate("xyz"):

            def turned(value: float, k: int = k) -> None:
                viewer.submit(f"turn {k}", lambda: viewer.turn(k, value))

            hint = "Rotation vector from the neutral orientation, base axes"
            self._pose.append(Slider(gui, f"rotation {axis} (°)", -TURN, TURN, 0.0, turned, hint))
        home = gui.add_button("Home", icon="home", hint="Back to the neutral pose")
        home.on_click(lambda _: viewer.submit("pose", state.go_home))

    def _internal_point(self) -> None:
        state, gui, viewer = self._state, self._gui, self._viewer
        options = [RULE_WORDS[rule] for rule in RULES]
        hint = "Where O is when the platform moves"
        self._rule = gui.add_dropdown("O is", options, initial_value=RULE_WORDS[state.rule], hint=hint)
        words = {words: rule for rule, words in RULE_WORDS.items()}

        def chosen(event: Any) -> None:
            if event.client_id is not None:
                rule = words[self._rule.value]
                viewer.submit("rule", lambda: state.set_rule(rule))

        self._rule.on_update(chosen)
        o, reach = state.home.internal_point.tolist(), REACH * viewer.subject.size
        for k, axis in enumerate("xyz"):

            def moved(value: float, k: int = k) -> None:
                viewer.submit(f"O {k}", lambda: viewer.move_internal_point(k, value))

            label = with_unit(f"O {axis}", self._unit)
            self._pose.append(Slider(gui, label, o[k] - reach, o[k] + reach, o[k], moved, "Place of O, base frame"))

    def _design(self) -> None:
        gui, viewer = self._gui, self._viewer
        self._angles = {v.name for v in viewer.subject.sliders if v.is_angle}
        for variable in viewer.subject.sliders:
            name, scale = variable.name, 180.0 / math.pi if variable.is_angle else 1.0

            def moved(value: float, name: str = name, scale: float = scale) -> None:
                viewer.submit(f"variable {name}", lambda: self._state.set_variables({name: value / scale}))

            label = with_unit(name.replace("_", " "), "°" if variable.is_angle else self._unit)
            low, high, value = (scale * x for x in (variable.low, variable.high, variable.value))
            self._variables[name] = Slider(gui, label, low, high, value, moved, variable.name)
        reset = gui.add_button("Reset design", icon="restore", hint="Back to the design of the file")
        reset.on_click(lambda _: viewer.submit("design", self._state.reset_design))

    def _modes(self) -> None:
        gui, viewer = self._gui, self._viewer
        find = gui.add_button("Find all", icon="search", hint="Every configuration with the leg lengths shown")
        find.on_click(lambda _: viewer.submit("modes", viewer.find_modes))
        self._mode = gui.add_dropdown("Mode", [NOT_SEARCHED], disabled=True)

        def chosen(event: Any) -> None:
            if event.client_id is not None and self._mode.value in self._mode_names:
                number = self._mode_names.index(self._mode.value)
                viewer.submit("pose", lambda: viewer.show_mode(number))

        self._mode.on_update(chosen)
        self._mode_names: list[str] = []

    def list_modes(self, names: list[str], nothing: str, shown: int) -> None:
        """Offer the modes found."""
        self._mode_names = names
        self._mode.options = tuple(names or [nothing])
        self._mode.disabled = not names
        if names:
            self._mode.value = names[shown]

    def _workspace(self) -> None:
        gui, viewer = self._gui, self._viewer
        limited = viewer.subject.study is not None
        hint = "Greatest condition number; 0 for none. The limits of the study hold besides"
        self._most = gui.add_number("cond. no. ≤", 0.0 if limited else 6.0, min=0.0, step=0.5, hint=hint)
        button = gui.add_button("Compute", icon="cube", hint="Positions in the orientation shown, a coarse picture")
        button.on_click(lambda _: viewer.compute_body(float(self._most.value)))
        clear = gui.add_button("Remove", icon="trash")
        clear.on_click(lambda _: viewer.remove_body())
        self._body = gui.add_html("")

    def tell_body(self, text: str) -> None:
        """Say how the workspace stands."""
        _write(self._body, "content", words_html(text))

    def body_words(self, size: float, is_open: bool) -> str:
        """Return the sentence about a workspace that is drawn."""
        if size <= 0.0:
            return "No position keeps all limits here."
        more = ", and more beyond what was looked at" if is_open else ""
        cubed = f"{self._unit}³" if self._unit else ""
        when = "with the orientation and the rule for O of the moment it was asked for"
        return f"Volume about {amount(f'{size:.3g}', cubed)}{more}, {when}."

    def _path(self) -> None:
        gui, viewer = self._gui, self._viewer
        upload = gui.add_upload_button("Open CSV", icon="upload", mime_type=".csv", hint="Columns t, x, y, z and turns")
        upload.on_upload(lambda _: viewer.submit("path", lambda: viewer.read_path(upload.value)))
        self._path_text = gui.add_html(words_html("No path is open."))
        self._play = gui.add_button("Play", icon="player-play", disabled=True)
        self._play.on_click(lambda _: viewer.submit("play", viewer.toggle_play))
        self._speed = gui.add_slider("speed", 0.1, 5.0, 0.1, 1.0)
        self._speed.on_update(lambda _: viewer.submit("speed", lambda: viewer.set_speed(self._speed.value)))
        self._time_at: Any = gui.add_folder("Time")
        self._time: Any = None

    def offer_path(self, name: str, duration: float, count: int) -> None:
        """Make the controls of a path that was opened."""
        viewer = self._viewer
        long = amount(f"{duration:g}", "s" if self._unit else "")
        _write(self._path_text, "content", words_html(f"{name}: {count} poses, duration {long}"))
        self._play.disabled = False
        if self._time is not None:
            self._time.handle.remove()
        with self._time_at:
            moved = lambda value: viewer.submit("time", lambda: viewer.seek(value))  # noqa: E731
            self._time = Slider(self._gui, "t", 0.0, duration, 0.0, moved, "Time since the first pose")

    def _view(self, dark: bool) -> None:
        gui, viewer = self._gui, self._viewer
        shape = gui.add_dropdown("ellipsoid", list(ELLIPSOIDS), hint="About the platform, its longest axis fixed")

        def chosen(_: Any) -> None:
            self.ellipsoid = shape.value
            viewer.submit("ellipsoid", lambda: None)

        shape.on_update(chosen)
        for part in ("labels", "handles", "axes"):
            box = gui.add_checkbox(part, True)
            box.on_update(lambda _, part=part, box=box: viewer.show(part, box.value))
        night = gui.add_checkbox("dark", dark)
        night.on_update(lambda _: viewer.set_dark(night.value))

    def _save(self) -> None:
        gui, viewer = self._gui, self._viewer
        picture = gui.add_button("Picture (PNG)", icon="camera", hint="The scene as it is seen now")
        picture.on_click(viewer.send_picture)
        file = gui.add_button("Design (TOML)", icon="download", hint="A design file: its neutral pose is the one shown")
        file.on_click(viewer.send_design)


def _write(handle: Any, name: str, value: Any) -> None:
    if getattr(handle, name) != value:
        setattr(handle, name, value)
