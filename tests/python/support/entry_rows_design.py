"""The table, second part: robots, studies, searches, workspaces."""

import entry_things as it
import numpy as np
from entry_rows import RATES, row

import ninedof as nd
from ninedof import poses
from ninedof.design.duty import DUTIES
from ninedof.design.limits import Limit

TRIPLE = [[1.0, 0.0, 0.0], [-0.5, 1.0, 0.0], [-0.5, -1.0, 0.0]]
TRIPLES = ("base_external", "base_internal", "platform_external", "platform_internal")

# --- robots and configurations ----------------------------------------------------------------------------------------

row("Geometry")(lambda: {name: np.array(TRIPLE) for name in TRIPLES})
row("Geometry.hexagonal", nd.Geometry.hexagonal, words={name: TRIPLES for name in ("a1", "a2", "b1", "b2")})(
    lambda: {"a1": 0.0, "a2": 5.75, "b1": 3.0, "b2": 0.0}
)
row("Geometry.symmetric", nd.Geometry.symmetric)(lambda: {name: np.array(TRIPLE[0]) for name in TRIPLES})
row("Configuration")(
    lambda: {"position": [0.0, 0.0, 4.0], "rotation": np.eye(3), "internal_point": np.array([0.0, 0.0, 2.0])}
)
row("Configuration.neutral", nd.Configuration.neutral)(lambda: {"zp": 4.0, "zs": np.array([2.0, 2.5]), "theta_z": 0.25})
row(
    "Configuration.moved", lambda **a: it.c().moved(**a), words={"tangent": ("position", "rotation", "internal_point")}
)(lambda: {"tangent": RATES})

OF_ROBOT = (
    *TRIPLES,
    *"a1 a2 b1 b2 zp zs variables position internal_point".split(),
)  # what variables make, and those left out

# --- studies ----------------------------------------------------------------------------------------------------------

DUTY = {
    "about": {"project": "a head", "author": "N", "revision": "B"},
    "tool": {"position": (0.0, 0.1, 0.2), "rotation": (0.0, 0.0, 0.5)},
    "loads": {"gravity": (0.0, 0.0, 9.81), "wrenches": ((0.0, 0.0, 0.0, 0.0, 0.0, -5.0),)},
    "masses": {
        **{"platform": 5.0, "centre": (0.0, 0.1, 0.0), "inertia": (1.0, 1.0, 1.5, 0.0, 0.1, 0.0), "cylinder": 2.0},
        **{"rod": 1.0, "cylinder_centre": 0.3, "rod_centre": 0.2, "cylinder_inertia": 0.1, "rod_inertia": 0.1},
        "internal_point": 0.5,
    },
    "speeds": {"linear": 2.0, "angular": 0.5, "acceleration": 1.0, "angular_acceleration": 0.25},
    "tolerances": {"joints": 0.02, "legs": 0.01},
}
ACTUATOR = {"name": "A", "shortest": 2.0, "longest": 5.0, "force": 80.0, "rate": 1.5, "price": 100.0}

row("Study")(
    lambda: {
        "family": "hexagonal",
        "variables": {"a1": 0.0, "theta_z": (-0.5, 0.5)},
        "constraints": {"radius_ratio": (None, 2.0), "base_cone": {"max_deg": 60.0, "axis": [0.0, 0.0, 1.0]}},
        "characteristic_length": 1.25,
        "starts": 1,
        "seed": 0,
        "objective": {"index": "condition_number", "poses": [{"position": [0.1, 0.0, 0.0], "unit": "zp"}]},
        "unit": "mm",
        "actuators": [dict(ACTUATOR)],
        "actuators_for": "all",
        "greatest_price": 900.0,
        **{name: kind(**DUTY[name]).to_dict() for name, kind in DUTIES.items()},
    },
    words={"variables": OF_ROBOT, "characteristic_length": OF_ROBOT},
)
for name, kind in DUTIES.items():
    row(kind.__name__)(DUTY[name].copy)
    row(f"{kind.__name__}.from_dict", kind.from_dict, words={"data": (name,)})(
        lambda kind=kind, name=name: {"data": kind(**DUTY[name]).to_dict()}
    )
