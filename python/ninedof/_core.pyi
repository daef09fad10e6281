"""The compiled core. Private: use the names of `ninedof`.

A stack of configurations comes whole (`Configuration`), or as its three arrays: position (n, 3), rotation (n, 3, 3),
internal point (n, 3), C-contiguous float64 (`Flat`); characteristic lengths as one value or n.
"""

from collections.abc import Callable, Sequence
from typing import Any

from numpy import float64, int8, int16, int32, int64, intc, uint8, uint32
from numpy.typing import ArrayLike, NDArray

from ninedof.robot.configuration import Configuration, Flat

_Floats = NDArray[float64]
_Out = _Floats | None
_Poses = Configuration | Flat
_Triple = tuple[float, float, float]
_Progress = Callable[[int, int, float | None], object]

class _Struct:
    """A struct of the core: its attributes by name, those left out as they are by default."""

    def __init__(self, **attributes: Any) -> None: ...

version: str
built_with: dict[str, str]

class Geometry:
    def __init__(
        self,
        base_external: ArrayLike,
        base_internal: ArrayLike,
        platform_external: ArrayLike,
        platform_internal: ArrayLike,
    ) -> None: ...
    @staticmethod
    def hexagonal(a1: float, a2: float, b1: float, b2: float) -> Geometry: ...
    @staticmethod
    def symmetric(
        base_external: ArrayLike,
        base_internal: ArrayLike,
        platform_external: ArrayLike,
        platform_internal: ArrayLike,
    ) -> Geometry: ...
    @property
    def base_external(self) -> _Floats: ...
    @property
    def base_internal(self) -> _Floats: ...
    @property
    def platform_external(self) -> _Floats: ...
    @property
    def platform_internal(self) -> _Floats: ...
    def __eq__(self, other: object) -> bool: ...
    def __hash__(self) -> int: ...

def check_configurations(position: _Floats, rotation: _Floats, internal_point: _Floats, is_stack: bool) -> None: ...
def moved(
    position: _Floats, rotation: _Floats, internal_point: _Floats, tangent: _Floats
) -> tuple[_Floats, _Floats, _Floats]: ...
def neutral(zp: _Floats, zs: _Floats, theta_z: _Floats, is_stack: bool) -> tuple[_Floats, _Floats, _Floats]: ...

# (n, 9), (n, 54), (n, 153), (n, 9), (n, 9)
def leg_lengths(g: Geometry, c: _Poses, threads: int, out: _Out, /) -> _Floats: ...
def idle_legs(shortest: _Floats, longest: _Floats) -> list[bool]: ...

idle_share: float

def jacobian(g: Geometry, c: _Poses, length: _Floats, threads: int, /) -> _Floats: ...
def velocity_matrices(g: Geometry, c: _Poses, length: _Floats, threads: int, /) -> _Floats: ...
def forward_velocity(g: Geometry, c: _Poses, rates: _Floats, threads: int, /) -> _Floats: ...

class CertificateColumns:
    proved: NDArray[intc]
    undecided: NDArray[intc]
    boxes: NDArray[int64]
    radius: _Floats
    places: _Floats
    place_radius: _Floats

class ModeColumns:
    count: NDArray[intc]
    status: list[str]
    obstacle: list[str]
    certain: NDArray[uint8]
    configuration: _Floats
    separation: _Floats
    side: NDArray[intc]
    certificate: CertificateColumns | None

def forward_position(g: Geometry, leg_lengths: _Floats, certify: bool, threads: int, /) -> ModeColumns: ...
def track(
    g: Geometry, leg_lengths: _Floats, path: int, c: _Poses, threads: int, /
) -> tuple[_Floats, NDArray[uint8]]: ...

track_statuses: list[str]
internal_point_statuses: list[str]

class LegLimits(_Struct):
    low: _Floats
    high: _Floats

class InternalPointProblem(_Struct):
    criterion: str
    limits: LegLimits
    characteristic_length: float
    clearance: float

