"""The surface of a workspace for the view: of a workspace run, or of the limits of a study, coarse and quickly."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from functools import partial
from time import perf_counter
from typing import Any

import numpy as np

from ninedof.design.limit_numbers import SPREADS
from ninedof.optimize.result import Result
from ninedof.redundancy.rules import WORDS, where_o
from ninedof.report.scene import numbers
from ninedof.support.arrays import Floats
from ninedof.workspace import WorkspaceMap, workspace
from ninedof.workspace.question_words import criterion_words
from ninedof.workspace.study_question import box_around, study_question

MOST = 100_000  # points of the raster: at most about 46 along each side
TOLERANCE = 0.02  # of the volume of a quick workspace
EVALUATIONS = 200_000  # and its most
SECONDS = 1.5  # that it may take
SMALL, ROOM = 0.6, 0.1  # of the box: a workspace that is looked at again; of its size: what is added on each side then


class _TooLong(Exception):
    pass


def body_of(workspace_map: WorkspaceMap) -> dict[str, Any] | None:
    """Return vertices and faces of the surface; None for orientations, samples and empty workspaces."""
    if workspace_map.of_angles or workspace_map.method == "sample" or not workspace_map.volume > 0.0:
        return None
    surface = workspace_map.surface(MOST)
    if not len(surface.faces):
        return None
    return {"vertices": numbers(surface.points), "faces": surface.faces.tolist()}


def _box_of(workspace_map: WorkspaceMap) -> tuple[Floats, Floats] | None:
    """Return a box close about a workspace that is small in its own: its cells show it too coarsely; else None."""
    inside = workspace_map.cells.fraction > 0.0
    centre, half = workspace_map.cells.centre[inside], 0.5 * workspace_map.cells.size[inside]
    low, high = (centre - half).min(axis=0), (centre + half).max(axis=0)
    low, high = low - ROOM * (high - low), high + ROOM * (high - low)
    low, high = np.maximum(low, workspace_map.low), np.minimum(high, workspace_map.high)
    return (low, high) if (high - low < SMALL * (workspace_map.high - workspace_map.low)).all() else None


def quick_body(result: Result, run: str = "RUN") -> tuple[dict[str, Any] | None, str]:
    """Return the body of a result's best design within the limits of its study, and what it is or why there is none.

    Positions at the orientation of the neutral pose. It takes about two seconds at most. `run` names the run in the
    sentence: "RUN#7" for a point of a front.
    """
    begin, how = perf_counter(), f"ninedof workspace {run} computes it"

    def stop(*_: object) -> None:
        if perf_counter() - begin > SECONDS:
            raise _TooLong

    best, unit = result.best, result.study.unit
    assert best is not None
    try:
        keywords, left = study_question(result)
        keywords["box"] = box_around(best.configuration, result.study.tool)
        if keywords["internal_point"] == "best":
            return None, f"The workspace with O placed anew at every position takes minutes: {how}."
        if not keywords["criteria"]:
            return None, f"No limit of the study ends a workspace: ninedof workspace {run} --legs LOW HIGH sets one."
        search = partial(
            workspace,
            best.geometry,
            tolerance=TOLERANCE,
            most_evaluations=EVALUATIONS,
            progress=stop,
        )
        found = whole = search(**keywords)
        if found.volume > 0.0 and (tight := _box_of(found)) is not None:
            with suppress(_TooLong):  # the first one serves
                found = search(**keywords | {"box": tight})
    except _TooLong:
        return None, f"The workspace takes longer than a report may: {how}."
    except ValueError as error:  # such as limits that leave a leg no length
        return None, f"The workspace is not shown: {error}."
    body = body_of(found)
    if body is None:
        return None, f"No position was found that keeps all limits, at a coarse look: {how}."
    rule = keywords["internal_point"]
    o = WORDS["shifted"] if isinstance(rule, Mapping) else where_o(rule, unit)  # the platform does not turn
    limits = [
        words for name, value in keywords["criteria"].items() for words in criterion_words(name, value, unit, True)
    ]
    note = (
        f"Workspace: positions of the platform in the orientation of the neutral pose, within {'; '.join(limits)}. "
        f"O is {o}. "
    )
    if left := [name.replace("_", " ") for name in left if name in SPREADS]:
        note += f"Not among them: {', '.join(left)}. "
    if whole.box_limits:
        note += "It ends at the box looked at and is larger. "
    return body, f"{note}A coarse search: {how} with its volume and its error."
