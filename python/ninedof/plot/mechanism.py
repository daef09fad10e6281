"""The manipulator in space: plates, nine legs, joints, the internal point O."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib import patheffects
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # type: ignore[import-untyped]

from ninedof.plot import scene, style
from ninedof.plot.plates import distinct, outlines
from ninedof.support.arrays import Floats

if TYPE_CHECKING:
    from ninedof.robot.configuration import Configuration
    from ninedof.robot.geometry import Geometry


@dataclass(frozen=True)
class Mechanism:
    """One panel of `mechanisms`."""

    title: str
    geometry: Geometry
    configuration: Configuration
    condition_number: float | None = None
    note: str = ""
    """A second line of the caption, such as the sizes."""


def draw_mechanism(
    axes3d: Any,
    geometry: Geometry,
    configuration: Configuration,
    title: str | None = None,
    unit: str = "",
    limits: scene.Limits | None = None,
    legend: bool = True,
) -> None:
    """Draw one manipulator on 3-D axes, at equal scale in all directions.

    Parameters
    ----------
    axes3d : mpl_toolkits.mplot3d.Axes3D
    geometry : Geometry
    configuration : Configuration
        A single one.
    title : str, optional
    unit : str
        Of the lengths, for the axis labels; none by default.
    limits : (float, float, float), optional
        Half width in x and y, lowest and highest z; those of the mechanism by default. The same limits give several
        axes one scale.
    legend : bool
        Whether to add a legend under the axes.

    Raises
    ------
    ValueError
        If the configuration is a stack.

    Examples
    --------
    >>> import ninedof as nd
    >>> from matplotlib.figure import Figure
    >>> from ninedof import plot
    >>> axes = Figure().add_subplot(projection="3d")
    >>> design = nd.Geometry.hexagonal(a1=0.0, a2=6.0, b1=3.0, b2=0.0)
    >>> plot.draw_mechanism(axes, design, nd.Configuration.neutral(zp=5.0, zs=3.2), unit="m")

    """
    if configuration.shape != ():
        raise ValueError(f"configuration: got a stack of shape {configuration.shape}, expected a single one")
    points = _points(geometry, configuration)
    base, platform, o = points[:6], points[6:12], points[12]

    scene.frame(axes3d, unit, limits or scene.limits(points))
    _plate(axes3d, base, style.BASE, alpha=0.88, zorder=1)
    top = max(float(platform[:, 2].max()), float(o[2]))
    axes3d.plot([0, 0], [0, 0], [0, top], color=style.MUTED, lw=0.8, ls=(0, (5, 4)), zorder=2)
    legs = [("l", *ends) for ends in zip(base[:3], platform[:3], strict=True)]
    legs += [("q", o, end) for end in platform[3:]]
    legs += [("r", start, o) for start in base[3:]]
    _legs(axes3d, legs)
    _plate(axes3d, platform, style.PLATFORM, alpha=0.72, zorder=20)
    joints = np.vstack([distinct(base), distinct(platform)])
    axes3d.plot(*joints.T, "o", color=style.INK, ms=4.2, mec="white", mew=0.6, zorder=21)
    axes3d.plot(*o[:, None], "o", color="white", ms=6.5, mec=style.INK, mew=1.4, zorder=22)
    halo = [patheffects.withStroke(linewidth=2.5, foreground="white")]
    beside = o + 0.06 * float(np.ptp(axes3d.get_xlim())) * scene.to_the_left()
    text = axes3d.text(
        *beside, "O", size=style.TITLE_SIZE, weight="bold", color=style.INK, path_effects=halo, zorder=23
    )
    text.set(ha="center", va="center")
    if title:
        axes3d.set_title(title, loc="center", size=style.TITLE_SIZE, weight="bold", color=style.INK, pad=0)
    if legend:
        axes3d.legend(handles=_keys(), loc="upper center", bbox_to_anchor=(0.5, 0.0), ncols=3, **_LEGEND)


def mechanisms(panels: Sequence[Mechanism], unit: str = "") -> Figure:
    """Return a figure of manipulators side by side, all at one scale.

    Parameters
    ----------
    panels : sequence of Mechanism
        One to about four, from left to right.
    unit : str
        Of the lengths.

    Examples
    --------
    >>> import ninedof as nd
    >>> from ninedof import plot
    >>> design = nd.Geometry.hexagonal(a1=0.0, a2=6.0, b1=3.0, b2=0.0)
    >>> stand = [nd.Configuration.neutral(zp=5.0, zs=zs) for zs in (2.0, 3.2)]
    >>> figure = plot.mechanisms([plot.Mechanism(f"zs {c.internal_point[2]}", design, c) for c in stand])

    """
    if not panels:
        raise ValueError("panels: got none, expected at least one Mechanism")
    limits = scene.limits(np.vstack([_points(panel.geometry, panel.configuration) for panel in panels]))
    with style.settings():
        figure = style.new_figure(width=max(4.0 * len(panels), 5.4), height=5.0)
        share = 1.0 / len(panels)
        for k, panel in enumerate(panels):
            axes = figure.add_axes(((k - 0.035) * share, 0.19, share, 0.77), projection="3d")
            draw_mechanism(axes, panel.geometry, panel.configuration, unit=unit, limits=limits, legend=False)
            middle = (k + 0.5) * share
            figure.text(middle, 0.925, panel.title, ha="center", size=style.TITLE_SIZE + 1, weight="bold")
            if panel.condition_number is not None:
                caption = f"condition number {panel.condition_number:.4f}"
                figure.text(middle, 0.165, caption, ha="center", size=style.TITLE_SIZE)
            figure.text(middle, 0.125, panel.note, ha="center", size=style.SMALL_SIZE, color=style.MUTED)
        figure.legend(
            handles=_keys(),
            loc="lower center",
            bbox_to_anchor=(0.5, 0.01),
            ncols=6 if len(panels) > 1 else 3,
            **_LEGEND,
        )
    return figure


_LEGEND: dict[str, Any] = {"fontsize": style.SMALL_SIZE, "frameon": False, "handlelength": 1.6, "columnspacing": 1.6}


def _keys() -> list[Any]:
    return [
        style.key(style.EXTERNAL, lw=2.6, label="external legs l"),
        style.key(style.UPPER, lw=2.2, label="upper internal q"),
        style.key(style.LOWER, lw=2.2, label="lower internal r"),
        Patch(color=style.BASE, label="base"),
        Patch(color=style.PLATFORM, label="platform"),
        style.key("white", marker="o", ms=6, mec=style.INK, mew=1.4, ls="", label="internal point O"),
    ]


def _points(geometry: Geometry, configuration: Configuration) -> Floats:
    """Return base joints, platform joints in the base frame (external before internal), and O: shape (13, 3)."""
    carried = np.vstack([geometry.platform_external, geometry.platform_internal])
    placed = configuration.position + carried @ configuration.rotation.T
    return np.vstack([geometry.base_external, geometry.base_internal, placed, configuration.internal_point])


def _plate(axes: Any, joints: Floats, colour: str, alpha: float, zorder: int) -> None:
    sides = outlines(joints)
    clear = 1.0 - alpha if len(sides) == 1 else 0.5 * (1.0 - alpha)  # two faces of a solid overlap
    faces = Poly3DCollection(sides, facecolor=colour, alpha=1.0 - clear, zorder=zorder)
    faces.set_edgecolor(style.INK)
    faces.set_linewidth(0.9 if len(sides) == 1 else 0.6)
    axes.add_collection3d(faces)


def _legs(axes: Any, legs: list[tuple[str, Floats, Floats]]) -> None:
    """Draw the legs from the back to the front, with a white rim where one crosses another."""
    eye = scene.towards_eye()
    for order, (kind, start, end) in enumerate(sorted(legs, key=lambda leg: float((leg[1] + leg[2]) @ eye))):
        width = 2.8 if kind == "l" else 2.3
        rim = [patheffects.Stroke(linewidth=width + 1.6, foreground="white"), patheffects.Normal()]
        ends = np.column_stack([start, end])
        axes.plot(*ends, color=style.LEG_COLOURS[kind], lw=width, zorder=3 + order, path_effects=rim)