row("Actuator")(ACTUATOR.copy)
row("Actuator.from_dict", nd.Actuator.from_dict, words={"data": ("actuator",)})(lambda: {"data": dict(ACTUATOR)})
row("Actuator.is_as_good_as", nd.Actuator(**ACTUATOR).is_as_good_as)(lambda: {"other": nd.Actuator(**ACTUATOR)})
row("Study.with_actuators", lambda **a: it.study().with_actuators(**a))(
    lambda: {"rows": {"external": nd.Actuator(**ACTUATOR)}}
)
row("Tool.seen", nd.Tool(**DUTY["tool"]).seen)(lambda: {"point": (1.0, 2.0, 3.0)})
ROBOT = {"geometry": it.g(), "configuration": it.c()}
row("Tool.turned", nd.Tool(**DUTY["tool"]).turned)(lambda: {"direction": (1.0, 2.0, 3.0)})
row("Tool.own", nd.Tool(**DUTY["tool"]).own)(lambda: {"points": np.array([1.0, 2.0, 3.0])})
row("Tool.robot", nd.Tool(**DUTY["tool"]).robot)(ROBOT.copy)
row("Tool.plates", nd.Tool(**DUTY["tool"]).plates)(lambda: {"geometry": it.g()})
row("Tool.plate", nd.Tool(**DUTY["tool"]).plate)(lambda: {"configuration": it.c()})
row("Tool.words", nd.Tool(**DUTY["tool"]).words)(lambda: {"unit": "mm"})
row("Tool.remark", nd.Tool(**DUTY["tool"]).remark)(lambda: {"unit": "mm"})
row("Study.leg_limits", lambda **a: it.study().leg_limits(**a), loose=("ranges",))(
    lambda: {"neutral": it.c(), "ranges": [(1.0, 9.0)] * 9}
)
row("Study.zp", lambda **a: it.study().zp(**a))(lambda: {"neutral": it.c()})
row("Masses.seen_from", nd.Masses(**DUTY["masses"]).seen_from)(lambda: {"tool": nd.Tool(**DUTY["tool"])})
row("Study.paper", nd.Study.paper)(dict)
row("Study.from_dict", nd.Study.from_dict, words={"data": ("study", *OF_ROBOT)})(lambda: {"data": it.study().to_dict()})
row("Study.problem", lambda **how: it.study().problem(**how))(lambda: {"over_region": False})
row("Study.limit_for_core", lambda **a: it.study().limit_for_core(**a))(lambda: {"limit": Limit("leg_ratio", high=3.0)})
DESIGN = {"a2": 5.0, "b1": 3.0, "zp": 4.0, "zs": 2.0, "theta_z": 0.0}
row("Study.evaluate", lambda **a: it.study().evaluate(**a), nan=("variables",), words={"variables": OF_ROBOT})(
    lambda: {"variables": dict(DESIGN)}
)
row("Study.vector", lambda **a: it.study().vector(**a), words={"variables": OF_ROBOT})(
    lambda: {"variables": dict(DESIGN)}
)
row("Study.with_solver", lambda **a: it.study().with_solver(**a), huge=("starts",))(lambda: {"starts": 1, "seed": 2})
row("Study.shown", lambda **a: it.study().shown(**a))(lambda: {"variable": "theta_z", "value": 1.0})
row("Study.unit_of", lambda **a: it.study().unit_of(**a))(lambda: {"variable": "theta_z"})

