"""Figures 1 to 5 of the paper: the architecture, two prototypes, the ellipsoids, the dimensions of the plates."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib import patheffects
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d import proj3d  # type: ignore[import-untyped]

from ninedof.plot import scene, style
from ninedof.plot.arguments import robot, sizes
from ninedof.plot.ellipsoid import EllipsoidPanel, ellipsoids
from ninedof.plot.mechanism import Mechanism, all_points, draw_mechanism, mechanisms
from ninedof.support.arguments import text
from ninedof.support.arrays import Floats

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from ninedof.robot.configuration import Configuration
    from ninedof.robot.geometry import Geometry

HALO = [patheffects.withStroke(linewidth=1.8, foreground="white")]
Axes4 = tuple["ArrayLike", "ArrayLike"]
"""Directions (3, 3) in columns and semi-axes (3,), as `ninedof.velocity_ellipsoid` returns them."""


def figure_1(geometry: Geometry, configuration: Configuration, unit: str = "") -> Figure:
    """Return Fig. 1: the architecture with its joints, legs, frames and vectors.

    Parameters
    ----------
    geometry : Geometry
    configuration : Configuration
        A single one. Away from the neutral pose the vectors p and s part.
    unit : str
        Of the lengths.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> figure = nd.plot.figure_1(g, nd.Configuration([0.6, 0.3, 4.0], internal_point=[0, 0, 2]))

    """
    robot(geometry, configuration)
    text("unit", unit)
    points = all_points(geometry, configuration)
    half, bottom, top = scene.limits(points)
    low, high = np.array([-half, -half, bottom]), np.array([half, half, top])
    with style.settings():
        width = 1.3 * style.ONE_COLUMN
        figure = style.new_figure(width, 0.3 + scene.height(low, high, width))
        axes = figure.add_axes((0.0, 0.0, 1.0, 1.0), projection="3d")
        vectors = [np.stack([np.zeros(3), end]) for end in (configuration.position, configuration.internal_point)]
        draw_mechanism(axes, geometry, configuration, unit=unit, legend=False, bare=True, clear_of=vectors)
        share = 0.3 / float(figure.get_size_inches()[1])
        scene.fit(axes, low, high, (0.0, share, 1.0, 1.0 - share))
        length = 0.16 * half
        for names, origin, turn in (
            (("x", "y", "z"), np.zeros(3), np.eye(3)),
            (("x̃", "ỹ", "z̃"), configuration.position, configuration.rotation),
        ):
            for name, along in zip(names, turn.T, strict=True):
                _arrow(axes, origin, origin + 1.4 * length * along, style.MUTED, 0.8)
                aside = 0.5 * scene.to_the_left() if name[0] == "z" else 0.0
                _word(axes, origin + length * ((1.2 if name[0] == "z" else 1.8) * along + aside), name, style.MUTED)
        for start, end in vectors:
            _arrow(axes, start, end, style.INK, 1.2)
        side = scene.to_the_left() * length
        _word(axes, 0.5 * configuration.position - 0.6 * side, r"$\mathbf{p}$", style.INK, style.TITLE_SIZE)
        _word(axes, 0.55 * configuration.internal_point + 0.7 * side, r"$\mathbf{s}$", style.INK, style.TITLE_SIZE)
        _joints(axes, points, 0.11 * half)
        words = "A on the base, B on the platform: joints of external legs; with a hat or tilde, of internal legs"
        figure.text(0.5, 0.25 * share, words, ha="center", size=style.SMALL_SIZE - 0.5)
    return figure


def _joints(axes: Any, points: Floats, away: float) -> None:
    """Name the joints outward of their plates; of two that coincide, both names."""
    letters = ["A", r"\hat{A}", "B", r"\tilde{B}"]
    words = [f"{letters[k // 3]}_{k % 3 + 1}" for k in range(12)]
    size = float(np.ptp(points[:12], axis=0).max())
    done: set[int] = set()
    for k in range(12):
        if k in done:
            continue
        same = [j for j in range(k, 12) if np.linalg.norm(points[j] - points[k]) < 1e-9 * size]
        done.update(same)
        plate = points[:6] if k < 6 else points[6:12]
        out = points[k] - plate.mean(axis=0)
        flat = scene.seen(np.stack([out, scene.to_the_left()]))
        out = out / max(float(np.linalg.norm(flat[0])), 0.35 * float(np.linalg.norm(out)))
        text = "$" + ",".join(words[j] for j in same) + "$"
        _word(axes, points[k] + away * (1.0 + 0.5 * (len(same) > 1)) * out, text, style.INK)


def _flat(axes: Any, point: Floats) -> tuple[float, float]:
    x, y, _ = proj3d.proj_transform(*np.asarray(point, dtype=np.float64), axes.get_proj())
    return float(x), float(y)


def _arrow(axes: Any, start: Floats, end: Floats, colour: str, width: float) -> None:
    arrow = {"arrowstyle": "-|>", "color": colour, "lw": width, "mutation_scale": 6, "shrinkA": 0, "shrinkB": 0}
    drawn = axes.annotate("", _flat(axes, end), _flat(axes, start), arrowprops=arrow, zorder=25)
    rim = patheffects.Stroke(linewidth=width + 1.0, foreground="white")  # seen on the dark plate too
    drawn.arrow_patch.set_path_effects([rim, patheffects.Normal()])


def _word(axes: Any, at: Floats, text: str, colour: str, size: float = style.SMALL_SIZE) -> None:
    looks = {"size": size, "color": colour, "zorder": 31, "path_effects": HALO}
    written = axes.annotate(text, _flat(axes, at), parse_math=True, **looks)
    written.set(ha="center", va="center")


def figure_2(geometry: Geometry, configuration: Configuration, unit: str = "") -> Figure:
    """Return Fig. 2: the first prototype, whose internal and external joints coincide in triangular plates.

    Parameters
    ----------
    geometry : Geometry
    configuration : Configuration
        A single one.
    unit : str
        Of the lengths.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=6.0, b1=3.0, b2=0.0)
    >>> figure = nd.plot.figure_2(g, nd.Configuration.neutral(zp=4.0, zs=2.4))

    """
    return mechanisms([Mechanism("first prototype: joints coupled, plates triangular", geometry, configuration)], unit)


def figure_3(geometry: Geometry, configuration: Configuration, unit: str = "") -> Figure:
    """Return Fig. 3: the second prototype, whose internal and external joints are apart in hexagonal plates.

    Parameters
    ----------
    geometry : Geometry
    configuration : Configuration
        A single one.
    unit : str
        Of the lengths.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=1.5, a2=4.5, b1=2.2, b2=0.8)
    >>> figure = nd.plot.figure_3(g, nd.Configuration.neutral(zp=4.0, zs=2.4))

    """
    return mechanisms([Mechanism("second prototype: joints apart, plates hexagonal", geometry, configuration)], unit)


def figure_4(translation: Axes4, rotation: Axes4) -> Figure:
    """Return Fig. 4: the unit sphere of leg rates and its images under J', ellipsoids of velocities.

    Parameters
    ----------
    translation, rotation : (directions, semi_axes)
        As `ninedof.velocity_ellipsoid` returns them for the two parts of the twist.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> home = nd.Configuration.neutral(zp=3.9828, zs=2.4435)
    >>> figure = nd.plot.figure_4(nd.velocity_ellipsoid(g, home), nd.velocity_ellipsoid(g, home, "rotation"))

    """
    translation, rotation = sizes("translation", translation), sizes("rotation", rotation)
    panels = [
        EllipsoidPanel("velocity of the platform", *translation, note="of p, unit of the leg rates"),
        EllipsoidPanel("angular velocity", *rotation, note="times l_c"),
    ]
    return ellipsoids(panels)
