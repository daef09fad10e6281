"""The design that a command is about, named by DESIGN or by sides and heights, and the poses it is looked at."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import numpy as np

import ninedof as nd
from ninedof.cli.answer import Answer
from ninedof.cli.options import (
    HEXAGON,
    ONE_DESIGN,
    HexagonalOptions,
    Options,
    Three,
    argument,
    length_option,
    numbers,
    option,
    struct,
    triple,
)
from ninedof.cli.screen import DONE, Screen, bold
from ninedof.conditioning.characteristic_length import length_at
from ninedof.conditioning.hexagonal import HEXAGONAL
from ninedof.paper.published import published_variables
from ninedof.records.design_file import hexagonal_design
from ninedof.records.load import design_and_result
from ninedof.redundancy.rules import RULES
from ninedof.robot.configuration import arrays_of, poses_of
from ninedof.sheet.pose_words import pose_words
from ninedof.support.arguments import vector
from ninedof.support.arrays import Floats
from ninedof.support.units import unit_entry

POSE = ("position", "rotation_deg", "internal_point")  # options that say where to look
NO_SIDE = 1e-12  # a determinant that is zero but for rounding
SAME = 1e-9  # relative: poses that differ by less coincide
ALIKE = 1e-3  # the same, of what the poses that ruled over a region span


@dataclass(frozen=True)
class Chosen:
    """A design at its neutral pose, and the result of its study, if there is one."""

    geometry: nd.Geometry
    configuration: nd.Configuration
    characteristic_length: float | str
    unit: str
    tool: nd.Tool
    result: nd.Result | None = None

    @property
    def design(self) -> nd.Design:
        """The design alone."""
        return nd.Design(self.geometry, self.configuration, self.characteristic_length, self.unit, self.tool)

    @property
    def machine(self) -> nd.Result | nd.Design:
        """The result, or the design alone without one."""
        return self.result or self.design

    def words(self, c: nd.Configuration) -> str:
        """Return a pose of the design in words."""
        return pose_words(c, self.configuration.rotation, self.unit)

    @property
    def study(self) -> nd.Study | None:
        """The study that it is from."""
        return None if self.result is None else self.result.study

    @property
    def rule(self) -> str:
        """The rule for O, that of the region of its study."""
        region = None if self.study is None else self.study.objective.region
        return "carried" if region is None else region.internal_point

    @property
    def duty(self) -> nd.Study:
        """The study that says what the machine is for; one of the tool alone without a study."""
        return self.study or nd.Study(tool=self.tool)

    @property
    def stated(self) -> dict[str, Any]:
        """Title block and tool of its study, as entries of a record's question for the report; those that it has."""
        entries = {"about": self.duty.about.to_dict(), "tool": self.tool.to_dict()}
        return {name: entry for name, entry in entries.items() if entry}

    @property
    def permitted_lengths(self) -> tuple[Floats, Floats] | None:
        """The least and greatest length of each leg by its study; None without one."""
        return None if self.result is None else self.result.permitted_lengths


@contextmanager
def searching(screen: Screen, command: str, *designs: Chosen) -> Iterator[None]:
    """Show the time so far while a command searches the region of a study; nothing for designs without one."""
    if all(one.study is None or one.study.objective.region is None for one in designs):
        yield
        return
    with screen.bar("boxes", command) as bar:
        bar.phase("searching the region")
        yield


C = TypeVar("C", bound=Chosen)


def named_design(name: str | None) -> Chosen:
    """Return the design that an argument DESIGN names; the published design at its best zs without one."""
    if name is None:
        return Chosen(*hexagonal_design(published_variables()))
    design, result = design_and_result(nd.load(name), name)
    return Chosen(*design, result)


def chosen_design(name: str | None, options: HexagonalOptions) -> Chosen:
    """Return the design that an argument DESIGN names, or that of the sides and heights of the hexagonal family."""
    values = options.values_of(*HEXAGON)
    if name is None:
        if missing := [f"--{side}" for side in HEXAGONAL if side not in values]:
            expected = "expected a design file or all of a1 a2 b1 b2 zp zs"
            raise ValueError(f"design: got no {', '.join(missing)}, {expected}")
        chosen = Chosen(*hexagonal_design(values | {"theta_z": math.radians(values.get("theta_z_deg", 0.0))}))
    elif values:
        raise ValueError(f"design: got {name} and {', '.join(values)}, expected one of the two")
    else:
        chosen = named_design(name)
    return with_length(chosen, options.lc)


def with_length(chosen: C, lc: str | None) -> C:
    """Return the design with the characteristic length given by --lc, if any."""
    return chosen if lc is None else replace(chosen, characteristic_length=length_option(lc))


@struct
class PoseOptions(Options):
    """A design and one pose."""

    design: str = argument(ONE_DESIGN)
    position: Three | None = triple("Position of the platform, base frame; the neutral one by default.")
    rotation_deg: Three | None = triple("Rotation vector from the neutral orientation, base axes, degrees.")
    internal_point: str | None = option(
        'O at that pose: carried, shifted, held, best, a fraction between the plates, or "X Y Z"; by default as in the '
        "region of the run's study, else carried.",
        values=RULES,
    )

    def at(self) -> DesignAtPoses:
        """Return the design at the poses of the options."""
        chosen = named_design(self.design)
        return DesignAtPoses(**vars(chosen), c=self.poses(chosen))

    def poses(self, chosen: Chosen) -> nd.Configuration:
        """Return a stack of one configuration, by default the neutral one."""
        home = chosen.configuration
        p = home.position if self.position is None else np.array(vector("--position", self.position))
        turn = np.radians((0.0, 0.0, 0.0) if self.rotation_deg is None else vector("--rotation-deg", self.rotation_deg))
        q = home.moved(np.concatenate([turn, np.zeros(6)])).rotation if turn.any() else home.rotation
        s = home.internal_point
        if self.values_of(*POSE):
            s = _internal_point(chosen, p, q, self.internal_point or chosen.rule)
        return nd.Configuration(p[None], q[None], s[None])