OF_A_SET = {"points": 3, "internal_point": "shifted", "unit": "length"}
row("Pose")(
    lambda: {
        "position": (0.1, 0.0, 0.0),
        "rotation": (0.0, 0.1, 0.0),
        "internal_point": "shifted",
        "unit": "length",
        "weight": 1.0,
    }
)
row("Pose.from_dict", nd.Pose.from_dict, words={"data": ("pose",)})(
    lambda: {"data": {"position": [0.1, 0.0, 0.0], "unit": "zp"}}
)
row("Region")(
    lambda: {
        "box": (0.1, 0.1, 0.1),
        "ball": None,
        "cylinder": None,
        "path": None,
        "tilt": 0.1,
        "yaw": 0.1,
        "internal_point": "shifted",
        "unit": "length",
    },
    words={"ball": ("region",), "cylinder": ("region",), "path": ("region",), "box": ("region",)},
)
row("Region.from_dict", nd.Region.from_dict, words={"data": ("region",)})(
    lambda: {"data": {"box": [0.1, 0.1, 0.1], "tilt_deg": 5.0}}
)
REGION = nd.Region(cylinder=(0.1, 0.1))
row("Region.size_at", nd.Region(ball=0.1, unit="zp").size_at)(lambda: {"home": it.c()})
row("Region.worded", REGION.worded)(lambda: {"unit": "mm"})
row("Objective", words={"region": ("box",), "poses": ("pose",)})(
    lambda: {
        "index": "condition_number",
        "aggregate": "worst",
        "weight": 0.5,
        "condition_limit": 10.0,
        "neutral_condition_limit": 10.0,
        "poses": (nd.Pose(),),
        "region": {"box": [0.1, 0.1, 0.1]},
    }
)
row("Objective.from_dict", nd.Objective.from_dict, words={"data": ("objective",)})(
    lambda: {
        "data": {
            "index": "condition_number",
            "poses": [{"position": [0.1, 0.0, 0.0]}],
            "box": {"half": [0.1, 0.1, 0.1], "points": 2},
        }
    }
)
row("Objective.for_core", nd.Objective().for_core)(lambda: {"over_region": False})
row("Objective.worded", nd.Objective(region=REGION).worded)(lambda: {"unit": "mm", "imposed": 3})
row("poses.box", poses.box)(lambda: {"half": (0.1, 0.1, 0.1), "tilt": None, "tilt_deg": [5.0, 0.0, 0.0], **OF_A_SET})
row("poses.ball", poses.ball, words={"points": ("points", "number")})(
    lambda: {"radius": 0.1, "tilt": [0.1, 0.0, 0.0], "tilt_deg": None, **OF_A_SET, "points": 7}
)
row("poses.path", poses.path, words={"positions": ("rotations", "position")})(
    lambda: {
        "positions": [[0.0, 0.0, 0.0], [0.1, 0.0, 0.0]],
        "rotations": [[0.0, 0.0, 0.0], [0.0, 0.1, 0.0]],
        "rotations_deg": None,
        **OF_A_SET,
    }
)

# --- searches ---------------------------------------------------------------------------------------------------------

row("optimize", huge=("starts",), loose=("out",))(
    lambda: {
        "study": nd.Study.paper(),
        "starts": 1,
        "seed": 0,
        "threads": 1,
        "progress": None,
        "warm": [DESIGN | {"a1": 0.0, "b2": 0.0}],
        "certify": False,
        "out": None,
        "time_limit": 60.0,
    }
)
row("trace", words={"start": OF_ROBOT}, nan=("start",))(
    lambda: {"study": it.study(), "start": dict(DESIGN), "formulation": "minimax"}
)
row("pareto", huge=("points",), words={"values": ("against",)})(
    lambda: {
        "study": it.study(),
        "against": "radius_ratio",
        "values": [1.8, 2.0],
        "points": 3,
        "threads": 1,
        "progress": None,
        "out": None,
    }
)
row("prove_optimum", few=4, huge=("time_limit",))(
    lambda: {
        "study": nd.Study.paper(),
        "condition_number": 3.7626590785960,
        "gap": 0.5,
        "time_limit": 5.0,
        "threads": 1,
        "progress": None,
    }
)
row("applicable_bounds")(lambda: {"result": it.result()})
row("check", huge=("perturbations",))(lambda: {"result": it.result(), "perturbations": 3, "seed": 0, "certify": False})
row("Result.largest_tolerance", lambda **a: it.region_result().largest_tolerance(**a), few=2)(
    lambda: {"condition_number": 50.0, "slack": 1e-3, "time_limit": 1.0, "threads": 1, "progress": None}
)
row("Result.certify", lambda **a: it.region_result().certify(**a), few=2)(
    lambda: {
        "condition_number": 50.0,
        "gap": 0.5,
        "time_limit": 1.0,
        "slack": 1e-3,
        "tolerance": 1e-3,
        "threads": 1,
        "rule": None,
        "resume": None,
        "progress": None,
        "keep": None,
    }
)
row("Result.is_certified_by", lambda **a: it.region_result().is_certified_by(**a))(
    lambda: {"certificate": it.certificate()}
)
row("Result.sheet", lambda **a: it.result().sheet(**a))(lambda: {"poses": it.stack(), "linear_speed": 1.0})
row("OptimumProof.gap", lambda **a: it.proof().gap(**a))(lambda: {"condition_number": 4.0})
row("OptimumProof.from_dict", nd.OptimumProof.from_dict, words={"data": ("proof",)}, loose=("data",))(
    lambda: {"data": it.proof().to_dict()}
)
row(
    "MachineCertificate.from_dict",
    nd.MachineCertificate.from_dict,
    words={"data": ("certificate", "mark", "rule")},
    loose=("data",),
)(lambda: {"data": it.certificate().to_dict()})
row("LimitProof.shown", lambda **a: it.certificate().limits[0].shown(**a))(lambda: {"value": 1.0})
row("LimitProof.unit", lambda **a: it.certificate().limits[0].unit(**a))(lambda: {"length": "mm", "force_unit": "N"})
row("LimitProof.worded", lambda **a: it.certificate().limits[0].worded(**a))(lambda: {"digits": 6})
row("LimitProof.outward", lambda **a: it.certificate().limits[0].outward(**a))(
    lambda: {"value": 1.0, "up": True, "digits": 6}
)

