"""The objective of a study: an index of the Jacobian, the poses, and how those are combined."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from inspect import signature
from typing import Any, TypeVar

from ninedof.design import poses
from ninedof.design.indices import objectives
from ninedof.design.pose import POSE_KEYS, Pose
from ninedof.design.region import REGION_KEYS, Region
from ninedof.support.arguments import choice, finite, items, known_keys, number, shown, table, text, whole
from ninedof.support.short import short_repr

Made = TypeVar("Made")

AGGREGATES = {
    "worst": "worst {index}",
    "mean_inverse": "harmonic mean of the {index}",
    "weighted": "worst and harmonic mean, weighted, of the {index}",
}
CONDITION_LIMITS = ("condition_limit", "neutral_condition_limit")
NUMBERS = ("aggregate", "weight", *CONDITION_LIMITS)
SETS: dict[str, Callable[..., tuple[Pose, ...]]] = {"box": poses.box, "ball": poses.ball, "path": poses.path}
SET_KEYS = {name: list(signature(make).parameters) for name, make in SETS.items()}  # the first of each is required


@short_repr
@dataclass(frozen=True)
class Objective:
    """The number that an optimization minimizes. By default the condition number at the neutral pose.

    Parameters
    ----------
    index : str
        "condition_number": of J', largest / smallest singular value (default). "frobenius": eq. (4), a smooth
        alternative. "speed": 1 / smallest singular value, the largest leg rates for a twist of unit norm.
        "six_legged": the condition number of the Gough-Stewart platform on the same plates, as a reference; at the
        neutral pose only.
    aggregate : str
        Over the poses: "worst" (default); "mean_inverse", the harmonic mean, its inverse being the global conditioning
        index; "weighted", between the two.
    weight : float
        Share of the worst in "weighted", in logarithms, from 0 to 1; 0.5 by default.
    condition_limit : float, optional
        Bound on the condition number at every pose, whatever the index; at least 1. None by default.
    neutral_condition_limit : float, optional
        The same at the neutral configuration alone, whatever the poses.
    poses : sequence of Pose or mappings
        Where the design is evaluated; by default at the neutral pose only. See `ninedof.poses`.
    region : Region or mapping, optional
        A continuous set of poses: limits hold and the index is the worst in all of it, and at the listed poses.

    Raises
    ------
    ValueError
        Naming the entry that does not fit.

    Examples
    --------
    >>> import ninedof as nd
    >>> from ninedof import poses
    >>> nd.Objective(poses=poses.box((0.1, 0.1, 0.1), unit="zp")).words
    'worst condition number over 27 poses'

    """

    index: str = "condition_number"
    aggregate: str = "worst"
    weight: float = 0.5
    condition_limit: float | None = None
    neutral_condition_limit: float | None = None
    poses: tuple[Pose, ...] = ()
    region: Region | None = None

    def __post_init__(self) -> None:
        """Check and normalize every entry."""
        listed = items("objective.poses", self.poses, "a sequence of poses")
        for name, value in {
            "index": _index(self.index),
            "aggregate": choice("objective.aggregate", self.aggregate, AGGREGATES),
            "weight": finite("objective.weight", self.weight, 0.0, 1.0),
            **{name: _condition_limit(name, getattr(self, name)) for name in CONDITION_LIMITS},
            "poses": tuple(_pose(k, pose) for k, pose in enumerate(listed)),
            "region": _region(self.region),
        }.items():
            object.__setattr__(self, name, value)
        if len(self.poses) > poses.MOST_POSES:
            raise ValueError(f"objective.poses: got {len(self.poses)}, expected at most {poses.MOST_POSES}")
        if self.poses and objectives()[self.index].function is None:
            raise ValueError(
                f"objective.poses: got {len(self.poses)}, expected none: {self.index} is for the neutral pose only"
            )
        if self.region is not None:
            if objectives()[self.index].function is None:
                raise ValueError(f"objective.region: got a region, expected none: {self.index} is for the neutral pose")
            if self.aggregate != "worst" and self.region.internal_point == "best":
                raise ValueError(f'objective.aggregate: got "{self.aggregate}", expected "worst" where O is best')
            if self.aggregate != "worst" and any(pose.weight > 0.0 for pose in self.poses):
                raise ValueError("objective.poses: got poses beside a mean over a region, expected weight = 0 for them")

    @property
    def mean_share(self) -> float:
        """The share of the harmonic mean in the logarithm of the objective."""
        return {"worst": 0.0, "mean_inverse": 1.0}.get(self.aggregate, 1.0 - self.weight)

    @property
    def words(self) -> str:
        """The objective in words."""
        return self.worded()

    def worded(self, unit: str = "", imposed: int = 0) -> str:
        """Return the objective in words, with the name of the length unit where a length stands.

        Of a region all poses count, or only so many imposed ones, at which O is not placed yet.
        """
        index, imposed = objectives()[self.index].words, whole("imposed", imposed, 0)
        unit = text("unit", unit)
        if self.region is not None and imposed:
            where = replace(self.region, internal_point="shifted").worded(unit)
            return f"{AGGREGATES[self.aggregate].format(index=index)} over {imposed} poses of {where}"
        if self.region is not None:
            listed = f" and {len(self.poses)} poses" if self.poses else ""
            return f"{AGGREGATES[self.aggregate].format(index=index)} over {self.region.worded(unit)}{listed}"
        if not self.poses:
            return index
        over = "at one pose" if len(self.poses) == 1 else f"over {len(self.poses)} poses"
        return f"{AGGREGATES[self.aggregate].format(index=index)} {over}"

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Objective:
        """Make an objective from the table [objective] of a study file; box, ball and path become poses."""
        known_keys(
            "objective",
            data,
            ["index", *NUMBERS, "internal_point", "unit", "poses", *SETS, "region"],
        )
        defaults = {name: data[name] for name in ("internal_point", "unit") if name in data}
        found: list[Pose] = []
        for k, entry in enumerate(items("objective.poses", data.get("poses", []), "tables [[objective.poses]]")):
            found.append(_pose(k, entry, **defaults))
        for name, make in SETS.items():
            if name in data:
                where = f"objective.{name}"
                known_keys(where, table(where, data[name]), SET_KEYS[name])
                if SET_KEYS[name][0] not in data[name]:
                    raise ValueError(f"{where}.{SET_KEYS[name][0]}: got nothing, expected a value")
                found.extend(_named(where, make, **(defaults | dict(data[name]))))
        # A region has no shift of s of its own: only a word for where O is, is a default for it too.
        region = _region(data.get("region"), **{k: v for k, v in defaults.items() if isinstance(v, str)})
        if defaults:
            _named("objective", Pose, **defaults)  # checked even where no pose uses the defaults
        rest = {name: data[name] for name in ("index", *NUMBERS) if name in data}
        return cls(poses=tuple(found), region=region, **rest)

    def to_dict(self) -> dict[str, Any]:
        """Return the table of a study file: the index, and what differs from the defaults."""
        numbers = {name: getattr(self, name) for name in NUMBERS}
        changed = {name: value for name, value in numbers.items() if value != getattr(Objective, name)}
        poses = {"poses": [pose.to_dict() for pose in self.poses]} if self.poses else {}
        region = {} if self.region is None else {"region": self.region.to_dict()}
        return {"index": self.index, **changed, **poses, **region}

    def for_core(self, over_region: bool = False) -> dict[str, Any]:
        """Return the objective as the core takes it; of a region, that over the listed poses, or over the region."""
        # Without the region a mean has no poses to be taken over.
        return {
            "index": self.index,
            "aggregate": self.aggregate if self.region is None or over_region else "worst",
            "weight": self.weight,
            **{name: math.inf if (limit := getattr(self, name)) is None else limit for name in CONDITION_LIMITS},
            "poses": [pose.for_core() for pose in self.poses],
        }


def _index(value: Any) -> str:
    """Return the core's word for an index of the table."""
    known = objectives()
    return str(known[choice("objective.index", value, known)].objective)


