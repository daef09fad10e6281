"""The body of a workspace in space, with the home pose and the region of a study in it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # type: ignore[import-untyped]
from numpy.typing import ArrayLike

from ninedof.plot import scene, style
from ninedof.plot.arguments import lines as checked_lines
from ninedof.plot.arguments import numbers, of_kind, texts
from ninedof.plot.section import home_mark
from ninedof.support.arguments import text
from ninedof.support.arrays import Floats

if TYPE_CHECKING:
    from ninedof.workspace import WorkspaceSurface

SHADES = np.array([[0.13, 0.22, 0.30], [0.88, 0.93, 0.96]])  # away from the light and towards it


def workspace_body(
    surface: WorkspaceSurface,
    coordinates: tuple[str, str, str] = ("x", "y", "z"),
    home: ArrayLike | None = None,
    lines: Sequence[ArrayLike] = (),
    unit: str = "",
) -> Figure:
    """Return a figure of the body of a workspace, one column wide.

    Parameters
    ----------
    surface : WorkspaceSurface
        As `WorkspaceMap.surface` returns it.
    coordinates : (str, str, str)
        Names of the axes, as `WorkspaceMap.coordinates`.
    home : array_like, shape (3,), optional
        The home position, marked.
    lines : sequence of array_like, each of shape (n, 3)
        The outline of the region of a study.
    unit : str
        Of the coordinates.

    Raises
    ------
    ValueError
        If the surface has no faces.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> found = nd.workspace(g, ([-4, -4, 0], [4, 4, 8]), criteria={"leg_limits": (2.5, 6.5)})
    >>> figure = nd.plot.workspace_body(found.surface(), home=[0.0, 0.0, 5.2])

    """
    if not len(of_kind("surface", surface, "WorkspaceSurface", "points", "faces").faces):
        raise ValueError("surface: got no faces, expected a workspace that is not empty")
    numbers("surface", surface.points, None, 3)
    if len(texts("coordinates", coordinates)) != 3:
        raise ValueError(f"coordinates: got {len(coordinates)}, expected three names")
    text("unit", unit)
    outline = checked_lines("lines", lines, None, 3)
    marked = [] if home is None else [numbers("home", home, 3)[None]]
    every = np.concatenate([surface.points, *outline, *marked])
    low, high = every.min(axis=0), every.max(axis=0)
    room = 0.04 * float((high - low).max())
    low, high = low - room, high + room
    with style.settings():
        figure = style.new_figure(style.ONE_COLUMN, style.ONE_COLUMN)
        axes: Any = figure.add_axes((0.0, 0.06, 0.97, 0.92), projection="3d")
        scene.box(axes, coordinates, unit, low, high)
        scene.fit(axes, low, high, (0.0, 0.08, 1.0, 0.92))
        faces = surface.points[surface.faces]
        front = surface.normals @ scene.towards_eye() > 0.0
        shades = _shades(surface.normals[front])
        body = Poly3DCollection(faces[front], facecolors=shades, edgecolors=shades, linewidth=0.4, zorder=5)
        body.set_rasterized(True)
        axes.add_collection3d(body)
        for line in outline:
            axes.plot(*line.T, color=style.INK, lw=1.0, zorder=7)
        keys: list[Any] = [Patch(fc=SHADES[1] * 0.5 + SHADES[0] * 0.5, label="workspace")]
        if outline:
            keys.append(style.key(style.INK, lw=1.0, label="region of the study"))
        for point in marked:
            floor = np.array([point[0], point[0]])
            floor[1, 2] = low[2]
            axes.plot(*floor.T, color=style.INK, lw=0.6, ls=(0, (3, 2)), zorder=7)
            axes.plot(*point.T, **home_mark())
            mark = {k: v for k, v in home_mark().items() if k != "color"}
            keys.append(style.key(style.INK, label="home", **mark))
        figure.legend(handles=keys, loc="lower center", ncols=3, bbox_to_anchor=(0.5, 0.0), columnspacing=1.2)
    return figure


def _shades(normals: Floats) -> Floats:
    """Return a colour for each face, light where it faces up and to the left of the viewer."""
    light = scene.towards_eye() + 0.8 * scene.to_the_left() + np.array([0.0, 0.0, 0.9])
    share = 0.5 + 0.5 * normals @ (light / np.linalg.norm(light))
    return np.asarray(SHADES[0] + share[:, None] * (SHADES[1] - SHADES[0]))
