"""Configurations of the robot: a single one or a stack."""

from __future__ import annotations

import math
from typing import Any, NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ninedof import _core
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import instance
from ninedof.support.arrays import Floats, all_finite, as_floats, broadcast_leading, frozen
from ninedof.support.structs import rows_of


class Flat(NamedTuple):
    """The arrays of a stack of configurations for the core, one after the other."""

    position: Floats
    rotation: Floats
    internal_point: Floats


Operands = tuple[Geometry, "Configuration | Flat"]


class Configuration:
    """Nine coordinates: platform position p, platform rotation Q and internal point s, all in the base frame.

    One configuration, or a stack with any leading dimensions; the three arguments broadcast against each other.
    Immutable: the arrays are read-only.

    Parameters
    ----------
    position : array_like, shape (..., 3)
        Origin p of the platform frame, length units.
    rotation : array_like, shape (..., 3, 3), or scipy.spatial.transform.Rotation
        Q, platform frame to base frame. The identity by default.
    internal_point : array_like, shape (..., 3)
        The point s where the six internal legs meet, length units.

    Raises
    ------
    ValueError
        If a shape does not fit, a number is not finite, or a matrix is not a proper rotation (to 1e-9). In a stack NaN
        is allowed: it marks a pose without data, for which every result is NaN.

    Examples
    --------
    >>> import ninedof as nd
    >>> nd.Configuration.neutral(zp=3.9828, zs=[2.3745, 2.4435]).shape
    (2,)

    """

    __slots__ = ("_internal_point", "_position", "_rotation")

    def __init__(self, position: ArrayLike, rotation: Any = None, internal_point: ArrayLike | None = None) -> None:
        if internal_point is None:
            raise ValueError("internal_point: got None, expected the coordinates of O, shape (..., 3)")
        if rotation is None:
            rotation = np.eye(3)
        elif hasattr(rotation, "as_matrix"):
            rotation = rotation.as_matrix()
        p = as_floats("position", position, (3,))
        q = as_floats("rotation", rotation, (3, 3))
        s = as_floats("internal_point", internal_point, (3,))
        shape, (p, q, s) = broadcast_leading({"position": (p, 1), "rotation": (q, 2), "internal_point": (s, 1)})
        _core.check_configurations(*_flat(p, q, s), bool(shape))
        self._position, self._rotation, self._internal_point = frozen(p), frozen(q), frozen(s)

    @classmethod
    def neutral(cls, zp: ArrayLike, zs: ArrayLike, theta_z: ArrayLike = 0.0) -> Configuration:
        """Eq. (6): p = (0, 0, zp), s = (0, 0, zs), Q a rotation by theta_z about z.

        Parameters
        ----------
        zp, zs : array_like
            Heights of the platform and of O above the base, length units; any shapes that broadcast.
        theta_z : array_like
            Rotation of the platform about z, radians. The paper uses 0; its claim in eq. (7) that other values
            bring no gain is not correct.

        """
        arguments = {"zp": zp, "zs": zs, "theta_z": theta_z}
        shape, arrays = broadcast_leading({name: (as_floats(name, x, ()), 0) for name, x in arguments.items()})
        flat_zp, flat_zs, flat_theta_z = (array.reshape(-1) for array in arrays)
        return cls._shaped(shape, *_core.neutral(flat_zp, flat_zs, flat_theta_z, bool(shape)))

    @classmethod
    def _of(cls, position: Floats, rotation: Floats, internal_point: Floats) -> Self:
        """Build from arrays that have already been checked."""
        new = cls.__new__(cls)
        new._position, new._rotation, new._internal_point = map(frozen, (position, rotation, internal_point))
        return new

    @classmethod
    def _shaped(cls, shape: tuple[int, ...], p: Floats, q: Floats, s: Floats) -> Self:
        """Build a stack of the given shape from checked arrays in any shape, as the core returns them."""
        return cls._of(p.reshape(*shape, 3), q.reshape(*shape, 3, 3), s.reshape(*shape, 3))

    def moved(self, tangent: ArrayLike) -> Configuration:
        """Return the configuration displaced along a tangent, Q becoming exp(omega) Q.

        Parameters
        ----------
        tangent : array_like, shape (..., 9)
            (omega, dp, ds): rotation vector in radians and displacements in length units, base frame. Broadcasts
            against the configuration.

        """
        shape, flat, t = broadcast_flat(self, tangent=(tangent, 9))
        return Configuration(*(a.reshape(shape + a.shape[1:]) for a in _core.moved(*flat, t)))

    @property
    def position(self) -> Floats:
        """Position p of the platform origin, shape (..., 3)."""
        return self._position

    @property
    def rotation(self) -> Floats:
        """Rotation Q of the platform, shape (..., 3, 3)."""
        return self._rotation

    @property
    def internal_point(self) -> Floats:
        """Internal point s, shape (..., 3)."""
        return self._internal_point

    @property
    def shape(self) -> tuple[int, ...]:
        """Leading dimensions; () for a single configuration."""
        return self._position.shape[:-1]

    def __len__(self) -> int:
        """Length of the first leading dimension."""
        if not self.shape:
            raise TypeError("a single configuration has no length")
        return self.shape[0]

    def __getitem__(self, index: Any) -> Configuration:
        """Select configurations from a stack by indices along the leading dimensions."""
        if not self.shape:
            raise TypeError("a single configuration cannot be indexed")
        picks: NDArray[np.intp] = np.arange(int(np.prod(self.shape))).reshape(self.shape)[index]
        return Configuration._of(*(array[picks] for array in flat(self)))

    def __bool__(self) -> bool:
        """Return True also for an empty stack."""
        return True

    def __eq__(self, other: object) -> bool:
        """Compare numbers and shape."""
        if not isinstance(other, Configuration):
            return NotImplemented
        own, others = arrays_of(self), arrays_of(other)
        return all(np.array_equal(own[name], others[name], equal_nan=True) for name in own)

    __hash__ = None  # type: ignore[assignment]  # as for numpy arrays

    def __repr__(self) -> str:
        """Show the numbers of a single configuration, or the shape of a stack."""
        if self.shape:
            return f"<Configuration stack of shape {self.shape}>"
        return f"Configuration({', '.join(f'{name}={array.tolist()}' for name, array in arrays_of(self).items())})"

    def __setstate__(self, state: tuple[None, dict[str, Any]]) -> None:
        """Restore a copied stack, or one pickled by protocol 2 or later; its arrays become read-only again."""
        for name, value in state[1].items():
            setattr(self, name, frozen(value) if name in Configuration.__slots__ else value)


