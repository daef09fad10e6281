"""The figures of a workspace. They are drawn with matplotlib, so this module is loaded where one is drawn."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.figure import Figure

from ninedof import plot
from ninedof.cli.answer import Figures
from ninedof.design.domains.region import Region, region_lines, section_outline
from ninedof.plot import Section
from ninedof.plot.style import round_to
from ninedof.robot.configuration import Configuration
from ninedof.support.arrays import Floats
from ninedof.workspace import CertifiedWorkspace, WorkspaceMap

NEAR = 10.0  # home is marked in a section within this part of the size of the workspace


def draw(workspace: WorkspaceMap, home: Configuration, region: Region | None) -> Figures:
    """Yield sections and, of positions, the body, behind their names.

    Vertical sections are at round values near the centre of the largest ball, or else the worst pose, or in the middle
    of the region of a study, which is outlined. The horizontal one goes through home, which is marked near its plane.
    """
    middle = workspace.ball_centre if workspace.ball_radius > 0.0 else workspace.worst_at
    if region is not None:
        middle = home.position
    sections = [_section(workspace, home, region, middle, *plane) for plane in _planes(workspace, home, middle)]
    yield "workspace", plot.workspace(workspace, sections)
    if workspace.of_angles:
        return
    if workspace.certified is not None and workspace.certified.volume[1] > 0.0:
        yield "certified_workspace", _certified(workspace, workspace.certified, home, region)
    surface = workspace.surface()
    if len(surface.faces):
        lines = () if region is None else region_lines(region, home)
        axes, unit = workspace.coordinates, workspace.unit
        yield "workspace_body", plot.workspace_body(surface, axes, home=home.position, lines=lines, unit=unit)


def _certified(
    workspace: WorkspaceMap, proved: CertifiedWorkspace, home: Configuration, region: Region | None
) -> Figure:
    middle = workspace.ball_centre if workspace.ball_radius > 0.0 and region is None else home.position
    panels = []
    for fixed, at in _planes(workspace, home, middle)[::2]:
        place = float(np.clip(at, proved.low[fixed], proved.high[fixed]))
        section = _section(workspace, home, region, middle, fixed, place)
        plane = proved.section(workspace.coordinates[fixed], place)
        panels.append(Section(plane, region=section.region, home=section.home, estimate=section.plane))
    return plot.certified_workspace(panels, workspace.unit)


def _planes(workspace: WorkspaceMap, home: Configuration, middle: Floats) -> list[tuple[int, float]]:
    round_values = [_round(float(middle[k]), workspace, k) for k in range(3)]
    if workspace.of_angles:
        return [(k, round_values[k]) for k in (1, 2)]
    height = float(home.position[2])
    heights = workspace.field.axes[2]
    through_home = heights[0] <= height <= heights[-1]
    return [(1, round_values[1]), (0, round_values[0]), (2, height if through_home else round_values[2])]


def _section(
    workspace: WorkspaceMap, home: Configuration, region: Region | None, middle: Floats, fixed: int, at: float
) -> Section:
    """Return one section with what is marked in it: home, and the region or else the largest ball and box."""
    axes = [k for k in range(3) if k != fixed]
    plane = workspace.slice(workspace.coordinates[fixed], at, smooth=True)
    near = abs(float(home.position[fixed]) - at) <= float(np.ptp(workspace.field.axes[fixed])) / NEAR
    marked = home.position[axes] if near and not workspace.of_angles else None
    if region is not None:
        return Section(plane, region=section_outline(region, home, fixed, at), home=marked)
    radius = np.sqrt(max(workspace.ball_radius**2 - (at - float(middle[fixed])) ** 2, 0.0))
    ball = (middle[axes], radius) if radius > 0.0 else None
    has_box = np.isfinite(workspace.box_low).all() and workspace.box_low[fixed] <= at <= workspace.box_high[fixed]
    inner = (workspace.box_low[axes], workspace.box_high[axes]) if has_box else None
    return Section(plane, ball, inner, home=marked)


def _round(value: float, workspace: WorkspaceMap, fixed: int) -> float:
    """Return a round value near a coordinate of a map, of angles round in degrees."""
    scale = 180.0 / math.pi if workspace.of_angles else 1.0
    span = float(np.ptp(workspace.field.axes[fixed]))
    return float(np.clip(round_to(scale * value, scale * span) / scale, workspace.low[fixed], workspace.high[fixed]))