class MapSettings(_Struct):
    seed_every: int
    audit_every: int
    audit_seed: int
    threads: int

class MapAudit:
    poses: int
    missed: int
    largest: float

class InternalPoints:
    internal_point: _Floats
    value: _Floats
    status: NDArray[uint8]
    active: NDArray[uint32]
    active_names: dict[int, tuple[str, ...]]

class InternalPointMap:
    points: InternalPoints
    audit: MapAudit
    searched: int
    followed: int

def best_internal_point(
    g: Geometry, position: _Floats, rotation: _Floats, start: _Floats, problem: InternalPointProblem, threads: int, /
) -> InternalPoints: ...
def best_internal_path(
    g: Geometry,
    position: _Floats,
    rotation: _Floats,
    start: _Floats | None,
    problem: InternalPointProblem,
    smoothness: float,
    /,
) -> InternalPoints: ...
def best_internal_map(
    g: Geometry,
    position: _Floats,
    rotation: _Floats,
    shape: Sequence[int],
    start: _Floats,
    problem: InternalPointProblem,
    settings: MapSettings,
    progress: _Progress | None,
    /,
) -> InternalPointMap: ...

class Followed:
    internal_point: _Floats
    leg_lengths: _Floats
    leg_rates: _Floats
    leg_accelerations: _Floats
    velocity: _Floats
    acceleration: _Floats
    condition_number: _Floats
    singularity_margins: _Floats
    tracked: int
    tracking_error: float

# The trajectory is `time`, `position` and `rotation`.
def follow(
    g: Geometry,
    home: _Poses,
    time: _Floats,
    position: _Floats,
    rotation: _Floats,
    rule: str | float,
    limits: tuple[_Floats, _Floats],
    characteristic_length: float,
    /,
) -> Followed: ...

class DriveFigures:
    push: _Floats
    pull: _Floats
    rms: _Floats
    power: _Floats
    braking: _Floats
    work: _Floats
    returned: _Floats

class LimitBreak:
    limit: str
    begin: float
    end: float
    worst: float
    at: float

# Times (n,), forces and rates (n, 9).
def drive_figures(time: _Floats, forces: _Floats, rates: _Floats, /) -> DriveFigures: ...
def leg_margins(leg_lengths: _Floats, low: _Floats, high: _Floats, /) -> _Floats: ...
def stretches(limit: str, time: _Floats, values: _Floats, margin: _Floats, tolerance: float, /) -> list[LimitBreak]: ...
def limit_breaks(
    time: _Floats, leg_lengths: _Floats, low: _Floats, high: _Floats, determinants: _Floats, /
) -> list[LimitBreak]: ...
def inverse_velocity(g: Geometry, c: _Poses, velocity: _Floats, threads: int, /) -> _Floats: ...

# (n, 3), (n, 27)
def internal_velocity(g: Geometry, c: _Poses, twist: _Floats, weights: _Floats, threads: int, /) -> _Floats: ...
def null_motion(g: Geometry, c: _Poses, threads: int, /) -> _Floats: ...

# (n, 9), (n, 9), (n, 54)
def forward_acceleration(
    g: Geometry, c: _Poses, rates: _Floats, accelerations: _Floats, threads: int, /
) -> _Floats: ...
def inverse_acceleration(
    g: Geometry, c: _Poses, velocity: _Floats, acceleration: _Floats, threads: int, /
) -> _Floats: ...
def jacobian_rate(g: Geometry, c: _Poses, velocity: _Floats, length: _Floats, threads: int, /) -> _Floats: ...

