"""The folders of the panel, ordered by use."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from ninedof.design.limit_numbers import compared
from ninedof.export.export import export, formats
from ninedof.motion.follow import follow
from ninedof.motion.trajectory import Trajectory
from ninedof.plot.files import picture
from ninedof.plot.style import REGION
from ninedof.records.design_file import save_design
from ninedof.records.motion import legs_csv
from ninedof.redundancy.rules import RULES, WORDS
from ninedof.support.extras import MissingExtra
from ninedof.support.units import amount, with_unit
from ninedof.viewer.machine import Machine, Variable
from ninedof.viewer.panel import Panel, Slider, legend_html, limits_html, number, numbers_html, words_html
from ninedof.viewer.scene import PATH_COLOUR
from ninedof.viewer.state import ELLIPSOIDS, State

TURN = 60.0  # degrees: end of the sliders of the rotation
REACH = 0.35  # of the size of the machine: end of the sliders of positions, from home
NOT_SEARCHED = "not searched"
PICTURE, DESIGN, LEGS = "picture (.png)", "design file (.toml)", "legs along the path (.csv)"
FORMATS = formats()
FILES = {f"{name} ({row.suffix})": name for name, row in FORMATS.items()}
FILE_WORDS = {
    PICTURE: "The scene as it is seen now.",
    DESIGN: "A design whose neutral pose is the pose shown; every command reads it.",
    LEGS: "Lengths, rates and accelerations of the legs along the path that is open.",
} | {kind: f"{FORMATS[name].words[0].upper()}{FORMATS[name].words[1:]}." for kind, name in FILES.items()}
"""The files that can be saved."""
IN_METRES = ("mjcf", "urdf", "sdf")


def build(panel: Panel) -> None:
    """Build all folders, the three of most use open."""
    panel.text("numbers", lambda: numbers_html(panel.numbers, panel.unit, panel.state.note))
    panel.text("legend", lambda: legend_html(lines_shown(panel.state)))
    family = panel.state.machine.family.replace("_", " ")
    design = f"Design: {family}" if family else "Design"
    body = "Tool's point" if panel.state.machine.design.tool else "Platform"
    for title, folder in {body: _platform, "Internal point O": _internal_point}.items():
        with panel.gui.add_folder(title):
            folder(panel)
    if (designs := panel.viewer.designs) is not None:
        with panel.gui.add_folder("Admissible designs"):
            panel.text("admissible", lambda: words_html(designs.words(panel.state.variables)))
    with panel.gui.add_folder("Limits"):
        panel.text("limits", lambda: limits_html(panel.numbers, panel.unit, panel.state.machine.force_unit))
        if words := spread_words(panel.state.machine):
            panel.text("spreads", lambda: words_html(words))
    closed = {"Assembly modes": _modes, "Workspace": _workspace, "Path": _path, "View": _view, "Save": _save}
    for title, folder in ({design: _design} | closed).items():
        with panel.gui.add_folder(title, expand_by_default=False):
            folder(panel)


def lines_shown(state: State) -> dict[str, str]:
    """Return the colours of the lines in the scene by what they are: the region and the path, if they are there."""
    lines = {}
    if state.machine.region is not None and "region" not in state.display.hidden:
        lines["region of the study"] = REGION
    if state.player is not None:
        lines[f"path {state.player.name}" if state.player.name != "path" else "path"] = PATH_COLOUR
    return lines


def spread_words(machine: Machine) -> str:
    """Return over which poses the limits are taken that compare lengths of legs; "" without any."""
    names = [] if machine.study is None else compared(machine.study)
    if not names:
        return ""
    over = "the poses of the study"
    if machine.region is not None:
        over = "the region" + " (q and r: the poses of the study)" * (machine.region.internal_point == "best")
    verb = "compares" if len(names) == 1 else "compare"
    what = " and ".join(names).replace("_", " ").capitalize()
    return f"{what} {verb} the lengths of the legs over {over} and at the pose shown."


def _coordinate(panel: Panel, k: int, label: str, reach: float, hint: str) -> None:
    at, write = panel.coordinates[k], partial(panel.state.set_coordinate, k)
    panel.slider(label.format("xyz"[k % 3]), (at - reach, at + reach), lambda: panel.coordinates[k], write, hint)


def _platform(panel: Panel) -> None:
    reach, tool = REACH * panel.state.machine.size, bool(panel.state.machine.design.tool)
    of = "tool's point" if tool else "platform's origin"
    for k in range(3):
        _coordinate(panel, k, with_unit("{}", panel.unit), reach, f"Position of the {of}, base frame")
    for k in range(3, 6):
        _coordinate(panel, k, "rotation {} (°)", TURN, "Rotation vector from the neutral orientation, base axes")
    panel.button("Home", "home", panel.state.go_home, "Back to the neutral pose")


def _internal_point(panel: Panel) -> None:
    state, rules = panel.state, {WORDS[rule]: rule for rule in RULES}
    hint = "Where O is when the platform moves"
    choice = panel.choice("O is", list(rules), lambda words: state.set_rule(rules[words]), hint)
    panel.follow(choice, "value", lambda: WORDS[state.rule])
    for k in range(6, 9):
        _coordinate(panel, k, with_unit("O {}", panel.unit), REACH * state.machine.size, "Place of O, base frame")


def _design(panel: Panel) -> None:
    state = panel.state
    for variable in state.machine.sliders:
        _variable(panel, variable)
    hint = "By which J' is made of one unit: condition number, best O and ellipsoids follow it"
    label = with_unit("characteristic length", panel.unit)
    panel.slider(label, state.length_range, lambda: state.variant.length, state.set_length, hint)
    panel.button("Reset design", "restore", state.reset_design, "Back to the design of the file")


def _variable(panel: Panel, variable: Variable) -> None:
    state, (name, low, high, is_angle) = panel.state, variable
    scale, unit = (math.degrees(1.0), "°") if is_angle else (1.0, panel.unit)
    panel.slider(
        with_unit(name.replace("_", " "), unit),
        (scale * low, scale * high),
        lambda: scale * state.variables[name],
        lambda value: state.set_variables({name: value / scale}),
        name,
    )


def _view(panel: Panel) -> None:
    display = panel.state.display
    hint = "About the platform, its longest axis fixed"
    panel.choice("ellipsoid", list(ELLIPSOIDS), lambda kind: setattr(display, "ellipsoid", kind), hint)
    there = {"region": panel.state.machine.region, "designs": panel.viewer.designs}
    for part in ("labels", "handles", "axes", *(name for name, one in there.items() if one is not None)):
        panel.check(part, True, partial(display.show, part))
    panel.check("dark", display.dark, panel.viewer.set_dark)


def _modes(panel: Panel) -> None:
    """Build the folder of every configuration with the leg lengths shown, to choose from."""
    state, listed = panel.state, panel.state.modes
    panel.button("Find all", "search", state.find_modes, "Every configuration with the leg lengths shown")

    def show(name: str) -> None:
        if name in (names := mode_names(state)):  # no other list has come meanwhile
            state.show_mode(names.index(name))

    choice = panel.choice("Mode", [NOT_SEARCHED], show)
    choice.disabled = True

    def follow(_: bool) -> None:
        nonlocal listed
        if state.modes is not listed:
            listed, names = state.modes, mode_names(state)
            choice.options = names
            choice.disabled = listed is None or not len(listed.condition_numbers)
            choice.value = names[0 if listed is None else listed.nearest]

    panel.followers.append(follow)


def mode_names(state: State) -> tuple[str, ...]:
    """Return the options of the choice of modes."""
    if state.modes is None:
        return (NOT_SEARCHED,)
    names = (f"{k}: condition number {number(x)}" for k, x in enumerate(state.modes.condition_numbers.tolist(), 1))
    return tuple(names) or (f"none: {state.modes.status}",)


def _workspace(panel: Panel) -> None:
    """Build the folder of the workspace, which is searched in a thread of its own."""
    viewer, state = panel.viewer, panel.state
    hint = "Greatest condition number; 0 for none. The limits of the study hold besides"
    first = 6.0 if state.machine.study is None else 0.0
    most = panel.gui.add_number("cond. no. ≤", first, min=0.0, step=0.5, hint=hint)
    hint = "Positions in the orientation shown, a coarse picture"
    panel.button("Compute", "cube", lambda: viewer.find_body(float(most.value)), hint)
    panel.button("Remove", "trash", viewer.remove_body)
    panel.text("workspace", lambda: words_html(state.body.words))


def _path(panel: Panel) -> None:
    """Build the folder of a path: open one, play it, or show it at a time."""
    viewer, state, gui = panel.viewer, panel.state, panel.gui
    upload = gui.add_upload_button("Open CSV", icon="upload", mime_type=".csv", hint="Columns t, x, y, z and turns")
    upload.on_upload(lambda _: viewer.submit("path", lambda: open_path(state, upload.value)))
    panel.text("path", lambda: words_html(path_words(state)))
    play = panel.widgets["play"] = panel.button("Play", "player-play", state.toggle)

    def playing() -> bool:
        return state.player is not None and state.player.playing

    panel.follow(play, "disabled", lambda: state.player is None)
    panel.follow(play, "label", lambda: "Pause" if playing() else "Play")
    panel.follow(play, "icon", lambda: "player-pause" if playing() else "player-play")
    panel.slider("speed", (0.1, 5.0), lambda: state.speed, lambda x: setattr(state, "speed", x), "Times the path's own")
    folder = gui.add_folder("Time")
    opened, time = state.player, None

    def follow(_: bool) -> None:
        nonlocal opened, time
        if state.player is not None and state.player is not opened:
            opened = state.player
            if time is not None:
                time.handle.remove()
            with folder:
                ends = (0.0, opened.duration)
                time = Slider(
                    gui, "t", ends, 0.0, lambda at: viewer.submit("t", lambda: state.seek(at)), "Since the first pose"
                )
        if time is not None and state.player is not None:
            time.show(state.player.time, False)

    panel.followers.append(follow)


def open_path(state: State, file: Any) -> None:
    """Open a path that the browser has sent; its name is shown and opens nothing here."""
    with TemporaryDirectory() as folder:
        place = Path(folder) / "path.csv"
        place.write_bytes(file.content)
        try:
            trajectory = Trajectory.load(place, state.variant.home, state.machine.unit)
        except ValueError as error:
            raise ValueError(str(error).replace(str(place), file.name)) from None
    state.open_path(file.name, trajectory)


def path_words(state: State) -> str:
    """Return what is said of the path that is open."""
    if state.player is None:
        return "No path is open."
    duration = amount(f"{state.player.duration:g}", "s" if state.machine.unit else "")
    return f"{state.player.name}: {len(state.player.trajectory)} poses, duration {duration}"


def _save(panel: Panel) -> None:
    """Build the folder of what is shown as a picture, a design file, or a file of another program."""
    gui = panel.gui
    kind = panel.widgets["file"] = gui.add_dropdown("file", list(FILE_WORDS), hint="What is shown, as a file")
    button = gui.add_button("Save", icon="download")
    text = panel.widgets["save"] = gui.add_html(words_html(FILE_WORDS[PICTURE]))

    def tell(words: str) -> None:
        text.content = words_html(words)

    kind.on_update(lambda _: tell(FILE_WORDS[kind.value]))
    button.on_click(lambda event: tell(send(panel.viewer, kind.value, event.client)))


def send(viewer: Any, kind: str, client: Any) -> str:
    """Send the files of a kind to a browser; return what was sent, or why nothing was."""
    try:
        files = files_of(viewer, kind) if kind != PICTURE else {"ninedof.png": picture(_pixels(client))}
    except (ValueError, MissingExtra) as error:
        return f"Not saved: {error}"
    for name, content in files.items():
        client.send_file_download(name, content, save_immediately=True)
    as_they_are = FILES.get(kind) in IN_METRES and not viewer.state.machine.unit
    more = " The unit is not known: its numbers stand as metres." if as_they_are else ""
    return f"Saved {' and '.join(files)}.{more}"


def files_of(viewer: Any, kind: str) -> dict[str, bytes]:
    """Return the files of a kind, by name; the picture alone needs a browser."""
    with viewer.lock:
        state = viewer.state
        design, rule, player, variant = state.design, state.rule, state.player, state.variant
        # A run has the ranges of its legs; of a design that was moved none are known.
        source = state.machine.result if state.unmoved else None
    if kind == LEGS:
        if player is None:
            raise ValueError("no path is open")
        g, c, length, unit = design[:4]
        limits = variant.leg_low, variant.leg_high
        return {"legs.csv": legs_csv(follow(g, replace(player.trajectory, unit=unit), c, rule, limits, length))}
    with TemporaryDirectory() as folder:
        if kind == DESIGN:
            save_design(design, Path(folder) / "design.toml")
        else:
            export(source or design, FILES[kind], Path(folder) / f"machine{FORMATS[FILES[kind]].suffix}")
        return {file.name: file.read_bytes() for file in sorted(Path(folder).iterdir(), reverse=True)}


def _pixels(client: Any) -> Any:
    camera = client.camera
    try:
        return client.get_render(height=camera.image_height, width=camera.image_width, transport_format="png")
    except RuntimeError:
        raise ValueError("the page was closed before the picture was drawn") from None
