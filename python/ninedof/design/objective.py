"""The objective of a study: an index of the Jacobian, the poses, and how those are combined."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from inspect import signature
from itertools import chain
from typing import Any, Self

from ninedof import _core
from ninedof.design.domains import poses
from ninedof.design.domains.poses import ZERO, Pose
from ninedof.design.domains.region import Region
from ninedof.design.duty import duty
from ninedof.design.indices import objectives
from ninedof.support.arguments import choice, finite, items, known_keys, number, text, whole
from ninedof.support.structs import StudyTable, entry, keys, within
from ninedof.support.text import short_repr

AGGREGATES = {
    "worst": "worst {index}",
    "mean_inverse": "harmonic mean of the {index}",
    "weighted": "worst and harmonic mean, weighted, of the {index}",
}
CONDITION_LIMIT = "condition_limit"
CONDITION_LIMITS = (CONDITION_LIMIT, "neutral_condition_limit")
SETS: dict[str, Callable[..., tuple[Pose, ...]]] = {"box": poses.box, "ball": poses.ball, "path": poses.path}
SHARED = ("internal_point", "unit")
"""Keys of the table [objective] that are defaults of its poses, sets and region."""


def _index(name: str, value: Any) -> str:
    """Return the core's word for an index of the table."""
    names = objectives()
    return str(names[choice(name, value, names)].objective)


def _condition_limit(name: str, value: Any) -> float | None:
    return None if number(name, value) == math.inf else finite(name, value, least=1.0)


def _poses(name: str, value: Any, **defaults: Any) -> tuple[Pose, ...]:
    entries = items(name, value, "a list of poses")
    if len(entries) > poses.MOST_POSES:
        raise ValueError(f"{name}: got {len(entries)}, expected at most {poses.MOST_POSES}")
    return tuple(duty(Pose)(f"{name}[{k}]", one, **defaults) for k, one in enumerate(entries))


def _set(name: str, value: Any, shared: Mapping[str, Any]) -> tuple[Pose, ...]:
    """Return the poses of a table such as [objective.box]: the arguments of the function of that name."""
    arguments = list(signature(SETS[name]).parameters)
    known_keys(name, value, arguments)
    if (first := arguments[0]) not in value:
        raise ValueError(f"{name}.{first}: got nothing, expected a value")
    with within(name):
        return SETS[name](**{**shared, **value})


@short_repr
@dataclass(frozen=True)
class Objective(StudyTable):
    """The number that an optimization minimizes. By default the condition number at the neutral pose.

    Parameters
    ----------
    index : str
        "condition_number": of J', eq. (2), largest / smallest singular value (default). "frobenius": eq. (4), a smooth
        alternative, at least 6. "speed": 1 / smallest singular value, the largest leg rates for a twist of unit norm.
        "six_legged": the condition number of the Gough-Stewart platform with legs r_i u_i and r̂_i ũ_i on the same
        plates, as a reference; at the neutral pose only.
    aggregate : str
        Over the poses: "worst" (default); "mean_inverse", the harmonic mean, its inverse being the global conditioning
        index; "weighted", between the two.
    weight : float
        Share w of the worst in "weighted", worst^w mean_inverse^(1-w), from 0 to 1; 0.5 by default.
    condition_limit : float, optional
        Bound on the condition number at every pose, whatever the index; at least 1. None by default.
    neutral_condition_limit : float, optional
        The same at the neutral pose alone, listed or not.
    poses : sequence of Pose or mappings
        Where the design is evaluated: at the neutral pose only if none is listed. See `ninedof.poses`.
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

    index: str = entry(_index, "condition_number")
    aggregate: str = entry(partial(choice, known=AGGREGATES), "worst")
    weight: float = entry(partial(finite, least=0.0, most=1.0), 0.5)
    condition_limit: float | None = entry(_condition_limit, None)
    neutral_condition_limit: float | None = entry(_condition_limit, None)
    poses: tuple[Pose, ...] = entry(_poses, ())
    region: Region | None = entry(duty(Region), None)

    def __post_init__(self) -> None:
        """Check every entry, and that they go together."""
        super().__post_init__()
        mean, region = self.aggregate != "worst", self.region
        if objectives()[self.index].function is None and (self.poses or region):
            name, got = ("region", "a region") if region else ("poses", len(self.poses))
            raise ValueError(f"{name}: got {got}, expected none: {self.index} is for the neutral pose only")
        if mean and region and region.internal_point == "best":
            raise ValueError(f'aggregate: got "{self.aggregate}", expected "worst" where O is best')
        if mean and region and any(pose.weight > 0.0 for pose in self.poses):
            raise ValueError("poses: got poses beside a mean over a region, expected weight = 0 for them")

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
        unit, imposed = text("unit", unit), whole("imposed", imposed, 0)
        index, count = objectives()[self.index].words, len(self.poses)
        combined = AGGREGATES[self.aggregate].format(index=index)
        if self.region is None:
            return f"{combined} at one pose" if count == 1 else f"{combined} over {count} poses" if count else index
        if imposed:
            return f"{combined} over {imposed} poses of {replace(self.region, internal_point='shifted').worded(unit)}"
        return f"{combined} over {self.region.worded(unit)}{f' and {count} poses' * (count > 0)}"

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Self:
        """Make an objective from the table [objective] of a study file; box, ball and path become poses.

        Its `unit` and `internal_point` are defaults for all of them.
        """
        known_keys("objective", data, [*keys(cls), *SETS, *SHARED])
        table = dict(data)
        with within("objective"):
            shared = {name: table.pop(name) for name in SHARED if name in table}
            Pose(**shared)  # checked even where no pose uses them
            sets = [_set(name, table.pop(name), shared) for name in SETS if name in table]
            listed_poses = _poses("poses", table.pop("poses", ()), **shared)
            if table.get("region") is not None:
                # A region has no shift of s of its own: only a word for where O is, is a default for it too.
                words = {name: word for name, word in shared.items() if isinstance(word, str)}
                table["region"] = duty(Region)("region", table["region"], **words)
            return cls(**table, poses=tuple(chain(listed_poses, *sets)))

    def to_dict(self) -> dict[str, Any]:
        """Return the table of a study file: the index, and what differs from the defaults."""
        return {"index": self.index, **super().to_dict()}

    def for_core(self, over_region: bool = False) -> _core.Objective:
        """Return the objective as the core takes it; of a region, that over the listed poses, or over the region."""
        # Without the region a mean has no poses to be taken over.
        return _core.Objective(
            index=self.index,
            aggregate=self.aggregate if self.region is None or over_region else "worst",
            weight=self.weight,
            poses=[pose.for_core() for pose in self.poses],
            **{name: math.inf if (limit := getattr(self, name)) is None else limit for name in CONDITION_LIMITS},
        )


def internal_motion(objective: Objective) -> str:
    """Return how O moves over the poses of a study, for its limits and for the sheet of its design.

    "held", "shifted", or "carried" where nothing turns; "least", where the rates of the legs are least, for one pose
    alone and where O is placed or follows no rule.
    """
    listed, region = objective.poses, objective.region
    turns = any(pose.rotation != ZERO for pose in listed)
    # Without a shift, shifted and held are the same.
    rules = {pose.internal_point for pose in listed if pose.position != ZERO or pose.internal_point != "shifted"}
    if region is not None:
        turns = turns or max(region.reach[3:]) > 0.0
        if max(region.reach[:3]) > 0.0 or region.internal_point == "best":
            rules.add(region.internal_point)
    if rules == {"shifted"}:
        return "shifted" if turns else "carried"
    return "held" if rules == {"held"} or (not rules and turns) else "least"
