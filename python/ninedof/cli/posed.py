"""The poses at which a command looks at a design: the neutral one, one given by options, or those of the study."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import Annotated, Any

import numpy as np
import typer

from ninedof.cli.chosen_design import Chosen
from ninedof.conditioning.characteristic_length import characteristic_length
from ninedof.redundancy.redundancy import best_internal_point
from ninedof.redundancy.rules import RULES
from ninedof.robot.configuration import Configuration, arrays_of
from ninedof.sheet.pose_words import pose_words
from ninedof.support.arguments import vector
from ninedof.support.arrays import Floats

Three = tuple[float, float, float]

Position = Annotated[
    Three | None,
    typer.Option(metavar="X Y Z", help="Position of the platform, base frame; the neutral one by default."),
]
RotationDeg = Annotated[
    Three | None,
    typer.Option(metavar="X Y Z", help="Rotation vector from the neutral orientation, base axes, degrees."),
]
InternalPoint = Annotated[
    str | None,
    typer.Option(
        help='O at that pose: carried (default), shifted, held, best, a fraction between the plates, or "X Y Z".'
    ),
]
AllPoses = Annotated[bool, typer.Option("--all-poses", help="All poses of the run's study, the neutral one first.")]


def chosen_poses(
    chosen: Chosen, position: Three | None, rotation_deg: Three | None, internal_point: str | None, all_poses: bool
) -> Configuration:
    """Return a stack of configurations: of the study, or one, by default the neutral one."""
    home = chosen.configuration
    given = {"position": position, "rotation-deg": rotation_deg, "internal-point": internal_point}
    named = [f"--{name}" for name, value in given.items() if value is not None]
    if all_poses:
        if named:
            raise ValueError(f"--all-poses: got {named[0]} beside it, expected one of the two")
        if chosen.result is None or chosen.result.best is None:
            raise ValueError("--all-poses: got a design without a study, expected a run")
        return chosen.result.best.configurations
    p = home.position if position is None else np.array(vector("--position", position))
    turn = np.radians((0.0, 0.0, 0.0) if rotation_deg is None else vector("--rotation-deg", rotation_deg))
    q = home.moved(np.concatenate([turn, np.zeros(6)])).rotation if turn.any() else home.rotation
    s = home.internal_point if not named else _internal_point(chosen, p, q, internal_point or "carried")
    return Configuration(p[None], q[None], s[None])


def length_at_home(chosen: Chosen) -> float:
    """Return the characteristic length as a number: a kind is taken at the neutral pose."""
    length = chosen.characteristic_length
    if isinstance(length, str):
        return float(characteristic_length(chosen.geometry, chosen.configuration, length))
    return length


def mentioned(c: Configuration, poses: Iterable[int], unit: str) -> Iterator[str]:
    """Yield the poses of a stack that a table mentions by their numbers."""
    if len(c) > 1:
        yield from (f"pose {k}: {pose_words(c[k], c.rotation[0], unit)}" for k in sorted(set(poses)))


def pose_lines(c: Configuration, chosen: Chosen) -> Iterator[str]:
    """Yield where a command looks."""
    if len(c) > 1:
        yield f"{len(c)} poses of the study; pose 0 is the neutral one"
    else:
        yield f"at {pose_words(c[0], chosen.configuration.rotation, chosen.unit)}"


def poses_data(c: Configuration) -> list[dict[str, Floats]]:
    """Return a stack as plain values, one pose after the other."""
    arrays = arrays_of(c)
    return [{name: array[k] for name, array in arrays.items()} for k in range(len(c))]


def _internal_point(chosen: Chosen, p: Floats, q: Floats, rule: str) -> Floats:
    home, g = chosen.configuration, chosen.geometry
    carried: Floats = p + q @ (home.rotation.T @ (home.internal_point - home.position))
    shifted: Floats = p + home.internal_point - home.position
    fixed = {"carried": carried, "shifted": shifted, "held": home.internal_point}
    if rule in fixed:
        return fixed[rule]
    if rule == "best":
        found = best_internal_point(g, p, q, characteristic_length=length_at_home(chosen), start=carried)
        if np.isnan(found.configuration.internal_point).any():
            raise ValueError(f"--internal-point: got best, but no place of O is the best there ({found.status})")
        return found.configuration.internal_point
    given = numbers(rule.translate(str.maketrans("(),", "   ")))  # as poses are printed, too
    if len(given) == 3:
        return np.array(given)
    if len(given) != 1:
        raise ValueError(f'--internal-point: got {rule!r}, expected {", ".join(RULES)}, a fraction or "X Y Z"')
    below, above = g.base_internal.mean(axis=0), p + q @ g.platform_internal.mean(axis=0)
    return np.asarray(below + given[0] * (above - below))


def numbers(text: str) -> list[float]:
    """Return the finite numbers of a text, divided by blanks or commas; none if one of its words is no number."""
    try:
        found = [float(word) for word in text.replace(",", " ").split()]
    except ValueError:
        return []
    return found if all(map(math.isfinite, found)) else []


def several(option: str, text: str, count: int, what: str) -> list[float]:
    """Return the numbers of an option that takes a fixed count of them in quotes."""
    found = numbers(text)
    if len(found) != count:
        raise ValueError(f'{option}: got {text!r}, expected {count} numbers "{what}"')
    return found


def load_option(text: str) -> list[float]:
    """Return the load given by --load."""
    return several("--load", text, 6, "mx my mz fx fy fz")


def at_worst(values: Any) -> tuple[float, int]:
    """Return the largest value and its pose."""
    at = int(np.argmax(values))
    return float(values[at]), at