def _condition_limit(name: str, value: Any) -> float | None:
    if value is None or (number(f"objective.{name}", value) == math.inf):
        return None
    return finite(f"objective.{name}", value, least=1.0)


def _region(value: Any, **defaults: Any) -> Region | None:
    """Return a region, made from a table if one is given."""
    if value is None or isinstance(value, Region):
        return value
    entries = dict(table("objective.region", value))
    known_keys("objective.region", entries, REGION_KEYS)
    return _named("objective.region", Region.from_dict, defaults | entries)


def _pose(index: int, value: Any, **defaults: Any) -> Pose:
    """Return a pose, made from a table if one is given."""
    if isinstance(value, Pose):
        return value
    if not isinstance(value, Mapping):
        raise ValueError(f"objective.poses[{index}]: got {shown(value)}, expected a Pose or a table")
    known_keys(f"objective.poses[{index}]", value, POSE_KEYS)
    return _named(f"objective.poses[{index}]", Pose.from_dict, value, **defaults)


def _named(where: str, make: Callable[..., Made], /, *arguments: Any, **named: Any) -> Made:
    """Call `make` and prefix its error messages with the place of the entry."""
    try:
        return make(*arguments, **named)
    except ValueError as error:
        raise ValueError(f"{where}.{error}") from None
