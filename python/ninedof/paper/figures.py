"""The seven figures of the paper. They are drawn with matplotlib, so no other module loads this one on import."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from ninedof import plot
from ninedof.paper.plates import figure_1, figure_5
from ninedof.paper.published import ZP, published_geometry, published_zs
from ninedof.paper.sweeps import sweep_figure
from ninedof.plot import style
from ninedof.plot.space.ellipsoid import Axes
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.statics.statics import velocity_ellipsoid
from ninedof.support.arrays import Floats
from ninedof.sweep import SweepResult

__all__ = ["all_figures", "figure_1", "figure_2", "figure_3", "figure_4", "figure_5", "figure_6", "figure_7"]

APART = {"a1": 1.5, "a2": 4.5, "b1": 2.2, "b2": 0.8}  # l_c: plates of the second prototype, not printed in the paper
AWAY = (0.1, 0.12, 0.0, 0.9, 0.3, 0.0, -0.4, 0.0, -0.2)  # rad and l_c: Fig. 1 is away from home, so that p and s part
TURNS = (-50.0, -25.0, 0.0, 25.0, 50.0)  # degrees: ticks of Fig. 6, which goes to one radian


def all_figures() -> Iterator[tuple[str, Figure]]:
    """Yield Figs. 1 to 7 of the published design as they are drawn, behind their names figure_1 to figure_7."""
    unit, g, home = "l_c", published_geometry(), Configuration.neutral(ZP, published_zs()[2])
    apart = Geometry.hexagonal(**APART)
    yield "figure_1", figure_1(g, home.moved(np.array(AWAY)))
    yield "figure_2", figure_2(g, home, unit)
    yield "figure_3", figure_3(apart, home, unit)
    yield "figure_4", figure_4(velocity_ellipsoid(g, home), velocity_ellipsoid(g, home, "rotation"))
    yield "figure_5", figure_5(apart, unit)
    yield "figure_6", figure_6(sweep_figure("6"))
    yield "figure_7", figure_7(sweep_figure("7"))


def figure_2(geometry: Geometry, configuration: Configuration, unit: str = "", figure: Figure | None = None) -> Figure:
    """Return Fig. 2: the first prototype, whose internal and external joints coincide in triangular plates.

    Parameters
    ----------
    geometry : Geometry
    configuration : Configuration
        A single one.
    unit : str
        Of the lengths.
    figure : matplotlib.figure.Figure or SubFigure, optional
        To draw in; a new one by default.

    Examples
    --------
    >>> import ninedof as nd
    >>> from ninedof.paper.figures import figure_2
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=6.0, b1=3.0, b2=0.0)
    >>> figure = figure_2(g, nd.Configuration.neutral(zp=4.0, zs=2.4))

    """
    robot = plot.Robot("first prototype: joints coupled, plates triangular", geometry, configuration)
    return plot.mechanisms([robot], unit, figure)


def figure_3(geometry: Geometry, configuration: Configuration, unit: str = "", figure: Figure | None = None) -> Figure:
    """Return Fig. 3: the second prototype, whose internal and external joints are apart in hexagonal plates.

    Parameters as in `figure_2`.

    Examples
    --------
    >>> import ninedof as nd
    >>> from ninedof.paper.figures import figure_3
    >>> g = nd.Geometry.hexagonal(a1=1.5, a2=4.5, b1=2.2, b2=0.8)
    >>> figure = figure_3(g, nd.Configuration.neutral(zp=4.0, zs=2.4))

    """
    robot = plot.Robot("second prototype: joints apart, plates hexagonal", geometry, configuration)
    return plot.mechanisms([robot], unit, figure)


def figure_4(translation: Axes, rotation: Axes, figure: Figure | None = None) -> Figure:
    """Return Fig. 4: the unit sphere of leg rates and its images under J', ellipsoids of velocities.

    Parameters
    ----------
    translation, rotation : (directions, semi_axes)
        As `ninedof.velocity_ellipsoid` returns them for the two parts of the twist.
    figure : matplotlib.figure.Figure or SubFigure, optional
        To draw in; a new one by default.

    Examples
    --------
    >>> import ninedof as nd
    >>> from ninedof.paper.figures import figure_4
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> home = nd.Configuration.neutral(zp=3.9828, zs=2.4435)
    >>> figure = figure_4(nd.velocity_ellipsoid(g, home), nd.velocity_ellipsoid(g, home, "rotation"))

    """
    titles = "velocity of the platform\nof p, unit of the leg rates", "angular velocity\ntimes l_c"
    return plot.ellipsoids(dict(zip(titles, (translation, rotation), strict=True)), figure=figure)


def figure_6(result: SweepResult, unit: str = "l_c", figure: Figure | None = None) -> Figure:
    """Return Fig. 6: the condition number against displacements of p, rotations, and displacements of O.

    Parameters
    ----------
    result : SweepResult
        The result of `ninedof.sweep_figure("6")`.
    unit : str
        Of lengths.
    figure : matplotlib.figure.Figure or SubFigure, optional
        To draw in; a new one by default.

    Examples
    --------
    >>> import ninedof as nd
    >>> from ninedof.paper.figures import figure_6
    >>> figure = figure_6(nd.sweep_figure("6", points=11))

    """
    names, x, rows = (result[key] for key in ("coordinate", "displacement", "condition_number"))
    ends = [x[0], 0.5 * x[0], 0.0, 0.5 * x[-1], x[-1]]
    groups = (
        (x, ends, f"platform moved ({unit})"),
        (np.degrees(x), TURNS, "platform turned (deg)"),
        (x, ends, f"O moved ({unit})"),
    )
    top = min(float(rows[np.isfinite(rows)].max()), 2.4 * float(rows.min()))
    with style.page(figure, style.TWO_COLUMNS, 2.7) as figure:
        grid = figure.add_gridspec(1, 3, left=0.07, right=0.98, bottom=0.16, top=0.88, wspace=0.12)
        panels: Any = grid.subplots(sharey=True)
        for k, (axes, (x, ticks, title)) in enumerate(zip(panels, groups, strict=True)):
            these = slice(3 * k, 3 * k + 3)
            for name, row, colour, dashes in zip(names[these], rows[these], style.SERIES, style.DASHES, strict=False):
                axes.plot(x, style.without_infinite(row), color=colour, ls=dashes, label=name)
            axes.set(xlabel=title, xlim=(x[0], x[-1]), ylim=(0.96 * float(rows.min()), top), xticks=ticks)
            axes.legend(loc="upper center", ncols=3, bbox_to_anchor=(0.5, 1.14), handlelength=2.2, columnspacing=1.0)
            options: dict[str, Any] = {"transform": axes.transAxes, "ha": "right", "va": "top"}
            if words := _cut_off(names[these].tolist(), rows[these], top):
                white = {"facecolor": "white", "edgecolor": "none", "pad": 1.0}
                axes.text(0.98, 0.98, words, size=style.SMALL_SIZE, bbox=white, **options)
        panels[0].set_ylabel("condition number")
    return figure


def _cut_off(names: Sequence[str], rows: Floats, top: float) -> str:
    highest = [(name, float(row[~np.isnan(row)].max(initial=0.0))) for name, row in zip(names, rows, strict=True)]
    return "\n".join(f"{name} is cut off: it reaches {most:.4g}" for name, most in highest if most > top)


def figure_7(result: SweepResult, ax: Any = None) -> Figure:
    """Return Fig. 7: the least condition number against the two ratios of sides.

    Parameters
    ----------
    result : SweepResult
        The result of `ninedof.sweep_figure("7")`.
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; those of a new figure by default.

    Examples
    --------
    >>> import ninedof as nd
    >>> from ninedof.paper.figures import figure_7
    >>> figure = figure_7(nd.sweep_figure("7", points=3))

    """
    names, x, rows = (result[key] for key in ("sides", "ratio", "condition_number"))
    with style.panel(ax, style.ONE_COLUMN, 2.5, (0.135, 0.155, 0.84, 0.8)) as (figure, axes):
        axes.plot(x, rows[0], color=style.SERIES[0], label=names[0])
        axes.plot(x, rows[1], "o", color=style.SERIES[1], ms=3.5, mfc="white", mew=1.0, label=names[1])
        axes.set_xscale("log", base=2)
        style.plain_numbers(axes.xaxis, [t for t in 2.0 ** np.arange(-10, 11) if x[0] <= t <= x[-1]])
        axes.set(xlabel="ratio of the sides", ylabel="least condition number")
        axes.legend(loc="upper right")
    return figure
