"""Two lists: what a run proves, and what it only searched."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from ninedof.design.limits import OF_LENGTHS
from ninedof.optimize.bounds import applicable_bounds
from ninedof.optimize.pareto import Front
from ninedof.optimize.result import Result, Status
from ninedof.proof.machine_record import MachineCertificate
from ninedof.tables.html import Html, bullets, joined, paragraphs, tag
from ninedof.workspace import WorkspaceMap
from ninedof.workspace.question import LEG_LIMITS

ROUNDING = 1e-9  # a gap that no figure on the page shows

# As in docs/optimization.md.
STATUS = {
    Status.OPTIMAL: "feasible, regular and stationary by tests that do not rely on the solver",
    Status.UNBOUNDED: "the objective keeps falling as variables without a bound grow: shown numerically, not proved",
    Status.INFEASIBLE: "no start led to a feasible design, nor did a search for the least violation",
    Status.STOPPED: "interrupted, or no end of a start passed the tests: no claim is made for the design",
}


def of_result(result: Result, certificate: MachineCertificate | None, others: Sequence[str] = ()) -> Html:
    """Return what is established of an optimization and what is not.

    `certificate` is what `ninedof certify` proved, `others` a sentence on another one for other tolerances.
    """
    proofs = [*(certificate.sentences() if certificate else ()), *others, *_checked(result)]
    as_built = result.reserve is not None and result.reserve.proved  # of every machine within the tolerances
    if as_built and (certificate is None or certificate.tolerances != result.study.tolerances):
        proofs.append("Proved: every machine within the tolerances keeps the limits at every pose.")
    between = not as_built and (certificate is None or not certificate.proved)
    return _two(proofs, list(_searched(result, between)), STATUS[result.status], result.status)


def of_front(front: Front) -> Html:
    """Return the same of a front: each of its points is an optimization."""
    counts = {status: sum(r.status == status for r in front.results) for status in Status}
    proofs = [f"{count} of {len(front)} limits: {s}, {STATUS[s]}." for s, count in counts.items() if count]
    proved = sum(r.reserve is not None and r.reserve.proved for r in front.results)
    proofs += [f"{proved} of {len(front)} limits: proved of every machine within the tolerances."] * bool(proved)
    searched = [
        "Each point is a local optimum, the best that its starts and those from neighbouring limits found. That none "
        "is better is not proved.",
        "Between the limits nothing was solved.",
    ]
    return _two(proofs, searched, "each limit is solved as a study of its own", "front")


def of_workspace(workspace: WorkspaceMap, question: Mapping[str, Any]) -> Html:
    """Return the same of a workspace and what was asked."""
    proofs = []
    legs = any(name == LEG_LIMITS or name in OF_LENGTHS for name in question.get("criteria", ()))
    of_positions = workspace.archetype not in ("orientation", "reachable") and question.get("internal_point") != "best"
    if workspace.ball_radius > 0.0 and legs and of_positions:
        proofs.append("Proved: in the largest ball and the largest box every leg keeps to its limits.")
    if workspace.certified is not None:
        proofs.extend(workspace.certified.sentences())
    searched = [
        "Limits not named as proved were sampled: a hole thinner than the samples may remain.",
        "The error of the volume is an estimate, not a bound.",
        f"Poses evaluated: {workspace.evaluations:,}.".replace(",", " "),
    ]
    if workspace.unseen > 0.0:
        searched.append(
            f"Parts that no sample has shown have a volume of at most {workspace.unseen:.2g}, with a confidence of "
            "95 %."
        )
    return _two(proofs, searched, "how the search ended", str(workspace.status))


def _two(proofs: list[str], searched: list[str], meaning: str, status: str) -> Html:
    lists = [
        tag("div", tag("h3", title), bullets(items))
        for title, items in (("Proved or checked", proofs), ("Searched, not proved", searched))
        if items
    ]
    return joined(paragraphs([f"Status “{status}”: {meaning}."]), tag("div", *lists, class_="pair"))


def _checked(result: Result) -> Iterator[str]:
    best = result.best
    if best is not None and result.status == Status.OPTIMAL:
        most = best.constraint_violation
        more = f" by more than {most:.1e}" * (most > 0.0)
        yield f"Checked: no limit or bound is violated at the poses imposed{more}."
        yield (
            f"Checked: no direction lowers the objective to first order and keeps the limits; the residual is "
            f"{best.optimality_residual:.1e}, at most 1e-6."
        )
    for bound in applicable_bounds(result) if best is not None else ():
        if bound.proved:
            yield f"Proved: {bound.sentence}."


def _searched(result: Result, between: bool) -> Iterator[str]:
    best, region, proof = result.best, result.region, result.proof
    is_best = best is not None and proof is not None and proof.gap(best.condition_number) < ROUNDING
    if best is not None and result.status == Status.OPTIMAL and not is_best:
        yield "That no other design is better. The starts are evidence only: see their agreement above."
    if region is not None and between and region.looked_at == 0:
        yield "That the limits hold between the poses imposed: the design was not looked at there."
    elif region is not None and between:
        yield (
            f"That the limits hold between the poses looked at: {region.looked_at} poses of the region, with descents "
            "from the worst of them. A worse pose between them is not excluded."
        )
    if region is None and best is not None and len(best.conditions) > 1:
        yield "Anything between the listed poses."
    for bound in applicable_bounds(result) if best is not None else ():
        if not bound.proved:
            yield f"Found by long searches: {bound.sentence}."
    if result.status == Status.INFEASIBLE:
        yield "That no design satisfies all limits. For each limit named, a design satisfies the others named."
