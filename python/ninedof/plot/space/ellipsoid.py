"""The unit sphere of leg rates and its images under the Jacobian, which are ellipsoids."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # type: ignore[import-untyped]
from numpy.typing import ArrayLike

from ninedof.plot import style
from ninedof.plot.space.scene import View
from ninedof.support.arrays import Floats, as_floats
from ninedof.support.placing import toward

VIEW = View(22.0, -58.0)  # no axis is much foreshortened
MOST_PANELS = 4
ROOM = 1.15  # half a panel, over the largest semi-axis
CUT = 0.92  # of half a panel: drawn length of an infinite semi-axis
RIM = [style.rim(2.6)]
CIRCLE = toward(np.linspace(0.0, 2.0 * np.pi, 181)).T
COLOURS = tuple(style.SERIES[k] for k in (0, 2, 1, 3, 2))

Axes = tuple["ArrayLike", "ArrayLike"]
"""Directions (3, 3) in columns and semi-axes (3,) in their order, each at least 0 and infinite ones too."""


def ellipsoids(
    panels: Mapping[str, Axes],
    source: str = "leg rates\nall nine, of norm 1 at most",
    mapping: str = "J'",
    figure: Figure | None = None,
) -> Figure:
    r"""Return a figure of the unit sphere and, at the same scale, its images.

    Parameters
    ----------
    panels : mapping of str to (directions, semi_axes)
        One to four by title, as `velocity_ellipsoid` and `force_ellipsoid` return them. A second line of a title is
        small, such as the symbol and its unit. An infinite semi-axis ends at the edge; the dashed circle in each is the
        unit sphere.
    source : str
        Title of the unit sphere.
    mapping : str
        Name of the map, written over the arrow.
    figure : matplotlib.figure.Figure or SubFigure, optional
        To draw in; a new one by default.

    Raises
    ------
    ValueError
        If there are no panels, too many, or an ellipsoid has a wrong shape, NaN, or a negative semi-axis.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> c = nd.Configuration.neutral(zp=3.9828, zs=2.4432)
    >>> figure = nd.plot.ellipsoids({"velocity\nṗ": nd.velocity_ellipsoid(g, c)})

    """
    style.counted("panels", panels, MOST_PANELS)
    shapes = {source: (np.eye(3), np.ones(3)), **{title: _checked(axes) for title, axes in panels.items()}}
    lengths = np.concatenate([semi_axes for _, semi_axes in shapes.values()])
    half = ROOM * lengths[np.isfinite(lengths)].max()
    count = len(shapes)
    share = 1.0 / count
    width = style.TWO_COLUMNS if count > 2 else 1.5 * style.ONE_COLUMN
    with style.page(figure, width, 0.6 + 0.95 * width / count) as figure:
        for k, (title, (directions, semi_axes)) in enumerate(shapes.items()):
            axes = figure.add_axes((k * share, 0.09, share, 0.74), projection="3d")
            _space(axes, half)
            _body(axes, directions, semi_axes, half, COLOURS[k])
            words, middle = "radius 1, dashed", (k + 0.5) * share
            if k:
                axes.plot(*_disc(np.eye(2)), color=style.SERIES[0], lw=0.9, ls=(0, (4, 3)), zorder=5)
                words = "semi-axes" + (" " if count < 5 else "\n") + "  ".join(map(_number, semi_axes))
            first, _, note = title.partition("\n")
            figure.text(middle, 0.925, first, ha="center", size=style.TITLE_SIZE, weight="bold")
            figure.text(middle, 0.87, note, ha="center", size=style.SMALL_SIZE, color=style.MUTED)
            figure.text(middle, 0.02, words, ha="center", size=style.SMALL_SIZE)
        ends = ((0.86 * share, 0.82), (1.14 * share, 0.82))
        figure.add_artist(
            FancyArrowPatch(
                *ends, transform=figure.transSubfigure, arrowstyle="-|>", mutation_scale=9, lw=1.2, color=style.INK
            )
        )
        figure.text(share, 0.85, mapping, ha="center", size=style.TITLE_SIZE, weight="bold")
    return figure


def _checked(axes: Axes) -> tuple[Floats, Floats]:
    directions, semi_axes = as_floats("panels", axes[0], (3, 3)), as_floats("panels", axes[1], (3,))
    if not (np.isfinite(directions).all() and (semi_axes >= 0.0).all()):
        raise ValueError(f"panels: got semi-axes {semi_axes.tolist()}, expected numbers >= 0 with their directions")
    return directions, semi_axes


def _number(value: float) -> str:
    return "∞" if np.isinf(value) else f"{value:#.3g}" if value else "0"


def _disc(shape: Floats) -> Floats:
    """Return the image of the unit circle under a matrix (2, 2), in the plane of the picture."""
    return np.column_stack([VIEW.right, VIEW.up]) @ shape @ CIRCLE


def _space(axes: Any, half: float) -> None:
    """Set equal scale and the view; draw thin coordinate axes."""
    axes.set(xlim=(-half, half), ylim=(-half, half), zlim=(-half, half))
    axes.set_box_aspect((1, 1, 1), zoom=1.45)
    VIEW.turn(axes)
    axes.set_axis_off()
    for name, along in zip("xyz", np.eye(3), strict=True):
        axes.plot(*np.outer(along, [-half, half]), color=style.MUTED, lw=0.7, zorder=1)
        axes.text(
            *(1.11 * half * along), name, size=style.SMALL_SIZE, color=style.MUTED, ha="center", va="center", zorder=1
        )


def _body(axes: Any, directions: Floats, semi_axes: Floats, half: float, colour: str) -> None:
    """Draw an ellipsoid: the filled outline, the principal ellipses, and the semi-axes that face the viewer."""
    infinite = np.isinf(semi_axes)
    shape = directions * np.where(infinite, CUT * half, semi_axes)
    # The projection of {shape @ u : |u| <= 1} is an ellipse, also for a flat body.
    wide, lengths, _ = np.linalg.svd(VIEW.seen(shape.T).T)
    outline = _disc(wide * lengths)
    axes.add_collection3d(Poly3DCollection([outline.T], facecolor=colour, alpha=0.16, lw=0, zorder=2))
    axes.plot(*outline, color=colour, lw=1.0, ls=_dashes(infinite), zorder=4)
    for pair in ([0, 1], [1, 2], [2, 0]):
        ring, dashes = shape[:, pair] @ CIRCLE, _dashes(infinite[pair])
        axes.plot(*ring, color=colour, lw=0.6, alpha=0.4, ls=dashes, zorder=3)
        axes.plot(*_in_front(ring, shape), color=colour, lw=1.1, ls=dashes, zorder=6)
    for tip, cut in zip(shape.T * np.where(VIEW.eye @ shape >= 0.0, 1.0, -1.0)[:, None], infinite, strict=True):
        axes.plot(*np.outer(tip, [0, 1]), color=style.INK, lw=1.4, ls=_dashes(cut), path_effects=RIM, zorder=7)
        if cut:
            across, up = np.abs(VIEW.seen(tip))
            beside, options = tip + 0.16 * half * (VIEW.up if across > up else VIEW.right), {"path_effects": RIM}
            axes.text(*beside, "∞", size=style.TITLE_SIZE + 1, ha="center", va="center", zorder=9, **options)
        else:
            axes.plot(*tip[:, None], "o", color=style.INK, ms=3.4, mec="white", mew=0.6, zorder=8)


def _dashes(infinite: Any) -> Any:
    """Return the line style: dashes if the line continues beyond the figure."""
    return (0, (3, 1.5)) if np.any(infinite) else "-"


def _in_front(ring: Floats, shape: Floats) -> Floats:
    """Return the half of a closed curve on the ellipsoid that faces the viewer, NaN elsewhere."""
    lengths = np.linalg.norm(shape, axis=0)
    if lengths.min() <= 1e-9 * lengths.max():
        return ring  # flat: no part is hidden
    inverse = np.linalg.inv(shape)
    facing = VIEW.eye @ inverse.T @ inverse @ ring  # the normal at shape @ u is along shape^-T u
    return np.where(facing >= -1e-9 * np.abs(facing).max(), ring, np.nan)
