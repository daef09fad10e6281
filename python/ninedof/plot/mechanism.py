"""The manipulator in space: plates, nine legs, joints, the internal point O."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib import patheffects
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from mpl_toolkits.mplot3d import Axes3D  # type: ignore[import-untyped]
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # type: ignore[import-untyped]
from numpy.typing import ArrayLike

from ninedof.plot import scene, style
from ninedof.plot.arguments import SMALLEST, number, robot, things
from ninedof.plot.arguments import lines as checked_lines
from ninedof.plot.arguments import numbers as checked_numbers
from ninedof.plot.leg_names import write_names
from ninedof.plot.plates import distinct, outlines
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import flag, instance, text
from ninedof.support.arrays import Floats

DASHES: dict[str, Any] = {"l": "-", "q": (0, (4.5, 0.9)), "r": (0, (1.6, 0.7))}  # told apart without colours


@dataclass(frozen=True)
class Mechanism:
    """One panel of `mechanisms`."""

    title: str
    geometry: Geometry
    configuration: Configuration
    condition_number: float | None = None
    note: str = ""
    """A second line of the caption, such as the sizes."""
    lines: Sequence[ArrayLike] = ()
    """The outline of a region of poses, lines of points (n, 3)."""

    def __post_init__(self) -> None:
        """Check the fields."""
        text("title", self.title)
        robot(self.geometry, self.configuration)
        if self.condition_number is not None:
            number("condition_number", self.condition_number, infinite=True)
        text("note", self.note)
        checked_lines("lines", self.lines, None, 3)


def draw_mechanism(
    axes3d: Any,
    geometry: Geometry,
    configuration: Configuration,
    title: str | None = None,
    unit: str = "",
    limits: scene.Limits | None = None,
    legend: bool = True,
    lines: Sequence[ArrayLike] = (),
    numbers: bool = True,
    bare: bool = False,
    clear_of: Sequence[ArrayLike] = (),
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
    lines : sequence of array_like, each of shape (n, 3)
        The outline of a region of poses.
    numbers : bool
        Whether to write the name of each leg on it.
    bare : bool
        Leave out the axes and their numbers.
    clear_of : sequence of array_like, each of shape (2, 3)
        Lines drawn by the caller, such as vectors, from which the names of legs keep away.

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
    instance("axes3d", axes3d, Axes3D)
    robot(geometry, configuration)
    text("title", "" if title is None else title)
    text("unit", unit)
    if limits is not None:
        half, low, high = limits = tuple(checked_numbers("limits", limits, 3).tolist())
        if not (half >= SMALLEST and high - low >= SMALLEST):
            raise ValueError(f"limits: got {limits}, expected a half width above 0 and the lowest z before the highest")
    for name, value in (("legend", legend), ("numbers", numbers), ("bare", bare)):
        flag(name, value)
    points = all_points(geometry, configuration)
    base, platform, o = points[:6], points[6:12], points[12]

    outline = checked_lines("lines", lines, None, 3)
    scene.frame(axes3d, unit, limits if limits is not None else scene.limits(np.concatenate([points, *outline])))
    _plate(axes3d, base, style.BASE, alpha=0.88, zorder=1)
    top = max(float(platform[:, 2].max()), float(o[2]))
    if bare:
        axes3d.set_axis_off()
        axes3d.texts[0].remove()  # the name of z
    else:
        axes3d.plot([0, 0], [0, 0], [0, top], color=style.MUTED, lw=0.6, ls=(0, (5, 4)), zorder=2)
    for line in outline:
        axes3d.plot(*line.T, color=style.REGION, lw=0.8, zorder=2)  # behind legs and platform
    legs = [("l", *ends) for ends in zip(base[:3], platform[:3], strict=True)]
    legs += [("q", o, end) for end in platform[3:]]
    legs += [("r", start, o) for start in base[3:]]
    _legs(axes3d, legs)
    _plate(axes3d, platform, style.PLATFORM, alpha=0.72, zorder=20)
    joints = np.vstack([distinct(base), distinct(platform)])
    axes3d.plot(*joints.T, "o", color=style.INK, ms=3.2, mec="white", mew=0.5, zorder=21)
    axes3d.plot(*o[:, None], "o", color="white", ms=4.6, mec=style.INK, mew=1.1, zorder=22)
    others = checked_lines("clear_of", clear_of, 2, 3)
    write_names(axes3d, legs if numbers else [], o, 0.05 * float(np.ptp(axes3d.get_xlim())), others)
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
    things("panels", panels, Mechanism)
    text("unit", unit)
    every = [np.asarray(line, dtype=np.float64) for panel in panels for line in panel.lines]
    limits = scene.limits(np.vstack([*(all_points(p.geometry, p.configuration) for p in panels), *every]))
    half, low, high = limits
    corners = np.array([-half, -half, low]), np.array([half, half, high])
    single = len(panels) == 1
    with style.settings():
        share = 1.0 / len(panels)
        words, keys = 0.52, 0.52 if single or every else 0.36  # inches for captions above, keys below
        width = (1.3 if every else 1.0) * style.ONE_COLUMN if single else style.TWO_COLUMNS
        figure = style.new_figure(width, words + keys + scene.height(*corners, width * share))
        height = float(figure.get_size_inches()[1])
        for k, panel in enumerate(panels):
            axes = figure.add_axes((0.0, 0.0, 1.0, 1.0), projection="3d")
            draw_mechanism(
                axes, panel.geometry, panel.configuration, None, unit, limits, legend=False, lines=panel.lines
            )
            scene.fit(axes, *corners, (k * share, keys / height, share, 1.0 - (words + keys) / height))
            kappa = panel.condition_number
            lines = [panel.title, "" if kappa is None else f"condition number {kappa:.4f}", panel.note]
            for line, down, size in zip(lines, (0.16, 0.3, 0.43), (8.5, 8.0, 7.0), strict=True):
                weight = "bold" if down < 0.2 else "normal"
                caption = figure.text((k + 0.5) * share, 1.0 - down / height, line, size=size, weight=weight)
                caption.set(ha="center", va="baseline", color=style.MUTED if down > 0.4 else style.INK)
        names = _keys()
        if every:
            names.append(style.key(style.REGION, lw=0.8, label="region of poses"))
        columns = 3 if single else 4 if every else 6
        figure.legend(handles=names, loc="lower center", bbox_to_anchor=(0.5, 0.0), ncols=columns, **_LEGEND)
    return figure


_LEGEND: dict[str, Any] = {"fontsize": style.SMALL_SIZE, "frameon": False, "handlelength": 1.5, "columnspacing": 1.2}


def _keys() -> list[Any]:
    return [
        style.key(style.EXTERNAL, lw=2.0, label="external legs l"),
        style.key(style.UPPER, lw=1.6, ls=DASHES["q"], label="upper internal q"),
        style.key(style.LOWER, lw=1.6, ls=DASHES["r"], label="lower internal r"),
        Patch(color=style.BASE, label="base"),
        Patch(color=style.PLATFORM, label="platform"),
        style.key("white", marker="o", ms=4.6, mec=style.INK, mew=1.1, ls="", label="internal point O"),
    ]


def all_points(geometry: Geometry, configuration: Configuration) -> Floats:
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
        width = 2.0 if kind == "l" else 1.6
        rim = [patheffects.Stroke(linewidth=width + 1.2, foreground="white"), patheffects.Normal()]
        ends = np.column_stack([start, end])
        options = {"color": style.LEG_COLOURS[kind], "ls": DASHES[kind], "lw": width}
        axes.plot(*ends, zorder=3 + order, path_effects=rim, dash_capstyle="butt", **options)