@struct
class PosesOptions(PoseOptions):
    """A design and one pose, or the poses of its study."""

    all_poses: bool = option("All poses of the run's study, the neutral one first.", False, "--all-poses")

    def poses(self, chosen: Chosen) -> nd.Configuration:
        """Return a stack of configurations: of the study, or one, by default the neutral one."""
        if not self.all_poses:
            return super().poses(chosen)
        self.refuse("beside --all-poses", *POSE)
        if chosen.result is None or chosen.result.best is None:
            raise ValueError("--all-poses: got a design without a study, expected a run")
        return chosen.result.best.configurations


@dataclass(frozen=True, kw_only=True)
class DesignAtPoses(Chosen):
    """A design at poses."""

    c: nd.Configuration

    def first(self, k: int) -> int:
        """Return the first pose that coincides with one: poses of a study may, and are named and printed once.

        Those that ruled over a region coincide where they are equal to a thousandth of what they span.
        """
        rows = [x.reshape(len(self.c), -1) for x in arrays_of(self.c).values()]
        size = SAME * max(np.abs(x[k]).max() for x in rows)
        spans = [np.ptp(x, axis=0).max() if self._region else 0.0 for x in rows]
        near = [np.abs(x - x[k]).max(axis=1) <= max(size, ALIKE * span) for x, span in zip(rows, spans, strict=True)]
        return int(np.argmax(np.all(near, axis=0)))

    @property
    def _region(self) -> bool:
        return self.study is not None and self.study.objective.region is not None

    def where(self, k: int) -> str:
        """Return " at pose 3", nothing where there is one pose."""
        return f" at pose {self.first(k)}" if len(self.c) > 1 else ""

    def answer(
        self, parts: Sequence[Any], data: Mapping[str, Any], used: Iterable[int] = (), status: int = DONE
    ) -> Answer:
        """Return what a command says of its poses; `used` are those that its tables mention by their numbers."""
        c = self.c
        if len(c) > 1:
            first = f"{len(c)} poses of the study; pose 0 is the neutral one"
            if self._region:
                alike = len(c) - len({self.first(k) for k in range(len(c))})
                first = f"{len(c)} poses{f', {len(c) - alike} of them distinct' * bool(alike)}: the neutral one, "
                first += "pose 0, and those of the region that ruled its condition number or a limit; extremes over "
                first += "the region: ninedof sheet"
            last = [f"pose {k}: {self.words(c[k])}" for k in sorted(set(used))]
        else:
            first, last = f"at {self.words(c[0])}", []
        beyond = beyond_words(self.geometry, self.configuration, c)
        return Answer(
            [first, *self.tool.remark(self.unit), *beyond, *parts, *last],
            unit_entry(self.unit) | {"poses": poses_of(c)} | dict(data),
            status,
        )


def beyond_words(g: nd.Geometry, home: nd.Configuration, c: nd.Configuration) -> list[Any]:
    """Return a line for each determinant whose sign at some pose of a stack is not that of the neutral pose."""
    parts = []
    for name, here, there in zip("NBC", nd.singularity_margins(g, c), nd.singularity_margins(g, home), strict=True):
        beyond = np.flatnonzero((here * np.sign(there) < -NO_SIDE) & (abs(there) > NO_SIDE)).tolist()
        if beyond:
            ends = ("positive", "negative") if there > 0.0 else ("negative", "positive")
            where = "here" if len(c) == 1 else f"at {len(beyond)} of {len(c)} poses, the first {beyond[0]}"
            signs = f"det {name} is {ends[0]} at the neutral pose, {ends[1]} {where}"
            parts.append(
                bold("beyond a singularity", f": {signs}; every way from the neutral pose passes det {name} = 0")
            )
    return parts


def length_at_home(chosen: Chosen) -> float:
    """Return the characteristic length as a number: a kind is taken at the neutral pose."""
    return length_at(chosen.geometry, chosen.configuration, chosen.characteristic_length)


def xyz(name: str) -> tuple[str, str, str]:
    """Return the heads of three columns of numbers, the coordinates of a point."""
    return f">{name}\nx", ">\ny", ">\nz"


def _internal_point(chosen: Chosen, p: Floats, q: Floats, rule: str) -> Floats:
    home, g = chosen.configuration, chosen.geometry
    carried: Floats = p + q @ (home.rotation.T @ (home.internal_point - home.position))
    shifted: Floats = p + home.internal_point - home.position
    fixed = {"carried": carried, "shifted": shifted, "held": home.internal_point}
    if rule in fixed:
        return fixed[rule]
    if rule == "best":
        limits = chosen.permitted_lengths
        best = nd.best_internal_point(
            g, p, q, characteristic_length=length_at_home(chosen), limits=limits, start=carried
        )
        if np.isnan(best.configuration.internal_point).any():
            raise ValueError(f"--internal-point: got best, but no place of O is the best there ({best.status})")
        return best.configuration.internal_point
    values = numbers(rule.translate(str.maketrans("(),", "   ")))  # as poses are printed, too
    if len(values) == 3:
        return np.array(values)
    if len(values) != 1:
        raise ValueError(f'--internal-point: got {rule!r}, expected {", ".join(RULES)}, a fraction or "X Y Z"')
    below, above = g.base_internal.mean(axis=0), p + q @ g.platform_internal.mean(axis=0)
    return np.asarray(below + values[0] * (above - below))