# (n, 6), (n, 6), and (n, 1) for the indices, which write into `out` if it is not None
def singular_values(g: Geometry, c: _Poses, length: _Floats, threads: int, out: _Out, /) -> _Floats: ...
def locked_condition_numbers(
    g: Geometry, c: _Poses, length: _Floats, sets: Sequence[tuple[int, int]], threads: int, /
) -> _Floats: ...
def relative_manipulability(g: Geometry, c: _Poses, threads: int, /) -> _Floats: ...
def hexagonal_condition_numbers(designs: _Floats, threads: int, out: _Out, /) -> _Floats: ...
def simd_level() -> str: ...
def interval_operations(name: str, operands: _Floats, /) -> _Floats: ...
def leg_length_bounds(g: Geometry, c: _Poses, threads: int, /) -> _Floats: ...
def determinant_bounds(g: Geometry, c: _Poses, threads: int, /) -> _Floats: ...
def condition_number_bounds(g: Geometry, c: _Poses, length: _Floats, threads: int, /) -> _Floats: ...
def axis_condition_number_bounds(g: Geometry, c: _Poses, length: _Floats, threads: int, /) -> _Floats: ...
def singular_value_bounds(g: Geometry, c: _Poses, length: _Floats, threads: int, /) -> _Floats: ...
def jacobian_bounds(g: Geometry, c: _Poses, length: _Floats, threads: int, /) -> _Floats: ...
def hexagonal_condition_number_bounds(designs: _Floats, threads: int, /) -> _Floats: ...
def axis_singular_values(g: Geometry, c: _Poses, length: _Floats, threads: int, /) -> _Floats: ...
def condition_number_two(g: Geometry, c: _Poses, length: _Floats, threads: int, out: _Out, /) -> _Floats: ...
def condition_number_frobenius(g: Geometry, c: _Poses, length: _Floats, threads: int, out: _Out, /) -> _Floats: ...
def reciprocal_condition_number(g: Geometry, c: _Poses, length: _Floats, threads: int, out: _Out, /) -> _Floats: ...
def manipulability(g: Geometry, c: _Poses, length: _Floats, threads: int, out: _Out, /) -> _Floats: ...
def isotropy_residual(g: Geometry, c: _Poses, length: _Floats, threads: int, out: _Out, /) -> _Floats: ...
def characteristic_length(g: Geometry, c: _Poses, kind: str, threads: int, /) -> _Floats: ...

class ArchitectureSingularity:
    kind: str
    leg: int
    other: int
    distance: float
    relative: float

class SimilarTriangles:
    dissimilarity: float
    rotations: _Floats

def nearest_architecture_singularity(g: Geometry, /) -> ArchitectureSingularity: ...
def similar_triangles(g: Geometry, /) -> SimilarTriangles: ...
def homothety_residual(g: Geometry, c: _Poses, /) -> float: ...

# (n, 3), (n, 16), (k, 9), (n, 6)
def singularity_margins(g: Geometry, c: _Poses, threads: int, out: _Out, /) -> _Floats: ...
def singularity(g: Geometry, c: _Poses, threads: int, /) -> _Floats: ...
def uncontrolled_motions(g: Geometry, c: _Poses, tolerance: float, /) -> _Floats: ...
def distance_to_singularity(g: Geometry, c: _Poses, direction: _Floats, most: float, threads: int, /) -> _Floats: ...

class NearestSingularity:
    distance: float
    mechanism: int
    direction: _Floats
    pose: int
    configuration: Configuration

# Motions are (9, 3).
def nearest_singularity(
    g: Geometry, c: _Poses, motions: _Floats, most: float, directions: int, threads: int, /
) -> NearestSingularity: ...
def nearest_singularities(g: Geometry, c: _Poses, internal_held: bool, /) -> list[NearestSingularity]: ...

# (n, 18): forces and what is unbalanced; (9, k); (n, 36); (n, 81)
def leg_forces(g: Geometry, c: _Poses, load: _Floats, threads: int, /) -> _Floats: ...
def self_stress(g: Geometry, c: _Poses, /) -> _Floats: ...
def stiffness(g: Geometry, c: _Poses, legs: _Floats, threads: int, /) -> _Floats: ...
def stiffness_with_o(g: Geometry, c: _Poses, legs: _Floats, threads: int, /) -> _Floats: ...

