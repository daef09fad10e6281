"""Fig. 1 of the paper: the architecture with its joints, legs, frames and vectors."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from mpl_toolkits.mplot3d import proj3d  # type: ignore[import-untyped]

from ninedof.plot import style
from ninedof.plot.space import scene
from ninedof.plot.space.mechanism import Robot, draw
from ninedof.support.arrays import Floats

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from ninedof.robot.configuration import Configuration
    from ninedof.robot.geometry import Geometry

LETTERS = ("A", r"\hat{A}", "B", r"\tilde{B}")
SMALL = 0.3  # inches, for the words below
LEFT = -scene.VIEW.right


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
