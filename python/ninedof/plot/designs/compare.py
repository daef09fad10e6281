"""The plates of two or three designs over each other, in one scale."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from ninedof.plot import style
from ninedof.robot.plates import plates_of
from ninedof.support.arguments import shown
from ninedof.support.units import metres

HEIGHT = 3.5  # inches
SIZES = (6.5, 4.8, 3.4)  # points, of the marks of each design: those above leave those below in sight
KINDS = {"E": "external joints (filled)", "I": "internal joints (open)"}


def compare(comparison: Any, figure: Figure | None = None) -> Figure:
    """Return a figure of the bases and of the platforms of designs over each other, all in one scale.

    Each plate is seen from +z of its own frame. A design has its colour, dashes and mark; external joints are filled,
    internal ones open.

    Parameters
    ----------
    comparison : Comparison
        As `ninedof.compare` returns it.
    figure : matplotlib.figure.Figure or SubFigure, optional
        To draw in; a new one by default.

    Examples
    --------
    >>> import ninedof as nd
    >>> result = nd.optimize(nd.Study.paper(), starts=8)
    >>> figure = nd.plot.compare(nd.compare(result, result.with_changes(a2="+10%")))

    """
    if not hasattr(comparison, "sheets"):
        raise ValueError(f"comparison: got {shown(comparison)}, expected what `ninedof.compare` returned")
    unit = comparison.unit
    scales = [metres(one.unit) / metres(unit) if one.unit != unit else 1.0 for one in comparison.sheets]
    plates = [plates_of(one.geometry) for one in comparison.sheets]
    half = 1.12 * max(plate.size * scale for pair, scale in zip(plates, scales, strict=True) for plate in pair)
    with style.page(figure, style.TWO_COLUMNS, HEIGHT, "constrained") as figure:
        panels = figure.subplots(1, 2, sharex=True, sharey=True)
        for k, axes in enumerate(panels):
            axes.set(xlim=(-half, half), ylim=(-half, half), aspect="equal", title=f"{plates[0][k].title}, from +z")
            axes.set_xlabel(style.with_unit("x", unit))
            for i, (pair, scale) in enumerate(zip(plates, scales, strict=True)):
                _plate(axes, pair[k], scale, i)
        panels[0].set_ylabel(style.with_unit("y", unit))
        handles = [style.key(**_look(i, "E"), label=name) for i, name in enumerate(comparison.names)]
        for kind, words in KINDS.items():
            ink = {"ls": "", "color": style.INK, "mec": style.INK}
            handles.append(style.key(**_look(0, kind) | ink, label=words))
        ncols = len(handles) if sum(map(len, comparison.names)) < 24 else 2  # long names would leave the page
        figure.legend(handles=handles, loc="outside lower center", ncols=ncols, frameon=False)
    return figure


def _look(i: int, kind: str) -> dict[str, Any]:
    colour = style.SERIES[i]
    face = colour if kind == "E" else "white"
    mark = {"marker": style.MARKS[i], "ms": SIZES[i], "mec": colour, "mfc": face, "mew": 1.0}
    return {"color": colour, "ls": style.DASHES[i], "lw": style.CURVE} | mark


def _plate(axes: Any, plate: Any, scale: float, i: int) -> None:
    if len(plate.outline):
        corners = scale * np.vstack([plate.outline, plate.outline[:1]])
        axes.plot(*corners.T, **_look(i, "E") | {"marker": ""}, zorder=2 + i)
    for name, joint in sorted(plate.joints.items()):
        look = _look(i, name[0]) | {"ls": ""}
        if name[0] == "I":
            look["ms"] = 0.7 * look["ms"]  # inside the external one where both share a place
        axes.plot(*(scale * joint[:2]), **look, zorder=5 + i + 0.5 * (name[0] == "I"))
