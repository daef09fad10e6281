"""The controls beside the scene, in folders ordered by use."""

from __future__ import annotations

import math
from typing import Any

from ninedof.redundancy.rules import RULES, WORDS
from ninedof.statics.ellipsoid import force_ellipsoid, velocity_ellipsoid
from ninedof.support.units import with_unit
from ninedof.viewer.body_folder import BodyFolder
from ninedof.viewer.controls import Slider
from ninedof.viewer.html import limits_html, numbers_html
from ninedof.viewer.modes import Modes
from ninedof.viewer.numbers import Numbers
from ninedof.viewer.playback import Playback
from ninedof.viewer.saving import Saving

TURN = 60.0  # degrees: end of the sliders of the rotation
REACH = 0.35  # of the size of the machine: end of the sliders of positions, from home
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
        family = viewer.subject.family.replace("_", " ")
        with gui.add_folder(f"Design: {family}" if family else "Design", expand_by_default=False):
            self._design()
        with gui.add_folder("Assembly modes", expand_by_default=False):
            self.modes = Modes(viewer, gui)
        with gui.add_folder("Workspace", expand_by_default=False):
            self.body = BodyFolder(viewer, gui)
        with gui.add_folder("Path", expand_by_default=False):
            self.playback = Playback(viewer, gui)
        with gui.add_folder("View", expand_by_default=False):
            self._view(dark)
        with gui.add_folder("Save", expand_by_default=False):
            self.saving = Saving(viewer, gui)

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
        _write(self._rule, "value", WORDS[state.rule])
        self._length.show(state.yardstick.length, settled)
        self.modes.refresh()
        self.playback.refresh()

    # --- folders --------------------------------------------------------------------------------------------------

    def _platform(self) -> None:
        state, gui, viewer = self._state, self._gui, self._viewer
        p, reach = state.home.position.tolist(), REACH * viewer.subject.size
        self._pose: list[Slider] = []
        for k, axis in enumerate("xyz"):

            def moved(value: float, k: int = k) -> None:
                viewer.submit(f"position {k}", lambda: state.move(k, value))

            label = with_unit(axis, self._unit)
            hint = "Position of the platform's origin, base frame"
            self._pose.append(Slider(gui, label, p[k] - reach, p[k] + reach, p[k], moved, hint))
        for k, axis in enumerate("xyz"):

            def turned(value: float, k: int = k) -> None:
                viewer.submit(f"turn {k}", lambda: state.turn(k, value))

            hint = "Rotation vector from the neutral orientation, base axes"
            self._pose.append(Slider(gui, f"rotation {axis} (°)", -TURN, TURN, 0.0, turned, hint))
        home = gui.add_button("Home", icon="home", hint="Back to the neutral pose")
        home.on_click(lambda _: viewer.submit("pose", state.go_home))

    def _internal_point(self) -> None:
        state, gui, viewer = self._state, self._gui, self._viewer
        options = [WORDS[rule] for rule in RULES]
        hint = "Where O is when the platform moves"
        self._rule = gui.add_dropdown("O is", options, initial_value=WORDS[state.rule], hint=hint)
        words = {words: rule for rule, words in WORDS.items()}

        def chosen(event: Any) -> None:
            if event.client_id is not None:
                rule = words[self._rule.value]
                viewer.submit("rule", lambda: state.set_rule(rule))

        self._rule.on_update(chosen)
        o, reach = state.home.internal_point.tolist(), REACH * viewer.subject.size
        for k, axis in enumerate("xyz"):

            def moved(value: float, k: int = k) -> None:
                viewer.submit(f"O {k}", lambda: state.move_internal_point(k, value))

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
        low, high = self._state.length_range

        def stretched(value: float) -> None:
            viewer.submit("length", lambda: self._state.set_length(value))

        hint = "By which J' is made of one unit: condition number, best O and ellipsoids follow it"
        length = self._state.yardstick.length
        self._length = Slider(gui, with_unit("characteristic length", self._unit), low, high, length, stretched, hint)
        reset = gui.add_button("Reset design", icon="restore", hint="Back to the design of the file")
        reset.on_click(lambda _: viewer.submit("design", self._state.reset_design))

    def _view(self, dark: bool) -> None:
        gui, viewer = self._gui, self._viewer
        shape = gui.add_dropdown("ellipsoid", list(ELLIPSOIDS), hint="About the platform, its longest axis fixed")

        def chosen(_: Any) -> None:
            self.ellipsoid = shape.value
            viewer.submit("ellipsoid", lambda: None)

        shape.on_update(chosen)
        region = ("region",) if viewer.subject.region is not None else ()
        for part in ("labels", "handles", "axes", *region):
            box = gui.add_checkbox(part, True)
            box.on_update(lambda _, part=part, box=box: viewer.show(part, box.value))
        night = gui.add_checkbox("dark", dark)
        night.on_update(lambda _: viewer.set_dark(night.value))


def _write(handle: Any, name: str, value: Any) -> None:
    if getattr(handle, name) != value:
        setattr(handle, name, value)
