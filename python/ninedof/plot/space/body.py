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
from ninedof.support.arrays import Floats, as_floats

if TYPE_CHECKING:
    from ninedof.workspace import WorkspaceSurface

SHADES = np.array([[0.13, 0.22, 0.30], [0.88, 0.93, 0.96]])  # away from the light and towards it
LIGHT = scene.VIEW.eye - 0.8 * scene.VIEW.right + np.array([0.0, 0.0, 0.9])  # from above and the left of the viewer

LINES = {
    True: {"color": style.INK, "lw": 0.9, "ls": (0, (3, 1.5)), "label": "region, inside"},
    False: {"color": style.ALARM, "lw": 1.6, "label": "region, outside"},
}
"""Of the outline of a region by whether it is in the body."""
RAY = np.linalg.qr([[1.0, 0.3, 0.37], [0.2, 1.0, 0.61], [0.5, -0.4, 1.0]])[0]  # base axes to those of a ray, the last
STEP = 0.01  # of the largest side of the picture, between points of an outline


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
        The outline of the region of a study: dashed inside the body, and in the colour of a warning where it sticks
        out.
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
    room = 0.04 * (high - low).max()
    low, high = low - room, high + room
    side = style.ONE_COLUMN
    with style.panel(ax, side, side, (0.0, 0.0, 1.0, 1.0), projection="3d") as (figure, axes):
        scene.box(axes, coordinates, unit, low, high)
        if ax is None:
            scene.fit(axes, low, high, (0.0, 0.11, 1.0, 0.89))
        front = surface.normals @ scene.VIEW.eye > 0.0
        share = 0.5 + 0.5 * surface.normals[front] @ (LIGHT / np.linalg.norm(LIGHT))
        shades = SHADES[0] + share[:, None] * (SHADES[1] - SHADES[0])
        faces = surface.points[surface.faces][front]
        body = Poly3DCollection(faces, facecolors=shades, edgecolors=shades, linewidth=0.4, zorder=5)
        body.set_rasterized(True)
        axes.add_collection3d(body)
        keys: list[Any] = [Patch(fc=SHADES.mean(axis=0), label="workspace")]
        sides = _inside(surface, [_dense(line, STEP * (high - low).max()) for line in outline])
        for inside, look in LINES.items():
            for part in sides[inside]:
                axes.plot(*part.T, **look, zorder=7 + (not inside))
            keys += [style.key(**look)] * bool(sides[inside])
        for point in marked:
            foot = [*point[:2], low[2]]
            axes.plot(*np.column_stack([point, foot]), color=style.INK, lw=0.6, ls=(0, (3, 2)), zorder=7)
            axes.plot(*point[:, None], **style.HOME)
            keys.append(style.key(**style.HOME, label="home"))
        words = {"handles": keys, "ncols": 2 if len(keys) == 4 else 3, "columnspacing": 1.2}
        if ax is None:
            figure.legend(**words, loc="lower center")
        else:
            axes.legend(**words, loc="upper center", bbox_to_anchor=(0.5, 0.0))
    return figure


def _dense(line: Floats, step: float) -> Floats:
    """Return a line with points no farther apart than a step."""
    counts = np.maximum(np.ceil(np.linalg.norm(np.diff(line, axis=0), axis=1) / step), 1.0).astype(int)
    parts = [a + np.arange(n)[:, None] / n * (b - a) for a, b, n in zip(line[:-1], line[1:], counts, strict=True)]
    return np.concatenate([*parts, line[-1:]])


def _inside(surface: WorkspaceSurface, lines: Sequence[Floats]) -> dict[bool, list[Floats]]:
    """Return the parts of lines inside a closed surface, and those outside.

    A point is inside where a ray from it, in a direction of no edge, passes the triangles of the surface an odd number
    of times.
    """
    parts: dict[bool, list[Floats]] = {True: [], False: []}
    quads = surface.points[surface.faces] @ RAY
    triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    low, high = triangles[..., :2].min(axis=1), triangles[..., :2].max(axis=1)
    for line in lines:
        inside = np.array([_passed(triangles, low, high, point) % 2 == 1 for point in line @ RAY])
        for first, last in style.stretches(inside):
            parts[bool(inside[first])].append(line[first : last + 1])
    return parts


def _passed(triangles: Floats, low: Floats, high: Floats, point: Floats) -> int:
    """Return how many triangles (n, 3, 3), within low and high (n, 2), lie above a point, along the last coordinate."""
    near = triangles[((low <= point[:2]) & (point[:2] <= high)).all(axis=1)]
    flat, heights = near[..., :2] - point[:2], near[..., 2] - point[2]
    ahead, after = np.roll(flat, -1, axis=1), np.roll(flat, -2, axis=1)
    weights = ahead[..., 0] * after[..., 1] - ahead[..., 1] * after[..., 0]
    over = (weights > 0.0).all(axis=1) | (weights < 0.0).all(axis=1)
    return int(np.sum((weights * heights).sum(axis=1)[over] / weights.sum(axis=1)[over] > 0.0))