# --- the internal point -----------------------------------------------------------------------------------------------

POINT = {
    "criterion": "condition_number",
    "limits": (np.full(9, 0.5), np.full(9, 9.0)),
    "characteristic_length": 1.0,
    "start": [0.0, 0.0, 2.375],
    "clearance": 0.01,
}
WHERE = {"position": [[0.0, 0.0, 4.0]], "rotation": np.eye(3)}
NO_POINT = ("clearance", "start", "limits", "position")  # where no point is allowed, it is NaN
row("best_internal_point", nan=NO_POINT, loose=("limits",))(
    lambda: {"geometry": it.g(), **WHERE, **POINT, "threads": 1}
)
row("best_internal_path", nan=NO_POINT, loose=("limits",), words={"rotation": ("position",)})(
    lambda: {"geometry": it.g(), **WHERE, **POINT, "smoothness": 0.1}
)
row("best_internal_map", nan=NO_POINT, loose=("limits",))(
    lambda: {
        "geometry": it.g(),
        **WHERE,
        **POINT,
        "threads": 1,
        "seed_every": 256,
        "audit_every": 512,
        "audit_seed": 0,
        "progress": None,
    }
)

# --- over poses -------------------------------------------------------------------------------------------------------

row("Trajectory", words={"time": ("leading",)})(
    lambda: {
        "time": np.arange(4.0),
        "position": np.outer(np.arange(4.0), [0.25, 0.0, 0.5]),
        "rotation": np.eye(3),
        "unit": "mm",
    }
)
SHAPE = {"duration": 1.0, "points": 9, "unit": "mm"}
row("Trajectory.circle", nd.Trajectory.circle, words={"radius": ("position",)})(
    lambda: {"home": it.c(), "radius": 0.1, **SHAPE}
)
row("Trajectory.line", nd.Trajectory.line, words={"step": ("position",)})(
    lambda: {"home": it.c(), "step": [0.1, 0.0, 0.0], **SHAPE}
)
row("Trajectory.spiral", nd.Trajectory.spiral, words={name: ("position",) for name in ("radius", "height")})(
    lambda: {"home": it.c(), "radius": 0.1, "height": 0.1, **SHAPE}
)
row(
    "follow",
    loose=("limits", "load"),
    words={"internal_point": ("leg_lengths",), "characteristic_length": ("kind",), "load": ("force", "moment")},
)(
    lambda: {
        "geometry": it.g(),
        "trajectory": it.trajectory(),
        "home": it.c(),
        "internal_point": "carried",
        "limits": (np.full(9, 0.5), np.full(9, 9.0)),
        "characteristic_length": 1.0,
        "load": ([0.0, 0.0, -1.0], [0.0, 0.0, 0.5]),
        "masses": nd.Masses(**DUTY["masses"]),
        "gravity": [0.0, 0.0, -9.81],
    }
)
row("region_map")(lambda: {"result": it.region_result()})
for of in (it.result, lambda: it.result().best):
    row(f"{type(of()).__name__}.path_limits", lambda of=of, **a: of().path_limits(**a))(
        lambda: {"followed": it.followed(), "home": it.c()}
    )
