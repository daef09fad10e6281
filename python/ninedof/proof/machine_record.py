"""The certificate of a machine: its limits one by one, in words and as plain values."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from typing import Any

from ninedof import _core
from ninedof.design.duty import Tolerances
from ninedof.design.limits import limit_words
from ninedof.proof.point_rule import PointRule
from ninedof.sheet.pose_words import words_of_pose
from ninedof.support.arguments import Vector, flag, number, table, text, whole
from ninedof.support.structs import made
from ninedof.support.text import short_repr
from ninedof.support.units import amount, kind_unit
from ninedof.tables.html import Worded

PROVED, VIOLATED, UNDECIDED = "proved", "violated", "undecided"


@dataclass(frozen=True)
class ProofPose:
    """A pose: a listed one, counted from 1, or shifts and turns from the neutral one."""

    shift: tuple[float, float, float] = (0.0, 0.0, 0.0)
    tilt: tuple[float, float, float] = (0.0, 0.0, 0.0)
    yaw: float = 0.0
    listed: int | None = None
    place: tuple[Vector, Vector, Vector] | None = None
    """p, O, and the rotation vector from the neutral pose in degrees, of one machine; None where it is of many."""

    def for_core(self) -> _core.MetAt:
        """Return the pose as the core counts poses."""
        number = -1 if self.listed is None else max(self.listed - 1, 0)
        return _core.MetAt(shift=self.shift, tilt=self.tilt, yaw=self.yaw, pose=number)

    def worded(self, unit: str = "") -> str:
        """Return the pose in words, angles in degrees: of one machine as the sheet has it."""
        if self.listed is not None:
            return f"pose {self.listed} of the study" if self.listed else "the neutral pose"
        if self.place is not None:
            return words_of_pose(*self.place, unit)
        shift = ", ".join(f"{x:.5g}" for x in self.shift)
        words = [f"p shifted by {amount(f'({shift})', unit)}"]
        vectors = [
            "(" + ", ".join(f"{math.degrees(x) + 0.0:.4g}" for x in turn) + ")°"
            for turn in (self.tilt, (0.0, 0.0, self.yaw))
            if any(turn)
        ]
        if vectors:
            words.append("turned " + " after ".join(vectors))
        return ", ".join(words)


@short_repr
@dataclass(frozen=True)
class LimitProof:
    """One side of one limit."""

    name: str
    kind: str
    """"ratio", "length", "angle" (radians) or "sign"."""
    side: str
    """"min" or "max"."""
    limit: float
    answer: str
    """"proved", "violated" or "undecided"."""
    value: tuple[float, float]
    """The worst value over all poses is in here, rigorously; one end was met at a pose."""
    margin: float
    """The least margin of the limit, proved, as `margin_of`: negative where the limit is not proved."""
    which: str
    """The leg, pair of legs or determinant that is worst."""
    at: tuple[ProofPose, ...]
    """The pose of the worst value; of a stroke where the leg is longest and where it is shortest."""
    boxes: int

    def shown(self, value: float) -> float:
        """Return a value as it is shown: angles in degrees."""
        return math.degrees(number("value", value)) if self.kind == "angle" else number("value", value)

    def unit(self, length: str, force_unit: str = "") -> str:
        """Return the unit of shown values."""
        return kind_unit(self.kind, text("length", length), text("force_unit", force_unit))

    def worded(self, digits: int = 6) -> str:
        """Return the bound that is proved, rounded to the safe side."""
        return self.outward(self.value[self.side == "max"], self.side == "max", digits)

    def outward(self, value: float, up: bool, digits: int) -> str:
        """Return a value as it is shown, rounded up or down."""
        size = self.shown(value)
        up, digits = flag("up", up), whole("digits", digits, 1, 400)
        if self.kind == "angle" and value != 0.0:  # less than two units in the last place from the exact degrees
            for _ in range(2):
                size = math.nextafter(size, math.inf if up else -math.inf)
        return outward(size, up, digits)


@dataclass(frozen=True)
class MachineCertificate(Worded):
    """Proved statements about a design at every pose it is made for."""

    where: str
    """The poses in words."""
    unit: str
    limits: tuple[LimitProof, ...]
    """First that no pose is singular, then the limits of the study."""
    lengths: tuple[tuple[float, float], ...]
    """Every leg (l, q, r) stays between these lengths."""
    condition: tuple[float, float]
    """The worst condition number over all poses is in here; the first was met, the second is proved."""
    condition_at: ProofPose
    condition_boxes: int
    left: tuple[tuple[float, ...], ...]
    """Boxes of poses where the condition number is not proved to be below `target`; empty if it is, or too many."""
    left_count: int
    target: float
    """The bound that was tried last; infinite where none was."""
    slack: float
    """Relative: limits count as kept up to this."""
    seconds: float
    joint_tolerance: float = 0.0
    """All is proved of every machine whose joint centres are within this of the drawing."""
    leg_tolerance: float = 0.0
    """And whose leg lengths are within this of what they are read as."""
    errors: tuple[tuple[float, float], ...] | None = None
    """As built: with the lengths of the drawing p, the platform (radians) and O are off by at most so much. The first
    number is found to first order, the second is proved; None without tolerances."""
    question: str = ""
    """Digest of what the proofs of `limits` depend on besides the machine: the study and the slack."""
    limits_timed: bool = False
    """Whether the time may have ended the search for a limit that is undecided."""
    errors_timed: bool = False
    """Whether the time ended the search for a bound of `errors` without one."""
    interrupted: bool = False
    rule: PointRule | None = None
    """The rule for O, if a region places it anew at every pose: all of this is proved of O placed by it."""
    force_unit: str = ""
    """"N" where the study states masses and lengths have a unit."""
    machine: str = ""
    """Digest of the machine and its poses: another run goes on with the certificate of the same machine only."""

    def __repr__(self) -> str:
        """Show how much is proved."""
        proved = sum(limit.answer == PROVED for limit in self.limits)
        condition = f"condition number at most {self.condition[1]:.6f}"
        return f"<MachineCertificate: {proved} of {len(self.limits)} limits proved at {self.where}; {condition}>"

    @property
    def proved(self) -> bool:
        """Whether every limit is proved."""
        return all(limit.answer == PROVED for limit in self.limits)

    def sentences(self) -> list[str]:
        """Return what is proved, and what is not, in words."""
        return [*self._of_poses(), *self._of_condition(), *(words for one in self.limits if (words := self._open(one)))]

    def _of_poses(self) -> Iterator[str]:
        """Yield what all is proved of, the lengths of the legs, and the limits that are proved."""
        if self.tolerances:
            yield self._as_built()
        if self.rule is not None:
            yield (
                f"O follows the rule stored in the certificate: {self.rule.words} in the shift, the tilt and the yaw. "
                "What is proved holds for this rule. With O placed for the least condition number, that is at no "
                "pose larger."
            )
        legs = []
        for k, kind in ((0, "external"), (3, "upper internal"), (6, "lower internal")):
            low, high = min(a for a, _ in self.lengths[k : k + 3]), max(b for _, b in self.lengths[k : k + 3])
            legs.append(f"the {kind} legs are {outward(low, False)} to {amount(outward(high, True), self.unit)} long")
        if math.isfinite(self.condition[1]):
            legs[-1] += f", and the condition number is at most {outward(self.condition[1], True)}"
        how = ", O placed by the rule" * (self.rule is not None) + ", as built" * bool(self.tolerances)
        yield f"Proved: at every pose of {self.where}{how}, {', '.join(legs)}."
        if self.limits and self.limits[0].answer == PROVED:
            yield "Proved: none of these poses is singular, and the machine never leaves its side of a singularity."
        names = [limit_words(one.name, one.side) for one in self.limits[1:] if one.answer == PROVED]
        if names:
            yield f"Proved, up to {self.slack:g} of each: the limit{'s' * (len(names) > 1)} of {', '.join(names)}."

    def _of_condition(self) -> Iterator[str]:
        """Yield the worst condition number met, and what is not proved of it."""
        low, high = self.condition
        if low > 0.0:
            at = self.condition_at.worded(self.unit)
            yield f"The worst condition number met is {outward(low, False)}, at {at}."
        boxes = f", with {self.left_count} {'box' if self.left_count == 1 else 'boxes'} of poses left"
        if not math.isfinite(high):
            yield f"No bound of the condition number is proved{boxes if self.left_count else ''}."
        elif self.left_count:
            yield f"Not decided: whether the condition number is at most {self.target:.6g}{boxes}."
        elif self.tolerances and self.target < high:
            yield (
                f"No bound of the condition number below {outward(self.target, False)} is proved of machines that "
                "differ by these tolerances, however long the search."
            )

    def _open(self, limit: LimitProof) -> str:
        """Return how a limit is violated, or what is known of one that is undecided; "" of one that is proved."""
        if limit.answer == PROVED:
            return ""
        name = ", ".join(filter(None, [limit.name.replace("_", " "), limit.which]))
        ends = [limit.outward(x, up, 9) for x, up in zip(limit.value, (False, True), strict=True)]
        size = [amount(end, limit.unit(self.unit, self.force_unit)) for end in ends]
        met = size[limit.side == "min"]
        if limit.answer == UNDECIDED:
            if math.isinf(limit.value[limit.side == "max"]):
                return f"Undecided: {name}: the worst value met so far is {met}, and nothing bounds it yet."
            return f"Undecided: {name}: the worst value is between {' and '.join(size)}."
        poses = [pose.worded(self.unit) for pose in limit.at]
        at = f", at {poses[0]}" if len(poses) == 1 else f", between {' and '.join(poses)}" if poses else ""
        return f"Violated{' by the rule' * (self.rule is not None)}: {name}: {met}{at}."

    @property
    def tolerances(self) -> Tolerances:
        """Of every machine that all of this is proved of."""
        return Tolerances(self.joint_tolerance, self.leg_tolerance)

    def _as_built(self) -> str:
        joints, legs = (amount(f"{x:.6g}", self.unit) for x in (self.joint_tolerance, self.leg_tolerance))
        words = f"As built: every joint centre within {joints} and every leg length within {legs} of the drawing."
        if self.errors is None or not all(math.isfinite(high) for _, high in self.errors):
            return f"{words} No bound of the error of its pose is proved{self._why_no_bound()}."
        position, turn, point = (high for _, high in self.errors)
        return (
            f"{words} With the lengths of the drawing p is off by at most "
            f"{amount(outward(position, True), self.unit)}, the platform by "
            f"{outward(math.degrees(turn) * (1 + 1e-12), True)}°, O by {amount(outward(point, True), self.unit)}."
        )

    def _why_no_bound(self) -> str:
        """Return why no bound of the error is proved; "" where that is not known."""
        if self.errors is None:
            return ""
        if not all(math.isfinite(met) for met, _ in self.errors):
            return ": to first order it is infinite at a pose, which is singular"
        why = "the time ended the search" if self.errors_timed else "the tolerances are too large for the proof"
        size = amount(outward(self.errors[0][0], False), self.unit)
        return f": {why}. To first order p is off by {size} at the worst pose met"

    def to_dict(self) -> dict[str, Any]:
        """Return plain values, for a file."""
        return {**asdict(self), "proved": self.proved}

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> MachineCertificate:
        """Make the certificate from what `to_dict` returns.

        Raises
        ------
        ValueError
            If it is not whole.

        """
        return made(cls, table("certificate", data))


def outward(value: float, up: bool, digits: int = 6) -> str:
    """Return a number in a few digits, rounded up or down."""
    if value == 0.0 or not math.isfinite(value):
        return f"{value:g}"
    from decimal import ROUND_CEILING, ROUND_FLOOR, Context  # when it is needed, as it takes time to load

    rounded = Context(prec=digits, rounding=ROUND_CEILING if up else ROUND_FLOOR).create_decimal_from_float(value)
    if -5 < rounded.adjusted() < digits:
        return f"{rounded.normalize():f}"
    mantissa, power = f"{rounded.normalize():e}".split("e")
    return f"{mantissa}e{int(power):+03d}"
