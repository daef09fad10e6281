"""Points of a sweep over the nine configuration coordinates, as configurations."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ninedof.arrays import Floats
from ninedof.chunks import Arrays
from ninedof.configuration import Configuration
from ninedof.geometry import Geometry
from ninedof.redundancy import best_internal_point
from ninedof.sweep.index import Index

__all__ = ["COORDINATES", "RULES", "Poses"]

ROTATION, POSITION, INTERNAL = (
    ("theta_x", "theta_y", "theta_z"),
    ("x_p", "y_p", "z_p"),
    ("x_s", "y_s", "z_s"),
)
COORDINATES = (*ROTATION, *POSITION, *INTERNAL)
"""In the order of `Configuration.moved`."""
RULES = ("held", "carried", "best")
"""Where O is while the platform moves."""

TRIPLES = ("base_external", "base_internal", "platform_external", "platform_internal")


@dataclass(frozen=True, eq=False)
class Poses:
    """How points become configurations."""

    geometry: Geometry
    home: Configuration
    relative: bool
    rule: str
    length: float | str

    def values(self, at: dict[str, Floats], count: int, indices: tuple[Index, ...], threads: int | None) -> Arrays:
        """Return the indices at n points."""
        c = self.configurations(at, count)
        return {i.name: i.values(self.geometry, c, self.length, threads) for i in indices}

    def question(self) -> dict[str, Any]:
        """Return what the values depend on."""
        return {
            "kind": "sweep",
            "geometry": {name: getattr(self.geometry, name) for name in TRIPLES},
            "home": {name: getattr(self.home, name) for name in ("position", "rotation", "internal_point")},
            "relative": self.relative,
            "internal_point": self.rule,
            "characteristic_length": self.length,
        }

    def configurations(self, values: dict[str, Floats], count: int) -> Configuration:
        """Return n configurations for n values of each swept coordinate."""
        p, s = (self._column(names, values, own, count) for names, own in self._points())
        turn = self._column(ROTATION, values, np.zeros(3), count)
        turned = any(name in values for name in ROTATION)
        start = self.home.rotation if self.relative or not turned else np.eye(3)
        q = np.broadcast_to(start, (count, 3, 3))
        if turned:
            tangent = np.concatenate([turn, np.zeros((count, 6))], axis=1)
            q = Configuration._of(np.zeros((count, 3)), q, np.zeros((count, 3))).moved(tangent).rotation
        if self.rule == "carried":
            s = s + self._carried(p, q)
        c = Configuration._of(p, q, s)
        if self.rule != "best":
            return c
        assert not isinstance(self.length, str), "refused before"
        found = best_internal_point(self.geometry, c.position, c.rotation, characteristic_length=self.length)
        return found.configuration

    def _points(self) -> tuple[tuple[tuple[str, ...], Floats], ...]:
        own = self.home.internal_point if self.rule != "carried" else np.zeros(3)
        return (POSITION, self.home.position), (INTERNAL, own)

    def _column(self, names: tuple[str, ...], values: dict[str, Floats], own: Floats, count: int) -> Floats:
        out = np.empty((count, 3))
        for k, name in enumerate(names):
            if name in values:
                out[:, k] = own[k] + values[name] if self.relative else values[name]
            else:
                out[:, k] = own[k]
        return out

    def _carried(self, p: Floats, q: Floats) -> Floats:
        """Return where O would be if it were fixed to the platform."""
        x, y, z = self.home.rotation.T @ (self.home.internal_point - self.home.position)
        # Written out: a product by BLAS may round otherwise in a chunk of another size.
        out: Floats = p + (q[:, :, 0] * x + q[:, :, 1] * y + q[:, :, 2] * z)
        return out