def flat(configuration: Configuration) -> Flat:
    """Return the arrays of a stack for the core; of a single configuration those of a stack of one."""
    return _flat(**arrays_of(configuration))


def _flat(position: Floats, rotation: Floats, internal_point: Floats) -> Flat:
    return Flat(position.reshape(-1, 3), rotation.reshape(-1, 3, 3), internal_point.reshape(-1, 3))


def arrays_of(configuration: Configuration) -> dict[str, Floats]:
    """Return the arrays of a configuration by name."""
    return {name: getattr(configuration, name) for name in Flat._fields}


def poses_of(configuration: Configuration) -> list[dict[str, Any]]:
    """Return a stack of poses, one after the other."""
    return rows_of(arrays_of(configuration))


def broadcast_flat(
    configuration: Configuration, **others: tuple[ArrayLike, int]
) -> tuple[tuple[int, ...], Flat, Floats]:
    """Broadcast a configuration against arrays of shape (..., k), each given with its k.

    Return the leading shape, the flat arrays of the configuration, and the others beside each other in one array of n
    rows. ValueError names the argument that has another shape or an infinite number; NaN marks missing data.
    """
    own = {name: (array, array.ndim - len(configuration.shape)) for name, array in arrays_of(configuration).items()}
    arrays = {
        name: (all_finite(name, as_floats(name, values, (k,)), missing=True), 1) for name, (values, k) in others.items()
    }
    shape, (p, q, s, *rest) = broadcast_leading(own | arrays)
    flat_rest = [a.reshape(math.prod(shape), a.shape[-1]) for a in rest]
    return shape, _flat(p, q, s), np.concatenate(flat_rest, axis=1)


def require_single(name: str, configuration: Any) -> Configuration:
    """Return one Configuration; raise ValueError, naming the argument, for a stack and for all else."""
    if (shape := instance(name, configuration, Configuration).shape) != ():
        raise ValueError(f"{name}: got a stack of shape {shape}, expected a single one")
    return configuration  # type: ignore[no-any-return]


def operands(geometry: Geometry, configuration: Configuration, name: str = "configuration") -> Operands:
    """Return the operands of the core, checked: geometry and configuration."""
    return instance("geometry", geometry, Geometry), instance(name, configuration, Configuration)


def operands_with(
    geometry: Geometry, configuration: Configuration, **others: tuple[ArrayLike, int]
) -> tuple[tuple[int, ...], Operands, Floats]:
    """Return the leading shape, the operands of the core, and the other arrays as one, as `broadcast_flat`."""
    operands(geometry, configuration)
    shape, flat, rows = broadcast_flat(configuration, **others)
    return shape, (geometry, flat), rows


def single(geometry: Geometry, configuration: Configuration, name: str = "configuration") -> Operands:
    """Return the operands of the core for a single configuration; a stack raises ValueError."""
    return instance("geometry", geometry, Geometry), require_single(name, configuration)
