"""Kinematic design of the nine-degree-of-freedom redundant parallel manipulator of Zanganeh and Angeles.

Figures are in `ninedof.plot`, which is loaded, with matplotlib, when it is first used.
"""

from ninedof.support import starting as _starting  # noqa: F401  # first: signals while the rest is loaded

# isort: split
from importlib import import_module as _import_module
from typing import TYPE_CHECKING
from typing import Any as _Any

try:
    from ninedof import _core
except ImportError as error:
    if "subinterpreter" in str(error):
        raise
    # A source tree without its compiled part.
    raise ImportError(
        "the compiled part of ninedof (ninedof._core) is missing or does not fit this Python: "
        "install the package with `pip install .` from its source directory and import it from elsewhere"
    ) from error

from ninedof.conditioning.characteristic_length import characteristic_length
from ninedof.conditioning.conditioning import (
    axis_singular_values,
    condition_number,
    isotropy_residual,
    manipulability,
    reciprocal_condition_number,
    singular_values,
)
from ninedof.conditioning.hexagonal import hexagonal_condition_number
from ninedof.design.actuators import Actuator
from ninedof.design.design_point import DesignPoint
from ninedof.design.domains import poses as poses
from ninedof.design.domains.poses import Pose
from ninedof.design.domains.region import Region
from ninedof.design.duty import About, Loads, Masses, Speeds, Tolerances
from ninedof.design.objective import Objective
from ninedof.design.study import Study
from ninedof.design.tool import Tool
from ninedof.export.export import export
from ninedof.kinematics.certificate import ModesCertificate
from ninedof.kinematics.kinematics import VelocityMatrices, jacobian, leg_lengths, velocity_matrices
from ninedof.kinematics.position import AssemblyModes, PositionStatus, Tracked, TrackStatus, forward_position, track
from ninedof.kinematics.velocity import (
    forward_acceleration,
    forward_velocity,
    internal_velocity,
    inverse_acceleration,
    inverse_velocity,
    jacobian_rate,
    null_motion,
)
from ninedof.motion import Followed, LimitBreak, Trajectory, follow
from ninedof.optimize.bounds import LowerBound, applicable_bounds
from ninedof.optimize.candidate import Candidate
from ninedof.optimize.check import check
from ninedof.optimize.optimize import Trace, optimize, trace
from ninedof.optimize.pareto import Front, pareto
from ninedof.optimize.region_map import RegionMap, region_map
from ninedof.optimize.result import Result, Status
from ninedof.paper.sweeps import sweep_figure
from ninedof.proof.admissible.admissible import admissible
from ninedof.proof.admissible.result import AdmissibleSet
from ninedof.proof.admissible.rows import AdmissibleRow, AdmissibleRows, admissible_actuators
from ninedof.proof.bounds import (
    Bounds,
    DeterminantBounds,
    axis_condition_number_bounds,
    condition_number_bounds,
    determinant_bounds,
    hexagonal_condition_number_bounds,
    jacobian_bounds,
    leg_length_bounds,
    singular_value_bounds,
)
from ninedof.proof.machine_record import LimitProof, MachineCertificate
from ninedof.proof.optimum import check_certificate, prove_optimum
from ninedof.proof.optimum_proof import OptimumProof
from ninedof.records.design_file import Design
from ninedof.records.load import load, save
from ninedof.records.proofs import load_certificate
from ninedof.redundancy.redundancy import InternalPoint, InternalPointStatus, best_internal_path, best_internal_point
from ninedof.redundancy.redundancy_map import InternalPointMap, MapAudit, best_internal_map
from ninedof.report.report import report
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.sheet.allotment import tolerances_for
from ninedof.sheet.comparison import Comparison, compare
from ninedof.sheet.failure.failure import failure
from ninedof.sheet.failure.result import Failure
from ninedof.sheet.path_limits import PathLimits, path_limits
from ninedof.sheet.path_payload import PathPayload, payload_along
from ninedof.sheet.payload import Payload, largest_payload
from ninedof.sheet.sheet import Sheet, sheet
from ninedof.singularity.architecture import (
    ArchitectureClass,
    ArchitectureSingularity,
    architecture_singularity,
)
from ninedof.singularity.singularity import (
    Mechanism,
    Singularity,
    SingularityMargins,
    singularity,
    singularity_margins,
    uncontrolled_motions,
)
from ninedof.singularity.singularity_distance import (
    NearestSingularity,
    SingularityDistance,
    distance_to_singularity,
    nearest_singularity,
)
from ninedof.statics.accuracy import ErrorBounds, error_bounds, error_map, error_samples
from ninedof.statics.dynamics import InverseDynamics, inverse_dynamics
from ninedof.statics.statics import (
    Ellipsoid,
    LegForces,
    force_ellipsoid,
    leg_forces,
    self_stress,
    stiffness,
    velocity_ellipsoid,
)
from ninedof.sweep import SweepResult, atlas, sweep, sweep_designs
from ninedof.viewer import view
from ninedof.workspace import (
    CertifiedWorkspace,
    WorkspaceCells,
    WorkspaceMap,
    WorkspaceSlice,
    WorkspaceStatus,
    certified_workspace,
    spread_rotations,
    workspace,
)

