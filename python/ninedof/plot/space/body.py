"""The body of a workspace in space, with the home pose and the region of a study in it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # type: ignore[import-untyped]
from numpy.typing import ArrayLike

from ninedof.plot import style
from ninedof.plot.space import scene
from ninedof.support.arrays import as_floats

if TYPE_CHECKING:
    from ninedof.workspace import WorkspaceSurface

SHADES = np.array([[0.13, 0.22, 0.30], [0.88, 0.93, 0.96]])  # away from the light and towards it
LIGHT = scene.VIEW.eye - 0.8 * scene.VIEW.right + np.array([0.0, 0.0, 0.9])  # from above and the left of the viewer


def workspace_body(
    surface: WorkspaceSurface,
    coordinates: tuple[str, str, str] = ("x", "y", "z"),
    home: ArrayLike | None = None,
    lines: Sequence[ArrayLike] = (),
    unit: str = "",
    ax: Any = None,
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
    ax : mpl_toolkits.mplot3d.Axes3D, optional
        Axes to draw on; those of a new figure by default.

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
    if not len(surface.faces):
        raise ValueError("surface: got no faces, expected a workspace that is not empty")
    outline = [as_floats(f"lines[{k}]", line, (3,)) for k, line in enumerate(lines)]
    marked = np.empty((0, 3)) if home is None else as_floats("home", home, (3,)).reshape(1, 3)
    every = np.concatenate([surface.points, *outline, marked])
    low, high = every.min(axis=0), every.max(axis=0)
    room = 0.04 * float((high - low).max())
    low, high = low - room, high + room
    side = style.ONE_COLUMN
    with style.panel(ax, side, side, (0.0, 0.0, 1.0, 1.0), projection="3d") as (figure, axes):
        scene.box(axes, coordinates, unit, low, high)
        if ax is None:
            scene.fit(axes, low, high, (0.0, 0.08, 1.0, 0.92))
        front = surface.normals @ scene.VIEW.eye > 0.0
        share = 0.5 + 0.5 * surface.normals[front] @ (LIGHT / np.linalg.norm(LIGHT))
        shades = SHADES[0] + share[:, None] * (SHADES[1] - SHADES[0])
        faces = surface.points[surface.faces][front]
        body = Poly3DCollection(faces, facecolors=shades, edgecolors=shades, linewidth=0.4, zorder=5)
        body.set_rasterized(True)
        axes.add_collection3d(body)
        keys: list[Any] = [Patch(fc=SHADES.mean(axis=0), label="workspace")]
        for line in outline:
            axes.plot(*line.T, color=style.INK, lw=1.0, zorder=7)
        keys += [style.key(style.INK, lw=1.0, label="region of the study")] * bool(outline)
        for point in marked:
            axes.plot(
                *np.column_stack([point, [*point[:2], low[2]]]), color=style.INK, lw=0.6, ls=(0, (3, 2)), zorder=7
            )
            axes.plot(*point[:, None], **style.HOME)
            keys.append(style.key(**style.HOME, label="home"))
        words: dict[str, Any] = {"handles": keys, "ncols": 3, "columnspacing": 1.2}
        if ax is None:
            figure.legend(**words, loc="lower center")
        else:
            axes.legend(**words, loc="upper center", bbox_to_anchor=(0.5, 0.0))
    return figure
