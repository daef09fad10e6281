"""One robot and its poses, the same for all methods and for the C++ programs."""

from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

HEAD, WIDTH = 37, 15  # numbers of the robot with its characteristic length, and of a pose


class Robot(NamedTuple):
    """Joint triples of shape (3, 3) and the characteristic length."""

    base_external: np.ndarray
    base_internal: np.ndarray
    platform_external: np.ndarray
    platform_internal: np.ndarray
    length: float


class Poses(NamedTuple):
    position: np.ndarray  # (n, 3)
    rotation: np.ndarray  # (n, 3, 3)
    internal_point: np.ndarray  # (n, 3)

    def first(self, count: int) -> "Poses":
        return Poses(*(a[:count] for a in self))


def write(path: Path, count: int, seed: int = 7) -> None:
    """A robot without symmetry; the platform tilted and off the axis, O somewhere between the plates."""
    rng = np.random.default_rng(seed)
    angle = -2.1 * np.arange(3)
    around = np.stack([np.cos(angle), np.sin(angle), np.zeros(3)], axis=-1)
    triples = [size * (around + rng.uniform(-0.3, 0.3, (3, 3))) for size in (2.0, 2.0, 1.0, 1.0)]
    table = np.empty((count, WIDTH))
    table[:, :3] = rng.uniform([-0.7, -0.7, 2.3], [0.7, 0.7, 3.7], (count, 3))
    table[:, 3:12] = Rotation.from_rotvec(rng.uniform(-0.5, 0.5, (count, 3))).as_matrix().reshape(count, 9)
    table[:, 12:] = rng.uniform([-0.5, -0.5, 1.0], [0.5, 0.5, 2.0], (count, 3))
    np.concatenate([*(t.ravel() for t in triples), [1.2], table.ravel()]).tofile(path)


def read(path: Path) -> tuple[Robot, Poses]:
    numbers = np.fromfile(path)
    table = numbers[HEAD:].reshape(-1, WIDTH)
    triples = numbers[: HEAD - 1].reshape(4, 3, 3)
    columns = (np.ascontiguousarray(table[:, a:b]) for a, b in ((0, 3), (3, 12), (12, 15)))
    position, rotation, internal_point = columns
    return Robot(*triples, numbers[HEAD - 1]), Poses(position, rotation.reshape(-1, 3, 3), internal_point)
