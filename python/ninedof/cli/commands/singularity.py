"""`ninedof singularity`: how far a design is from losing control of the platform or O."""

from __future__ import annotations

import math
from typing import Annotated, Any

import numpy as np
import typer
from rich.table import Table

from ninedof.cli import options, posed
from ninedof.cli.chosen_design import Chosen, named_design
from ninedof.cli.pose_words import pose_words
from ninedof.cli.screen import Screen
from ninedof.cli.sheet_tables import MECHANISMS
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.robot.configuration import Configuration
from ninedof.singularity.singularity import singularity as singularity_of
from ninedof.singularity.singularity_distance import SingularityDistance, distance_to_singularity
from ninedof.support.arrays import Floats

PLACE = 4
EXAMPLES = """[bold]Examples[/bold]

  ninedof singularity design.toml

  ninedof singularity runs/20260101-120000 --all-poses

  ninedof singularity runs/20260101-120000#7 --direction "0 0 0 1 0 0 1 0 0" --most 500 --json | jq .distance"""

GROUPS = {"turning about": (0, "°"), "p along": (3, ""), "O along": (6, "")}
AROUND = 1000  # directions of each group, besides the axes


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
    data = {"poses": posed.poses_data(c), "margins": here.margins._asdict(), "mechanism": here.mechanism}
    screen.data(data | (_coordinates(chosen, c, screen) if motion is None else _along(chosen, c, motion, most, screen)))


def _along(chosen: Chosen, c: Configuration, motion: Floats, most: float, screen: Screen) -> dict[str, Any]:
    """Print the first singularity on one motion."""
    found = distance_to_singularity(chosen.geometry, c, motion, most)
    k = int(np.argmin(found.distance))
    if math.isfinite(found.distance[k]):
        where = pose_words(c[k].moved(found.distance[k] * motion), chosen.configuration.rotation)
        screen.print(f"first singularity at {found.distance[k]:.6g} of the motion: {_kind(found, k)}")
        screen.print(f"there {where}")
    else:
        screen.print(f"no singularity up to {most:g} of the motion" + ("" if found.resolved.all() else ", not proved"))
    return {"direction": motion, "distance": found.distance, "at": found.mechanism, "resolved": found.resolved}


def _coordinates(chosen: Chosen, c: Configuration, screen: Screen) -> dict[str, Any]:
    """Print the distances along the coordinates and in many directions, and the nearest singularities."""
    reach = 2.0 * float(leg_lengths(chosen.geometry, c).max())
    table = Table(title="Distance to the first singularity", title_justify="left", title_style="bold")
    for k, head in enumerate(("", "backward", "kind", "forward", "kind")):
        table.add_column(head, justify="right" if k % 2 else "left")
    nearest, out = [], {}
    for name, (first, unit) in GROUPS.items():
        far = math.pi if unit else reach
        motions = np.zeros((6 + AROUND, 9))
        motions[:, first : first + 3] = far * np.concatenate([-np.eye(3), np.eye(3), _sphere(AROUND)])
        found = distance_to_singularity(chosen.geometry, c[:, None], motions)
        distance = np.degrees(far * found.distance) if unit else far * found.distance
        at, axes = np.argmin(distance, axis=0), np.arange(6)
        least, kinds = distance[at[:6], axes], found.mechanism[at[:6], axes]
        cells = [(f"{x:.4g}{unit}" if math.isfinite(x) else "-", str(k)) for x, k in zip(least, kinds, strict=True)]
        for k, axis in enumerate("xyz"):
            table.add_row(f"{name} {axis}", *cells[k], *cells[k + 3], end_section=k == 2)
        pose, number = np.unravel_index(int(np.argmin(distance)), distance.shape)
        nearest.append(_nearest(name, unit, chosen, c[int(pose)], found, (int(pose), int(number)), distance, motions))
        out[name.split()[0] + ("_deg" if unit else "")] = {
            "backward": least[:3],
            "forward": least[3:],
            "kinds": kinds,
            "nearest": distance[pose, number],
            "nearest_kind": found.mechanism[pose, number],
            "nearest_direction": motions[number, first : first + 3] / far,
        }
    screen.print(table)
    for name, words in MECHANISMS.items():
        screen.print(f"kind {name[-1]}: {words}")
    for line in nearest:
        screen.print(line)
    return {"distance": out}


def _nearest(
    name: str,
    unit: str,
    chosen: Chosen,
    pose: Configuration,
    found: SingularityDistance,
    at: tuple[int, int],
    distance: Floats,
    motions: Floats,
) -> str:
    """Return the nearest singularity of a group in words."""
    what = name.split()[0]
    if not math.isfinite(distance[at]):
        return f"{what}: no singularity in {len(motions)} directions"
    where = pose_words(pose.moved(found.distance[at] * motions[at[1]]), chosen.configuration.rotation)
    nearest = f"{distance[at]:.4g}{unit}, kind {found.mechanism[at]}"
    return f"{what}: nearest of {len(motions)} directions {nearest}, where {where}"


def _kind(found: SingularityDistance, k: int) -> str:
    return MECHANISMS[f"det_{found.mechanism[k]}"]


def _sphere(count: int) -> Floats:
    """Return directions spread evenly: a spiral of golden angles."""
    k = np.arange(count)
    z, around = 1.0 - (2.0 * k + 1.0) / count, k * math.pi * (3.0 - math.sqrt(5.0))
    return np.stack([np.sqrt(1.0 - z * z) * np.cos(around), np.sqrt(1.0 - z * z) * np.sin(around), z], axis=1)
