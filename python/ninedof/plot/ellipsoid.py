"""Fig. 4: the unit sphere of leg rates and its images under the Jacobian, which are ellipsoids."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib import patheffects
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # type: ignore[import-untyped]
from numpy.typing import ArrayLike

from ninedof.plot import scene, style
from ninedof.plot.arguments import sizes, things
from ninedof.support.arguments import text
from ninedof.support.arrays import Floats

ELEVATION, AZIMUTH = 22.0, -58.0  # degrees: no axis is much foreshortened
EYE = scene.towards_eye(ELEVATION, AZIMUTH)
ACROSS = np.cross([0.0, 0.0, 1.0], EYE) / np.linalg.norm(np.cross([0.0, 0.0, 1.0], EYE))
SCREEN = np.stack([ACROSS, np.cross(EYE, ACROSS)])  # rows: to the right and up in the picture

MOST_PANELS = 4
ROOM = 1.15  # half a panel, over the largest semi-axis
CUT = 0.92  # of half a panel: drawn length of an infinite semi-axis


@dataclass(frozen=True, eq=False)
class EllipsoidPanel:
    """One ellipsoid in space, as `velocity_ellipsoid` and `force_ellipsoid` return it."""

    title: str
    directions: ArrayLike
    """Columns: the axes, shape (3, 3)."""
    semi_axes: ArrayLike
    """Lengths >= 0 in the order of the columns, shape (3,); an infinite one ends at the edge."""
    note: str = ""
    """A second line, such as the symbol and its unit."""

    def __post_init__(self) -> None:
        """Check the texts; the axes are looked at where they are drawn."""
        text("title", self.title)
        text("note", self.note)


def ellipsoids(
    panels: Sequence[EllipsoidPanel],
    source: str = "leg rates",
    source_note: str = "all nine, of norm 1 at most",
    mapping: str = "J'",
) -> Figure:
    """Return a figure of the unit sphere and, at the same scale, its images.

    Parameters
    ----------
    panels : sequence of EllipsoidPanel
        One to four. The dashed circle in each is the unit sphere.
    source, source_note : str
        Name and description of the unit sphere.
    mapping : str
        Name of the map, written over the arrow.

    Raises
    ------
    ValueError
        If there are no panels, too many, or an ellipsoid has a wrong shape, NaN, or a negative semi-axis.

    Examples
    --------
    >>> import ninedof as nd
    >>> from ninedof.plot.ellipsoid import EllipsoidPanel, ellipsoids
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> c = nd.Configuration.neutral(zp=3.9828, zs=2.4432)
    >>> figure = ellipsoids([EllipsoidPanel("velocity", *nd.velocity_ellipsoid(g, c), note="ṗ")])

    """
    shapes = [
        sizes("panels", (panel.directions, panel.semi_axes))
        for panel in things("panels", panels, EllipsoidPanel, MOST_PANELS)
    ]
    for name, words in (("source", source), ("source_note", source_note), ("mapping", mapping)):
        text(name, words)
    finite = [float(a) for _, semi_axes in shapes for a in semi_axes if np.isfinite(a)]
    half = ROOM * max([1.0, *finite])
    count = len(panels) + 1
    share = 1.0 / count
    unit = EllipsoidPanel(source, np.eye(3), np.ones(3), source_note)
    with style.settings():
        width = style.TWO_COLUMNS if count > 2 else 1.5 * style.ONE_COLUMN
        figure = style.new_figure(width, 0.6 + 0.95 * width / count)
        for k, panel in enumerate([unit, *panels]):
            axes = figure.add_axes((k * share, 0.09, share, 0.74), projection="3d")
            _space(axes, half)
            directions, semi_axes = shapes[k - 1] if k else (np.eye(3), np.ones(3))
            _body(axes, directions, semi_axes, half, style.SERIES[(0, 2, 1, 3, 2)[k]])
            if k:
                outline = SCREEN.T @ _circle()
                axes.plot(*outline, color=style.SERIES[0], lw=0.9, ls=(0, (4, 3)), zorder=5)
            middle = (k + 0.5) * share
            figure.text(middle, 0.925, panel.title, ha="center", size=style.TITLE_SIZE, weight="bold")
            figure.text(middle, 0.87, panel.note, ha="center", size=style.SMALL_SIZE, color=style.MUTED)
            words = (
                ("semi-axes\n" if count > 4 else "semi-axes ") + "  ".join(map(_number, semi_axes))
                if k
                else "radius 1, dashed"
            )
            figure.text(middle, 0.02, words, ha="center", size=style.SMALL_SIZE)
        _arrow(figure, share, mapping)
    return figure


def _number(value: float) -> str:
    return "∞" if np.isinf(value) else f"{value:#.3g}" if value else "0"


def _circle() -> Floats:
    angle = np.linspace(0.0, 2.0 * np.pi, 181)
    return np.stack([np.cos(angle), np.sin(angle)])


def _space(axes: Any, half: float) -> None:
    """Set equal scale and the view; draw thin coordinate axes."""
    axes.set(xlim=(-half, half), ylim=(-half, half), zlim=(-half, half))
    axes.set_box_aspect((1, 1, 1), zoom=1.45)
    axes.set_proj_type("ortho")
    axes.view_init(elev=ELEVATION, azim=AZIMUTH)
    axes.computed_zorder = False
    axes.set_axis_off()
    axes.patch.set_visible(False)
    for name, along in zip("xyz", np.eye(3), strict=True):
        axes.plot(*np.outer(along, [-half, half]), color=style.MUTED, lw=0.7, zorder=1)
        text = axes.text(*(1.11 * half * along), name, size=style.SMALL_SIZE, color=style.MUTED, zorder=1)
        text.set(ha="center", va="center")


def _body(axes: Any, directions: Floats, semi_axes: Floats, half: float, colour: str) -> None:
    """Draw an ellipsoid: the filled outline, the principal ellipses, and the semi-axes that face the viewer."""
    infinite = np.isinf(semi_axes)
    shape = directions * np.where(infinite, CUT * half, semi_axes)
    # The projection of {shape @ u : |u| <= 1} is {SCREEN @ shape @ u}: an ellipse, also for a flat body.
    wide, lengths, _ = np.linalg.svd(SCREEN @ shape)
    outline = SCREEN.T @ (wide * lengths) @ _circle()
    axes.add_collection3d(Poly3DCollection([outline.T], facecolor=colour, alpha=0.16, lw=0, zorder=2))
    axes.plot(*outline, color=colour, lw=1.0, ls=_dashes(bool(infinite.any())), zorder=4)
    for i, j in ((0, 1), (1, 2), (2, 0)):
        ring = shape[:, [i, j]] @ _circle()
        axes.plot(*ring, color=colour, lw=0.6, alpha=0.4, ls=_dashes(bool(infinite[[i, j]].any())), zorder=3)
        axes.plot(*_in_front(ring, shape), color=colour, lw=1.1, ls=_dashes(bool(infinite[[i, j]].any())), zorder=6)
    rim = [patheffects.Stroke(linewidth=2.6, foreground="white"), patheffects.Normal()]
    for tip, cut in zip(shape.T * np.where(EYE @ shape >= 0.0, 1.0, -1.0)[:, None], infinite, strict=True):
        axes.plot(*np.outer(tip, [0, 1]), color=style.INK, lw=1.4, ls=_dashes(cut), path_effects=rim, zorder=7)
        if cut:
            beside = tip + 0.16 * half * SCREEN[int(abs(SCREEN[0] @ tip) > abs(SCREEN[1] @ tip))]
            text = axes.text(*beside, "∞", size=style.TITLE_SIZE + 1, color=style.INK, path_effects=rim, zorder=9)
            text.set(ha="center", va="center")
        else:
            axes.plot(*tip[:, None], "o", color=style.INK, ms=3.4, mec="white", mew=0.6, zorder=8)


def _dashes(cut: bool) -> Any:
    """Return the line style: dashes if the line continues beyond the figure."""
    return (0, (3, 1.5)) if cut else "-"


def _in_front(ring: Floats, shape: Floats) -> Floats:
    """Return the half of a closed curve on the ellipsoid that faces the viewer, NaN elsewhere."""
    lengths = np.linalg.norm(shape, axis=0)
    if lengths.min() <= 1e-9 * lengths.max():
        return ring  # flat: no part is hidden
    inverse = np.linalg.inv(shape)
    facing = EYE @ inverse.T @ inverse @ ring  # the normal at shape @ u is along shape^-T u
    return np.where(facing >= -1e-9 * np.abs(facing).max(), ring, np.nan)


def _arrow(figure: Figure, share: float, name: str) -> None:
    """Draw an arrow from the sphere to the first ellipsoid, with the name of the map."""
    ends = ((0.86 * share, 0.82), (1.14 * share, 0.82))
    options: dict[str, Any] = {"arrowstyle": "-|>", "mutation_scale": 9, "lw": 1.2, "color": style.INK}
    figure.add_artist(FancyArrowPatch(*ends, transform=figure.transFigure, **options))
    figure.text(share, 0.85, name, ha="center", size=style.TITLE_SIZE, weight="bold")