row("path_limits")(lambda: {"study": it.study(), "followed": it.followed(), "home": it.c()})
row("tolerances_for", words={"position": ("position", "rotation")})(
    lambda: {"design": it.design(), "position": 0.1, "rotation": 0.01, "weights": (1.0, 1.0)}
)
row("sheet", few=3, huge=("samples",))(
    lambda: {
        "design": it.design(),
        "poses": it.stack(),
        "linear_speed": 1.0,
        "angular_speed": 0.5,
        "internal": "least",
        "loads": [0.0, 0.0, 0.0, 0.0, 0.0, -1.0],
        "leg_errors": 1e-3,
        "joint_errors": 1e-3,
        "leg_stiffness": 100.0,
        "characteristic_length": 1.0,
        "twist": RATES[:6],
        "twist_rate": RATES[:6],
        "mass": 2.0,
        "centre": [0.0, 0.0, 0.1],
        "gravity": [0.0, 0.0, -9.81],
        "samples": 10,
        "unit": "mm",
    }
)
row("largest_payload", few=3, huge=("samples",))(
    lambda: {
        "design": it.design(),
        "force": 100.0,
        "pull": 50.0,
        "centre": (0.0, 0.0, 0.1),
        "loads": [0.0, 0.0, 0.0, 0.0, 0.0, -1.0],
        "samples": 10,
    }
)
row("payload_along")(
    lambda: {
        "design": it.design(),
        "motion": it.followed(),
        "force": 100.0,
        "power": 50.0,
        "centre": (0.0, 0.0, 0.1),
    }
)
row("failure", few=3, huge=("samples",))(
    lambda: {
        "design": it.design(),
        "poses": it.stack(),
        "condition_number": 5.0,
        "loads": [0.0, 0.0, 0.0, 0.0, 0.0, -1.0],
        "pairs": False,
        "characteristic_length": 1.0,
        "samples": 10,
    }
)
row("admissible", few=3, words={"vary": ("vary",)})(
    lambda: {
        "of": it.study(),
        "vary": {"a2": (4.0, 8.0), "b1": (2.0, 4.0)},
        "at": {"zp": 4.0, "zs": 2.4, "theta_z": 0.0},
        "condition_number": 9.0,
        "time_limit": 5.0,
        "resolution": 0.2,
        "threads": 1,
        "executor": None,
        "resume": None,
        "progress": None,
    }
)
row("admissible_actuators", few=3, words={"vary": ("vary",)})(
    lambda: {
        "study": it.study_with_actuators(),
        "vary": {"a2": (4.0, 8.0), "b1": (2.0, 4.0)},
        "at": {"zp": 4.0, "zs": 2.4, "theta_z": 0.0},
        "time_limit": 5.0,
        "resolution": 0.2,
        "threads": 1,
        "progress": None,
    }
)
row("AdmissibleSet.state_of", lambda **a: it.admissible_set().state_of(**a))(lambda: {"designs": [[5.0, 3.0]]})
row("AdmissibleSet.around", lambda **a: it.admissible_set().around(**a), few=3)(
    lambda: {"design": {"a2": 5.0, "b1": 3.0}, "proportions": {"a2": 2.0, "b1": 1.0}, "progress": None}
)
row("sweep", dear=("out",), huge=("over",), words={"over": ("x_p",)})(
    lambda: {
        "geometry": it.g(),
        "home": it.c(),
        "over": {"x_p": (-1.0, 1.0, 3), "y_p": np.array([0.0, 0.5])},
        "index": "condition_number",
        "relative": True,
        "internal_point": "held",
        "characteristic_length": 1.0,
        "executor": None,
        "out": None,
        "chunk": 4,
        "threads": 1,
        "progress": None,
        "unit": "mm",
    }
)
row(
    "sweep_designs",
    huge=("over",),
    words={"over": ("zs",), "design": OF_ROBOT, "characteristic_length": OF_ROBOT},
    nan=("over", "characteristic_length"),
)(
    lambda: {
        "design": {"a1": 0.0, "a2": 5.0, "b1": 3.0, "b2": 0.0, "zp": 4.0},
        "over": {"zs": (1.0, 2.0, 3)},
        "index": ["condition_number", "manipulability"],
        "family": "hexagonal",
        "characteristic_length": 1.0,
        "executor": None,
        "out": None,
        "chunk": 4,
        "progress": None,
        "unit": "mm",
    }
)
row("sweep_figure", huge=("points",))(
    lambda: {"figure": "6", "points": 3, "executor": None, "out": None, "progress": None}
)
row("SweepResult.at", lambda **a: it.swept().at(**a), loose=("position",))(
    lambda: {"name": "condition_number", "position": (2,)}
)
row("SweepResult.least", lambda **a: it.swept().least(**a))(lambda: {"name": "condition_number"})
row("atlas", huge=("designs",), words={"bounds": ("a2",)})(
    lambda: {
        "designs": 100,
        "seed": 1,
        "bounds": {"a2": (1.0, 6.0)},
        "executor": None,
        "out": None,
        "chunk": 50,
        "progress": None,
    }
)
OF_A_WORKSPACE = {
    "criteria": {"leg_limits": (0.5, 6.0)},
    "internal_point": 0.5,
    "rotation": np.eye(3),
    "region": None,
    "orientations": None,
    "home": None,
    "characteristic_length": 1.0,
    "threads": 1,
    "progress": None,
    "unit": "mm",
}
row(
    "workspace",
    nan=("internal_point", "characteristic_length"),
    huge=("resolution", "points", "shifts", "most_evaluations"),
)(
    lambda: {
        "geometry": it.g(),
        "box": it.BOX,
        "archetype": "constant_orientation",
        **OF_A_WORKSPACE,
        "position": None,
        "method": "octree",
        "tolerance": 0.5,
        "resolution": 4,
        "points": None,
        "shifts": 2,
        "seed": 0,
        "most_evaluations": 100,
        "index": "manipulability",
    }
)
row("certified_workspace", few=10, huge=("most_boxes", "time_limit"))(
    lambda: {
        "geometry": it.g(),
        "box": it.BOX,
        "archetype": "constant_orientation",
        **OF_A_WORKSPACE,
        "gap": 0.9,
        "time_limit": 2.0,
        "most_boxes": 50,
    }
)
row("CertifiedWorkspace.section", lambda **a: it.certified().section(**a), words={"axis": ("at",)})(
    lambda: {"axis": "z", "at": 4.0, "pixels": 8}
)
row("CertifiedWorkspace.state", lambda **a: it.certified().state(**a))(lambda: {"points": [[0.0, 0.0, 4.0]]})
row("CertifiedWorkspace.with_estimate", lambda **a: it.certified().with_estimate(**a))(
    lambda: {"volume": 0.5, "error": 0.1}
)
row("WorkspaceMap.limits", lambda **a: it.workspace().limits(**a))(lambda: {"grouped": False})
row("WorkspaceMap.slice", lambda **a: it.workspace().slice(**a), words={"axis": ("at",)})(
    lambda: {"axis": "z", "at": 4.0, "pixels": 8, "smooth": False}
)
row("WorkspaceMap.surface", lambda **a: it.workspace().surface(**a))(lambda: {"most": 1000})
row("spread_rotations", huge=("count",))(lambda: {"count": 3, "angle": 1.0})
row("compare", lambda **a: nd.compare(it.result(), it.result(), **a))(lambda: {"names": ["one", "other"]})
row("Result.with_changes", lambda **a: it.result().with_changes(**a))(lambda: {"a2": 5.0})

