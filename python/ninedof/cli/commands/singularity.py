"""`ninedof singularity`: how far a design is from losing control of the platform or O."""

from __future__ import annotations

import math
from typing import Annotated, Any

import numpy as np
import typer
from rich.table import Table

from ninedof.cli import options, posed
from ninedof.cli.chosen_design import Chosen, named_design
from ninedof.cli.screen import Screen
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.robot.configuration import Configuration, arrays_of
from ninedof.sheet.pose_words import pose_words
from ninedof.sheet.words import MECHANISMS
from ninedof.singularity.nearest_singularity import PARTS, NearestSingularity, nearest_singularity
from ninedof.singularity.singularity import singularity as singularity_of
from ninedof.singularity.singularity_distance import SingularityDistance, distance_to_singularity
from ninedof.support.arrays import Floats
from ninedof.support.units import amount, unit_entry

PLACE = 4
EXAMPLES = """[bold]Examples[/bold]

  ninedof singularity design.toml

  ninedof singularity runs/20260101-120000 --all-poses

  ninedof singularity runs/20260101-120000#7 --direction "0 0 0 1 0 0 1 0 0" --most 500 --json | jq .distance"""

# Of each part: its name, the unit shown, what radians or lengths are multiplied by.
GROUPS = {
    "rotation": ("turning about", "°", math.degrees(1.0)),
    "position": ("p along", "", 1.0),
    "internal_point": ("O along", "", 1.0),
}


def singularity(
    design: options.Design,
    direction: Annotated[
        str | None,
        typer.Option(help='A motion "wx wy wz px py pz sx sy sz" of platform and O, radians and lengths, base axes.'),
    ] = None,
    most: Annotated[float, typer.Option(help="End of it, in multiples of the motion.")] = 1.0,
    position: posed.Position = None,
    rotation_deg: posed.RotationDeg = None,
    internal_point: posed.InternalPoint = None,
    all_poses: posed.AllPoses = False,
    json: options.Json = False,
) -> None:
    """Print the distance to the nearest singularity, with its kind and pose: along each coordinate, or one motion.

    Along a coordinate the others stay, O too while the platform moves. Turns are looked at up to half a turn, p and O
    up to twice the longest leg.
    """
    screen = Screen(json)
    words = "wx wy wz px py pz sx sy sz"
    motion = None if direction is None else np.array(posed.several("--direction", direction, 9, words))
    if motion is not None and not motion.any():
        raise ValueError(f"--direction: got {direction!r}, expected a motion that is not zero")
    chosen = named_design(design)
    c = posed.chosen_poses(chosen, position, rotation_deg, internal_point, all_poses)
    here = singularity_of(chosen.geometry, c)
    for line in posed.pose_lines(c, chosen):
        screen.print(line)
    dets = {name: np.abs(values) for name, values in here.margins._asdict().items()}
    for name, values in dets.items():
        at = int(np.argmin(values))
        where = f" at pose {at}" if len(c) > 1 else ""
        screen.print(f"|det {name[-1].upper()}| = {values[at]:.6f}{where} (0: {MECHANISMS[name]})")
    data = {
        "poses": posed.poses_data(c),
        "margins": here.margins._asdict(),
        "mechanism": here.mechanism,
    }
    screen.data(
        unit_entry(chosen.unit)
        | data
        | (_coordinates(chosen, c, screen) if motion is None else _along(chosen, c, motion, most, screen))
    )


def _along(chosen: Chosen, c: Configuration, motion: Floats, most: float, screen: Screen) -> dict[str, Any]:
    """Print the first singularity on one motion."""
    found = distance_to_singularity(chosen.geometry, c, motion, most)
    k = int(np.argmin(found.distance))
    if math.isfinite(found.distance[k]):
        where = pose_words(c[k].moved(found.distance[k] * motion), chosen.configuration.rotation, chosen.unit)
        screen.print(f"first singularity at {found.distance[k]:.6g} of the motion: {_kind(found, k)}")
        screen.print(f"there {where}")
    else:
        screen.print(f"no singularity up to {most:g} of the motion" + ("" if found.resolved.all() else ", not proved"))
    return {"direction": motion, "distance": found.distance, "at": found.mechanism, "resolved": found.resolved}


def _coordinates(chosen: Chosen, c: Configuration, screen: Screen) -> dict[str, Any]:
    """Print the distances along the coordinates, and the nearest singularities in any direction."""
    table = Table(title="Distance to the first singularity", title_justify="left", title_style="bold")
    for k, head in enumerate(("", "backward", "kind", "forward", "kind")):
        table.add_column(head, justify="right" if k % 2 else "left")
    reach = 2.0 * float(leg_lengths(chosen.geometry, c).max())
    nearest, out = [], {}
    for part, (name, unit, factor) in GROUPS.items():
        far = math.pi if unit else reach
        motions = np.zeros((6, 9))
        motions[:, PARTS[part] : PARTS[part] + 3] = far * np.concatenate([-np.eye(3), np.eye(3)])
        found = distance_to_singularity(chosen.geometry, c[:, None], motions)
        at, axes = np.argmin(found.distance, axis=0), np.arange(6)
        least, kinds = factor * far * found.distance[at, axes], found.mechanism[at, axes]
        texts = (f"{x:.4g}{unit}" if unit else amount(f"{x:.4g}", chosen.unit) for x in least)
        shown_kinds = zip(texts, least, kinds, strict=True)
        cells = [(text if math.isfinite(x) else "-", str(k)) for text, x, k in shown_kinds]
        for k, axis in enumerate("xyz"):
            table.add_row(f"{name} {axis}", *cells[k], *cells[k + 3], end_section=k == 2)
        one = nearest_singularity(chosen.geometry, c, part, far)
        far_off = f"{factor * one.distance:.5g}"
        shown = far_off + unit if unit else amount(far_off, chosen.unit)
        nearest.append(_nearest(name, shown, one, len(c), chosen))
        out[part + ("_deg" if unit else "")] = {
            "backward": least[:3],
            "forward": least[3:],
            "kinds": kinds,
            "nearest": {
                "distance": factor * one.distance,
                "kind": one.mechanism,
                "direction": one.direction,
                "pose": one.pose,
                "there": arrays_of(one.configuration),
            },
        }
    screen.print(table)
    for name, words in MECHANISMS.items():
        screen.print(f"kind {name[-1]}: {words}")
    for line in nearest:
        screen.print(line)
    return {"distance": out}


def _nearest(name: str, distance: str, one: NearestSingularity, count: int, chosen: Chosen) -> str:
    """Return the nearest singularity of a part in words."""
    if not math.isfinite(one.distance):
        return f"{name} any axis: no singularity found"
    pose = f" from pose {one.pose}" if count > 1 else ""
    where = pose_words(one.configuration, chosen.configuration.rotation, chosen.unit)
    return f"{name} any axis: nearest {distance}{pose}, kind {one.mechanism}, where {where}"


def _kind(found: SingularityDistance, k: int) -> str:
    return MECHANISMS[f"det_{found.mechanism[k]}"]
