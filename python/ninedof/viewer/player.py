"""Playback of a path: the pose of the platform at a time, and the time that has passed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ninedof.motion.rotations import from_vectors, to_quaternions, vectors_between
from ninedof.motion.trajectory import Trajectory
from ninedof.support.arrays import Floats


@dataclass
class Player:
    """A path and where it is shown."""

    trajectory: Trajectory
    time: float = 0.0
    """Of the path, from its first pose on."""
    speed: float = 1.0
    playing: bool = False

    @property
    def duration(self) -> float:
        """Time from the first pose to the last."""
        return float(self.trajectory.time[-1] - self.trajectory.time[0])

    def advance(self, seconds: float) -> None:
        """Let time pass; after the last pose the path begins again."""
        if self.playing:
            self.time += seconds * self.speed
            if self.time > self.duration:
                self.time %= self.duration

    def pose(self) -> tuple[Floats, Floats]:
        """Return position and rotation of the platform, between two poses of the path on the straight way."""
        times = self.trajectory.time
        at = float(np.clip(times[0] + self.time, times[0], times[-1]))
        k = int(np.clip(np.searchsorted(times, at, side="right") - 1, 0, len(times) - 2))
        share = (at - float(times[k])) / float(times[k + 1] - times[k])
        p, q = self.trajectory.position[k : k + 2], self.trajectory.rotation[k : k + 2]
        first, second = to_quaternions(q)
        turn: Floats = from_vectors(share * vectors_between(first, second)[None])[0] @ q[0]
        return p[0] + share * (p[1] - p[0]), turn
