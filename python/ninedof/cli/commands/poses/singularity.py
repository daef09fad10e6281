"""`ninedof singularity`: how far a design is from losing control of the platform or O."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

import ninedof as nd
from ninedof.cli.answer import Answer
from ninedof.cli.options import option, several, struct
from ninedof.cli.posed import DesignAtPoses, PosesOptions
from ninedof.robot.configuration import arrays_of
from ninedof.sheet.tables import MECHANISMS
from ninedof.singularity.singularity_distance import PARTS
from ninedof.support.arrays import Floats
from ninedof.support.units import amount
from ninedof.tables import Table, columns

EXAMPLES = """
  ninedof singularity design.toml
  ninedof singularity runs/20260101-120000 --all-poses
  ninedof singularity runs/20260101-120000#7 --direction "0 0 0 1 0 0 1 0 0" --most 500 --json | jq .distance"""

# Of each part: its name, the unit shown, what radians or lengths are multiplied by.
GROUPS = {
    "rotation": ("turning about", "°", math.degrees(1.0)),
    "position": ("p along", "", 1.0),
    "internal_point": ("O along", "", 1.0),
}


@struct
class _Options(PosesOptions):
    direction: str | None = option(
        'A motion "wx wy wz px py pz sx sy sz" of platform and O, radians and lengths, base axes.'
    )
    most: float = option("End of it, in multiples of the motion.", 1.0)


def singularity(options: _Options) -> Answer:
    """Print the distance to the nearest singularity, with its kind and pose: along each coordinate, or one motion.

    Along a coordinate the others stay, O too while the platform moves. Turns are looked at up to half a turn, p and O
    up to twice the longest leg.
    """
    words = "wx wy wz px py pz sx sy sz"
    motion = None if options.direction is None else np.array(several("--direction", options.direction, words))
    if motion is not None and not motion.any():
        raise ValueError(f"--direction: got {options.direction!r}, expected a motion that is not zero")
    at = options.at()
    here = nd.singularity(at.geometry, at.c)
    parts: list[Any] = []
    for name, values in here.margins._asdict().items():
        k = int(np.argmin(np.abs(values)))
        parts.append(f"|det {name[-1].upper()}| = {abs(values[k]):.6f}{at.where(k)} (0: {MECHANISMS[name]})")
    more, data = _coordinates(at) if motion is None else _along(at, motion, options.most)
    return at.answer([*parts, *more], {"margins": here.margins._asdict(), "mechanism": here.mechanism} | data)


def _along(at: DesignAtPoses, motion: Floats, most: float) -> tuple[list[Any], dict[str, Any]]:
    """Return the first singularity on one motion, in words and as data."""
    result = nd.distance_to_singularity(at.geometry, at.c, motion, most)
    k = int(np.argmin(result.distance))
    if math.isfinite(result.distance[k]):
        there = at.words(at.c[k].moved(result.distance[k] * motion))
        kind = MECHANISMS[f"det_{result.mechanism[k]}"]
        words = [f"first singularity at {result.distance[k]:.6g} of the motion: {kind}", f"there {there}"]
    else:
        words = [f"no singularity up to {most:g} of the motion" + ("" if result.resolved.all() else ", not proved")]
    data = {"direction": motion, "distance": result.distance, "at": result.mechanism, "resolved": result.resolved}
    return words, data


def _coordinates(at: DesignAtPoses) -> tuple[list[Any], dict[str, Any]]:
    """Return the distances along the coordinates, and the nearest singularities in any direction."""
    g, c, length_unit = at.geometry, at.c, at.unit
    reach = 2.0 * float(nd.leg_lengths(g, c).max())
    nearest, out, rows = [], {}, list[Any]()
    for part, (name, degree, factor) in GROUPS.items():
        far = math.pi if degree else reach
        motions = np.zeros((6, 9))
        motions[:, PARTS[part] : PARTS[part] + 3] = far * np.concatenate([-np.eye(3), np.eye(3)])
        result = nd.distance_to_singularity(g, c[:, None], motions)
        pose, axes = np.argmin(result.distance, axis=0), np.arange(6)
        least, kinds = factor * far * result.distance[pose, axes], result.mechanism[pose, axes]

        def text(x: float, digits: int, degree: str = degree) -> str:
            number = f"{x:.{digits}g}"
            return "-" if not math.isfinite(x) else number + degree if degree else amount(number, length_unit)

        for k, axis in enumerate("xyz"):
            backward, forward = ((text(least[j], 4), str(kinds[j])) for j in (k, k + 3))
            rows.append((f"{name} {axis}", *backward, *forward))
        rows.append(())
        one = nd.nearest_singularity(g, c, part, far)
        nearest.append(_nearest(name, text(factor * one.distance, 5), one, at))
        out[part + ("_deg" if degree else "")] = {
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
    heads = columns("", ">backward", "kind", ">forward", "kind")
    kinds_words = [f"kind {name[-1]}: {words}" for name, words in MECHANISMS.items()]
    title = "Distance to the first singularity, O at rest while the platform moves"
    return [Table(title, heads, rows), *kinds_words, *nearest], {"distance": out}


def _nearest(name: str, distance: str, one: nd.NearestSingularity, at: DesignAtPoses) -> str:
    way = f"{name} any axis" + ", O at rest" * (not name.startswith("O"))
    if not math.isfinite(one.distance):
        return f"{way}: no singularity found"
    pose = at.where(one.pose).replace(" at ", " from ")
    return f"{way}: nearest {distance}{pose}, kind {one.mechanism}, where {at.words(one.configuration)}"
