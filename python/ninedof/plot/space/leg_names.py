"""The names of legs beside them, where they cover nothing."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy as np

from ninedof.plot import style
from ninedof.plot.space.scene import HALO, VIEW
from ninedof.support.arrays import Floats

LEAST = 1.2  # least distance of two names, in their distance from the legs
ALONG = np.linspace(0.2, 0.8, 25)  # where a name may stand on its leg

Leg = tuple[str, Floats, Floats]
"""Its kind and its ends."""


def write_names(axes: Any, legs: list[Leg], o: Floats, away: float, clear_of: Sequence[Floats] = ()) -> None:
    """Write l1 to r3 beside the legs and O beside its point, `away` to one side, clear of further lines (2, 3)."""
    options: dict[str, Any] = {"path_effects": HALO, "zorder": 30, "ha": "center", "va": "center"}
    left = -VIEW.right
    lines = [VIEW.seen(np.stack([start, end])) for _, start, end in legs] + [VIEW.seen(line) for line in clear_of]
    turn = np.linspace(0.0, 2.0 * np.pi, 25)[:-1, None]
    around = o + 1.4 * away * (np.cos(turn) * left + np.sin(turn) * VIEW.up)
    room = np.min([_distance(VIEW.seen(around), line) for line in lines] or [np.ones(len(around))], axis=0)
    beside = around[int(np.argmax(np.round(room / away, 1)))]
    taken = [VIEW.seen(beside)]
    axes.text(*beside, "O", size=style.TITLE_SIZE, weight="bold", color=style.INK, **options)
    count: Counter[str] = Counter()
    for k, (kind, start, end) in enumerate(legs):
        count[kind] += 1
        places = start + ALONG[:, None] * (end - start)
        spots = np.concatenate([places + side * away * left for side in (-1.0, 1.0)])
        flat = VIEW.seen(spots)
        others = [_distance(flat, line) for j, line in enumerate(lines) if j != k]
        room = np.min([*(2.0 * d for d in others), _distance(flat, lines[k]) * 1.6], axis=0)
        names = np.min([np.linalg.norm(flat - spot, axis=1) for spot in taken], axis=0)
        centred = np.tile(np.abs(ALONG - 0.5), 2)
        best = int(np.argmax(np.minimum(np.minimum(room / away, names / (1.6 * away)), 1.6) - 0.3 * centred))
        if names[best] < LEAST * away:  # no room in the picture
            continue
        taken.append(flat[best])
        colour = style.LEG_COLOURS[kind]
        axes.text(*spots[best], f"{kind}{count[kind]}", size=style.SMALL_SIZE, color=colour, **options)


def _distance(points: Floats, line: Floats) -> Floats:
    """Return the distance of points (n, 2) from a segment (2, 2)."""
    start, along = line[0], line[1] - line[0]
    share = np.clip((points - start) @ along / max(float(along @ along), 1e-300), 0.0, 1.0)
    return np.asarray(np.linalg.norm(points - start - share[:, None] * along, axis=1))
