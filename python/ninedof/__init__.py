"""Kinematic design of the nine-degree-of-freedom redundant parallel manipulator of Zanganeh and Angeles."""

try:
    from ninedof import _core
except ImportError as error:  # a source tree without its compiled part
    raise ImportError(
        "the compiled part of ninedof (ninedof._core) is missing or does not fit this Python: "
        "install the package with `pip install .` from its source directory and import it from elsewhere"
    ) from error

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
from ninedof.forward_position import AssemblyModes, PositionStatus, forward_position
from ninedof.geometry import Geometry
from ninedof.kinematics import (
    VelocityMatrices,
    forward_velocity,
    inverse_velocity,
    jacobian,
    leg_lengths,
    velocity_matrices,
)
from ninedof.lengths import characteristic_length
from ninedof.objective import Objective
from ninedof.optimize import Trace, optimize, trace
from ninedof.pareto import Front, pareto
from ninedof.point import DesignPoint
from ninedof.pose import Pose
from ninedof.redundancy import InternalPoint, InternalPointStatus, best_internal_path, best_internal_point
from ninedof.result import Candidate, Result, Status
from ninedof.singularity import (
    Mechanism,
    Singularity,
    SingularityDistance,
    SingularityMargins,
    distance_to_singularity,
    singularity,
    singularity_margins,
    uncontrolled_motions,
)
from ninedof.study import Study
from ninedof.tracking import Tracked, TrackStatus, track

__version__: str = _core.version

__all__ = [
    "AssemblyModes",
    "Candidate",
    "Configuration",
    "DesignPoint",
    "Front",
    "Geometry",
    "InternalPoint",
    "InternalPointStatus",
    "LowerBound",
    "Mechanism",
    "Objective",
    "Pose",
    "PositionStatus",
    "Result",
    "Singularity",
    "SingularityDistance",
    "SingularityMargins",
    "Status",
    "Study",
    "Trace",
    "TrackStatus",
    "Tracked",
    "VelocityMatrices",
    "applicable_bounds",
    "axis_singular_values",
    "best_internal_path",
    "best_internal_point",
    "characteristic_length",
    "condition_number",
    "distance_to_singularity",
    "forward_position",
    "forward_velocity",
    "inverse_velocity",
    "isotropy_residual",
    "jacobian",
    "leg_lengths",
    "manipulability",
    "optimize",
    "pareto",
    "reciprocal_condition_number",
    "singular_values",
    "singularity",
    "singularity_margins",
    "trace",
    "track",
    "uncontrolled_motions",
    "velocity_matrices",
]
