"""The view of a page as plain values: the machine, its poses, its region, and the body of a workspace."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from functools import partial
from time import perf_counter
from typing import Any

import numpy as np

from ninedof.conditioning.conditioning import condition_number
from ninedof.design.limit_numbers import SPREADS
from ninedof.design.tool import Tool
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.optimize.result import Result
from ninedof.redundancy.rules import WORDS, where_o
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.sheet.sheet import Sheet
from ninedof.support.arrays import Floats
from ninedof.workspace import WorkspaceMap, workspace
from ninedof.workspace.study_question import box_around, design_question
from ninedof.workspace.tables import criterion_words

DIGITS = 6  # significant, of coordinates in the page


def machine(
    name: str,
    g: Geometry,
    length: float,
    poses: Iterable[tuple[str, Configuration]],
    lines: Sequence[Floats] = (),
    body: Mapping[str, Any] | None = None,
    tool: Tool | None = None,
) -> dict[str, Any]:
    """Return a machine with its named poses, the lines of a region and the body of a workspace, where there are some.

    `length` is the characteristic length; poses are of the tool's point, and a line goes there from the plate's origin.
    """
    from ninedof.robot.plates import outlines

    base = np.vstack([g.base_external, g.base_internal])
    platform = np.vstack([g.platform_external, g.platform_internal])
    return {
        "name": name,
        "base": numbers(base),
        "platform": numbers(platform),
        "basePlate": [numbers(face) for face in outlines(base)],
        "plateOrigin": list(tool.seen((0.0, 0.0, 0.0))) if tool else None,
        "platformPlate": [numbers(face) for face in outlines(platform)],
        "poses": [_pose(words, g, c, length) for words, c in poses],
        "region": [numbers(line) for line in lines],
        "body": body,
    }


def _pose(words: str, g: Geometry, c: Configuration, length: float) -> dict[str, Any]:
    kappa = condition_number(g, c, length) if np.isfinite(length) else np.inf
    return {
        "name": words,
        "p": numbers(c.position),
        "q": [[round(float(x), 9) for x in row] for row in c.rotation],
        "s": numbers(c.internal_point),
        "kappa": f"{kappa:.6f}" if np.isfinite(kappa) else "infinite",
        "lengths": [f"{x:.6g}" for x in leg_lengths(g, c)],
    }


def worst_poses(sheet: Sheet) -> list[tuple[str, Configuration]]:
    """Return the neutral pose and the worst poses of a sheet, each with all that is worst there."""
    names: dict[int, list[str]] = {0: []}
    names.setdefault(sheet.condition_number.pose, []).append("worst condition number")
    names.setdefault(sheet.clearance.pose, []).append(f"least clearance, {' and '.join(sheet.clearance.legs)}")
    if len(sheet.configurations) > 1:
        lengths = leg_lengths(sheet.geometry, sheet.configurations)
        most = max(range(9), key=lambda k: sheet.legs[k].stroke_ratio)
        for words, pick in (("shortest", np.argmin), ("longest", np.argmax)):
            names.setdefault(int(pick(lengths[:, most])), []).append(f"{sheet.legs[most].name} {words}")
    for name, det in sheet.determinants.items():
        names.setdefault(det.pose, []).append(f"least |det {name[-1].upper()}|")
    neutral = ["neutral pose", *(names.pop(0) if len(sheet.configurations) > 1 else [])]
    rows = [(0, neutral), *names.items()]
    return [(", ".join(words), sheet.configurations[k]) for k, words in rows]


def scene(machines: Iterable[Mapping[str, Any]], unit: str = "", start: int = 0) -> dict[str, Any]:
    """Return what the view shows; `start` is the machine it begins with."""
    return {"unit": unit, "machines": list(machines), "start": start}


def numbers(points: Floats) -> Any:
    """Return coordinates as lists of short numbers."""
    values = np.asarray(points, dtype=float)
    size = float(np.abs(values).max(initial=0.0))
    decimals = DIGITS - 1 - int(np.floor(np.log10(size))) if size > 0.0 else 0
    return (np.round(values, decimals) + 0.0).tolist()


MOST = 100_000  # points of the raster: at most about 46 along each side
TOLERANCE = 0.02  # of the volume of a quick workspace
EVALUATIONS = 200_000  # and its most
SECONDS = 1.5  # that it may take
SMALL, ROOM = 0.6, 0.1  # of the box: a workspace that is looked at again; of its size: what is added on each side then


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
            raise TimeoutError

    best, unit = result.best, result.study.unit
    assert best is not None
    try:
        keywords, left = design_question(result)
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
        positions = whole = search(**keywords)
        if positions.volume > 0.0 and (tight := _box_of(positions)) is not None:
            with suppress(TimeoutError):  # the first one serves
                positions = search(**keywords | {"box": tight})
    except TimeoutError:
        return None, f"The workspace takes longer than a report may: {how}."
    except ValueError as error:  # such as limits that leave a leg no length
        return None, f"The workspace is not shown: {error}."
    body = body_of(positions)
    if body is None:
        return None, f"No position was found that keeps all limits, at a coarse look: {how}."
    rule = keywords["internal_point"]
    o = WORDS["shifted"] if isinstance(rule, Mapping) else where_o(rule, unit)  # the platform does not turn
    tool, criteria = result.study.tool, keywords["criteria"]
    limits = [words for name, value in criteria.items() for words in criterion_words(name, value, unit, tool, True)]
    whose = "tool's point" if tool else "platform"
    note = (
        f"Workspace: positions of the {whose} in the orientation of the neutral pose, within {'; '.join(limits)}. "
        f"O is {o}. "
    )
    if left := [name.replace("_", " ") for name in left if name in SPREADS]:
        note += f"Not among them: {', '.join(left)}. "
    if whole.box_limits:
        note += "It ends at the box looked at and is larger. "
    return body, f"{note}A coarse search: {how} with its volume and its error."
