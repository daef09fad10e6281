"""The table: a good call of each public name of `ninedof`, with every argument that it takes."""

import entry_things as it
import numpy as np
from entry_engine import Row

import ninedof as nd

ROWS = {}
TWIST = {"omega": [0.1, 0.2, 0.3], "pdot": [1.0, 2.0, 3.0], "sdot": [0.5, 0.25, 0.125]}
RATES = np.linspace(-1.0, 1.0, 9)


def row(name, call=None, *, of=None, **options):
    """Add a row; arguments are given as a function, special things about the row as keywords."""

    def add(arguments, **more):
        def made():
            return dict(arguments())

        target = call or getattr(nd, name)
        ROWS[of or name] = Row(target, made, **options, **more)
        return arguments

    return add


def robot(**others):
    """Geometry and configuration, then other arguments."""
    return lambda: {"geometry": it.g(), "configuration": it.c(), **others}


def on_the_axis(**others):
    return lambda: {"geometry": it.g(), "configuration": it.on_axis(), **others}


# Numbers whose squares overflow give inf - inf: NaN says so, and no wrong number comes of it.
OVERFLOW = {"nan": ("characteristic_length", "leg_rates", "omega", "zs", "leg_errors", "joint_errors")}
LENGTH = {"characteristic_length": 1.25}
THREADS = {"threads": 1}


def index(name, **others):
    row(name, loose=("out",), **OVERFLOW)(lambda: {**robot(**LENGTH, **THREADS, **others)(), "out": np.zeros(())})


# --- one robot, one configuration -------------------------------------------------------------------------------------

row("leg_lengths", loose=("out",))(lambda: {**robot(**THREADS)(), "out": np.zeros(9)})
row("velocity_matrices")(robot(**LENGTH))
row("jacobian")(robot(**LENGTH))
row("forward_velocity")(robot(leg_rates=RATES))
row("inverse_velocity")(robot(**TWIST, weights=None))
row("inverse_velocity", of="inverse_velocity: O chosen")(
    robot(omega=TWIST["omega"], pdot=TWIST["pdot"], sdot=None, weights=np.arange(1.0, 10.0))
)
row("internal_velocity")(robot(omega=TWIST["omega"], pdot=TWIST["pdot"], weights=np.arange(1.0, 10.0)))
row("null_motion")(robot())
row("forward_acceleration", **OVERFLOW)(robot(leg_rates=RATES, leg_accelerations=RATES))
row("inverse_acceleration", **OVERFLOW)(robot(**TWIST, alpha=TWIST["omega"], pddot=TWIST["pdot"], sddot=TWIST["sdot"]))
row("jacobian_rate")(robot(**TWIST, **LENGTH))
index("condition_number", norm="2")
for name in ("reciprocal_condition_number", "manipulability", "isotropy_residual"):
    index(name)
row("singular_values", loose=("out",), **OVERFLOW)(lambda: {**robot(**LENGTH, **THREADS)(), "out": np.zeros(6)})
row("axis_singular_values", **OVERFLOW)(on_the_axis(**LENGTH))
row("characteristic_length")(robot(kind="optimal"))
DESIGN = {"a1": 0.25, "a2": 5.75, "b1": 3.0, "b2": 0.25, "zp": 4.0, "zs": 2.375}
row("hexagonal_condition_number", **OVERFLOW)(lambda: {**DESIGN, **THREADS})
row("hexagonal_condition_number", of="hexagonal_condition_number: stacks", **OVERFLOW)(
    lambda: {**{name: np.full(2, value) for name, value in DESIGN.items()}, "threads": 1}
)
row("forward_position")(lambda: {"geometry": it.g(), "leg_lengths": it.lengths(), "certify": True, **THREADS})
row("track", nan=("leg_lengths",))(
    lambda: {"geometry": it.g(), "leg_lengths": np.stack([it.lengths()] * 2), "start": it.c(), **THREADS}
)
row("singularity_margins", loose=("out",))(lambda: {**robot(**THREADS)(), "out": np.zeros(3)})
row("singularity")(robot(**THREADS))
row("architecture_singularity")(lambda: {"geometry": it.g()})
row("uncontrolled_motions")(robot(tolerance=1e-9))
row("distance_to_singularity")(robot(direction=RATES, most=1.0, **THREADS))
row("nearest_singularity")(
    robot(part="position", most=2.0, directions=3, **THREADS),
)
row("leg_forces")(robot(moment=[0.0, 0.0, 1.0], force=[0.0, 1.0, -9.0], force_at_o=[0.0, 0.5, 0.0]))
row("inverse_dynamics", nan=("motion", "load"), words={"motion": ("velocity", "acceleration")})(
    robot(
        motion=(RATES, RATES),
        masses=nd.Masses(platform=2.0, cylinder=0.5, cylinder_centre=0.2),
        gravity=[0.0, 0.0, -9.81],
        load=[0.0, 0.0, 1.0, 0.0, 1.0, -9.0],
        unit="m",
    )
)
row("self_stress")(robot())
row("stiffness")(robot(leg_stiffness=np.arange(1.0, 10.0), internal=False))
row("error_map")(robot())
row("error_bounds", **OVERFLOW)(
    robot(leg_errors=np.full(9, 1e-3), joint_errors=np.full(12, 1e-3), distribution="normal")
)
row("error_samples", huge=("samples",), words={"leg_errors": ("leg_lengths",)}, **OVERFLOW)(
    robot(leg_errors=np.full(9, 1e-3), joint_errors=np.full(12, 1e-3), samples=3, seed=1, threads=1)
)
row("velocity_ellipsoid", **OVERFLOW)(robot(part="translation", **LENGTH))
row("force_ellipsoid", **OVERFLOW)(robot(part="translation", **LENGTH))

# --- proved numbers ---------------------------------------------------------------------------------------------------

for name in ("leg_length_bounds", "determinant_bounds"):
    row(name)(robot(**THREADS))
for name in ("condition_number_bounds", "singular_value_bounds", "jacobian_bounds"):
    row(name)(robot(**LENGTH, **THREADS))
row("axis_condition_number_bounds")(on_the_axis(**LENGTH, **THREADS))
row("hexagonal_condition_number_bounds")(lambda: {**DESIGN, **THREADS})
