"""The model behind the screen: design, pose and rule for O go in, everything shown comes out. It knows no screen."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from ninedof.conditioning.conditioning import condition_number
from ninedof.design.study import LENGTH
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.kinematics.position import PositionStatus, forward_position
from ninedof.motion.rotations import from_vectors, to_quaternions, vectors_between
from ninedof.motion.trajectory import Trajectory
from ninedof.records.design_file import Design
from ninedof.redundancy.redundancy import best_internal_point
from ninedof.redundancy.rules import RULES
from ninedof.robot.configuration import Configuration
from ninedof.sheet.pose_words import turn_deg
from ninedof.statics.statics import Ellipsoid, force_ellipsoid, velocity_ellipsoid
from ninedof.support.arguments import choice, known_keys
from ninedof.support.arrays import Floats
from ninedof.viewer.body import Body
from ninedof.viewer.machine import Machine

ELLIPSOIDS = {
    "none": None,
    "velocity": (velocity_ellipsoid, "translation"),
    "angular velocity": (velocity_ellipsoid, "rotation"),
    "force": (force_ellipsoid, "translation"),
    "moment": (force_ellipsoid, "rotation"),
}


class Modes(NamedTuple):
    """Every configuration with some leg lengths, the best conditioned first."""

    configurations: Configuration
    """Of shape (count,)."""
    condition_numbers: Floats
    """Shape (count,)."""
    status: PositionStatus
    nearest: int
    """The one nearest to the pose shown."""


@dataclass
class Player:
    """A path and where it is shown."""

    name: str
    trajectory: Trajectory
    time: float = 0.0
    """Of the path, from its first pose on."""
    playing: bool = False

    @property
    def duration(self) -> float:
        """Time from the first pose to the last."""
        return float(self.trajectory.time[-1] - self.trajectory.time[0])

    def pose(self) -> tuple[Floats, Floats]:
        """Return position and rotation of the platform, between two poses of the path on the straight way."""
        t, p, q = self.trajectory.time, self.trajectory.position, self.trajectory.rotation
        at = min(float(t[0]) + self.time, float(t[-1]))
        k = min(int(np.searchsorted(t, at, side="right")), len(t) - 1)
        share = (at - t[k - 1]) / (t[k] - t[k - 1])
        turn: Floats = from_vectors(share * vectors_between(*to_quaternions(q[k - 1 : k + 1]))[None])[0] @ q[k - 1]
        return p[k - 1] + share * (p[k] - p[k - 1]), turn


@dataclass
class Display:
    """The choices of the folder "View"."""

    dark: bool = False
    hidden: set[str] = field(default_factory=set)
    """Of "labels", "handles", "axes", "region" and "designs"."""
    ellipsoid: str = "none"
    """One of `ELLIPSOIDS`."""

    def show(self, part: str, visible: bool) -> None:
        """Show or hide a part."""
        (self.hidden.discard if visible else self.hidden.add)(part)


class State:
    """A machine in a pose.

    Parameters
    ----------
    machine : Machine
        Its design is shown first, at the neutral pose.

    """

    def __init__(self, machine: Machine, dark: bool = False) -> None:
        self.machine = machine
        self.variables = dict(machine.variables)
        self.rule = "carried" if machine.region is None else machine.region.internal_point
        self.note = ""
        """One sentence where something could not be done, such as a design that does not exist; "" otherwise."""
        self.modes: Modes | None = None
        """The assembly modes found last, of the design shown; None without any, such as after a change of it."""
        self.player: Player | None = None
        self.speed = 1.0
        """Of a path, times its own."""
        self.body = Body()
        self.display = Display(dark)
        self._length: float | None = None  # chosen by hand
        self.variant = machine.variant(self.variables)
        self.configuration = self._placed = self.variant.home

    # --- pose ---------------------------------------------------------------------------------------------------------

    @property
    def coordinates(self) -> list[float]:
        """Position, rotation vector from the neutral orientation (base axes, degrees), and O: nine numbers."""
        c = self.configuration
        turn = turn_deg(c, self.variant.home.rotation)
        return [*c.position.tolist(), *turn.tolist(), *c.internal_point.tolist()]

    def set_coordinate(self, k: int, value: float) -> None:
        """Change one of `coordinates`."""
        x = self.coordinates
        x[k] = value
        if k < 3:
            self.set_pose(position=x[:3])
        elif k < 6:
            self.set_pose(turn_deg=x[3:6])
        else:
            self.set_internal_point(x[6:])

    def set_pose(self, position: Any = None, turn_deg: Any = None, rotation: Floats | None = None) -> None:
        """Move the platform: to a position, a rotation vector from the neutral orientation, or a matrix; O follows."""
        c = self.configuration
        p = c.position if position is None else np.asarray(position, dtype=np.float64)
        q = c.rotation if rotation is None else rotation
        if turn_deg is not None:
            q = from_vectors(np.radians([turn_deg]))[0] @ self.variant.home.rotation
        pose, self.note = self._placed, ""
        arm = pose.internal_point - pose.position
        carried: Floats = p + q @ pose.rotation.T @ arm
        s = {"shifted": p + arm, "held": pose.internal_point}.get(self.rule, carried)
        self.configuration = Configuration(p, q, self._best(p, q, s) if self.rule == "best" else s)

    def set_internal_point(self, point: Any) -> None:
        """Move O; where it was placed at its best it then stays."""
        if self.rule == "best":
            self.rule = "held"
        self.set_configuration(Configuration(self.configuration.position, self.configuration.rotation, point))

    def set_rule(self, rule: str) -> None:
        """Set where O is when the platform moves: one of `RULES`, from where O is now."""
        self.rule = choice("O", rule, RULES)
        self.set_configuration(self.configuration)
        self.set_pose()

    def set_configuration(self, c: Configuration) -> None:
        """Show a configuration as it is, such as an assembly mode; O stays there until the platform moves."""
        self.configuration = self._placed = c

    def go_home(self) -> None:
        """Return to the neutral pose."""
        self.set_configuration(self.variant.home)
        if self.rule == "best":
            self.set_pose()

    # --- path ---------------------------------------------------------------------------------------------------------

    def open_path(self, name: str, trajectory: Trajectory) -> None:
        """Show a path at its first pose."""
        self.player = Player(name, trajectory)
        self.seek(0.0)

    def toggle(self) -> None:
        """Play or pause the path."""
        if self.player is not None:
            self.player.playing = not self.player.playing

    def seek(self, at: float) -> None:
        """Show the pose of the path at a time."""
        if self.player is not None:
            self.player.time = at
            position, rotation = self.player.pose()
            self.set_pose(position=position, rotation=rotation)

    def advance(self, seconds: float) -> None:
        """Let time pass for a path that is played; after its last pose it begins again."""
        if self.player is not None and self.player.playing and seconds > 0.0:
            at, end = self.player.time + seconds * self.speed, self.player.duration
            self.seek(at if at <= end else at % end)

    # --- design -------------------------------------------------------------------------------------------------------

    def set_variables(self, values: Mapping[str, float]) -> None:
        """Change variables of the family, angles in radians. The platform keeps its shift and turn from home.

        A design that does not exist, such as one with a negative radius, leaves everything as it is, with a note.
        """
        known_keys("variables", values, list(self.variables))
        self._change(self.variables | {name: float(value) for name, value in values.items()}, self._length)

    def set_length(self, value: float) -> None:
        """Change the characteristic length; one of a kind is then a number, a free one a variable as the others."""
        if LENGTH in self.variables:
            self.set_variables({LENGTH: value})
        else:
            self._change(self.variables, float(value))

    def reset_design(self) -> None:
        """Return to the design to begin with."""
        self._change(dict(self.machine.variables), None)

    @property
    def length_range(self) -> tuple[float, float]:
        """Ends of a slider of the characteristic length: a quarter to four times it, within the bounds of the study."""
        length, study = self.variant.length, self.machine.study
        if not 0.0 < length < math.inf:  # a kind that has no value here
            length = 0.25 * self.machine.size
        bounds = None if study is None else study.characteristic_length
        low, high = bounds if isinstance(bounds, tuple) else (0.0, math.inf)
        return max(low, 0.25 * length), min(high, 4.0 * length)

    # --- for files and the scene --------------------------------------------------------------------------------------

    @property
    def design(self) -> Design:
        """The design shown, its neutral pose the pose shown."""
        machine = self.machine
        return Design(self.variant.geometry, self.configuration, self.variant.length, machine.unit, machine.design.tool)

    @property
    def unmoved(self) -> bool:
        """Whether the design is the one to begin with, at its neutral pose."""
        design = self.machine.design
        return self._length is None and self.variables == self.machine.variables and self.design[:2] == design[:2]

    def find_modes(self) -> Modes:
        """List every configuration with the leg lengths shown."""
        g, c = self.variant.geometry, self.configuration
        modes = forward_position(g, leg_lengths(g, c))
        kappa = np.asarray(condition_number(g, modes, self.variant.length)) if modes.count else np.zeros(0)
        order = np.argsort(kappa, kind="stable")
        ordered, nearest = modes[order], 0
        if modes.count:
            away = np.abs(ordered.position - c.position).max(axis=1) / self.machine.size
            away += np.abs(ordered.internal_point - c.internal_point).max(axis=1) / self.machine.size
            nearest = int(np.argmin(away + np.abs(ordered.rotation - c.rotation).max(axis=(1, 2))))
        self.modes = Modes(ordered, kappa[order], modes.status, nearest)
        return self.modes

    def show_mode(self, k: int) -> None:
        """Show one of the modes listed."""
        if self.modes is not None and k < len(self.modes.condition_numbers):
            self.set_configuration(self.modes.configurations[k])

    def ellipsoid(self) -> Ellipsoid | None:
        """Return the ellipsoid chosen at the pose shown."""
        kind = ELLIPSOIDS[self.display.ellipsoid]
        if kind is None:
            return None
        return kind[0](self.variant.geometry, self.configuration, kind[1], self.variant.length)

    # --- within -------------------------------------------------------------------------------------------------------

    def _change(self, variables: dict[str, float], length: float | None) -> None:
        try:
            variant = self.machine.variant(variables, length)
        except ValueError as error:
            self.note = f"no such design: {error}"
            return
        c, old, new = self.configuration, self.variant.home, variant.home
        self.variables, self._length, self.variant, self.modes, self.note = variables, length, variant, None, ""
        if new is not old:
            shift, arm = c.position - old.position, c.internal_point - old.internal_point
            turn = c.rotation @ old.rotation.T @ new.rotation
            self.set_configuration(Configuration(new.position + shift, turn, new.internal_point + arm))
        if self.rule == "best":
            self.set_pose()

    def _best(self, p: Floats, q: Floats, carried: Floats) -> Floats:
        g, limits, length = self.variant.geometry, (self.variant.leg_low, self.variant.leg_high), self.variant.length
        best = best_internal_point(g, p, q, limits=limits, characteristic_length=length, start=carried, threads=1)
        point = best.configuration.internal_point
        if not np.isnan(point).any():
            return point
        why = f" ({', '.join(best.active)})" if best.active else ""
        self.note = f"no best O at this pose: {best.status}{why}"
        return carried