if TYPE_CHECKING:
    from ninedof import plot as plot

__version__: str = _core.version

__all__ = [
    "About",
    "Actuator",
    "AdmissibleRow",
    "AdmissibleRows",
    "AdmissibleSet",
    "ArchitectureClass",
    "ArchitectureSingularity",
    "AssemblyModes",
    "Bounds",
    "Candidate",
    "CertifiedWorkspace",
    "Comparison",
    "Configuration",
    "Design",
    "DesignPoint",
    "DeterminantBounds",
    "Ellipsoid",
    "ErrorBounds",
    "Failure",
    "Followed",
    "Front",
    "Geometry",
    "InternalPoint",
    "InternalPointMap",
    "InternalPointStatus",
    "InverseDynamics",
    "LegForces",
    "LimitBreak",
    "LimitProof",
    "Loads",
    "LowerBound",
    "MachineCertificate",
    "MapAudit",
    "Masses",
    "Mechanism",
    "ModesCertificate",
    "NearestSingularity",
    "Objective",
    "OptimumProof",
    "PathLimits",
    "PathPayload",
    "Payload",
    "Pose",
    "PositionStatus",
    "Region",
    "RegionMap",
    "Result",
    "Sheet",
    "Singularity",
    "SingularityDistance",
    "SingularityMargins",
    "Speeds",
    "Status",
    "Study",
    "SweepResult",
    "Tolerances",
    "Tool",
    "Trace",
    "TrackStatus",
    "Tracked",
    "Trajectory",
    "VelocityMatrices",
    "WorkspaceCells",
    "WorkspaceMap",
    "WorkspaceSlice",
    "WorkspaceStatus",
    "admissible",
    "admissible_actuators",
    "applicable_bounds",
    "architecture_singularity",
    "atlas",
    "axis_condition_number_bounds",
    "axis_singular_values",
    "best_internal_map",
    "best_internal_path",
    "best_internal_point",
    "certified_workspace",
    "characteristic_length",
    "check",
    "check_certificate",
    "compare",
    "condition_number",
    "condition_number_bounds",
    "determinant_bounds",
    "distance_to_singularity",
    "error_bounds",
    "error_map",
    "error_samples",
    "export",
    "failure",
    "follow",
    "force_ellipsoid",
    "forward_acceleration",
    "forward_position",
    "forward_velocity",
    "hexagonal_condition_number",
    "hexagonal_condition_number_bounds",
    "internal_velocity",
    "inverse_acceleration",
    "inverse_dynamics",
    "inverse_velocity",
    "isotropy_residual",
    "jacobian",
    "jacobian_bounds",
    "jacobian_rate",
    "largest_payload",
    "leg_forces",
    "leg_length_bounds",
    "leg_lengths",
    "load",
    "load_certificate",
    "manipulability",
    "nearest_singularity",
    "null_motion",
    "optimize",
    "pareto",
    "path_limits",
    "payload_along",
    "prove_optimum",
    "reciprocal_condition_number",
    "region_map",
    "report",
    "save",
    "self_stress",
    "sheet",
    "singular_value_bounds",
    "singular_values",
    "singularity",
    "singularity_margins",
    "spread_rotations",
    "stiffness",
    "sweep",
    "sweep_designs",
    "sweep_figure",
    "tolerances_for",
    "trace",
    "track",
    "uncontrolled_motions",
    "velocity_ellipsoid",
    "velocity_matrices",
    "view",
    "workspace",
]


def __getattr__(name: str) -> _Any:
    """Load the figures when they are first used."""
    if name == "plot":
        return _import_module("ninedof.plot")
    raise AttributeError(f"module 'ninedof' has no attribute {name!r}")


def __dir__() -> list[str]:
    """Return the names, those of the figures too."""
    return sorted({*globals(), "plot"})
