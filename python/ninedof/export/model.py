"""One design as every file format sees it, and what a format is."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ninedof.design.limit_numbers import cone_limits
from ninedof.design.study import Study
from ninedof.design.tool import Tool
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.robot.configuration import Configuration
from ninedof.robot.designs import robot_of
from ninedof.robot.geometry import TRIPLES, Geometry, triples
from ninedof.sheet.sheet import Sheet, sheet
from ninedof.support.arrays import Floats
from ninedof.support.units import METRES, unit_argument

P, O = "p", "O"
"""Origin of the platform frame, and the internal point."""

LEGS = (
    *((f"l{i}", f"base_external_{i}", f"platform_external_{i}") for i in (1, 2, 3)),
    *((f"q{i}", f"platform_internal_{i}", O) for i in (1, 2, 3)),
    *((f"r{i}", f"base_internal_{i}", O) for i in (1, 2, 3)),
)
"""Name, first and second end of each leg, in the order of `leg_lengths`."""

JOINTS = tuple(f"{name}_{i}" for name in TRIPLES for i in (1, 2, 3))
Ranges = tuple[tuple[float, float], ...]
Fields = tuple[Geometry, Configuration, float | str, str]
"""Geometry, neutral configuration, characteristic length and unit: the fields of a design of a file, in order."""


class Format(NamedTuple):
    """A format of files: the constant `FORMAT` of a module of this room."""

    name: str
    suffix: str
    words: str
    """Of the file, for people."""
    text: Callable[..., str]
    """Returns the contents for a `Model`; its other parameters are the options of the format, with defaults."""
    read: Callable[[str], Fields] | None = None
    """Returns the design in a text, or raises ValueError with what is wrong; None if there is no way back."""
    mark: str = "written by ninedof"
    """A text that every such file holds."""
    beside: tuple[str, str, Callable[[Model], str]] | None = None
    """Suffix, mark and text of a second file: machine.loops.json beside machine.urdf."""

    @property
    def options(self) -> list[str]:
        """Names of the options."""
        return [name for name in inspect.signature(self.text).parameters if name != "model"]


@dataclass(frozen=True, eq=False)
class Model:
    """One design as the writers of files see it. Lengths in the unit of the design, angles in radians."""

    geometry: Geometry
    """Each joint in the frame of its plate."""
    configuration: Configuration
    """The neutral one of the plate: a single configuration."""
    characteristic_length: float | str = 1.0
    """A number, or a kind of `ninedof.characteristic_length`."""
    unit: str = ""
    """Name of the length unit, one of `ninedof.support.units.UNITS`; "" without one."""
    name: str = "ninedof"
    """Names the robot inside the file: letters, digits, "_" and "-"."""
    study: Study | None = None
    """The study that found the design."""
    source: Any = None
    """The argument of `model_of`: a Result, a Design, ..."""
    tool: Tool = field(default_factory=Tool)
    """Whose point and axes poses of the study are about, in the frame of the platform's plate."""

    def in_metres(self) -> Model:
        """Return geometry and neutral configuration in metres; as they are without a unit."""
        c, unit = self.configuration, self.unit
        geometry = Geometry(*(in_metres(points, unit) for points in triples(self.geometry).values()))
        p, s = in_metres(c.position, unit), in_metres(c.internal_point, unit)
        x, y, z = in_metres(self.tool.position, unit).tolist()
        return Model(geometry, Configuration(p, c.rotation, s), tool=Tool((x, y, z), self.tool.rotation))

    @cached_property
    def own_frame(self) -> dict[str, Floats]:
        """The twelve joints in the frame of their plate, by name."""
        rows = [point for points in triples(self.geometry).values() for point in points]
        return dict(zip(JOINTS, rows, strict=True))

    @cached_property
    def base_frame(self) -> dict[str, Floats]:
        """The twelve joints, p and O at the neutral pose in the base frame, by name."""
        p, q = self.configuration.position, self.configuration.rotation
        joints = {name: p + q @ x if name.startswith("platform") else x for name, x in self.own_frame.items()}
        return {**joints, P: p, O: self.configuration.internal_point}

    @cached_property
    def cone_axes(self) -> dict[str, Floats]:
        """The axis of the cone of each joint in the frame of its plate, of length 1, by name.

        That of a limit of the study where it has one, else the direction of the leg at the neutral pose, from the
        joint along the leg.
        """
        p, q, s = self.configuration.position, self.configuration.rotation, self.configuration.internal_point
        axes, cones = dict[str, Floats](), cone_limits(self.study)
        for name, at in self.own_frame.items():
            body, kind, number = name.split("_")
            other = self.own_frame[f"{'platform' if body == 'base' else 'base'}_{kind}_{number}"]
            in_base = body == "base"
            end = s if kind == "internal" else p + q @ other if in_base else other
            axis = end - at if in_base else q.T @ (end - p) - at
            if (limit := cones[f"{body}_cone_{kind}"]) is not None and limit.axis:
                axis = np.array(limit.axis)
            axes[name] = axis / max(float(np.linalg.norm(axis)), 1e-300)
        return axes

    @cached_property
    def neutral_lengths(self) -> Floats:
        """The nine leg lengths at the neutral configuration, shape (9,)."""
        return leg_lengths(self.geometry, self.configuration)

    @cached_property
    def sheet(self) -> Sheet | None:
        """The engineering sheet over the poses or the region of the study; None without a study. May take seconds."""
        return None if self.study is None else sheet(self.source)

    @cached_property
    def leg_ranges(self) -> Ranges | None:
        """Shortest and longest length of each leg, in the order of `LEGS`; None where nothing limits them.

        Those that a region needs, as its sheet has them, or those at the listed poses; for a study of the neutral pose
        alone its limits on leg lengths, if they limit all nine on both sides.
        """
        poses, study = getattr(self.source, "configurations", None), self.study
        if study is not None and study.objective.region is not None and self.sheet is not None:
            return tuple((leg.shortest, leg.longest) for leg in self.sheet.legs)
        if poses is not None and len(poses) > 1:
            lengths = leg_lengths(self.source.geometry, poses)  # both as the tool sees them
            return tuple(zip(lengths.min(axis=0).tolist(), lengths.max(axis=0).tolist(), strict=True))
        if study is None:
            return None
        limits = np.transpose(study.leg_limits(self.source.configuration)).tolist()
        return tuple((a, b) for a, b in limits) if all(0.0 < a < b < math.inf for a, b in limits) else None

    @property
    def permitted_ranges(self) -> Ranges | None:
        """Permitted lengths of the legs, where all are limited on both sides and `leg_ranges` are those needed."""
        ends = getattr(self.source, "permitted_lengths", None)
        if ends is None or self.leg_ranges is None:
            return None
        ranges: Ranges = tuple(zip(*(one.tolist() for one in ends), strict=True))
        limited = all(0.0 < low < high < math.inf for low, high in ranges)
        return ranges if limited and ranges != self.leg_ranges else None


