"""The proof that no design of a study has a condition number below a bound."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ninedof.support.arguments import finite, path_argument
from ninedof.support.kept.files import write_whole
from ninedof.support.structs import entries_of, plain_fields
from ninedof.support.text import short_repr
from ninedof.tables.html import notebook

FILE = "optimum.certificate"


@short_repr
@dataclass(frozen=True)
class OptimumProof:
    """A lower bound of the condition number of every design of a study, proved."""

    lower_bound: float
    """No design of the study has a condition number below it, at the neutral pose or `where`."""
    target: float
    """The bound to be proved; `lower_bound` if the search came to its end."""
    complete: bool
    boxes: int
    """Boxes of designs examined."""
    open: int
    """Boxes left for which less than the target is proved."""
    seconds: float
    better: float | None = None
    """Upper bound of the condition number of a design below the target, where the search met one in its domain and
    ended; None if it met none. Perhaps no design of the study: the proof takes the radii and the twist of hexagons as
    independent within their ranges, and leaves limits out."""
    left_out: tuple[str, ...] = ()
    """Limits of the study that the proof does without: the bound holds for more designs than the study allows."""
    interrupted: bool = False
    """Whether Ctrl-C ended the search."""
    where: str = ""
    """The poses of the worst condition number: "over the region", "at its poses"; "" for the neutral pose."""
    reason: str = ""
    """Why boxes of designs prove a study about the neutral pose, and not its class, which is faster; "" elsewhere."""
    certificate: bytes = field(default=b"", repr=False, compare=False)
    """A file that `ninedof check` and ninedof_check read; empty if nothing is proved, if the search did not come to
    its end, of a class of plane plates at the neutral pose, and of non-planar ones above a gigabyte."""

    @property
    def words(self) -> str:
        """The bound as a sentence."""
        from decimal import ROUND_FLOOR, Context, Decimal  # when it is needed, as it takes time to load

        digits = Context(prec=400)  # of any double
        bound = Decimal(self.lower_bound).quantize(Decimal("1e-11"), ROUND_FLOOR, digits)  # never more than was proved
        where = self.where and f" {self.where}"
        sentence = f"Proved: no machine of this class has a condition number below {bound.normalize(digits):f}{where}"
        if self.reason:
            return f"{sentence}. The class has no proof here ({self.reason}): by boxes of designs, which take longer."
        if not self.left_out:
            return f"{sentence}."
        return f"{sentence}. The proof does without {', '.join(self.left_out)}: with them it holds all the more."

    def _repr_html_(self) -> str:
        return notebook(self.words)

    def gap(self, condition_number: float) -> float:
        """Return what is left open below a condition number, as a fraction of it."""
        return max(0.0, 1.0 - self.lower_bound / finite("condition_number", condition_number, 1.0))

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write the certificate.

        Raises
        ------
        ValueError
            If there is none: the search was ended before all was proved.

        """
        if not self.certificate:
            raise ValueError("certificate: got a proof that did not come to its end, expected a complete one")
        return write_whole(path_argument("path", path), self.certificate)

    def to_dict(self) -> dict[str, Any]:
        """Return every field but the certificate as plain values."""
        return plain_fields(self, "certificate")

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> OptimumProof:
        """Return the proof of a mapping as `to_dict` makes it, without its certificate."""
        return cls(**entries_of(cls, data, "proof", skipped=["certificate"]))
