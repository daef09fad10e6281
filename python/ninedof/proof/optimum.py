"""A proved lower bound of the condition number of all designs of a study, at the neutral pose or over poses."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace

from ninedof import _core
from ninedof.design.study import Study
from ninedof.proof.design_range import LONGEST
from ninedof.proof.optimum_proof import OptimumProof
from ninedof.proof.optimum_steps import MOST_BOXES, StepByStep, prove_class, ways_of
from ninedof.support.arguments import finite, instance, path_argument
from ninedof.support.arrays import thread_argument
from ninedof.support.kept.files import read_whole
from ninedof.support.running import Progress, progress_argument
from ninedof.support.structs import from_core
from ninedof.support.text import short_repr


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
    none below the target. Of a symmetric class at the neutral pose a design counts through the five numbers (hexagons),
    seven (other planar designs) or eleven (non-planar ones) on which its singular values and limits depend, so that the
    paper's problem takes a second or two. Over a region, at listed poses, with a tool, for other families and for
    limits that the first proof does not know, boxes of one to six free variables break a limit, or have a greater
    condition number, at a pose that is met: smaller and smaller gaps are proved, where the neutral pose is one of the
    poses there first, without some limits. Ctrl-C and the time limit return what is proved so far.

    Parameters
    ----------
    study : Study
        With the worst condition number as its objective. Of a symmetric family at the neutral pose any number of
        variables may be free, sizes may begin at 0, and the characteristic length of planar plates may be of any kind;
        elsewhere it is a number. Of the limits radius_ratio, leg_ratio (max),
        zs_fraction and, of non-planar designs, lengths of legs, joint_height, height and footprint (max) are part of
        that proof, others are left out (`OptimumProof.left_out`), but where up to four variables are free and they
        matter. Over poses that hold the neutral one more than six may be free: the bound is then that of the neutral
        pose. Elsewhere at most six are free, between finite ends, and O is shifted or held.
    condition_number : float
        Of the best design known.
    gap : float, optional
        To be proved: no condition number below (1 - gap) condition_number. By default 1e-12 for hexagons, 1e-6 for
        other planar designs and 2e-3 for non-planar ones, which is the work of minutes, and 1e-3 over poses.
    time_limit : float, optional
        Seconds; none by default.
    threads : int, optional
        One per processor by default. Without a time limit the result is the same for any number.
    progress : callable, optional
        Called as progress(boxes examined, 0, lower bound so far).

    Raises
    ------
    ValueError
        If the theory does not reach the study: the message says what it expects.
    RuntimeError
        If floating-point numbers of this process do not follow IEEE 754, as after loading code built with -ffast-math.

    Notes
    -----
    docs/theory/proof.md has the lemmas. Assumed: IEEE 754 arithmetic.

    Examples
    --------
    >>> import ninedof as nd
    >>> proof = nd.prove_optimum(nd.Study.paper(), 3.7626590785960, gap=1e-3)
    >>> proof.complete, round(proof.lower_bound, 3)
    (True, 3.759)

    """
    return prove(study, condition_number, gap, time_limit, threads, progress)


def prove(
    study: Study,
    condition_number: float,
    gap: float | None,
    time_limit: float | None,
    threads: int | None,
    progress: Progress | None,
    earlier: OptimumProof | None = None,
) -> OptimumProof:
    """Prove as `prove_optimum` does, and go on with an earlier proof of the same study."""
    best = finite("condition_number", condition_number)
    ways = ways_of(instance("study", study, Study))
    aim = ways.gap if gap is None else finite("gap", gap, least=0.0, most=1.0)
    limit = 0.0 if time_limit is None else finite("time_limit", time_limit, least=0.0)
    progress_argument(progress)
    if not best * (1.0 - aim) > 1.0:
        raise ValueError(f"condition_number: got {best:g} and a gap of {aim:g}, expected more than 1 to be proved")
    count = thread_argument(threads)
    if ways.home is not study or ways.by_boxes:
        return StepByStep(study, ways, limit or LONGEST, count, progress).prove(best, gap, earlier)
    proof = prove_class(study, best * (1.0 - aim), MOST_BOXES, limit, count, progress)
    proved = from_core(OptimumProof, proof, target=best * (1.0 - aim), where="", reason="")
    if earlier is None or earlier.lower_bound <= proved.lower_bound:
        return proved
    return replace(proved, lower_bound=earlier.lower_bound, certificate=earlier.certificate)


def relaxed(study: Study) -> Study:
    """Return the study without the limits that a proof leaves out: the bound comes up to its optimum, and not further.

    At the neutral pose alone where the class alone proves it; the study itself if no limit is left out.
    """
    ways = ways_of(study)
    if ways.by_boxes or ways.home is None:
        return study
    left_out = {label.removesuffix(" at neutral").removesuffix(".min") for label in ways.left_out}
    others = {name: limit for name, limit in ways.home.constraints.items() if name not in left_out}
    return replace(ways.home, constraints=others) if left_out else ways.home


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
    """Nothing wrong was found, and not all was confirmed: of a set or a workspace, or as the time was over."""
    study: tuple[str, ...] = ()
    """Of a proof: what it is about, one line each, as the checker read them; angles in radians."""


def check_certificate(
    path: str | os.PathLike[str], *, time_limit: float | None = None, progress: Progress | None = None
) -> CertificateCheck:
    """Check a certificate without trusting the search that wrote it: of an optimum, a machine, designs or a workspace.

    By the code of the program ninedof_check, which shares none with the search: numbers, formulas and bounds are its
    own. The certificate of the paper's study takes half a second.

    Parameters
    ----------
    path : path
        As `OptimumProof.save`, and `save_certificate` of a `Result`, an `AdmissibleSet` or a `CertifiedWorkspace` write
        it.
    time_limit : float, optional
        Seconds; none by default. A machine with limits of forces may take minutes.
    progress : callable, optional
        Called as progress(bytes or boxes read, all of them, None).

    Returns
    -------
    CertificateCheck
        A certificate that is damaged, changed or no proof is refused with the reason.

    Raises
    ------
    ValueError
        If the file cannot be read.

    """
    data = read_whole(path_argument("path", path))
    seconds = LONGEST if time_limit is None else finite("time_limit", time_limit, least=0.0)
    return from_core(CertificateCheck, _core.check_certificate(data, progress_argument(progress), seconds))