def in_metres(values: ArrayLike, unit: str) -> Floats:
    """Return lengths in metres; as they are without a unit."""
    above, below = METRES[unit]
    return np.asarray(values, dtype=np.float64) * above / below


def from_metres(values: ArrayLike, unit: str) -> Floats:
    """Undo `in_metres`, to rounding."""
    above, below = METRES[unit]
    return np.asarray(values, dtype=np.float64) * below / above


def model_of(design: Any, name: str = "ninedof", unit: str | None = None) -> Model:
    """Return the model of anything with a geometry, a configuration and a characteristic length.

    The name is that of the robot inside the file; other characters than letters, digits, "_" and "-" become "_". The
    unit is that of the study or of the design file. Without both it must be given, "" for none: a simulator would take
    millimetres for metres. ValueError says what is missing or differs.
    """
    if not all(hasattr(design, name) for name in ("geometry", "configuration", "characteristic_length")):
        raise ValueError(f"design: got {type(design).__name__}, expected a result or a design")
    g, c, length = robot_of(design, "design"), design.configuration, design.characteristic_length
    if np.shape(c.position) != (3,):
        raise ValueError(f"design: got a stack of configurations of shape {c.shape}, expected a single one")
    study = getattr(design, "study", None)
    own = getattr(study or design, "unit", None)
    if own is None and unit is None:
        raise ValueError(f'unit: got none, expected the length unit of a {type(design).__name__}, "" for none')
    unit = None if unit is None else unit_argument(unit)
    if own and unit and unit != own:
        raise ValueError(f"unit: got {unit}, expected {own}, the unit of the design")
    tool = getattr(study or design, "tool", Tool())
    plates = (tool.plates(g), tool.plate(c)) if tool else (g, c)
    clean = "".join(x if x.isascii() and (x.isalnum() or x in "_-") else "_" for x in name) or "ninedof"
    return Model(*plates, length, unit_argument(own or unit or ""), clean, study, design, tool)
