"""Functions of a robot and its pose that also take a design, which has both."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from inspect import signature
from typing import Any, ParamSpec, Protocol, TypeVar, overload

from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import shown

P = ParamSpec("P")
R_co = TypeVar("R_co", covariant=True)
LENGTH = "characteristic_length"


class HasRobot(Protocol):
    """A design: a Result, a Candidate, a DesignPoint, or a Design of a file."""

    @property
    def geometry(self) -> Any:
        """The Geometry; None for a result without one."""

    @property
    def configuration(self) -> Any:
        """Its neutral Configuration."""

    @property
    def characteristic_length(self) -> Any:
        """The length that the design is judged by: a number or a kind."""


class TakesDesigns(Protocol[P, R_co]):
    """A function of a geometry and more, or of a design in place of what that has."""

    @overload
    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> R_co: ...
    @overload
    def __call__(self, geometry: HasRobot, /, *args: Any, **kwargs: Any) -> R_co: ...


def takes_designs(function: Callable[P, R_co]) -> TakesDesigns[P, R_co]:
    """Let a function of (geometry, configuration, ...) take a design first.

    The design stands for its geometry, for its neutral configuration where none follows, and for its characteristic
    length where the function takes one and none is given.
    """
    names = list(signature(function).parameters)
    posed = len(names) > 1 and names[1] in ("configuration", "home")
    judged = LENGTH in names or "options" in names
    place = names.index(LENGTH) if LENGTH in names else len(names)

    @wraps(function)
    def call(geometry: Any, *args: Any, **kwargs: Any) -> R_co:
        if isinstance(geometry, Geometry) or not hasattr(geometry, "geometry"):
            return function(geometry, *args, **kwargs)
        robot = robot_of(geometry)
        if posed and names[1] not in kwargs and not (args and isinstance(args[0], Configuration)):
            args = (geometry.configuration, *args)
        if judged and LENGTH not in kwargs and len(args) < place:
            kwargs[LENGTH] = geometry.characteristic_length
        return function(robot, *args, **kwargs)  # type: ignore[arg-type]

    return call  # type: ignore[return-value]  # one function with both signatures


def robot_of(design: HasRobot, name: str = "geometry") -> Geometry:
    """Return the geometry of a design; ValueError for a result without one, and for what is no design."""
    if not hasattr(design, "geometry"):
        raise ValueError(f"{name}: got {shown(design)}, expected a Geometry or a design")
    if design.geometry is None:
        raise ValueError(f"{name}: got a result without a design, expected one: {getattr(design, 'reason', '')}")
    geometry: Geometry = design.geometry
    return geometry
