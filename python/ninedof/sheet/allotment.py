"""Which tolerances keep a machine within an error: the inverse of its accuracy."""

from __future__ import annotations

import math
from typing import Any

from numpy.typing import ArrayLike

from ninedof.design.duty import Tolerances
from ninedof.sheet.sheet import sheet
from ninedof.support.arguments import finite, items, shown


def tolerances_for(
    design: Any,
    position: float | None = None,
    rotation: float | None = None,
    weights: ArrayLike = (1.0, 1.0),
) -> Tolerances:
    """Return tolerances of joints and legs with which no pose of a machine errs by more, to first order.

    Errors of first order are linear in the tolerances, so each group may use its part of the allowed error: joints and
    legs the same by default. Together they stay within it, and a little below where their worst poses differ.

    Parameters
    ----------
    design : Result, Candidate, DesignPoint or a design of a file
        Over the poses of its study, of a region study over its region, as `sheet` looks at them.
    position : float, optional
        Largest displacement of p, of the tool's point where there is one; in the unit of lengths.
    rotation : float, optional
        Largest angle that the platform turns, radians. At least one of the two.
    weights : (joints, legs)
        The parts of the error that the joints and the legs may make, in any scale; (1, 1) by default, (1, 0) for legs
        without an error.

    Returns
    -------
    Tolerances
        Radius about each joint centre, and half width of each leg length; 0 for a group of weight 0.

    Raises
    ------
    ValueError
        If an argument does not fit, or a pose has an error that no tolerance bounds: it is singular.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=581.24, b1=290.62, b2=0.0)
    >>> design = nd.Design(g, nd.Configuration.neutral(398.28, 244.32), 100.0, "mm")
    >>> kept = nd.tolerances_for(design, position=0.1)
    >>> round(kept.joints, 5), round(kept.legs, 5)
    (0.0091, 0.01172)
    >>> bool(nd.error_bounds(design, leg_errors=kept.legs, joint_errors=kept.joints).position <= 0.1)
    True

    """
    allowed = {
        name: finite(name, value, least=0.0)
        for name, value in (("position", position), ("rotation", rotation))
        if value is not None
    }
    if not allowed:
        raise ValueError("position, rotation: got neither, expected an error that is allowed")
    parts = [
        finite("weights", weight, least=0.0) for weight in items("weights", weights, "those of joints and legs", 2)
    ]
    if not sum(parts) > 0.0:
        raise ValueError(f"weights: got {shown(weights)}, expected one above 0")
    out = []
    for weight, joints in zip(parts, (1.0, 0.0), strict=True):
        if not weight:
            out.append(0.0)
            continue
        worst = sheet(design, joint_errors=joints, leg_errors=1.0 - joints).accuracy
        errors = {name: getattr(worst, name).value for name in allowed}
        if not all(map(math.isfinite, errors.values())):
            raise ValueError("design: got one with a singular pose, expected one whose errors tolerances bound")
        out.append(weight / sum(parts) * min(error / errors[name] for name, error in allowed.items()))
    return Tolerances(*out)
