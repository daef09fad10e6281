"""The commands that look at a design at poses: the neutral one, one given by options, or those of the study."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

import ninedof as nd
from ninedof.cli.answer import Answer
from ninedof.cli.chosen_design import Chosen, named_design
from ninedof.cli.options import ONE_DESIGN, Options, Three, argument, option, struct, triple, typed, word_or_number
from ninedof.cli.screen import DONE, bold
from ninedof.redundancy.rules import RULES
from ninedof.robot.configuration import arrays_of
from ninedof.support.arguments import vector
from ninedof.support.arrays import Floats
from ninedof.support.units import unit_entry

NO_SIDE = 1e-12  # a determinant that is zero but for rounding
SAME = 1e-9  # relative: poses that differ by less coincide


@struct
class PoseOptions(Options):
    """A design and one pose."""

    design: str = argument(ONE_DESIGN)
    position: Three | None = triple("Position of the platform, base frame; the neutral one by default.")
    rotation_deg: Three | None = triple("Rotation vector from the neutral orientation, base axes, degrees.")
    internal_point: str | None = option(
        'O at that pose: carried (default), shifted, held, best, a fraction between the plates, or "X Y Z".'
    )

    def named(self) -> list[str]:
        """Return the options that say where to look."""
        return list(map(typed, self.given("position", "rotation_deg", "internal_point")))

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
        if self.named():
            s = _internal_point(chosen, p, q, self.internal_point or "carried")
        return nd.Configuration(p[None], q[None], s[None])


@struct
class PosesOptions(PoseOptions):
    """A design and one pose, or the poses of its study."""

    all_poses: bool = option("All poses of the run's study, the neutral one first.", False, "--all-poses")

    def poses(self, chosen: Chosen) -> nd.Configuration:
        """Return a stack of configurations: of the study, or one, by default the neutral one."""
        if not self.all_poses:
            return super().poses(chosen)
        if named := self.named():
            raise ValueError(f"--all-poses: got {named[0]} beside it, expected one of the two")
        if chosen.result is None or chosen.result.best is None:
            raise ValueError("--all-poses: got a design without a study, expected a run")
        return chosen.result.best.configurations


@dataclass(frozen=True, kw_only=True)
class DesignAtPoses(Chosen):
    """A design at poses."""

    c: nd.Configuration

    def first(self, k: int) -> int:
        """Return the first pose that coincides with one: poses of a study may, and are named and printed once."""
        rows = np.hstack([x.reshape(len(self.c), -1) for x in arrays_of(self.c).values()])
        return int(np.argmax(np.abs(rows - rows[k]).max(axis=1) <= SAME * np.abs(rows[k]).max()))

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
            last = [f"pose {k}: {self.words(c[k])}" for k in sorted(set(used))]
        else:
            first, last = f"at {self.words(c[0])}", []
        beyond = beyond_words(self.geometry, self.configuration, c)
        return Answer(
            [first, *beyond, *parts, *last], unit_entry(self.unit) | {"poses": poses_data(c)} | dict(data), status
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
    length = chosen.characteristic_length
    if isinstance(length, str):
        return float(nd.characteristic_length(chosen.geometry, chosen.configuration, length))
    return length


def xyz(name: str) -> tuple[str, str, str]:
    """Return the heads of three columns of numbers, the coordinates of a point."""
    return f">{name}\nx", ">\ny", ">\nz"


def poses_data(c: nd.Configuration) -> list[dict[str, Floats]]:
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
        best = nd.best_internal_point(g, p, q, characteristic_length=length_at_home(chosen), start=carried)
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


def numbers(text: str) -> list[float]:
    """Return the finite numbers of a text, divided by blanks or commas; none if one of its words is no number."""
    try:
        values = [float(word) for word in text.replace(",", " ").split()]
    except ValueError:
        return []
    return values if all(map(math.isfinite, values)) else []


def several(option: str, text: str, expected: str) -> list[float]:
    """Return the numbers of an option that takes as many as `expected` has words, in quotes."""
    values, count = numbers(text), len(expected.split())
    if len(values) != count:
        raise ValueError(f'{option}: got {text!r}, expected {count} numbers "{expected}"')
    return values


def rule_option(text: str) -> str | float:
    """Return the rule for O given by --internal-point, or a fraction."""
    return word_or_number("--internal-point", text, RULES, f"{', '.join(RULES)} or a fraction")


def loads_option(texts: Iterable[str] | None) -> list[list[float]]:
    """Return the loads given by --load."""
    return [several("--load", text, "mx my mz fx fy fz") for text in texts or ()]