THINGS = {  # one of each class whose methods without arguments are called
    **{kind.__name__: lambda kind=kind, name=name: kind(**DUTY[name]) for name, kind in DUTIES.items()},
    "Actuator": lambda: nd.Actuator(**ACTUATOR),
    "AdmissibleRow": lambda: it.admissible_rows().rows[0],
    "AdmissibleSet": it.admissible_set,
    "Candidate": lambda: it.result().best,
    "CertifiedWorkspace": it.certified,
    "Comparison": lambda: nd.compare(it.result(), it.result()),
    "Failure": lambda: nd.failure(it.design(), it.stack()),
    "Followed": it.followed,
    "Front": it.front,
    "MachineCertificate": it.certificate,
    "Objective": nd.Objective,
    "OptimumProof": it.proof,
    "PathLimits": lambda: nd.path_limits(it.study(), it.followed(), it.c()),
    "Payload": lambda: nd.largest_payload(it.design(), 100.0),
    "Pose": lambda: nd.Pose((0.1, 0.0, 0.0)),
    "Region": lambda: nd.Region(cylinder=(0.1, 0.1)),
    "Result": it.region_result,
    "Sheet": lambda: it.result().sheet(it.stack()),
    "Study": it.study,
    "SweepResult": it.swept,
    "WorkspaceMap": it.workspace,
}