class Masses(_Struct):
    platform: float
    centre: Sequence[float] | _Floats
    inertia: _Floats
    cylinder: _Floats
    rod: _Floats
    cylinder_centre: _Floats
    rod_centre: _Floats
    cylinder_inertia: _Floats
    rod_inertia: _Floats
    internal_point: float

# Rows of 27: velocity, acceleration, load; forces, rates and what is unbalanced.
def inverse_dynamics(
    g: Geometry, c: _Poses, motion: _Floats, masses: Masses, gravity: _Floats, threads: int, /
) -> _Floats: ...

# Rows of 36: forces without a payload, of a unit of it, greatest pushes and pulls; shares (n, 18).
def payload_shares(instants: _Floats, threads: int, /) -> _Floats: ...

# Tolerances are (n, 21): legs, joints. (n, 81); (n, 93): nine components, three distances, covariance; (count, 9)
def error_map(g: Geometry, c: _Poses, threads: int, /) -> _Floats: ...
def error_bounds(g: Geometry, c: _Poses, tolerances: _Floats, threads: int, /) -> _Floats: ...
def error_samples(g: Geometry, c: _Poses, tolerances: _Floats, count: int, seed: int, threads: int, /) -> _Floats: ...

# (n, 42) for twists, (n, 12) for their parts: directions, semi-axes
def velocity_ellipsoid_twist(g: Geometry, c: _Poses, length: _Floats, threads: int, /) -> _Floats: ...
def velocity_ellipsoid_rotation(g: Geometry, c: _Poses, length: _Floats, threads: int, /) -> _Floats: ...
def velocity_ellipsoid_translation(g: Geometry, c: _Poses, length: _Floats, threads: int, /) -> _Floats: ...
def force_ellipsoid_twist(g: Geometry, c: _Poses, length: _Floats, threads: int, /) -> _Floats: ...
def force_ellipsoid_rotation(g: Geometry, c: _Poses, length: _Floats, threads: int, /) -> _Floats: ...
def force_ellipsoid_translation(g: Geometry, c: _Poses, length: _Floats, threads: int, /) -> _Floats: ...
def design_family_names() -> list[str]: ...

class ConstraintInfo:
    name: str
    kind: str
    sides: tuple[str, ...]
    units: tuple[str, ...]
    options: tuple[str, ...]
    default_low: float | None
    needs: tuple[str, ...]
    is_angle: bool
    body: str

constraint_table: list[ConstraintInfo]
criterion_table: list[ConstraintInfo]
singularity_free_steps: tuple[int, int]

class VariableInfo:
    name: str
    kind: str
    low: float
    high: float

def family_variables(family: str, /) -> list[VariableInfo]: ...

class Duty(_Struct):
    loads: Any
    masses: Masses
    gravity: _Floats
    motion: PlatformMotion

class Limit(_Struct):
    name: str
    low: float
    high: float
    of: str
    axis: _Floats
    steps: int
    at: str
    duty: Duty | None
    @property
    def label(self) -> str: ...

class Pose(_Struct):
    position: Sequence[float] | _Floats
    rotation: Sequence[float] | _Floats
    internal: Sequence[float] | _Floats
    best_internal: bool
    in_zp: bool
    weight: float

class Objective(_Struct):
    index: str
    aggregate: str
    weight: float
    condition_limit: float
    neutral_condition_limit: float
    poses: list[Pose]

class Region(_Struct):
    shape: str
    size: Sequence[float] | _Floats
    corners: Sequence[Sequence[float]]
    tilt: float
    yaw: float
    shifted: bool
    placed: bool
    in_zp: bool
    tool_height: float
    @property
    def reach(self) -> list[float]: ...

