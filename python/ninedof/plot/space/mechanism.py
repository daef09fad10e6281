"""The manipulator in space: plates, nine legs, joints, the internal point O."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # type: ignore[import-untyped]
from numpy.typing import ArrayLike

from ninedof.plot import style
from ninedof.plot.space import scene
from ninedof.plot.space.leg_names import Leg, write_names
from ninedof.robot.configuration import Configuration, require_single
from ninedof.robot.geometry import LEGS, Geometry
from ninedof.robot.plates import distinct, outlines, points_of
from ninedof.support.arrays import Floats

if TYPE_CHECKING:
    from ninedof.design.tool import Tool

DASHES = {"l": "-", "q": (0, (4.5, 0.9)), "r": (0, (1.6, 0.7))}  # told apart without colours
WIDTHS = {"l": 2.0, "q": 1.6, "r": 1.6}
POINT_O = {"marker": "D", "color": style.INK, "ms": 4.2, "mec": "white", "mew": 0.7, "ls": ""}
"""A diamond: a ring beside the letter O would be read as a second one."""
TOOL = {"color": style.REGION, "lw": 1.6, "marker": "v", "ms": 5.0, "mec": "white", "mew": 0.5}
_LEGEND = {"handlelength": 1.5, "columnspacing": 1.2}


@dataclass(frozen=True, eq=False)
class Robot:
    """A design at one pose, to be drawn by `mechanism` and `mechanisms`."""

    title: str
    geometry: Geometry
    configuration: Configuration
    """A single one."""
    condition_number: float | None = None
    note: str = ""
    """A second line of the caption, such as the sizes."""
    lines: Sequence[ArrayLike] = ()
    """The outline of a region of poses, lines of points (n, 3)."""
    tool: Tool | None = None
    """Whose point and axes geometry and configuration are about; None without one."""

    def points(self) -> Floats:
        """Return base joints, platform joints in the base frame (external before internal), and O: shape (13, 3)."""
        require_single("configuration", self.configuration)
        return points_of(self.geometry, self.configuration)

    def corners(self) -> tuple[Floats, Floats]:
        """Return the corners of the box about it and the lines."""
        return scene.corners(np.vstack([self.points(), *map(np.asarray, self.lines), *self.tool_line()]))

    def tool_line(self) -> list[Floats]:
        """Return the line from the plate's origin to the tool's point, shape (2, 3); none without a tool."""
        plate = self.tool.plate(self.configuration) if self.tool else None
        return [] if plate is None else [np.array([plate.position, self.configuration.position])]


def mechanism(
    robot: Robot,
    unit: str = "",
    ax: Any = None,
    corners: tuple[ArrayLike, ArrayLike] | None = None,
    legend: bool = True,
) -> Figure:
    """Return a figure of one manipulator, at equal scale in all directions.

    Parameters
    ----------
    robot : Robot
    unit : str
        Of the lengths, for the axis labels; none by default.
    ax : mpl_toolkits.mplot3d.Axes3D, optional
        Axes to draw on. By default the figure is that of `mechanisms`.
    corners : (low, high), optional
        Ends of x, y and z, each of shape (3,); those of the mechanism by default. The same give several
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
    >>> design = nd.Geometry.hexagonal(a1=0.0, a2=6.0, b1=3.0, b2=0.0)
    >>> figure = nd.plot.mechanism(nd.plot.Robot("mine", design, nd.Configuration.neutral(zp=5.0, zs=3.2)), unit="m")

    """
    if ax is None:
        return mechanisms([robot], unit)
    low, high = robot.corners() if corners is None else map(np.asarray, corners)
    with style.settings():
        scene.box(ax, ("x", "y", "z"), unit, low, high)
        top = robot.points()[6:, 2].max()
        ax.plot([0, 0], [0, 0], [0, top], color=style.MUTED, lw=0.6, ls=(0, (5, 4)), zorder=2)
        draw(ax, robot)
        if robot.title:
            ax.set_title(robot.title, loc="center", pad=0)
        if legend:
            ax.legend(
                handles=_keys(bool(robot.tool)), loc="upper center", bbox_to_anchor=(0.5, 0.0), ncols=3, **_LEGEND
            )
    figure: Figure = ax.figure
    return figure


def mechanisms(robots: Sequence[Robot], unit: str = "", figure: Figure | None = None) -> Figure:
    """Return a figure of manipulators side by side, all at one scale.

    Parameters
    ----------
    robots : sequence of Robot
        One to about four, from left to right.
    unit : str
        Of the lengths.
    figure : matplotlib.figure.Figure or SubFigure, optional
        To draw in; a new one by default.

    Examples
    --------
    >>> import ninedof as nd
    >>> design = nd.Geometry.hexagonal(a1=0.0, a2=6.0, b1=3.0, b2=0.0)
    >>> stand = [nd.Configuration.neutral(zp=5.0, zs=zs) for zs in (2.0, 3.2)]
    >>> figure = nd.plot.mechanisms([nd.plot.Robot(f"zs {c.internal_point[2]}", design, c) for c in stand])

    """
    style.counted("robots", robots, 6)
    boxes = np.array([robot.corners() for robot in robots])
    low, high = boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)
    single, lines = len(robots) == 1, any(len(robot.lines) for robot in robots)
    share = 1.0 / len(robots)
    words, keys = 0.52, 0.52 if single or lines else 0.36  # inches for captions above, keys below
    width = (1.3 if lines else 1.0) * style.ONE_COLUMN if single else style.TWO_COLUMNS
    with style.page(figure, width, words + keys + scene.height(low, high, width * share)) as figure:
        tall = style.inches(figure)[1]
        for k, robot in enumerate(robots):
            axes = figure.add_axes((0.0, 0.0, 1.0, 1.0), projection="3d")
            mechanism(replace(robot, title=""), unit, axes, (low, high), False)
            scene.fit(axes, low, high, (k * share, keys / tall, share, 1.0 - (words + keys) / tall))
            middle, kappa = (k + 0.5) * share, robot.condition_number
            text = "" if kappa is None else f"condition number {kappa:.4f}"
            options: dict[str, Any] = {"ha": "center", "va": "baseline"}
            figure.text(middle, 1.0 - 0.16 / tall, robot.title, size=style.TITLE_SIZE, weight="bold", **options)
            figure.text(middle, 1.0 - 0.3 / tall, text, size=style.TEXT_SIZE, **options)
            figure.text(middle, 1.0 - 0.43 / tall, robot.note, size=style.SMALL_SIZE, color=style.MUTED, **options)
        names = (
            _keys(any(robot.tool for robot in robots))
            + [style.key(style.REGION, lw=0.8, label="region of poses")] * lines
        )
        columns = 3 if single else 4 if lines else 6
        figure.legend(handles=names, loc="lower center", bbox_to_anchor=(0.5, 0.0), ncols=columns, **_LEGEND)
    return figure


def draw(axes: Any, robot: Robot, clear_of: Sequence[Floats] = ()) -> None:
    """Draw plates, legs and joints with their names, which keep away from further lines (2, 3)."""
    points = robot.points()
    base, platform, o = points[:6], points[6:12], points[12]
    _plate(axes, base, style.BASE, alpha=0.88, zorder=1)
    for line in robot.lines:
        axes.plot(*np.asarray(line, dtype=np.float64).T, color=style.REGION, lw=0.8, zorder=2)  # behind legs, platform
    legs = legs_of(points)
    # From the back to the front, with a white rim where one crosses another.
    for order, (name, start, end) in enumerate(sorted(legs, key=lambda leg: (leg[1] + leg[2]) @ scene.VIEW.eye)):
        kind = name[0]
        rim = [style.rim(WIDTHS[kind] + 1.2)]
        axes.plot(
            *np.column_stack([start, end]),
            zorder=3 + order,
            path_effects=rim,
            color=style.LEG_COLOURS[kind],
            ls=DASHES[kind],
            lw=WIDTHS[kind],
            dash_capstyle="butt",
        )
    _plate(axes, platform, style.PLATFORM, alpha=0.72, zorder=20)
    joints = np.vstack([distinct(base), distinct(platform)])
    axes.plot(*joints.T, "o", color=style.INK, ms=3.2, mec="white", mew=0.5, zorder=21)
    axes.plot(*o[:, None], **POINT_O, zorder=22)
    away = 0.05 * np.ptp(axes.get_xlim())
    for line in robot.tool_line():
        axes.plot(*line.T, zorder=23, markevery=[1], **TOOL)
    write_names(axes, legs, o, away, outlines(base), [*clear_of, *robot.tool_line()])


def legs_of(points: Floats) -> list[Leg]:
    """Return name and ends of each leg; points as `Robot.points`, in space or in a plane."""
    return list(zip(LEGS, points[[0, 1, 2, 12, 12, 12, 3, 4, 5]], points[[*range(6, 12), 12, 12, 12]], strict=True))


def _keys(tool: bool) -> list[Any]:
    words = {"l": "external legs l", "q": "upper internal q", "r": "lower internal r"}
    return [
        *(style.key(style.LEG_COLOURS[k], lw=WIDTHS[k], ls=DASHES[k], label=label) for k, label in words.items()),
        Patch(color=style.BASE, label="base"),
        Patch(color=style.PLATFORM, label="platform"),
        style.key(**POINT_O, label="internal point O"),
        *([style.key(**TOOL, label="tool")] if tool else []),
    ]


def _plate(axes: Any, joints: Floats, colour: str, alpha: float, zorder: int) -> None:
    sides = outlines(joints)
    alpha, width = (alpha, 0.9) if len(sides) == 1 else (0.5 * (1.0 + alpha), 0.6)  # two faces of a solid overlap
    faces = Poly3DCollection(sides, facecolor=colour, alpha=alpha, lw=width, zorder=zorder)
    faces.set_edgecolor(style.INK)
    axes.add_collection3d(faces)
