"""Figs. 1 and 5 of the paper: the architecture, and the two plates from above with the sides that define them."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Polygon
from mpl_toolkits.mplot3d import proj3d  # type: ignore[import-untyped]

from ninedof.plot import style
from ninedof.plot.space import scene
from ninedof.plot.space.mechanism import Robot, draw
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.robot.plates import outlines
from ninedof.support.arrays import Floats
from ninedof.support.units import amount

LETTERS = ("A", r"\hat{A}", "B", r"\tilde{B}")
SMALL = 0.3  # inches, for the words below
LEFT = -scene.VIEW.right
OUT = 0.17  # of the reach of a plate: how far its dimensions stand off
EXTERNAL: dict[str, Any] = {"marker": "o", "ms": 6.5, "color": style.EXTERNAL, "mec": "white", "mew": 0.5, "ls": ""}
BASE: dict[str, Any] = EXTERNAL | {"marker": "s", "ms": 4.0, "color": style.LOWER}
PLATFORM: dict[str, Any] = EXTERNAL | {"marker": "D", "ms": 3.4, "color": style.UPPER}
CENTRED: dict[str, Any] = {"ha": "center", "va": "center", "size": style.TEXT_SIZE}


def figure_1(geometry: Geometry, configuration: Configuration, ax: Any = None) -> Figure:
    """Return Fig. 1: the architecture with its joints, legs, frames and vectors.

    Parameters
    ----------
    geometry : Geometry
    configuration : Configuration
        A single one. Away from the neutral pose the vectors p and s part.
    ax : mpl_toolkits.mplot3d.Axes3D, optional
        Axes to draw on; those of a new figure by default.

    Examples
    --------
    >>> import ninedof as nd
    >>> from ninedof.paper.figures import figure_1
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> figure = figure_1(g, nd.Configuration([0.6, 0.3, 4.0], internal_point=[0, 0, 2]))

    """
    robot = Robot("", geometry, configuration)
    low, high = robot.corners()
    half, p, s = float(high[0]), configuration.position, configuration.internal_point
    width = 1.3 * style.ONE_COLUMN
    tall = SMALL + scene.height(low, high, width)
    with style.panel(ax, width, tall, (0.0, 0.0, 1.0, 1.0), projection="3d") as (figure, axes):
        scene.box(axes, ("x", "y", ""), "", low, high)
        axes.set_axis_off()
        if ax is None:
            scene.fit(axes, low, high, (0.0, SMALL / tall, 1.0, 1.0 - SMALL / tall))
        vectors = [np.stack([np.zeros(3), end]) for end in (p, s)]
        draw(axes, robot, clear_of=vectors)
        length = 0.16 * half
        frames = (("xyz", np.zeros(3), np.eye(3)), (("x̃", "ỹ", "z̃"), p, configuration.rotation))
        for names, origin, turn in frames:
            for name, along in zip(names, turn.T, strict=True):
                up = name[0] == "z"
                _arrow(axes, origin, origin + 1.4 * length * along, style.MUTED, 0.8)
                at = origin + length * (1.2 * along + 0.5 * LEFT if up else 1.8 * along)
                _word(axes, at, name, style.MUTED)
        for start, end in vectors:
            _arrow(axes, start, end, style.INK, 1.2)
        _word(axes, 0.5 * p - 0.6 * length * LEFT, r"$\mathbf{p}$", style.INK, style.TITLE_SIZE)
        _word(axes, 0.55 * s + 0.7 * length * LEFT, r"$\mathbf{s}$", style.INK, style.TITLE_SIZE)
        _joints(axes, robot.points(), 0.11 * half)
        if ax is None:
            words = "A on the base, B on the platform: joints of external legs; with a hat or tilde, of internal legs"
            figure.text(0.5, 0.25 * SMALL / tall, words, ha="center", size=style.SMALL_SIZE - 0.5)
    return figure


def _joints(axes: Any, points: Floats, away: float) -> None:
    """Name the joints outward of their plates; of two that coincide, both names."""
    words = [f"{LETTERS[k // 3]}_{k % 3 + 1}" for k in range(12)]
    size = float(np.ptp(points[:12], axis=0).max())
    labelled: set[int] = set()
    for k in range(12):
        same = [j for j in range(k, 12) if np.linalg.norm(points[j] - points[k]) < 1e-9 * size]
        if k not in labelled:
            plate = points[:6] if k < 6 else points[6:12]
            out = points[k] - plate.mean(axis=0)
            flat = float(np.linalg.norm(scene.VIEW.seen(out)))
            out = out / max(flat, 0.35 * float(np.linalg.norm(out)))
            text = "$" + ",".join(words[j] for j in same) + "$"
            _word(axes, points[k] + away * (1.0 + 0.5 * (len(same) > 1)) * out, text, style.INK)
        labelled.update(same)


def _flat(axes: Any, point: Floats) -> tuple[float, float]:
    x, y, _ = proj3d.proj_transform(*np.asarray(point, dtype=np.float64), axes.get_proj())
    return float(x), float(y)


def _arrow(axes: Any, start: Floats, end: Floats, colour: str, width: float) -> None:
    arrow = axes.annotate("", _flat(axes, end), _flat(axes, start), arrowprops=style.arrow(colour, width), zorder=25)
    arrow.arrow_patch.set_path_effects([style.rim(width + 1.0)])  # seen on the dark plate too


def _word(axes: Any, at: Floats, text: str, colour: str, size: float = style.SMALL_SIZE) -> None:
    looks: dict[str, Any] = {"size": size, "color": colour, "zorder": 31, "path_effects": scene.HALO}
    axes.annotate(text, _flat(axes, at), parse_math=True, ha="center", va="center", **looks)


def figure_5(geometry: Geometry, unit: str = "", figure: Figure | None = None) -> Figure:
    """Return Fig. 5: base and platform from above, with joints, axes and the sides a1, a2, b1, b2.

    Each plate fills its panel: the title of the platform has its scale to that of the base.

    Parameters
    ----------
    geometry : Geometry
        Of `Geometry.hexagonal`; of others the same distances are drawn: from the first external joint to the first and
        to the third internal joint.
    unit : str
        Of the lengths.
    figure : matplotlib.figure.Figure or SubFigure, optional
        To draw in; a new one by default.

    Examples
    --------
    >>> import ninedof as nd
    >>> from ninedof.paper.figures import figure_5
    >>> figure = figure_5(nd.Geometry.hexagonal(a1=1.5, a2=4.5, b1=2.2, b2=0.8))

    """
    base = np.vstack([geometry.base_external, geometry.base_internal])[:, :2]
    platform = np.vstack([geometry.platform_external, geometry.platform_internal])[:, :2]
    scale = float(np.abs(base).max() / np.abs(platform).max())
    with style.page(figure, style.TWO_COLUMNS, 3.5) as figure:
        left, right = (figure.add_axes((x, 0.08, 0.48, 0.84)) for x in (0.01, 0.51))
        left.set_title("base", loc="center")
        right.set_title("platform" + (f" (scale {scale:.3g} : 1)" if abs(scale - 1.0) > 0.01 else ""), loc="center")
        _plate(left, base, BASE, style.BASE, (r"\mathbf{r}", r"\hat{\mathbf{r}}"), ("x", "y"))
        _plate(right, platform, PLATFORM, style.PLATFORM, (r"\mathbf{u}", r"\tilde{\mathbf{u}}"), ("x̃", "ỹ"))
        for axes, letter, flat in ((left, "a", base), (right, "b", platform)):
            _dimension(axes, flat[3], flat[0], f"{letter}1", np.abs(flat).max(), unit)
            _dimension(axes, flat[0], flat[5], f"{letter}2", np.abs(flat).max(), unit)
        keys = [
            style.key(**EXTERNAL, label="external joint"),
            style.key(**BASE, label="internal joint of the base"),
            style.key(**PLATFORM, label="internal joint of the platform"),
        ]
        figure.legend(handles=keys, loc="lower center", ncols=3)
    return figure


def _plate(
    axes: Any, flat: Floats, internal: dict[str, Any], colour: str, symbols: tuple[str, str], names: tuple[str, str]
) -> None:
    """Draw a plate with its joints, the symbols of their vectors, and the axes x and y."""
    reach = float(np.abs(flat).max())
    for outline in outlines(np.column_stack([flat, np.zeros(6)])):
        axes.add_patch(Polygon(outline[:, :2], fc=colour, alpha=0.28, ec=style.INK, lw=0.9))
    coincide = float(np.linalg.norm(flat[:, None] - flat[None], axis=-1)[~np.eye(6, dtype=bool)].min()) < 1e-6 * reach
    for k, point in enumerate(flat):
        axes.plot(*point, zorder=5, **(EXTERNAL if k < 3 else internal))
        inward = (0.33 if coincide and k >= 3 else 0.13) * reach * point / np.linalg.norm(point)
        axes.text(*(point - inward), f"${symbols[k // 3]}_{k % 3 + 1}$", parse_math=True, **CENTRED)
    tip = 0.3 * reach
    for name, along in zip(names, np.eye(2), strict=True):
        axes.annotate("", tuple(tip * along), (0.0, 0.0), arrowprops=style.arrow(style.MUTED, 0.8))
        axes.text(*(1.2 * tip * along), name, color=style.MUTED, **CENTRED)
    room = (1.0 + 2.0 * OUT) * reach
    axes.set(xlim=(-room, room), ylim=(-room, room), aspect="equal")
    axes.set_axis_off()


def _dimension(axes: Any, start: Floats, end: Floats, name: str, reach: float, unit: str) -> None:
    """Draw a dimension line beside a side, outside the plate, with extension lines and its length."""
    length, away = float(np.linalg.norm(end - start)), OUT * reach
    middle = 0.5 * (start + end)
    if length < 1e-6 * reach:  # the joints coincide
        out = middle / np.linalg.norm(middle)
        axes.text(*(middle + 2.1 * away * out * [1.0, 0.6]), f"{name} = 0", **CENTRED)
        return
    across = np.array([end[1] - start[1], start[0] - end[0]]) / length
    out = away * across * (1.0 if across @ middle > 0.0 else -1.0)
    for point in (start, end):
        axes.plot(*np.column_stack([point + 0.25 * out, point + 1.15 * out]), color=style.INK, lw=0.6)
    axes.annotate("", tuple(end + out), tuple(start + out), arrowprops=style.arrow(style.INK, 0.7, "<|-|>"))
    angle = (float(np.degrees(np.arctan2(*(end - start)[::-1]))) + 90.0) % 180.0 - 90.0
    words = f"{name} = {amount(f'{length:.4g}', unit)}"
    axes.text(*(middle + 1.6 * out), words, rotation=angle, rotation_mode="anchor", **CENTRED)
