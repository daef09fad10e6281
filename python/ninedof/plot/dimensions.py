"""Fig. 5 of the paper: the two plates from above, with the sides that define them."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from ninedof.plot import style
from ninedof.plot.plates import outlines
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import instance, text
from ninedof.support.arrays import Floats
from ninedof.support.units import amount

OUT = 0.17  # of the reach of a plate: how far its dimensions stand off


def figure_5(geometry: Geometry, unit: str = "") -> Figure:
    """Return Fig. 5: base and platform from above, with joints, axes and the sides a1, a2, b1, b2.

    Each plate fills its panel: the title of the platform has its scale to that of the base.

    Parameters
    ----------
    geometry : Geometry
        Of `Geometry.hexagonal`; of others the same distances are drawn: from the first external joint to the first and
        to the third internal joint.
    unit : str
        Of the lengths.

    Examples
    --------
    >>> import ninedof as nd
    >>> figure = nd.plot.figure_5(nd.Geometry.hexagonal(a1=1.5, a2=4.5, b1=2.2, b2=0.8))

    """
    instance("geometry", geometry, Geometry)
    text("unit", unit)
    with style.settings():
        figure = style.new_figure(style.TWO_COLUMNS, 3.5)
        plates = (
            ("base", geometry.base_external, geometry.base_internal, "a", style.BASE, 0.0),
            ("platform", geometry.platform_external, geometry.platform_internal, "b", style.PLATFORM, 0.5),
        )
        reach = _reach(geometry.base_external, geometry.base_internal)
        for name, external, internal, letter, colour, left in plates:
            axes = figure.add_axes((left + 0.01, 0.08, 0.48, 0.84))
            scale = reach / _reach(external, internal)
            axes.set_title(name + (f" (scale {scale:.3g} : 1)" if abs(scale - 1.0) > 0.01 else ""), loc="center")
            _plate(axes, np.asarray(external), np.asarray(internal), letter, colour, unit)
        keys = [
            style.key(style.EXTERNAL, marker="o", ms=6.5, mec="white", mew=0.5, ls="", label="external joint"),
            style.key(style.LOWER, marker="s", ms=4.0, mec="white", mew=0.5, ls="", label="internal joint of the base"),
            style.key(
                style.UPPER, marker="D", ms=3.4, mec="white", mew=0.5, ls="", label="internal joint of the platform"
            ),
        ]
        figure.legend(handles=keys, loc="lower center", ncols=3)
    return figure


def _reach(external: Floats, internal: Floats) -> float:
    """Return the largest coordinate of the joints of a plate: each is drawn at its own scale."""
    return float(np.abs(np.vstack([external, internal])[:, :2]).max())


def _plate(axes: Any, external: Floats, internal: Floats, letter: str, colour: str, unit: str) -> None:
    flat = np.vstack([external, internal])[:, :2]
    reach = _reach(external, internal)
    for outline in outlines(np.column_stack([flat, np.zeros(6)])):
        axes.add_patch(Polygon(outline[:, :2], fc=colour, alpha=0.28, ec=style.INK, lw=0.9))
    away = OUT * reach
    base = letter == "a"
    coincide = float(np.linalg.norm(flat[:, None] - flat[None], axis=-1)[~np.eye(6, dtype=bool)].min()) < 1e-6 * reach
    for k, point in enumerate(flat):
        mark: dict[str, Any] = {"marker": "o", "ms": 6.5, "color": style.EXTERNAL}
        if k >= 3:
            mark = (
                {"marker": "s", "ms": 4.0, "color": style.LOWER}
                if base
                else {"marker": "D", "ms": 3.4, "color": style.UPPER}
            )
        axes.plot(*point, ls="", mec="white", mew=0.5, zorder=5, **mark)
        hats = (r"\mathbf{r}", r"\hat{\mathbf{r}}") if base else (r"\mathbf{u}", r"\tilde{\mathbf{u}}")
        inward = (0.33 if coincide and k >= 3 else 0.13) * reach * point / np.linalg.norm(point)
        symbol = f"${hats[k // 3]}_{k % 3 + 1}$"
        axes.text(*(point - inward), symbol, ha="center", va="center", size=style.TEXT_SIZE, parse_math=True)
    for number, (start, end) in enumerate(((flat[3], flat[0]), (flat[0], flat[5])), start=1):
        _dimension(axes, start, end, f"{letter}{number}", away, reach, unit)
    tip = 0.3 * reach
    for name, along in zip(("x", "y") if base else ("x̃", "ỹ"), np.eye(2), strict=True):
        arrow = {"arrowstyle": "-|>", "color": style.MUTED, "lw": 0.8, "mutation_scale": 7, "shrinkA": 0, "shrinkB": 0}
        axes.annotate("", tuple(tip * along), (0.0, 0.0), arrowprops=arrow)
        axes.text(*(1.2 * tip * along), name, ha="center", va="center", size=style.TEXT_SIZE, color=style.MUTED)
    room = reach + 2.0 * away
    axes.set(xlim=(-room, room), ylim=(-room, room), aspect="equal")
    axes.set_axis_off()


def _dimension(axes: Any, start: Floats, end: Floats, name: str, away: float, reach: float, unit: str) -> None:
    """Draw a dimension line beside a side, outside the plate, with extension lines and its length."""
    length = float(np.linalg.norm(end - start))
    middle = 0.5 * (start + end)
    if length < 1e-6 * reach:  # the joints coincide
        out = middle / np.linalg.norm(middle)
        axes.text(
            *(middle + 2.1 * away * out * [1.0, 0.6]), f"{name} = 0", ha="center", va="center", size=style.TEXT_SIZE
        )
        return
    across = np.array([end[1] - start[1], start[0] - end[0]]) / length
    out = across * (1.0 if across @ middle > 0.0 else -1.0)
    for point in (start, end):
        axes.plot(*np.column_stack([point + 0.25 * away * out, point + 1.15 * away * out]), color=style.INK, lw=0.6)
    arrow = {"arrowstyle": "<|-|>", "color": style.INK, "lw": 0.7, "mutation_scale": 6, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", tuple(end + away * out), tuple(start + away * out), arrowprops=arrow)
    angle = float(np.degrees(np.arctan2(*(end - start)[::-1])))
    angle = (angle + 90.0) % 180.0 - 90.0
    words = f"{name} = {amount(f'{length:.4g}', unit)}"
    text = axes.text(*(middle + 1.6 * away * out), words, rotation=angle, rotation_mode="anchor", size=style.TEXT_SIZE)
    text.set(ha="center", va="center")
