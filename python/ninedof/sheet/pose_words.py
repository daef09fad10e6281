"""A configuration in words."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

import numpy as np

from ninedof.design.tool import Tool
from ninedof.motion.rotations import to_quaternions, vectors_between
from ninedof.robot.configuration import Configuration
from ninedof.support.arrays import Floats
from ninedof.support.units import amount


def pose_words(c: Configuration, neutral_rotation: Floats, unit: str = "") -> str:
    """Return position, place of O and turn, as --position, --internal-point and --rotation-deg take them."""
    return words_of_pose(c.position, c.internal_point, turn_deg(c, neutral_rotation), unit)


def words_of_pose(position: Iterable[float], internal_point: Iterable[float], turn: Iterable[float], unit: str) -> str:
    """Return the same for points and a rotation vector in degrees."""
    p, o = (amount(vector_words(point), unit) for point in (position, internal_point))
    return f"p = {p}, O = {o}, turned {vector_words(round(x, 4) for x in turn)}° from neutral"


def outside_words(c: Configuration, tool: Tool, unit: str = "") -> Iterator[str]:
    """Yield a sentence for each plate beyond which O lies at a pose of a stack: its plane is z = 0 of its own frame."""
    plate = tool.plate(c)
    beyond = (plate.internal_point - plate.position)[:, None] @ plate.rotation[:, :, 2:]
    for far, words in ((-c.internal_point[:, 2], "below the base"), (beyond[:, 0, 0], "above the platform")):
        k = int(np.argmax(np.nan_to_num(far, nan=-1.0)))
        if far[k] > 1e-9 * np.linalg.norm(c.internal_point[k]):
            p, o = (vector_words(float(f"{x:.5g}") for x in point[k]) for point in (c.position, c.internal_point))
            by = "by up to" if len(far) > 1 else "by"
            yield f"O lies {words}, {by} {amount(f'{far[k]:.4g}', unit)}: at p = {p}, O = {o}."


def turn_deg(c: Configuration, neutral_rotation: Floats) -> Floats:
    """Return the rotation vector from the neutral orientation, base axes, degrees: its direction is the axis."""
    neutral, turned = (to_quaternions(np.reshape(q, (-1, 3, 3))) for q in (neutral_rotation, c.rotation))
    return np.asarray(np.degrees(vectors_between(neutral, turned)).reshape(c.rotation.shape[:-1]))


def vector_words(values: Iterable[float]) -> str:
    """Return numbers in brackets; what is rounding beside the largest is 0."""
    numbers = [float(x) for x in values]
    least = 1e-6 * max((abs(x) for x in numbers), default=0.0)
    return "(" + ", ".join(f"{x if abs(x) > least else 0.0:g}" for x in numbers) + ")"


def gravity_words(gravity: Iterable[float], force_unit: str) -> str:
    """Return gravity with the unit that it has where forces are newtons."""
    return amount(f"gravity {vector_words(gravity)}", "m/s²" * (force_unit == "N"))


def decimals_of(*arrays: Floats) -> int:
    """Return how many decimals show four digits of the largest number."""
    size = max(float(np.abs(array[np.isfinite(array)]).max(initial=0.0)) for array in arrays)
    return max(0, 3 - math.floor(math.log10(size))) if size > 0.0 else 0


def fixed(value: float, decimals: int) -> str:
    """Return a number with as many decimals as all of a table, 0 where nothing is left of it."""
    text = f"{value:.{decimals}f}"
    return text if text.strip("-0.") else "0"
