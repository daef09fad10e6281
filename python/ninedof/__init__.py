"""Kinematic design of the nine-degree-of-freedom redundant parallel manipulator of Zanganeh and Angeles."""

try:
    from ninedof import _core
except ImportError as error:  # a source tree without its compiled part
    raise ImportError(
        "the compiled part of ninedof (ninedof._core) is missing or does not fit this Python: "
        "install the package with `pip install .` from its source directory and import it from elsewhere"
    ) from error

from ninedof.acceleration import forward_acceleration, inverse_acceleration, jacobian_rate
from ninedof.bounds import LowerBound, applicable_bounds
from ninedof.conditioning import (
    axis_singular_values,
    condition_number,
    isotropy_residual,
    manipulability,
    reciprocal_condition_number,
    singular_values,
)
from ninedof.configuration import Configuration
from ninedof.geometry import Geometry
from ninedof.kinematics import VelocityMatrices, jacobian, leg_lengths, velocity_matrices
from ninedof.lengths import characteristic_length
from ninedof.objective import Objective
from ninedof.optimize import Trace, optimize, trace
from ninedof.pareto import Front, pareto
from ninedof.point import DesignPoint
from ninedof.pose import Pose
from ninedof.result import Candidate, Result, Status
from ninedof.study import Study
from ninedof.velocity import forward_velocity, internal_velocity, inverse_velocity, null_motion

__version__: str = _core.version

__all__ = [
    "Candidate",
    "Configuration",
    "DesignPoint",
    "Front",
    "Geometry",
    "LowerBound",
    "Objective",
    "Pose",
    "Result",
    "Status",
    "Study",
    "Trace",
    "VelocityMatrices",
    "applicable_bounds",
    "axis_singular_values",
    "characteristic_length",
    "condition_number",
    "forward_acceleration",
    "forward_velocity",
    "internal_velocity",
    "inverse_acceleration",
    "inverse_velocity",
    "isotropy_residual",
    "jacobian",
    "jacobian_rate",
    "leg_lengths",
    "manipulability",
    "null_motion",
    "optimize",
    "pareto",
    "reciprocal_condition_number",
    "singular_values",
    "trace",
    "velocity_matrices",
]
