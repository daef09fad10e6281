"""The compiled core. Private: use the names of `ninedof`.

Configurations come as three flat arrays: position (n, 3), rotation (n, 3, 3), internal point (n, 3), C-contiguous
float64; characteristic lengths as one value or n.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from numpy import float64, int8, int16, int64, intc, uint8
from numpy.typing import ArrayLike, NDArray

_Floats = NDArray[float64]
_Out = _Floats | None
_Nearest = tuple[float, float, _Floats, int, _Floats]
_Triple = tuple[float, float, float]
_LimitBreak = tuple[str, float, float, float, float]
_Range = tuple[str, Sequence[float], Sequence[float], float]
_Progress = Callable[[int, int, float | None], object]

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
def leg_lengths(g: Geometry, p: _Floats, q: _Floats, s: _Floats, threads: int, out: _Out, /) -> _Floats: ...
def idle_legs(shortest: _Floats, longest: _Floats) -> list[bool]: ...

idle_share: float

def jacobian(g: Geometry, p: _Floats, q: _Floats, s: _Floats, length: _Floats, threads: int, /) -> _Floats: ...
def velocity_matrices(g: Geometry, p: _Floats, q: _Floats, s: _Floats, length: _Floats, threads: int, /) -> _Floats: ...
def forward_velocity(g: Geometry, p: _Floats, q: _Floats, s: _Floats, rates: _Floats, threads: int, /) -> _Floats: ...
def forward_position(
    g: Geometry, leg_lengths: _Floats, threads: int, /
) -> tuple[NDArray[intc], list[str], list[str], NDArray[uint8], _Floats, _Floats, NDArray[intc]]: ...
def track(
    g: Geometry, leg_lengths: _Floats, path: int, p: _Floats, q: _Floats, s: _Floats, threads: int, /
) -> tuple[_Floats, NDArray[uint8]]: ...

track_statuses: list[str]
internal_point_statuses: list[str]

# "internal_point" (n, 3), "value", "status", "active" (n,); "active_names" has the words for each key in "active".
def best_internal_point(
    g: Geometry, position: _Floats, rotation: _Floats, start: _Floats, problem: dict[str, Any], threads: int, /
) -> dict[str, Any]: ...
def best_internal_path(
    g: Geometry, position: _Floats, rotation: _Floats, start: _Floats, problem: dict[str, Any], smoothness: float, /
) -> dict[str, Any]: ...

# The same and "audit", "searched" and "followed".
def best_internal_map(
    g: Geometry,
    position: _Floats,
    rotation: _Floats,
    shape: Sequence[int],
    start: _Floats,
    problem: dict[str, Any],
    settings: dict[str, Any],
    progress: _Progress | None,
    /,
) -> dict[str, Any]: ...

# The fields of `Followed` that are computed; "singularity_margins" (3, n), "leg_forces" (0, 9) without loads, "tracked"
# the number of poses. The trajectory is `time`, `position` and `rotation`.
def follow(
    g: Geometry,
    home_p: _Floats,
    home_q: _Floats,
    home_s: _Floats,
    time: _Floats,
    position: _Floats,
    rotation: _Floats,
    rule: str | float,
    limits: tuple[_Floats, _Floats],
    characteristic_length: float,
    loads: _Floats,
    /,
) -> dict[str, Any]: ...
def leg_margins(leg_lengths: _Floats, low: _Floats, high: _Floats, /) -> _Floats: ...
def stretches(
    limit: str, time: _Floats, values: _Floats, margin: _Floats, tolerance: float, /
) -> list[_LimitBreak]: ...
def limit_breaks(
    time: _Floats, leg_lengths: _Floats, low: _Floats, high: _Floats, determinants: _Floats, /
) -> list[_LimitBreak]: ...
def inverse_velocity(
    g: Geometry, p: _Floats, q: _Floats, s: _Floats, velocity: _Floats, threads: int, /
) -> _Floats: ...

# (n, 3), (n, 27)
def internal_velocity(
    g: Geometry, p: _Floats, q: _Floats, s: _Floats, twist: _Floats, weights: _Floats, threads: int, /
) -> _Floats: ...
def null_motion(g: Geometry, p: _Floats, q: _Floats, s: _Floats, threads: int, /) -> _Floats: ...

# (n, 9), (n, 9), (n, 54)
def forward_acceleration(
    g: Geometry, p: _Floats, q: _Floats, s: _Floats, rates: _Floats, accelerations: _Floats, threads: int, /
) -> _Floats: ...
def inverse_acceleration(
    g: Geometry, p: _Floats, q: _Floats, s: _Floats, velocity: _Floats, acceleration: _Floats, threads: int, /
) -> _Floats: ...
def jacobian_rate(
    g: Geometry, p: _Floats, q: _Floats, s: _Floats, velocity: _Floats, length: _Floats, threads: int, /
) -> _Floats: ...

# (n, 6), (n, 6), and (n, 1) for the indices, which write into `out` if it is not None
def singular_values(
    g: Geometry, p: _Floats, q: _Floats, s: _Floats, length: _Floats, threads: int, out: _Out, /
) -> _Floats: ...
def hexagonal_condition_numbers(designs: _Floats, threads: int, out: _Out, /) -> _Floats: ...
def simd_level() -> str: ...
def interval_operations(name: str, operands: _Floats, /) -> _Floats: ...
def leg_length_bounds(g: Geometry, p: _Floats, q: _Floats, s: _Floats, threads: int, /) -> _Floats: ...
def determinant_bounds(g: Geometry, p: _Floats, q: _Floats, s: _Floats, threads: int, /) -> _Floats: ...
def condition_number_bounds(
    g: Geometry, p: _Floats, q: _Floats, s: _Floats, length: _Floats, threads: int, /
) -> _Floats: ...
def axis_condition_number_bounds(
    g: Geometry, p: _Floats, q: _Floats, s: _Floats, length: _Floats, threads: int, /
) -> _Floats: ...
def singular_value_bounds(
    g: Geometry, p: _Floats, q: _Floats, s: _Floats, length: _Floats, threads: int, /
) -> _Floats: ...
def jacobian_bounds(g: Geometry, p: _Floats, q: _Floats, s: _Floats, length: _Floats, threads: int, /) -> _Floats: ...
def hexagonal_condition_number_bounds(designs: _Floats, threads: int, /) -> _Floats: ...
def axis_singular_values(
    g: Geometry, p: _Floats, q: _Floats, s: _Floats, length: _Floats, threads: int, /
) -> _Floats: ...
def condition_number_two(
    g: Geometry, p: _Floats, q: _Floats, s: _Floats, length: _Floats, threads: int, out: _Out, /
) -> _Floats: ...
def condition_number_frobenius(
    g: Geometry, p: _Floats, q: _Floats, s: _Floats, length: _Floats, threads: int, out: _Out, /
) -> _Floats: ...
def reciprocal_condition_number(
    g: Geometry, p: _Floats, q: _Floats, s: _Floats, length: _Floats, threads: int, out: _Out, /
) -> _Floats: ...
def manipulability(
    g: Geometry, p: _Floats, q: _Floats, s: _Floats, length: _Floats, threads: int, out: _Out, /
) -> _Floats: ...
def isotropy_residual(
    g: Geometry, p: _Floats, q: _Floats, s: _Floats, length: _Floats, threads: int, out: _Out, /
) -> _Floats: ...
def characteristic_length(g: Geometry, p: _Floats, q: _Floats, s: _Floats, kind: str, threads: int, /) -> _Floats: ...

# (n, 3), (n, 16), (k, 9), (n, 6)
def singularity_margins(g: Geometry, p: _Floats, q: _Floats, s: _Floats, threads: int, out: _Out, /) -> _Floats: ...
def singularity(g: Geometry, p: _Floats, q: _Floats, s: _Floats, threads: int, /) -> _Floats: ...
def uncontrolled_motions(g: Geometry, p: _Floats, q: _Floats, s: _Floats, tolerance: float, /) -> _Floats: ...
def distance_to_singularity(
    g: Geometry, p: _Floats, q: _Floats, s: _Floats, direction: _Floats, most: float, threads: int, /
) -> _Floats: ...

# Motions are (9, 3); distance, code of the mechanism, direction (3,), pose, the motion (9,) that leads there.
def nearest_singularity(
    g: Geometry, p: _Floats, q: _Floats, s: _Floats, motions: _Floats, most: float, directions: int, threads: int, /
) -> _Nearest: ...
def nearest_singularities(
    g: Geometry, p: _Floats, q: _Floats, s: _Floats, internal_held: bool, /
) -> tuple[_Nearest, _Nearest, _Nearest]: ...

# (n, 18): forces and what is unbalanced; (9, k); (n, 36); (n, 81)
def leg_forces(g: Geometry, p: _Floats, q: _Floats, s: _Floats, load: _Floats, threads: int, /) -> _Floats: ...
def self_stress(g: Geometry, p: _Floats, q: _Floats, s: _Floats, /) -> _Floats: ...
def stiffness(g: Geometry, p: _Floats, q: _Floats, s: _Floats, legs: _Floats, threads: int, /) -> _Floats: ...
def stiffness_with_o(g: Geometry, p: _Floats, q: _Floats, s: _Floats, legs: _Floats, threads: int, /) -> _Floats: ...

# Tolerances are (n, 21): legs, joints. (n, 81); (n, 93): nine components, three distances, covariance; (count, 9)
def error_map(g: Geometry, p: _Floats, q: _Floats, s: _Floats, threads: int, /) -> _Floats: ...
def error_bounds(g: Geometry, p: _Floats, q: _Floats, s: _Floats, tolerances: _Floats, threads: int, /) -> _Floats: ...
def error_samples(
    g: Geometry,
    p: _Floats,
    q: _Floats,
    s: _Floats,
    tolerances: _Floats,
    count: int,
    seed: int,
    threads: int,
    /,
) -> _Floats: ...

# (n, 42) for twists, (n, 12) for their parts: directions, semi-axes
def velocity_ellipsoid_twist(
    g: Geometry, p: _Floats, q: _Floats, s: _Floats, length: _Floats, threads: int, /
) -> _Floats: ...
def velocity_ellipsoid_rotation(
    g: Geometry, p: _Floats, q: _Floats, s: _Floats, length: _Floats, threads: int, /
) -> _Floats: ...
def velocity_ellipsoid_translation(
    g: Geometry, p: _Floats, q: _Floats, s: _Floats, length: _Floats, threads: int, /
) -> _Floats: ...
def force_ellipsoid_twist(
    g: Geometry, p: _Floats, q: _Floats, s: _Floats, length: _Floats, threads: int, /
) -> _Floats: ...
def force_ellipsoid_rotation(
    g: Geometry, p: _Floats, q: _Floats, s: _Floats, length: _Floats, threads: int, /
) -> _Floats: ...
def force_ellipsoid_translation(
    g: Geometry, p: _Floats, q: _Floats, s: _Floats, length: _Floats, threads: int, /
) -> _Floats: ...
def design_family_names() -> list[str]: ...

_Row = tuple[str, str, tuple[str, ...], tuple[str, ...], tuple[str, ...], float | None]
constraint_table: tuple[_Row, ...]
criterion_table: tuple[_Row, ...]
singularity_free_steps: tuple[int, int]

def family_variables(family: str, /) -> list[tuple[str, str, float, float]]: ...

class Problem:
    def __init__(
        self,
        family: str,
        bounds: Sequence[tuple[float, float]],
        limits: Sequence[dict[str, Any]],
        characteristic_length: float | str | tuple[float, float],
        objective: dict[str, Any],
    ) -> None: ...
    @property
    def names(self) -> list[str]: ...
    def geometry(self, x: Sequence[float], /) -> Geometry: ...
    def configurations(self, x: Sequence[float], /) -> tuple[_Floats, _Floats, _Floats]: ...
    def characteristic_length(self, x: Sequence[float], /) -> float: ...
    def exempt_pairs(self, /) -> list[bool]: ...
    def evaluate(self, x: Sequence[float], /) -> dict[str, Any]: ...
    def starts(self, count: int, seed: int, /) -> _Floats: ...

limit_parts: dict[str, tuple[str, ...]]
limits_over_lengths: tuple[str, ...]
margin_tolerance: float

def limit_numbers(
    name: str,
    axis: Sequence[float],
    geometry: Geometry,
    home_position: _Floats,
    home_rotation: _Floats,
    home_internal_point: _Floats,
    position: _Floats,
    rotation: _Floats,
    internal_point: _Floats,
    /,
) -> _Floats: ...
def pairs_sharing_a_joint(geometry: Geometry, /) -> list[bool]: ...

# `optimize` returns the fields of `ninedof.Result` that the core knows, `trace` objectives and those of a `Candidate`.
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
    ) -> None: ...

class PointRule:
    def __init__(
        self,
        scale: Sequence[float],
        powers: Sequence[Sequence[int]],
        coefficients: Sequence[Sequence[float]],
        /,
    ) -> None: ...
    @property
    def scale(self) -> list[float]: ...
    @property
    def powers(self) -> list[list[int]]: ...
    @property
    def coefficients(self) -> list[_Triple]: ...

class PosedRobot:
    def __init__(
        self,
        geometry: Geometry,
        position: _Floats,
        rotation: _Floats,
        internal_point: _Floats,
        characteristic_length: float,
        region: Mapping[str, Any] | None,
        rule: PointRule | None,
        /,
    ) -> None: ...

class MetAt:
    def __init__(self, shift: Sequence[float], tilt: Sequence[float], yaw: float, pose: int, /) -> None: ...
    @property
    def shift(self) -> _Triple: ...
    @property
    def tilt(self) -> _Triple: ...
    @property
    def yaw(self) -> float: ...
    @property
    def pose(self) -> int: ...

def limits_over_poses(
    machine: PosedRobot, problem: Problem, tolerance: float, threads: int, seconds: float, /
) -> tuple[
    list[tuple[str, str, str, float, tuple[float, float], str, str, list[MetAt], bool, int]],
    list[tuple[float, float]],
]: ...

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
def region_pose(region: dict[str, Any], at: Sequence[float], /) -> tuple[_Triple, _Triple, _Triple]: ...
def region_poses(region: dict[str, Any], at: _Floats, /) -> _Floats: ...
def search_region(
    problem: Problem, region: dict[str, Any], variables: Sequence[float], samples: int, seed: int, threads: int, /
) -> dict[str, Any]: ...
def leg_ranges(problem: Problem, zp: float, lengths: _Floats, /) -> list[_Range]: ...
def search_region_placed(
    problem: Problem,
    region: dict[str, Any],
    variables: Sequence[float],
    log_index: float,
    ranges: Sequence[_Range],
    known: Sequence[tuple[Sequence[float], Sequence[float]]],
    samples: int,
    seed: int,
    threads: int,
    /,
) -> dict[str, Any]: ...
def place_in_region(
    problem: Problem,
    region: dict[str, Any],
    variables: Sequence[float],
    log_index: float,
    ranges: Sequence[_Range],
    known: Sequence[Sequence[float]],
    at: _Floats,
    threads: int,
    /,
) -> tuple[_Floats, _Floats]: ...

class OptimumCheck:
    @property
    def residual(self) -> float: ...
    @property
    def active(self) -> int: ...
    @property
    def steps(self) -> int: ...
    @property
    def better(self) -> int: ...
    @property
    def gain(self) -> float: ...

class RegionCheck:
    @property
    def index(self) -> float: ...
    @property
    def margin(self) -> float: ...
    @property
    def excess(self) -> float: ...
    @property
    def poses(self) -> int: ...
    @property
    def mean(self) -> float: ...
    @property
    def standard_error(self) -> float: ...

def check_optimum(problem: Problem, variables: Sequence[float], steps: int, seed: int, /) -> OptimumCheck: ...
def check_region(
    problem: Problem,
    region: dict[str, Any],
    variables: Sequence[float],
    leg_ranges: Sequence[Sequence[float]],
    seed: int,
    /,
) -> RegionCheck: ...

class RuleTask:
    def __init__(
        self,
        machine: PosedRobot,
        problem: Problem,
        variables: Sequence[float],
        log_index: float,
        ranges: Sequence[_Range],
        known: Sequence[Sequence[float]],
        /,
    ) -> None: ...

def fit_rule(task: RuleTask, threads: int, phase: Callable[[str], object], /) -> PointRule: ...
def optimize(problem: Problem, settings: Settings, progress: _Progress | None, /) -> dict[str, Any]: ...
def optimize_region(
    problem: Problem,
    region: dict[str, Any],
    settings: Settings,
    progress: _Progress | None,
    phase: Callable[[str], object] | None,
    /,
) -> dict[str, Any]: ...
def trace(problem: Problem, start: Sequence[float], formulation: str, /) -> tuple[list[float], dict[str, Any]]: ...
def prove_optimum(
    study: Problem,
    target: float,
    threads: int,
    box_limit: int,
    time_limit: float,
    keep_tree: bool,
    progress: _Progress | None,
    /,
) -> dict[str, Any]: ...
def check_certificate(certificate: bytes, progress: _Progress | None, /) -> tuple[bool, str, int, int, list[str]]: ...

workspace_limits: list[str]

def workspace(
    g: Geometry,
    domain: dict[str, Any],
    kind: str,
    fraction: float,
    point: _Floats,
    criteria: dict[str, Any],
    settings: dict[str, Any],
    home: tuple[_Floats, _Floats, _Floats] | None,
    progress: _Progress | None,
) -> dict[str, Any]: ...
def certified_workspace(
    g: Geometry,
    domain: dict[str, Any],
    kind: str,
    fraction: float,
    point: _Floats,
    criteria: dict[str, Any],
    settings: dict[str, Any],
    home: tuple[_Floats, _Floats, _Floats] | None,
    progress: _Progress | None,
) -> dict[str, Any]: ...
def region_share(
    g: Geometry,
    home: tuple[_Floats, _Floats, _Floats],
    criteria: Mapping[str, Any],
    region: Mapping[str, Any],
    count: int,
    /,
) -> tuple[float, int, tuple[str, ...]]: ...
def spread_rotations(count: int, angle: float) -> _Floats: ...

class PlatformMotion:
    def __init__(
        self,
        internal: str,
        linear_speed: float,
        angular_speed: float,
        given: tuple[Sequence[float], Sequence[float]] | None,
    ) -> None: ...

class SheetQuestion:
    def __init__(
        self,
        geometry: Geometry,
        position: _Floats,
        rotation: _Floats,
        internal_point: _Floats,
        limits: Sequence[tuple[str, Sequence[float]]],
        exempt: Sequence[bool],
        motion: PlatformMotion,
        loads: Sequence[Sequence[float]],
        weight: tuple[float, Sequence[float], Sequence[float]] | None,
        errors: tuple[Sequence[float] | _Floats, Sequence[float] | _Floats] | None,
        leg_stiffness: Sequence[float] | _Floats | None,
        characteristic_length: float | None,
    ) -> None: ...

def sheet_numbers(question: SheetQuestion, p: _Floats, q: _Floats, s: _Floats, /) -> list[tuple[str, _Floats]]: ...
def sheet_over_region(
    question: SheetQuestion, region: dict[str, Any], samples: int, placing: tuple[Any, ...] | None, /
) -> tuple[_Floats, int, float, float]: ...
def leg_lengths_over(
    g: Geometry, p: _Floats, q: _Floats, s: _Floats, region: dict[str, Any], samples: int, /
) -> tuple[_Floats, _Floats]: ...
def certified_states(certified: Any, points: _Floats, /) -> NDArray[int8]: ...

_Ends = tuple[_Floats, _Floats]
_Axes = tuple[_Floats, _Floats, _Floats]
_Section = tuple[_Floats, _Floats, NDArray[uint8], NDArray[int16], _Floats, _Floats]

# Cells, fields and surfaces are the tuples of ninedof.workspace.
def workspace_field(cells: Any, ends: _Ends, most: int, /) -> tuple[_Axes, _Floats, _Floats]: ...
def workspace_surface(field: Any, /) -> tuple[_Floats, NDArray[int64]]: ...
def cell_section(cells: Any, ends: _Ends, fixed: int, at: float, pixels: int, /) -> _Section: ...
def field_section(cells: Any, ends: _Ends, field: Any, fixed: int, at: float, /) -> _Section: ...
def surface_normals(surface: Any, /) -> _Floats: ...
def enclosed_volume(surface: Any, /) -> float: ...

class WorkspacePoses:
    @property
    def position(self) -> _Floats: ...
    @property
    def rotation(self) -> _Floats: ...
    @property
    def internal_point(self) -> _Floats: ...
    def statistics(
        self, values: _Floats, by_modulus: bool, /
    ) -> tuple[float, float, list[float], float, list[float]]: ...

def workspace_poses(
    g: Geometry,
    domain: Mapping[str, Any],
    kind: str,
    fraction: float,
    point: _Floats,
    cells: Any,
    ends: _Ends,
    first_piece_alone: bool,
    /,
) -> WorkspacePoses: ...
