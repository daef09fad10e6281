"""The model behind the screen: design, pose and rule for O go in, everything shown comes out. It knows no screen."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from ninedof.conditioning.conditioning import condition_number
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.motion.rotations import from_vectors, to_quaternions, vectors_between
from ninedof.position.forward_position import PositionStatus, forward_position
from ninedof.redundancy.redundancy import best_internal_point
from ninedof.redundancy.rules import RULES
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.runs.design_file import Design
from ninedof.support.arguments import choice, known_keys, vector
from ninedof.support.arrays import Floats
from ninedof.viewer.body import BodyQuestion
from ninedof.viewer.numbers import Numbers, Yardstick, numbers
from ninedof.viewer.subject import Subject

LENGTH = "characteristic_length"
SAME = 1e-9  # of the size of the machine: rounding is no motion
Turn = tuple[float, float, float]


class State:
    """A machine in a pose.

    Parameters
    ----------
    subject : Subject
        The design to begin with, at its neutral pose.

    """

    def __init__(self, subject: Subject) -> None:
        self.subject = subject
        self.variables = dict(subject.variables)
        self.rule = subject.rule
        self._length: float | None = None  # chosen by hand
        self.note = ""
        """One sentence where something could not be done, such as a design that does not exist; "" otherwise."""
        self.listed: Configuration | None = None
        """The assembly modes found last, of the design shown; None without any, such as after a change of it."""
        self._problem = subject.problem
        self.geometry: Geometry = subject.geometry
        self.home: Configuration = subject.home
        self.yardstick = self._yardstick()
        self._stand(subject.home.position, subject.home.rotation, subject.home.internal_point)
        self._keep()

    # --- pose ---------------------------------------------------------------------------------------------------------

    @property
    def configuration(self) -> Configuration:
        """The pose shown."""
        return self._configuration

    @property
    def turn_deg(self) -> Turn:
        """Rotation vector from the neutral orientation to the one shown, base axes, degrees."""
        first, second = to_quaternions(np.stack([self.home.rotation, self.configuration.rotation]))
        x, y, z = np.degrees(vectors_between(first, second)).tolist()
        return x, y, z

    def set_pose(self, position: Any = None, turn_deg: Any = None, rotation: Floats | None = None) -> None:
        """Move the platform: to a position, a rotation vector from the neutral orientation, or a matrix; O follows."""
        p = self.configuration.position if position is None else np.array(vector("position", position))
        q = self.configuration.rotation if rotation is None else rotation
        if turn_deg is not None:
            q = from_vectors(np.radians([vector("turn_deg", turn_deg)]))[0] @ self.home.rotation
        self._stand(p, q, self._placed(p, q))

    def move(self, axis: int, value: float) -> None:
        """Move the platform along one axis."""
        self.set_pose(position=_with(self.configuration.position, axis, value))

    def turn(self, axis: int, value: float) -> None:
        """Set one component of the rotation vector, degrees."""
        self.set_pose(turn_deg=_with(self.turn_deg, axis, value))

    def move_internal_point(self, axis: int, value: float) -> None:
        """Move O along one axis."""
        self.set_internal_point(_with(self.configuration.internal_point, axis, value))

    def set_internal_point(self, point: Any) -> None:
        """Move O; where it was placed at its best it then stays."""
        if self.rule == "best":
            self.rule = "held"
        self._stand(self.configuration.position, self.configuration.rotation, np.array(vector("O", point)))
        self._keep()

    def set_rule(self, rule: str) -> None:
        """Say where O is when the platform moves: one of `RULES`, from where O is now."""
        self.rule = choice("O", rule, RULES)
        self._keep()
        self.set_pose()

    def set_configuration(self, c: Configuration) -> None:
        """Show a configuration as it is, such as an assembly mode; O stays there until the platform moves."""
        self._stand(c.position, c.rotation, c.internal_point)
        self._keep()

    def go_home(self) -> None:
        """Return to the neutral pose."""
        self._stand(self.home.position, self.home.rotation, self.home.internal_point)
        self._keep()
        if self.rule == "best":
            self.set_pose()

    # --- design -------------------------------------------------------------------------------------------------------

    def set_variables(self, values: Mapping[str, float]) -> None:
        """Change variables of the family, angles in radians. The platform keeps its shift and turn from home.

        A design that does not exist, such as one with a negative radius, leaves everything as it is, with a note.
        """
        known_keys("variables", values, list(self.variables))
        wanted = self.variables | {name: float(value) for name, value in values.items()}
        try:
            problem = self._checked_problem()
            x = [wanted[name] for name in problem.names]
            geometry = problem.geometry(x)
            home = Configuration(*problem.configurations(x))[0]
        except ValueError as error:
            self.note = f"no such design: {error}"
            return
        shift = self.configuration.position - self.home.position
        turn = self.configuration.rotation @ self.home.rotation.T
        move = self.configuration.internal_point - self.home.internal_point
        self.note, self.variables, self.geometry, self.home = "", wanted, geometry, home
        self.listed = None
        self.yardstick = self._yardstick()
        p, q = home.position + shift, turn @ home.rotation
        self._stand(p, q, home.internal_point + move)
        self._keep()
        if self.rule == "best":
            self.set_pose()

    @property
    def length_range(self) -> tuple[float, float]:
        """Ends of a slider of the characteristic length: a quarter to four times it, within the bounds of the study."""
        length, study = self.yardstick.length, self.subject.study
        if not 0.0 < length < math.inf:  # a kind that has no value here
            length = 0.25 * self.subject.size
        bounds = None if study is None else study.characteristic_length
        low, high = bounds if isinstance(bounds, tuple) else (0.0, math.inf)
        return max(low, 0.25 * length), min(high, 4.0 * length)

    def set_length(self, value: float) -> None:
        """Change the characteristic length; one of a kind is then a number, a free one a variable as the others."""
        if LENGTH in self.variables:
            self.set_variables({LENGTH: value})
        else:
            self._length = float(value)
            self._measure()

    def reset_design(self) -> None:
        """Return to the design to begin with."""
        self._length = None
        if self.variables:
            self.set_variables(self.subject.variables)
        else:
            self._measure()

    def _measure(self) -> None:
        """Let the numbers follow another characteristic length."""
        self.listed, self.yardstick = None, self._yardstick()
        if self.rule == "best":
            self.set_pose()

    # --- what is shown ------------------------------------------------------------------------------------------------

    @property
    def design(self) -> Design:
        """What is shown as a design: its neutral pose is the pose shown."""
        return Design(self.geometry, self.configuration, self.yardstick.length, self.subject.unit)

    @property
    def unmoved(self) -> bool:
        """Whether the design is the one to begin with, at its neutral pose."""
        if self._length is not None or self.variables != self.subject.variables:
            return False
        here, home = self.configuration, self.home
        points = np.abs([here.position - home.position, here.internal_point - home.internal_point])
        return bool(points.max() < SAME * self.subject.size and np.abs(here.rotation - home.rotation).max() < SAME)

    def numbers(self) -> Numbers:
        """Return the numbers of the pose shown."""
        return numbers(self.yardstick, self.geometry, self.configuration)

    def modes(self) -> tuple[Configuration, Floats, PositionStatus]:
        """Return every configuration with the leg lengths shown, and `listed` then has them.

        Returns
        -------
        modes : Configuration of shape (count,)
            The best conditioned first.
        condition_numbers : ndarray, shape (count,)
        status : PositionStatus

        """
        found = forward_position(self.geometry, leg_lengths(self.geometry, self.configuration))
        kappa = np.zeros(0)
        if found.count:
            kappa = np.asarray(condition_number(self.geometry, found, self.yardstick.length))
        order = np.argsort(kappa, kind="stable")
        self.listed = found[order]
        return self.listed, kappa[order], found.status

    def body_question(self, condition_limit: float = math.inf) -> BodyQuestion:
        """Return what the workspace of the orientation shown is asked of."""
        c = self.configuration
        # Without a turn O that is shifted with the platform is O that is carried with it.
        carried = c.rotation.T @ self._shifted if self.rule == "shifted" else self._carried
        size = self.subject.size
        return BodyQuestion(self.yardstick, self.geometry, c, self.rule, carried, size, condition_limit)

    # --- within -------------------------------------------------------------------------------------------------------

    def _stand(self, p: Floats, q: Floats, s: Floats) -> None:
        self._configuration = Configuration(p, q, s)

    def _keep(self) -> None:
        """Remember where O is: in the platform, and from its origin in base axes."""
        c = self.configuration
        self._held = c.internal_point
        self._shifted = c.internal_point - c.position
        self._carried = c.rotation.T @ self._shifted

    def _placed(self, p: Floats, q: Floats) -> Floats:
        """Return O at a pose of the platform by the rule."""
        carried: Floats = p + q @ self._carried
        if self.rule == "best":
            return self._best(p, q, carried)
        self.note = ""
        return {"carried": carried, "shifted": p + self._shifted, "held": self._held}[self.rule]

    def _best(self, p: Floats, q: Floats, carried: Floats) -> Floats:
        low, high = self.yardstick.leg_low, self.yardstick.leg_high
        found = best_internal_point(
            self.geometry,
            p,
            q,
            limits=(low, high),
            characteristic_length=self.yardstick.length,
            start=carried,
            threads=1,
        )
        self.note = ""
        if np.isnan(found.configuration.internal_point).any():
            why = ", ".join(found.active)
            self.note = f"no best O at this pose: {found.status}" + (f" ({why})" if why else "")
            return carried
        return found.configuration.internal_point

    def _checked_problem(self) -> Any:
        if self._problem is None:
            raise ValueError("this machine belongs to no family of designs")
        return self._problem

    def _own_length(self) -> float:
        return self.subject.length_at(self.geometry, self.home, self.variables)

    def _yardstick(self) -> Yardstick:
        subject, beside, margins = self.subject, None, list[tuple[str, float]]()
        if subject.study is not None:
            problem = self._checked_problem()
            x = [self.variables[name] for name in problem.names]
            beside = np.asarray(leg_lengths(self.geometry, Configuration(*problem.configurations(x))))
            if subject.study.constraints:
                margins = [(name, float(value)) for name, value, _ in problem.evaluate(x)["margins"]]
        low, high = subject.leg_limits(float(self.home.position[2]))
        return Yardstick(
            study=subject.study,
            neutral=self.home,
            length=self._own_length() if self._length is None else self._length,
            leg_low=low,
            leg_high=high,
            beside=beside,
            design_margins=tuple(margins),
        )


def _with(values: Any, axis: int, value: float) -> list[float]:
    found = [float(x) for x in values]
    found[axis] = value
    return found
