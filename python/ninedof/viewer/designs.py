"""A set of admissible designs as a picture behind the machine: a click shows the design of that place."""

from __future__ import annotations

import logging
import os
from collections.abc import Mapping, Sequence
from itertools import combinations
from typing import Any

import numpy as np

from ninedof.design.study import Study
from ninedof.motion.rotations import to_quaternions
from ninedof.plot import style
from ninedof.plot.admissible import admissible as figure_of
from ninedof.proof.admissible.result import INSIDE, OUTSIDE, AdmissibleSet
from ninedof.records.proofs import latest_admissible
from ninedof.support.arguments import instance
from ninedof.support.arrays import Floats
from ninedof.viewer.machine import Machine

HEIGHT, WIDTH = 2.6, 5.0  # at most, of the picture in the scene
BEHIND, ABOVE, BELOW = 2.2, 1.1, 0.5  # the machine; its lower side above the ground, at most so far below the platform
RIGHT, UP = np.array([0.885, 0.465, 0.0]) / np.hypot(0.885, 0.465), np.array([0.0, 0.0, 1.0])  # of the first camera
NORMAL = np.cross(RIGHT, UP)  # towards that camera
HINT = "A click in the picture shows the design there."


class DesignPicture:
    """The planes of a set, upright behind the machine, and which design is where.

    `top` is the height of the platform in the scene: it covers none of the picture, seen from the first camera.
    """

    def __init__(self, designs: AdmissibleSet, top: float = 0.0) -> None:
        self.designs = designs
        figure = figure_of(designs)
        canvas: Any = figure.canvas
        with style.settings():
            canvas.draw()
        self.pixels = np.array(canvas.buffer_rgba())[..., :3]
        self._planes = list(zip(figure.axes, combinations(range(len(designs.vary)), 2), strict=False))
        self._resolution = np.array(self.pixels.shape[1::-1], dtype=np.float64)
        self.size: Floats = self._resolution * min(HEIGHT / self._resolution[1], WIDTH / self._resolution[0])
        self.centre: Floats = (max(ABOVE, top - BELOW) + 0.5 * self.size[1]) * UP - BEHIND * NORMAL
        self.turn = to_quaternions(np.column_stack([RIGHT, -UP, -NORMAL])[None])[0]

    def design_at(self, origin: Sequence[float], direction: Sequence[float]) -> dict[str, float] | None:
        """Return the design where a ray of the scene meets a plane of the set; None beside the planes."""
        way, from_eye = np.array(direction), self.centre - np.array(origin)
        if abs(way @ NORMAL) < 1e-9:
            return None
        at = way * (from_eye @ NORMAL) / (way @ NORMAL) - from_eye
        pixel = (np.array([at @ RIGHT, at @ UP]) / self.size + 0.5) * self._resolution
        for axes, pair in self._planes:
            if axes.bbox.contains(*pixel):
                values = axes.transData.inverted().transform(pixel)
                chosen = zip(pair, np.where(self._in_degrees(pair), np.radians(values), values).tolist(), strict=True)
                return dict(self.designs.of.at) | {self.designs.vary[k]: value for k, value in chosen}
        return None

    def marks(self, variables: Mapping[str, float]) -> list[Floats | None]:
        """Return where a design is in each plane, in the frame of the picture, y down; None outside of the plane."""
        out: list[Floats | None] = []
        for axes, pair in self._planes:
            values = np.array([variables[self.designs.vary[k]] for k in pair])
            pixel = axes.transData.transform(np.where(self._in_degrees(pair), np.degrees(values), values))
            x, y = self.size * (pixel / self._resolution - 0.5)
            out.append(np.array([x, -y, 0.0]) if axes.bbox.padded(1.0).contains(*pixel) else None)
        return out

    def words(self, variables: Mapping[str, float]) -> str:
        """Return what is proved of a design."""
        of = self.designs.of
        held = [name for name in of.study.variables if name not in of.vary]
        other = [name for name in held if abs(variables[name] - of.at[name]) > 1e-9 * max(1.0, abs(of.at[name]))]
        if other:
            return f"The design shown has another {' and '.join(other)}: the set is at {of.values(other)}. {HINT}"
        x = [variables[name] for name in of.vary]
        if not all(low <= value <= high for value, (low, high) in zip(x, of.ranges, strict=True)):
            return f"The design shown is not in the ranges of the set. {HINT}"
        state, bound = self.designs.state_of([x])[0], of.condition_number
        most = "" if bound is None else f"a condition number of at most {bound:g}"
        words = {
            INSIDE: f"Proved: the design shown keeps every limit{most and f' and {most}'} at every pose.",
            OUTSIDE: f"Proved: the design shown breaks a limit{most and f', or {most}'}.",
        }
        drawn = " It is proved as it is drawn, without tolerances." if of.study.tolerances else ""
        return f"{words.get(state, 'Of the design shown nothing is proved.')}{drawn} {HINT}"

    def _in_degrees(self, pair: Sequence[int]) -> list[bool]:
        return [self.designs.vary[k] in self.designs.study.angles for k in pair]


def designs_of(machine: Machine, design: Any, designs: AdmissibleSet | None) -> AdmissibleSet | None:
    """Return the set to show beside a machine, which is of its study: the one given, or that of the run of a path."""
    if designs is None:
        if machine.result is None or not isinstance(design, str | os.PathLike):
            return None
        try:
            return latest_admissible(design, machine.result.study)
        except ValueError as error:  # a damaged file: the machine is shown without it
            logging.getLogger("ninedof").warning("%s", error)
            return None
    study = instance("designs", designs, AdmissibleSet).study
    if machine.result is None or _asked(study) != _asked(machine.result.study):
        raise ValueError("designs: got a set of another study, expected one of the study of the result")
    if len(designs.vary) < 2:
        raise ValueError(f"designs: got a set of {designs.vary[0]} alone, expected two to four variables")
    return designs


def _asked(study: Study) -> dict[str, Any]:
    return study.to_dict() | {"solver": None}


def add_picture(api: Any, picture: DesignPicture, ball: Any) -> dict[str, Any]:
    """Add the picture to a scene of viser, with a ball in each plane for the design shown; return the nodes."""
    width, height = picture.size.tolist()
    place = {"wxyz": picture.turn, "position": picture.centre}
    plain = {"cast_shadow": False, "receive_shadow": False}
    nodes = {"/designs": api.add_image("/designs", picture.pixels, width, height, format="png", **place, **plain)}
    vertices, faces = ball
    for k in range(len(picture.marks(picture.designs.of.at))):
        name = f"/designs/{k}"
        nodes[name] = api.add_mesh_simple(name, 0.04 * vertices, faces, color=(20, 20, 20), **plain)
    return nodes