class Problem:
    def __init__(
        self,
        family: str,
        bounds: Sequence[tuple[float, float]],
        limits: Sequence[Limit],
        characteristic_length: float | str | tuple[float, float],
        objective: Objective,
        tool_position: Sequence[float] = ...,
        tool_rotation: Sequence[float] = ...,
    ) -> None: ...
    @property
    def names(self) -> list[str]: ...
    def with_limits(
        self, limits: Sequence[Limit], condition_limit: float, neutral_condition_limit: float, /
    ) -> Problem: ...
    def geometry(self, x: Sequence[float], /) -> Geometry: ...
    def configurations(self, x: Sequence[float], /) -> tuple[_Floats, _Floats, _Floats]: ...
    def characteristic_length(self, x: Sequence[float], /) -> float: ...
    def exempt_pairs(self, /) -> list[bool]: ...
    def evaluate(self, x: Sequence[float], /) -> Evaluation: ...
    def starts(self, count: int, seed: int, /) -> _Floats: ...

class Margin:
    name: str
    value: float
    gradient: _Floats
    limited: float
    part: str

class Evaluation:
    objective: float
    log_objective: float
    gradient: _Floats
    condition_number: float
    conditions: list[float]
    characteristic_length: float
    margins: list[Margin]

limit_parts: dict[str, tuple[str, ...]]
limits_over_lengths: dict[str, tuple[str, ...]]
margin_tolerance: float

def limit_numbers(
    limit: Limit, geometry: Geometry, home: _Poses, c: _Poses, characteristic_length: float, /
) -> _Floats: ...
def margin(kind: str, side: str, limit: _Floats, value: _Floats, /) -> Any: ...
def spread_numbers(name: str, longest: _Floats, shortest: _Floats, /) -> _Floats: ...
def pairs_sharing_a_joint(geometry: Geometry, /) -> list[bool]: ...

class Settings:
    def __init__(
        self,
        *,
        starts: int = ...,
        seed: int = ...,
        threads: int = ...,
        max_evaluations: int = ...,
        warm: Sequence[Sequence[float]] | _Floats | None = ...,
        time_limit: float = ...,
        explain: bool = ...,
    ) -> None: ...

class PointRule(_Struct):
    scale: Sequence[float] | _Floats
    powers: Sequence[Sequence[int]]
    coefficients: Sequence[Sequence[float] | _Floats]

class PosedRobot:
    def __init__(
        self,
        geometry: Geometry,
        configurations: Configuration,
        characteristic_length: float,
        region: Region | None,
        rule: PointRule | None,
        tolerances: Tolerances | None = None,
        /,
    ) -> None: ...

class MetAt(_Struct):
    shift: _Triple
    tilt: _Triple
    yaw: float
    pose: int

class LimitOverPoses:
    name: str
    kind: str
    side: str
    limit: float
    value: tuple[float, float]
    answer: str
    which: str
    at: list[MetAt]
    at_neutral: bool
    boxes: int

class LimitsOverPoses:
    limits: list[LimitOverPoses]
    lengths: tuple[tuple[float, float], ...]

def limits_over_poses(
    machine: PosedRobot, problem: Problem, slack: float, threads: int, seconds: float, /
) -> LimitsOverPoses: ...
def error_over_poses(
    machine: PosedRobot, gap: float, threads: int, seconds: float, /
) -> tuple[tuple[float, float], tuple[float, float], tuple[float, float]]: ...

class ConditionSettings:
    def __init__(
        self,
        *,
        threads: int,
        seconds: float,
        gap: float,
        wanted: Sequence[float],
        tolerance: float,
        slice_seconds: float = ...,
        least_seconds: float = ...,
        keep_share: float = ...,
    ) -> None: ...

class ConditionState:
    low: float
    high: float
    at: MetAt
    boxes: int
    left: Sequence[Sequence[float]]
    target: float
    interrupted: bool
    def __init__(self) -> None: ...
    @property
    def left_count(self) -> int: ...

def search_condition(
    machine: PosedRobot,
    settings: ConditionSettings,
    earlier: ConditionState,
    keep: Callable[[ConditionState], object] | None,
    progress: _Progress | None,
    /,
) -> ConditionState: ...

