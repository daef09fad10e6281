"""The seven figures of the paper, drawn anew from the published design."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ninedof.paper import published
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.statics.ellipsoid import velocity_ellipsoid
from ninedof.sweep import sweep_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FIGURES = {
    "figure_1": "Fig. 1, the architecture",
    "figure_2": "Fig. 2, the first prototype",
    "figure_3": "Fig. 3, the second prototype",
    "figure_4": "Fig. 4, the ellipsoids",
    "figure_5": "Fig. 5, the plates",
    "figure_6": "Fig. 6, condition number against displacement",
    "figure_7": "Fig. 7, condition number against the ratio of sides",
}
APART = {
    "a1": 1.5,
    "a2": 4.5,
    "b1": 2.2,
    "b2": 0.8,
}  # l_c: plates of the second prototype, which the paper does not print
AWAY = (0.1, 0.12, 0.0, 0.9, 0.3, 0.0, -0.4, 0.0, -0.2)  # rad and l_c: Fig. 1 is away from home, so that p and s part


def paper_figures(directory: Path, say: Callable[[str], object]) -> list[Path]:
    """Draw Figs. 1 to 7 into a folder as figure_1 to figure_7; return the files."""
    from ninedof import plot

    unit = "l_c"
    g, home = published.published_geometry(), Configuration.neutral(published.ZP, published.published_zs()[2])
    apart = Geometry.hexagonal(**APART)
    draw: tuple[Callable[[], Figure], ...] = (
        lambda: plot.figure_1(g, home.moved(np.array(AWAY)), unit),
        lambda: plot.figure_2(g, home, unit),
        lambda: plot.figure_3(apart, home, unit),
        lambda: plot.figure_4(velocity_ellipsoid(g, home), velocity_ellipsoid(g, home, "rotation")),
        lambda: plot.figure_5(apart, unit),
        lambda: plot.figure_6(sweep_figure("6")),
        lambda: plot.figure_7(sweep_figure("7")),
    )
    files: list[Path] = []
    for (stem, name), make in zip(FIGURES.items(), draw, strict=True):
        say(f"drawing {name}")
        files += plot.save(make(), directory, stem)
    return files
