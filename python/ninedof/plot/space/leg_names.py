"""The names of the nine legs and of O: each beside its leg, or at the end of a thin line where there is no room."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.path import Path

from ninedof.plot import style
from ninedof.plot.space.scene import HALO, VIEW
from ninedof.support.arrays import Floats

LEAST = 1.2  # least distance of two names, in the distance of a name from its leg
ALONG = np.linspace(0.2, 0.8, 13)  # where a name may stand on its leg
AROUND = np.linspace(0.0, 2.0 * np.pi, 17)[:-1]
REACH = np.array([2.0, 3.0, 4.0, 5.5, 7.0])  # of names with a line to their leg, in the same distance
CHIP = {"facecolor": "white", "edgecolor": "none", "pad": 0.8, "alpha": 0.9}
"""The ground of a name: a plate behind it may be dark."""

Leg = tuple[str, Floats, Floats]
"""Its name and its ends."""


def write_names(
    axes: Any, legs: Sequence[Leg], o: Floats, away: float, dark: Sequence[Floats], clear_of: Sequence[Floats]
) -> None:
    """Write the name of each leg, `away` to one side, and O beside its point.

    Names keep off other legs, further lines (2, 3), and dark faces (n, 3) where there is another place; beside its leg,
    a name is nearer to it than to others of its colour.
    """
    lines = [VIEW.seen(np.stack([start, end])) for _, start, end in legs] + [VIEW.seen(line) for line in clear_of]
    faces = [Path(VIEW.seen(face)) for face in dark]
    beside = o + 1.4 * away * _ring(AROUND)
    flat = VIEW.seen(beside)
    room = np.min([np.full(len(flat), 1.6 * away), *(_distance(flat, line) for line in lines)], axis=0) / away
    spot = beside[np.argmax(np.round(room, 1) - 0.5 * _within(flat, faces))]
    taken = [VIEW.seen(spot)]
    options = {"zorder": 30, "ha": "center", "va": "center"}
    axes.text(
        *spot, "O", size=style.TITLE_SIZE, weight="bold", style="italic", color=style.INK, path_effects=HALO, **options
    )
    short_first = np.argsort([np.linalg.norm(np.diff(line, axis=0)) for line in lines[: len(legs)]], kind="stable")
    for k in short_first.tolist():
        name, start, end = legs[k]
        on_leg, spots, apart = _places(start, end, away)
        flat = VIEW.seen(spots)
        others = lines[:k] + lines[k + 1 :]
        own = _distance(flat, lines[k])
        room = np.min([*(2.0 * _distance(flat, line) for line in others), 1.6 * own], axis=0) / away
        alike = [lines[j] for j, leg in enumerate(legs) if j != k and leg[0][0] == name[0]]
        taken_for = (apart == 1.0) & np.any([_distance(flat, line) < 1.5 * own for line in alike], axis=0)
        names = np.min([np.linalg.norm(flat - one, axis=1) for one in taken], axis=0) / away
        crossed = sum(_crosses(VIEW.seen(on_leg), flat, line) for line in others)
        centred = np.tile(np.abs(ALONG - 0.5), len(spots) // len(ALONG))
        worth = np.minimum(np.minimum(room, names / 1.6), 1.6) - 0.3 * centred - 0.6 * _within(flat, faces)
        worth -= 0.7 * (apart > 1.0) + 0.15 * (apart - 1.0) + 0.25 * crossed + 2.0 * (names < LEAST) + 0.9 * taken_for
        best = np.argmax(np.round(worth, 6))
        taken.append(flat[best])
        colour = style.LEG_COLOURS[name[0]]
        if apart[best] > 1.0:
            tip = spots[best] - 0.5 / apart[best] * (spots[best] - on_leg[best])
            axes.plot(*np.column_stack([on_leg[best], tip]), color=colour, lw=0.5, zorder=29)
        axes.text(*spots[best], name, size=style.SMALL_SIZE, color=colour, bbox=CHIP, **options)


def _ring(turn: Floats) -> Floats:
    """Return unit vectors in the plane of the picture, shape (n, 3)."""
    return np.asarray(np.cos(turn)[:, None] * -VIEW.right + np.sin(turn)[:, None] * VIEW.up)


def _places(start: Floats, end: Floats, away: float) -> tuple[Floats, Floats, Floats]:
    """Return points on a leg, places for its name and their distances in `away`: beside it, then with a line to it."""
    on_leg = start + ALONG[:, None] * (end - start)
    along = VIEW.seen(end - start) / max(float(np.linalg.norm(VIEW.seen(end - start))), 1e-300)
    beside = along[1] * VIEW.right - along[0] * VIEW.up
    steps = [(side * beside, 1.0) for side in (1.0, -1.0)]
    steps += [(way, reach) for reach in REACH.tolist() for way in _ring(AROUND)]
    spots = np.concatenate([on_leg + apart * away * way for way, apart in steps])
    return np.tile(on_leg, (len(steps), 1)), spots, np.repeat([apart for _, apart in steps], len(ALONG))


def _within(points: Floats, faces: Sequence[Path]) -> Floats:
    """Return 1 for the points (n, 2) on one of some faces, else 0."""
    return np.asarray(np.any([face.contains_points(points) for face in faces] or [np.zeros(len(points))], axis=0) * 1.0)


def _distance(points: Floats, line: Floats) -> Floats:
    """Return the distance of points (n, 2) from a segment (2, 2)."""
    start, along = line[0], line[1] - line[0]
    share = np.clip((points - start) @ along / max(along @ along, 1e-300), 0.0, 1.0)
    return np.asarray(np.linalg.norm(points - start - share[:, None] * along, axis=1))


def _crosses(starts: Floats, ends: Floats, line: Floats) -> Floats:
    """Return whether each segment from (n, 2) to (n, 2) crosses one segment (2, 2)."""
    a, b = line

    def side(p: Floats, q: Floats, r: Floats) -> Floats:
        return (q - p)[..., 0] * (r - p)[..., 1] - (q - p)[..., 1] * (r - p)[..., 0]

    apart = side(a, b, starts) * side(a, b, ends) < 0.0
    return np.asarray(apart & (side(starts, ends, a) * side(starts, ends, b) < 0.0))