class DesignQuestion(_Struct):
    problem: Problem
    region: Sequence[Region]
    at: Sequence[float]
    varied: Sequence[int]
    low: Sequence[float]
    high: Sequence[float]
    condition: float

class DesignSet:
    low: _Floats
    high: _Floats
    state: NDArray[int8]
    demand: NDArray[int32]
    poses: _Floats
    demands: tuple[tuple[str, str], ...]
    inside: float
    outside: float
    undecided: float
    looked_at: int
    boxes: int
    interrupted: bool

class DesignExistence:
    state: str
    design: list[float]
    looked_at: int
    open: int
    interrupted: bool
    def certificate(self, question: DesignQuestion, /) -> bytes: ...

class BeyondSide:
    demand: int
    at: MetAt

class DesignRoom:
    found: bool
    low: list[float]
    high: list[float]
    demand: int
    beyond: list[list[BeyondSide]]
    boxes: int

# Earlier pieces are those of what has the columns of a DesignSet.
def admissible_designs(
    question: DesignQuestion,
    *,
    threads: int,
    seconds: float,
    resolution: float,
    undecided: float,
    earlier: Any = ...,
    progress: _Progress | None = ...,
) -> DesignSet: ...
def any_admissible(
    question: DesignQuestion,
    *,
    threads: int = ...,
    seconds: float = ...,
    resolution: float = ...,
    certificate: bool = ...,
    progress: _Progress | None = ...,
) -> DesignExistence: ...

# The set is a ninedof.AdmissibleSet.
def design_certificate(question: DesignQuestion, set: Any) -> bytes: ...
def machine_certificate(question: DesignQuestion, *, slack: float) -> bytes: ...
def room_around(
    question: DesignQuestion,
    design: Sequence[float],
    proportions: Sequence[float],
    *,
    boxes: int,
    progress: _Progress | None = ...,
) -> DesignRoom: ...
def region_poses(region: Region, at: _Floats, /) -> _Floats: ...
def permitted_range(problem: Problem, zp: float, lengths: _Floats, /) -> LegLimits: ...

class PlacedDesign(_Struct):
    problem: Problem
    variables: Sequence[float] | _Floats
    log_index: float
    leg_ranges: LegLimits | None
    known: Sequence[Sequence[float]]

class OptimumCheck:
    residual: float
    active: int
    steps: int
    better: int
    gain: float

class RegionCheck:
    index: float
    margin: float
    excess: float
    poses: int
    mean: float
    standard_error: float

def check_optimum(problem: Problem, variables: Sequence[float], steps: int, seed: int, /) -> OptimumCheck: ...
def check_region(
    problem: Problem, region: Region, variables: Sequence[float], legs: LegLimits | None, seed: int, /
) -> RegionCheck: ...
def place_in_region(design: PlacedDesign, region: Region, at: _Floats, threads: int, /) -> tuple[_Floats, _Floats]: ...
def fit_rule(
    machine: PosedRobot, design: PlacedDesign, threads: int, phase: Callable[[str], object], /
) -> PointRule: ...

class Candidate:
    variables: _Floats
    objective: float
    neutral_condition_number: float
    conditions: tuple[float, ...]
    characteristic_length: float
    active: tuple[str, ...]
    prices: dict[str, float]
    optimality_residual: float
    constraint_violation: float
    reached: int

class Result:
    status: str
    reason: str
    causes: tuple[str, ...]
    candidates: list[Candidate]
    evaluations: int
    starts_done: int
    runs_abandoned: int
    runs_completed: int
    interrupted: bool

class RegionMean:
    nodes: int
    quadrature: float
    value: float
    error: float
    standard_error: float

class RegionReport:
    poses: list[Pose]
    rounds: int
    looked_at: int
    objective: float
    objective_at: Pose
    margin: float
    limit: str
    gain: float
    mean: RegionMean | None
    leg_ranges: LegLimits | None

class RegionResult:
    result: Result
    region: RegionReport

