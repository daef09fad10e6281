"""`ninedof workspace`: the workspace of a design, its table and its run folder."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from typing import Any, TypeVar

from ninedof.cli.answer import Answer, Figures, finish_job, write_and_print
from ninedof.cli.posed import Chosen, named_design, with_length
from ninedof.cli.screen import DONE, INTERRUPTED, NO_RESULT, bold
from ninedof.cli.workspace_question import Question, WorkspaceOptions, question_of
from ninedof.records.record import run_folder, write_run
from ninedof.robot.configuration import arrays_of
from ninedof.robot.geometry import triples
from ninedof.support.kept.store import Store
from ninedof.workspace import CertifiedWorkspace, WorkspaceMap, certified_workspace
from ninedof.workspace import workspace as find_workspace
from ninedof.workspace.study_question import region_share
from ninedof.workspace.tables import criteria_lines, cut_words, share_words, workspace_table, workspace_words

S = TypeVar("S", WorkspaceMap, CertifiedWorkspace)
OF_THE_MAP = ("method", "tolerance", "resolution", "points", "seed", "index")
EXAMPLES = """
  ninedof workspace --legs 1.5 6.5 --condition 5 --singularity-free
  ninedof workspace runs/20260101-120000    the limits of the study, O as the design has it
  ninedof workspace runs/20260101-120000 --upper 1.5 3 --clearance 0 --no-figures
  ninedof workspace design.toml --legs 2.5 6.5 --x -2 2 --y -2 2 --z 3 7 --out run1
  ninedof workspace runs/20260101-120000 --certify --gap 0.02    bounds of the volume, proved
  ninedof workspace --archetype orientation --angle-deg 60 --legs 1.5 6.5 --json | jq .workspace.volume"""


def workspace(options: WorkspaceOptions) -> None:
    """Compute the workspace of a robot: its volume, its boundary and what limits it.

    A run brings the limits of its study that a single pose can meet; each option replaces its own, one of all legs or
    joints those of each kind too. O keeps its place between the plates. Of a region study, the box is about the region,
    which is outlined, and O follows its rule.
    """
    screen = options.screen
    chosen = with_length(named_design(options.design), options.lc)
    question = question_of(options, chosen)
    home, region = chosen.configuration, question.region
    record = {"geometry": triples(chosen.geometry), "home": arrays_of(home), **question.keywords, **chosen.stated}
    how: dict[str, Any] = {"home": home, "threads": options.threads}
    whole = {"kind": "workspace", **record, "proof": question.proof}
    with run_folder(options.out) as directory, Store(directory, whole) as store:

        def search() -> WorkspaceMap:
            with screen.bar("poses", options.archetype.replace("_", " ")) as bar:
                return find_workspace(chosen.geometry, **question.keywords, **how, progress=bar.show)

        result = _piece(store, 0, WorkspaceMap, search)

    # At once: an interruption of what follows does not lose the map.
    keep = Answer(_parts(result, question, chosen), {"workspace": result.to_dict()})
    write_and_print(screen, keep, partial(write_run, result, directory, record))
    if (proof := question.proof) is not None and not result.interrupted:

        def prove() -> CertifiedWorkspace:
            keywords = {name: value for name, value in question.keywords.items() if name not in OF_THE_MAP}
            with screen.bar("boxes", "proving") as bar:
                return certified_workspace(chosen.geometry, **keywords, **proof, **how, progress=bar)

        proved = _piece(store, 1, CertifiedWorkspace, prove)
        if result.method != "sample":
            proved = proved.with_estimate(result.volume, result.error)
        result = replace(result, certified=proved)
        keep = Answer(proved.sentences(), {"workspace": result.to_dict()})
        write_and_print(screen, keep, partial(write_run, result, directory, record))
    data: dict[str, Any] = {"workspace": result.to_dict()}
    if region is not None and region.internal_point != "best" and not result.interrupted:
        keywords = question.keywords
        share = region_share(region, chosen.geometry, home, keywords["criteria"], keywords["characteristic_length"])
        screen.print(share_words(region, share, chosen.unit))
        data["region"] = {name: getattr(share, name) for name in ("share", "looked_at", "passed")}
    stopped = result.interrupted or (result.certified is not None and result.certified.interrupted)
    with_figures = result.volume > 0.0 and result.method != "sample"

    def draw() -> Figures:
        from ninedof.cli import workspace_figures

        return workspace_figures.draw(result, home, None if result.of_angles else region)

    answer = Answer([], data, INTERRUPTED if stopped else DONE if result.volume > 0.0 else NO_RESULT)
    write = partial(write_run, result, directory, record)
    finish_job(options, directory, answer, write, draw if with_figures else None)


def _piece(store: Store, number: int, kind: type[S], compute: Callable[[], S]) -> S:
    """Return a result that is in the store, or compute and keep it; an interrupted one is no piece."""
    if (arrays := store.read(number)) is not None:
        return kind._made(arrays)
    result = compute()
    if not result.interrupted:
        store.keep(number, result._contents())
    return result


def _parts(result: WorkspaceMap, question: Question, chosen: Chosen) -> Iterator[Any]:
    criteria, unit, tool = question.criteria, chosen.unit, chosen.tool
    lines = criteria_lines(question.keywords, chosen.configuration, criteria.own, criteria.left, unit, tool)
    yield from (bold(*words) for words in cut_words(result))
    yield next(lines)
    yield from tool.remark(unit)
    if criteria.actuators:
        yield criteria.actuators
    if criteria.replaced:
        yield f"limits of the study that options replace: {', '.join(criteria.replaced)}"
    yield from lines
    yield from chosen.duty.tolerances.remark()
    yield workspace_table(result)
    yield from (bold(*words) for words in workspace_words(result))
