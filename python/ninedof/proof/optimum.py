"""A proved lower bound of the condition number of every design that a study allows."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ninedof import _core
from ninedof.design.study import Study
from ninedof.support.arguments import finite, instance, path_argument
from ninedof.support.arrays import thread_argument
from ninedof.support.files import write_whole
from ninedof.support.progress import Progress, progress_argument
from ninedof.support.short import short_repr
from ninedof.support.structs import entries_of, from_core

FILE = "optimum.certificate"
GAPS = {"hexagonal": 1e-12, "symmetric": 1e-6}
"""Relative gaps to prove: of hexagons five numbers matter, of other symmetric designs seven."""
MOST_BOXES = 100_000_000  # a gigabyte of tree, some five minutes
PLAIN = ("lower_bound", "target", "complete", "boxes", "open", "seconds", "better", "interrupted")


@short_repr
@dataclass(frozen=True)
class OptimumProof:
    """A lower bound of the condition number of every design of a study, proved."""

    lower_bound: float
    """No design of the study has a condition number below it, at the neutral pose."""
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
    certificate: bytes = field(default=b"", repr=False, compare=False)
    """A file that `ninedof check` and the program ninedof_check read; empty if the search did not come to its end."""

    @property
    def words(self) -> str:
        """The bound as a sentence."""
        from decimal import ROUND_FLOOR, Context, Decimal  # when it is needed, as it takes time to load

        digits = Context(prec=400)  # of any double
        bound = Decimal(self.lower_bound).quantize(Decimal("1e-11"), ROUND_FLOOR, digits)  # never more than was proved
        sentence = f"Proved: no machine of this class has a condition number below {bound.normalize(digits):f}"
        if not self.left_out:
            return f"{sentence}."
        return f"{sentence}. The proof does without {', '.join(self.left_out)}: with them it holds all the more."

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
        return {name: getattr(self, name) for name in PLAIN} | {"left_out": list(self.left_out)}

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> OptimumProof:
        """Return the proof of a mapping as `to_dict` makes it, without its certificate."""
        return cls(**entries_of(cls, data, "proof", skipped=["certificate"]))


def prove_optimum(
    study: Study,
    condition_number: float,
    *,
    gap: float | None = None,
    time_limit: float | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
) -> OptimumProof:
    """Prove that no design of a study is better than a known one by more than a given gap.

    Branch and bound over all designs, in interval arithmetic: boxes of designs are cut until each is proved to hold
    none below the target. A design counts through the five numbers (hexagons) or seven (other planar symmetric
    designs) on which its singular values depend, so that the paper's problem takes a second or two. Ctrl-C and the time
    limit return what is proved so far.

    Parameters
    ----------
    study : Study
        Of the family "hexagonal" or "symmetric", at the neutral pose, with a characteristic length that is a number.
        Its bounds and the limits radius_ratio, leg_ratio (max) and zs_fraction are part of the proof. Others are left
        out, see `OptimumProof.left_out`.
    condition_number : float
        Of the best design known.
    gap : float, optional
        To be proved: no condition number below (1 - gap) condition_number. By default 1e-12 for hexagons and 1e-6 for
        other symmetric designs, which is the work of minutes.
    time_limit : float, optional
        Seconds; none by default.
    threads : int, optional
        One per processor by default. Without a time limit the result is the same for any number.
    progress : callable, optional
        Called as progress(boxes examined, 0, lower bound so far).

    Returns
    -------
    OptimumProof

    Raises
    ------
    ValueError
        If the theory does not reach the study: the message says what it expects.
    RuntimeError
        If floating-point numbers of this process do not follow IEEE 754, as after loading code built with -ffast-math.

    Notes
    -----
    docs/theory/proof.md has the lemmas. Assumed: IEEE 754 arithmetic, and a logarithm, exponential, sine and cosine of
    the C library that are right within two units in the last place.

    Examples
    --------
    >>> import ninedof as nd
    >>> proof = nd.prove_optimum(nd.Study.paper(), 3.7626590785960, gap=1e-3)
    >>> proof.complete, round(proof.lower_bound, 3)
    (True, 3.759)

    """
    best = finite("condition_number", condition_number)
    problem = _problem(study)
    aim = GAPS.get(study.family, 0.0) if gap is None else finite("gap", gap, least=0.0, most=1.0)
    limit = 0.0 if time_limit is None else finite("time_limit", time_limit, least=0.0)
    progress_argument(progress)
    target = best * (1.0 - aim)
    if not target > 1.0:
        raise ValueError(f"condition_number: got {best:g} and a gap of {aim:g}, expected more than 1 to be proved")
    settings = _core.OptimumSettings(
        target=target, threads=thread_argument(threads), box_limit=MOST_BOXES, time_limit=limit, keep_tree=True
    )
    return from_core(OptimumProof, _core.prove_optimum(problem, settings, progress), target=target)


def left_out_of(study: Study) -> tuple[str, ...]:
    """Return the limits of a study that a proof leaves out; raise ValueError if the theory does not reach the study."""
    settings = _core.OptimumSettings(target=2.0, threads=1, box_limit=0)  # looks at the study and at no box
    return _core.prove_optimum(_problem(study), settings, None).left_out


def _problem(study: Study) -> _core.Problem:
    instance("study", study, Study)
    if study.objective.region is not None:
        raise ValueError("objective: got a region of poses, expected the neutral pose alone for a proof")
    if study.tool:
        raise ValueError("tool: got [tool], expected none: the proof of an optimum is of plates without a tool")
    return study.problem()


@short_repr
@dataclass(frozen=True)
class CertificateCheck:
    """The verdict of the checker of a certificate."""

    proved: bool
    words: str
    """The proved statement, or the reason of a refusal."""
    boxes: int
    recut: int
    """Boxes that were cut further than by the search."""
    incomplete: bool = False
    """Of a set of designs: nothing in it is wrong, and not all of it could be confirmed."""
    study: tuple[str, ...] = ()
    """Of a proof: the designs that it is about, one line each, as the checker read them; angles in radians."""


def check_certificate(path: str | os.PathLike[str], *, progress: Progress | None = None) -> CertificateCheck:
    """Check a certificate of an optimum or of a set of designs, without trusting the search that wrote it.

    By the code of the program ninedof_check, which shares none with the search: numbers, formulas and bounds are its
    own. The certificate of the paper's study takes some eight seconds.

    Parameters
    ----------
    path : path
        As `OptimumProof.save` and `AdmissibleSet.save_certificate` write it.
    progress : callable, optional
        Called as progress(bytes or boxes of designs read, all of them, None).

    Returns
    -------
    CertificateCheck
        A certificate that is damaged, changed or no proof is refused with the reason.

    Raises
    ------
    ValueError
        If the file cannot be read.

    """
    try:
        data = path_argument("path", path).read_bytes()
    except OSError as error:
        raise ValueError(f"certificate: got {path!s}, expected a file that can be read ({error.strerror})") from None
    progress_argument(progress)
    return from_core(CertificateCheck, _core.check_certificate(data, progress))