class Trace:
    best: tuple[float, ...]
    end: Candidate

def optimize(problem: Problem, settings: Settings, progress: _Progress | None, /) -> Result: ...
def optimize_region(
    problem: Problem,
    region: Region,
    settings: Settings,
    progress: _Progress | None,
    phase: Callable[[str], object] | None,
    /,
) -> RegionResult: ...
def trace(problem: Problem, start: Sequence[float], formulation: str, /) -> Trace: ...

class OptimumSettings(_Struct):
    target: float
    threads: int
    box_limit: int
    time_limit: float
    keep_tree: bool

class OptimumProof:
    lower_bound: float
    complete: bool
    boxes: int
    open: int
    better: float | None
    seconds: float
    interrupted: bool
    left_out: tuple[str, ...]
    certificate: bytes

class Verdict:
    proved: bool
    incomplete: bool
    words: str
    boxes: int
    recut: int
    study: tuple[str, ...]

def prove_optimum(study: Problem, settings: OptimumSettings, progress: _Progress | None, /) -> OptimumProof: ...
def check_certificate(certificate: bytes, progress: _Progress | None, seconds: float = ...) -> Verdict: ...

workspace_limits: list[str]

class OrientationRegion(_Struct):
    chart: str
    angle: float
    torsion_low: float
    torsion_high: float

class WorkspaceDomain(_Struct):
    archetype: str
    low: _Floats
    high: _Floats
    position: _Floats
    rotations: _Floats
    region: OrientationRegion

class InternalPointRule(_Struct):
    kind: str
    fraction: float
    point: _Floats

class WorkspaceCriteria(_Struct):
    legs: LegLimits | None
    limits: list[Limit]
    exempt: list[bool]
    condition_number: float | None
    characteristic_length: float

class WorkspaceQuestion:
    domain: WorkspaceDomain
    rule: InternalPointRule
    criteria: WorkspaceCriteria
    home: Configuration | None
    def __init__(self, geometry: Geometry, /, **attributes: Any) -> None: ...
    @property
    def geometry(self) -> Geometry: ...

class WorkspaceSettings(_Struct):
    method: str
    tolerance: float
    resolution: int
    most_evaluations: int
    points: int
    shifts: int
    seed: int
    threads: int

class WorkspaceCells:
    centre: _Floats
    state: NDArray[uint8]
    limit: NDArray[int16]
    fraction: _Floats
    condition_number: _Floats
    piece: NDArray[int32]

class WorkspaceMap:
    status: str
    volume: float
    error: float
    unseen: float
    chart_volume: float
    box_limits: bool
    home_allowed: bool
    home_limit: str
    pieces: _Floats
    ball_centre: _Floats
    ball_radius: float
    box_low: _Floats
    box_high: _Floats
    conditioning_index: float
    conditioning_index_error: float
    worst_condition_number: float
    worst_at: _Floats
    percentiles: _Floats
    boundary_area: float
    limit_area: _Floats
    levels: _Floats
    cells: WorkspaceCells
    sides: _Floats
    low: _Floats
    high: _Floats
    evaluations: int
    internal_point_audit: MapAudit

def workspace(
    question: WorkspaceQuestion, settings: WorkspaceSettings, progress: _Progress | None, /
) -> WorkspaceMap: ...

class CertifySettings(_Struct):
    gap: float
    seconds: float
    threads: int
    boxes: int

class CertifiedWorkspace:
    end: str
    volume: tuple[float, float]
    home_volume: tuple[float, float]
    home: str
    beyond: str
    box_low: _Floats
    box_high: _Floats
    low: _Floats
    high: _Floats
    inner_low: _Floats
    inner_high: _Floats
    open_low: _Floats
    open_high: _Floats
    open_volume: _Floats
    first_cut: NDArray[int64]
    cuts: _Floats
    looked: int

def certified_workspace(
    question: WorkspaceQuestion, settings: CertifySettings, progress: _Progress | None, /
) -> CertifiedWorkspace: ...
def workspace_certificate(question: WorkspaceQuestion, found: CertifiedWorkspace, /) -> bytes: ...
def certified_states(certified: Any, points: _Floats, /) -> NDArray[int8]: ...

class RegionShare:
    share: float
    looked_at: int
    passed: tuple[str, ...]

def region_share(question: WorkspaceQuestion, region: Region, count: int, /) -> RegionShare: ...
def spread_rotations(count: int, angle: float) -> _Floats: ...

class TwistMotion(_Struct):
    twist: Sequence[float] | _Floats
    rate: Sequence[float] | _Floats

class PlatformMotion(_Struct):
    internal: str
    linear_speed: float
    angular_speed: float
    given: TwistMotion | None

class Weight(_Struct):
    mass: float
    centre: Sequence[float] | _Floats
    gravity: Sequence[float] | _Floats

class Tolerances(_Struct):
    legs: _Floats
    joints: Sequence[float] | _Floats

class PayloadLimits(_Struct):
    push: _Floats
    pull: _Floats
    centre: Sequence[float] | _Floats
    gravity: Sequence[float] | _Floats

class SheetQuestion:
    limits: Sequence[Limit]
    exempt: Sequence[bool]
    motion: PlatformMotion | None
    loads: Any
    weight: Weight | None
    masses: Masses | None
    gravity: Sequence[float] | _Floats
    payload: PayloadLimits | None
    errors: Tolerances | None
    leg_stiffness: _Floats | None
    characteristic_length: float | None
    locked: Any
    def __init__(self, geometry: Geometry, neutral: Configuration, /, **attributes: Any) -> None: ...

class SheetRegion:
    worst: _Floats
    looked_at: int
    mean: float
    mean_error: float

def sheet_numbers(question: SheetQuestion, c: _Poses, /) -> dict[str, _Floats]: ...
def sheet_over_region(
    question: SheetQuestion, region: Region, samples: int, placed: PlacedDesign | None, /
) -> SheetRegion: ...
def even_poses(region: Region, count: int, /) -> _Floats: ...
def leg_lengths_over(
    g: Geometry, neutral: Configuration, region: Region, samples: int, /
) -> tuple[_Floats, _Floats]: ...

_Axes = tuple[_Floats, _Floats, _Floats]

class WorkspaceSurface:
    @property
    def points(self) -> _Floats: ...
    @property
    def faces(self) -> NDArray[int64]: ...
    @property
    def normals(self) -> _Floats: ...
    @property
    def volume(self) -> float: ...

class WorkspaceField:
    def __init__(self, axes: Sequence[_Floats], fraction: _Floats, condition_number: _Floats) -> None: ...
    @property
    def axes(self) -> _Axes: ...
    @property
    def fraction(self) -> _Floats: ...
    @property
    def condition_number(self) -> _Floats: ...
    def surface(self) -> WorkspaceSurface: ...

class WorkspaceSection:
    horizontal: _Floats
    vertical: _Floats
    state: NDArray[uint8]
    limit: NDArray[int16]
    condition_number: _Floats
    fraction: _Floats

# Maps are ninedof.workspace.WorkspaceMap.
def workspace_field(map: Any, most: int, /) -> WorkspaceField: ...
def cell_section(map: Any, fixed: int, at: float, pixels: int, /) -> WorkspaceSection: ...
def field_section(map: Any, field: WorkspaceField, fixed: int, at: float, /) -> WorkspaceSection: ...

class IndexStatistics:
    mean: float
    least: float
    least_at: list[float]
    greatest: float
    greatest_at: list[float]

class WorkspacePoses:
    @property
    def configurations(self) -> Configuration: ...
    def statistics(self, values: _Floats, by_modulus: bool, /) -> IndexStatistics: ...

def workspace_poses(question: WorkspaceQuestion, map: Any, first_piece_alone: bool, /) -> WorkspacePoses: ...
