"""Entries that must be refused: one table a kind of entry, tried in every public call that has such an argument.

What no call may do with any entry is in test_entry_points.py; entries of a study are in design/test_bad_entries.py.
"""

import dataclasses
import importlib
import math
from concurrent.futures import ThreadPoolExecutor

import entry_things as it
import numpy as np
import pytest
from entry_engine import bounded
from entry_rows import ROWS

import ninedof as nd

for tables in ("entry_rows_design", "entry_rows_places"):
    importlib.import_module(tables)

NAN, INF, ONE = math.nan, math.inf, np.eye(3)
NO_LENGTHS = [-1.0, NAN, INF, "x", 1j, [[1.0], [1.0, 2.0]], 10**400]
NO_COUNTS = [-1, 1.0, 1.5, "2", True, [1], 2**64]
NO_VECTORS = [np.ones(2), np.ones((7, 2)), [1.0], [0.0, INF, 1.0], "fast", ["0", "0", "1"], {}]
NO_VECTORS += [[0.0, 0.0, 1j], [[1.0], [2.0, 3.0]], [10**400, 0, 0], np.zeros(3, "M8[s]"), np.array([0, 0, None])]
NO_VECTORS += [np.ma.masked_array(np.ones(3), mask=[True, False, False])]
NO_ROTATIONS = [np.diag([1.0, 1.0, -1.0]), -ONE, 2.0 * ONE, ONE + np.diag([1e-6, 0.0], k=1), 0.0 * ONE, 1e200 * ONE]
NO_ROTATIONS += [np.full((3, 3), INF), np.eye(4), [0.0, 0.0, 0.0, 1.0], "xyz", ONE + 0j]
NO_ROTATIONS += [np.ma.masked_array(ONE, mask=ONE)]
NO_TRIPLES = [NAN * ONE, [[1, 0, 0], [0, INF, 0], [0, 0, 1]], ONE[:2], [1.0, 2.0, 3.0], np.eye(3, 4), [ONE], 1.0, "abc"]
NO_TRIPLES += [
    [[1.0, 2.0], [3.0]],
    {},
    [[object()] * 3] * 3,
    [[1.0, 2.0, 3.0]] * 3,
    *(x * ONE for x in (1e-160, 1e-101, 1.1e100, 1e158)),
]
NO_ORBITS = [(0.0, 1.0, 0.0), (-1.0, 1.0, 0.0), (NAN, 1.0, 0.0), (1.0, NAN, 0.0), (1.0, 0.0, INF), (1.0, 0.0), "abc", 3]
FAR = [1e-120, 1e120]  # lengths whose squares and products are no ordinary doubles

KINDS = {  # values that are refused, arguments that have the kind
    "length above 0": ([0.0, None, *FAR, *NO_LENGTHS], "characteristic_length"),
    "number above 0": ([0.0, *NO_LENGTHS], "most clearance smoothness leg_mass platform_mass"),
    "number from 0": (NO_LENGTHS, "tolerance linear_speed angular_speed mass gap"),
    "seconds": ([-1.0, NAN, "1"], "time_limit"),
    "count from 1": ([0, *NO_COUNTS], "starts chunk seed_every audit_every designs most_boxes resolution"),
    "count from 0": (NO_COUNTS, "seed threads samples points perturbations directions audit_seed"),
    "vector": (
        [None, *NO_VECTORS],
        "omega pdot sdot alpha pddot sddot moment force force_at_o position internal_point step centre",
    ),
    "number a leg": (
        [np.ones(8), np.ones((7, 8)), np.full(9, INF), "abc", np.ones(9) * 1j, [["1"] * 9], None],
        "leg_rates leg_accelerations leg_lengths direction weights",
    ),
    "tolerance": (
        [-1e-9, INF, NAN, None, "fine", [1.0] * 8, [[1.0, 2.0], [1.0]], 1j],
        "leg_errors joint_errors leg_stiffness",
    ),
    "word": (
        ["x", 1, 1.0, True, ["2"]],
        "kind norm part criterion method archetype index formulation format internal family figure unit",
    ),
    "robot or result": (
        [None, "robot", 1, {}],
        "geometry configuration home study result design trajectory followed",
    ),
    "rotation": (NO_ROTATIONS, "rotation"),
    "side": ([INF, "1", None, 1j, 10**400], "a1 a2 b1 b2 zp zs theta_z"),
    "function": ([3, "x", True], "progress"),
    "executor": ([3, "dask", object(), [ThreadPoolExecutor], ThreadPoolExecutor, lambda: 3], "executor"),
    "folder": ([5, b"x", "", "a\0b"], "out"),
}
OTHER_KINDS = {  # of some calls: rows, what is refused, their arguments
    "triple": ("Geometry", NO_TRIPLES, "base_external base_internal platform_external platform_internal"),
    "triple on a line": ("Geometry", [np.diag([0, 0, 1.0])], "base_internal platform_internal"),
    "orbit": ("Geometry.symmetric", NO_ORBITS, "base_external base_internal platform_external platform_internal"),
    "side from 0": ("Geometry.hexagonal", [-1.0, -1e-300, [1.0]], "a1 a2 b1 b2"),
    "leg lengths": ("forward_position", [-np.ones(9), np.zeros(9), np.full(9, NAN), np.full(9, 1e120)], "leg_lengths"),
    "leg lengths on the way": ("track", [-np.ones(9), np.full(9, 1e120)], "leg_lengths"),
    "configuration": ("track", [np.ones(15)], "start"),
    "weights": (
        "internal_velocity, inverse_velocity: O chosen",
        [np.where(np.arange(9) == 4, bad, 1.0) for bad in (0.0, -1.0, NAN, INF)] + [np.full(9, NAN)],
        "weights",
    ),
    "limits": (
        "best_internal_point, best_internal_map",
        [3.0, (3.0, 2.0), (np.ones(4), 2.0), (np.ones((2, 9)), 3.0)],
        "limits",
    ),
    "two lengths": (
        "jacobian, velocity_matrices, jacobian_rate, axis_singular_values, condition_number, velocity_ellipsoid, "
        "force_ellipsoid, best_internal_point, best_internal_map",
        [[1.0, 2.0]],
        "characteristic_length",
    ),
    "norm": ("condition_number", ["1", "fro", "", INF], "norm"),
    "threads": ("condition_number", [0, 2**40], "threads"),
    "kind": ("characteristic_length", ["", "mean leg", "OPTIMAL"], "kind"),
    "part": ("velocity_ellipsoid, force_ellipsoid", ["translations", "", ["twist"]], "part"),
    "tolerance of motions": ("uncontrolled_motions", [0.0, [1e-9, 1e-9]], "tolerance"),
    "side or height": ("Configuration.neutral", [1e200], "zp zs"),
    "place": ("Configuration", [[0.0, -2e100, 0.0], [[0.0, 0.0, 1.0], [0.0, -2e100, 0.0]]], "position internal_point"),
    "start": ("best_internal_point, best_internal_map", [[1.0, 2.0], np.zeros((2, 3)), "x"], "start"),
    "start of a path": ("best_internal_path", [np.zeros((5, 3))], "start"),
    "one configuration": ("self_stress", [it.stack()], "configuration"),
    "one configuration, moving": ("uncontrolled_motions", [it.stack()], "configuration"),
    "one configuration, erring": ("error_samples", [it.stack()], "configuration"),
    "warm": (
        "optimize",
        [3, "best", ["best"], [1.0, 2.0], np.zeros((2, 7)), {"a9": 1.0}, {"a1": 1.0}]
        + [dict.fromkeys(("a1", "a2", "b1", "b2", "zp", "zs"), bad) for bad in (NAN, True, "1")],
        "warm",
    ),
}
EXCEPT = {  # rows and arguments where one of these values has a meaning, or another argument is named
    *(
        "tolerances_for position",
        "follow internal_point",
        "workspace internal_point",
        "workspace characteristic_length",
    ),
    *("follow characteristic_length", "sheet characteristic_length", "inverse_velocity sdot", "workspace position"),
    *("failure characteristic_length", "admissible resolution", "admissible time_limit"),
    *("admissible_actuators resolution", "admissible_actuators time_limit"),
    *("inverse_velocity: O chosen sdot", "sheet centre", "stiffness internal", "workspace home"),
    *("certified_workspace home", "certified_workspace internal_point", "certified_workspace characteristic_length"),
    *("sweep_designs design", "sheet leg_errors", "sheet joint_errors"),
    *("sheet leg_stiffness", "Region.worded unit", "Objective.worded unit"),
    "payload_along force",  # none beside a power
    *("inverse_velocity weights", "inverse_velocity: O chosen weights", "internal_velocity weights", "view design"),
}
CASES = [
    *((row, argument, kind, bad) for kind, (bad, names) in KINDS.items() for argument in names.split() for row in ROWS),
    *(
        (row, argument, kind, bad)
        for kind, (rows, bad, names) in OTHER_KINDS.items()
        for row in rows.split(", ")
        for argument in names.split()
    ),
]
CASES = [case for case in CASES if case[1] in ROWS[case[0]].arguments() and f"{case[0]} {case[1]}" not in EXCEPT]


@pytest.mark.parametrize(("row", "argument", "kind", "values"), CASES, ids=[f"{c[0]} {c[1]} {c[2]}" for c in CASES])
@pytest.mark.filterwarnings("ignore")  # data discarded with a warning must raise
def test_a_kind_of_entry(row, argument, kind, values):
    for bad in values:
        arguments = ROWS[row].arguments() | {argument: bad}
        with bounded(), pytest.raises(ValueError, match=rf"(?s)^.*\b{argument}\b.*: got .+, expected .+"):
            ROWS[row].call(**arguments)


REACHABLE = {"archetype": "reachable", "rotation": None, "index": None}
POINT = {"a2": 5.0, "b1": 3.0, "zp": 4.0, "zs": 2.0, "theta_z": 0.0}
BAD_POINT = {"a2": NAN, "zp": INF, "zs": None, "b1": "1", "theta_z": True}
ORIENTATION = {"archetype": "orientation", "box": None, "position": [0, 0, 4]}
HOME = it.on_axis()
MANY_FREE = nd.Study(variables={"theta_z": (0.0, 0.1)}, tool={"position": (0.1, 0.0, 0.0)})
MEAN_LEG = nd.Study(variables={"a1": 0.0, "b2": 0.0}, characteristic_length="mean_leg")
PLACED = nd.Study(objective={"region": {"box": [0.1, 0.1, 0.1], "internal_point": "best"}})
NO_DESIGN = dataclasses.replace(it.result(), candidates=())
AT_JOINT = nd.Configuration(HOME.position, ONE, HOME.position + it.g().platform_internal[0])
APART = [  # a row, entries that are refused because of what they are together or where they stand, words of the error
    (
        "condition_number",
        {"characteristic_length": "mean"},
        "characteristic_length: got .*, expected one of optimal, na",
    ),
    ("workspace", {"box": ([1, 0, 0], [0, 1, 1])}, r"box \(x\)"),
    ("workspace", {"box": ([0, 0, 0], [1, 1, NAN])}, r"box \(z\)"),
    ("workspace", {"box": ([0, 0], [1, 1, 1])}, r"box \(low\)"),
    ("workspace", {"box": None}, "box"),
    ("workspace", {"criteria": {"leg_limit": (1, 2)}}, "criteria"),
    ("workspace", {"criteria": {"leg_limits": 3.0}}, "leg_limits"),
    ("workspace", {"criteria": {"leg_limits": (3.0, 2.0)}}, r"leg_limits \(l1\)"),
    ("workspace", {"criteria": {"leg_limits": (NAN, 2.0)}}, r"leg_limits \(l1\)"),
    ("workspace", {"criteria": {"leg_limits": (np.where(np.arange(9) == 7, INF, 0.0), INF)}}, r"leg_limits \(r2\)"),
    ("workspace", {"criteria": {"condition_number": True}}, "condition_number"),
    ("workspace", {"criteria": {"condition_number": 0.5}}, "condition_number"),
    ("workspace", {"criteria": {"leg_clearance": True}}, "leg_clearance"),
    ("workspace", {"criteria": {"leg_clearance": 0.0}}, "leg_clearance"),
    ("workspace", {"criteria": {"platform_cone": True}}, "platform_cone"),
    ("workspace", {"criteria": {"platform_cone": {"max": 1.0, "axis": [0, 0, 0]}}}, r"platform_cone \(axis\)"),
    ("workspace", {"criteria": {"base_cone": -1.0}}, "base_cone"),
    ("workspace", {"criteria": {"base_cone": {"axis": [0, 0, 1]}}}, "base_cone"),
    ("workspace", {"criteria": {"singularity_free": 1.5}}, "singularity_free"),
    ("workspace", {"method": "sample", "criteria": {"singularity_free": True}, "index": None}, "method"),
    ("workspace", {"orientations": np.zeros((0, 3, 3)), **REACHABLE}, "orientations"),
    ("workspace", {"orientations": [], **REACHABLE}, "orientations"),
    ("workspace", {"orientations": 5}, "orientations"),
    ("workspace", {"internal_point": "worst"}, "internal_point"),
    ("workspace", {"internal_point": NAN}, "internal_point"),
    ("workspace", {"position": [0, 0, 1]}, "position"),
    ("workspace", ORIENTATION, "region"),
    ("workspace", ORIENTATION | {"region": {"tilt": 1.0}}, "region"),
    ("workspace", ORIENTATION | {"region": {"angle": 4.0}}, r"region \(angle\)"),
    ("workspace", {"home": nd.Configuration.neutral(zp=[1.0, 2.0], zs=1.0)}, "home"),
    ("workspace", {"tolerance": 0.0}, "tolerance"),
    ("workspace", {"resolution": 600}, "resolution: got 600, expected a whole number from 2 to 128$"),
    ("workspace", {"method": "grid", "resolution": 600}, "resolution: got 600, expected a whole number from 2 to 512$"),
    ("workspace", {"method": "grid", "resolution": 64}, "resolution: got 64, expected a grid of at most most_evaluat"),
    ("workspace", REACHABLE | {"index": "speed"}, "index: .* expected none for the reachable workspace"),
    ("workspace", {"internal_point": "best"}, "index: .* expected none with the best internal point"),
    ("WorkspaceMap.slice", {"axis": "w"}, "axis: got"),
    ("WorkspaceMap.slice", {"axis": "z", "at": 9.0}, "at: got"),
    ("WorkspaceMap.slice", {"axis": "z", "at": NAN}, "at: got"),
    ("certified_workspace", {"box": None}, "box: got nothing"),
    ("certified_workspace", {"box": ([0, 0, 0], [1, 1, 0])}, "box"),
    ("certified_workspace", {"box": ([0.0, 0.0, 4.8], [5e-324, 0.1, 4.9])}, "box: got 5e-324"),
    ("certified_workspace", {"archetype": "orientation"}, "archetype: got 'orientation', expected positions"),
    ("certified_workspace", {"internal_point": "best"}, "internal_point: got 'best', expected carried, shifted, held"),
    ("certified_workspace", {"criteria": {}}, "criteria: got none, expected at least one"),
    ("certified_workspace", {"criteria": {"condition_number": 0.5}}, "condition_number: got 0.5, expected at least 1"),
    ("certified_workspace", {"criteria": {"leg_limits": (5e-324, 6.5)}}, "leg_limits: got 5e-324"),
    ("certified_workspace", {"gap": 0.0}, "gap: got 0"),
    ("certified_workspace", {"gap": 1.0}, "gap: got 1"),
    (
        "certified_workspace",
        {"box": ([-1e160] * 3, [1e160] * 3), "criteria": {"condition_number": 5.0}},
        "box: got one whose volume",
    ),
    (
        "certified_workspace",
        {"criteria": {"singularity_free": True}, "home": nd.Configuration.neutral(zp=4.0, zs=0.0)},
        "home: got a configuration that rounding cannot tell from a singular one",
    ),
    ("best_internal_point", {"limits": (np.ones(4), 2.0)}, r"limits \(low\): got"),
    ("best_internal_point", {"limits": (3.0, 2.0)}, "limits of l1: got"),
    ("best_internal_point", {"criterion": "leg_centring", "limits": None}, "limits of q1: got"),
    ("best_internal_map", {"criterion": "leg_centring", "limits": None}, "limits of q1: got"),
    ("best_internal_path", {"position": [0.0, 0.0, 3.98]}, "position: got "),
    ("sheet", {"design": it.g(), "poses": None}, "poses: got none"),
    ("sheet", {"design": it.g(), "poses": HOME}, "poses: got"),
    ("sheet", {"loads": [1.0, 2.0]}, "loads: got"),
    ("sheet", {"twist": None}, "twist_rate: got"),
    ("sheet", {"leg_errors": NAN}, "leg_errors: got NaN"),
    ("sheet", {"joint_errors": INF}, "joint_errors: got an infinite number"),
    ("sheet", {"leg_stiffness": [1.0] * 8 + [NAN]}, "leg_stiffness: got NaN"),
    ("sheet", {"twist": [1.0, 2.0]}, "twist: got"),
    ("sheet", {"mass": None}, "centre: got .* without a mass"),
    ("sheet", {"gravity": [1.0]}, "gravity"),
    ("sheet", {"samples": 0}, "samples"),
    ("nearest_singularity", {"most": -1.0}, "most: got -1"),
    ("nearest_singularity", {"configuration": nd.Configuration.neutral(4.0, [[2.0]])}, "configuration: got shape"),
    (
        "uncontrolled_motions",
        {"configuration": nd.Configuration([[NAN, 0, 4]], internal_point=[[0, 0, 2]])[0]},
        "configuration: got NaN",
    ),
    ("distance_to_singularity", {"direction": np.ones((3, 9))[:, :8]}, "direction"),
    ("inverse_velocity", {"weights": np.ones(9)}, "weights: got .+, expected"),
    ("leg_forces", {"configuration": it.stack(), "moment": [[0.0] * 3] * 3}, ".*moment"),
    ("stiffness", {"configuration": it.stack(), "leg_stiffness": [[1.0] * 9] * 3}, ".*leg_stiffness"),
    ("forward_velocity", {"configuration": it.stack(), "leg_rates": np.ones((3, 9))}, ".*leg_rates"),
    ("error_samples", {"leg_errors": np.zeros((2, 9))}, "leg_errors, joint_errors: got"),
    ("Trajectory", {"time": [0.0, 1.0, 1.0], "position": np.zeros((3, 3))}, "time.*got 1 after 1"),
    ("Trajectory", {"time": [0.0, 1.0], "position": np.zeros((2, 3))}, "time: got"),
    ("Trajectory", {"position": np.full((4, 3), NAN)}, ".*NaN"),
    ("follow", {"internal_point": "stay"}, "internal_point: got 'stay'"),
    ("follow", {"limits": (5.0, 2.0)}, "limits: got 5 to 2"),
    ("follow", {"load": ([0.0, NAN, 0.0], None)}, r"load \(force\): got NaN"),
    ("best_internal_point", {"start": [0.0, 0.0, INF]}, "start: got an infinite number"),
    ("follow", {"internal_point": "best", "limits": (0.0, 3.0)}, r".*no position of O is allowed at t = 0 \(l1 high"),
    (
        "Configuration",
        {"position": np.zeros((2, 3)), "rotation": np.broadcast_to(ONE, (3, 3, 3))},
        r".*position \(2,\)",
    ),
    ("Configuration.neutral", {"zp": [1.0, 2.0], "zs": [0.1, 0.2, 0.3]}, r".*zp \(2,\), zs \(3,\)"),
    ("Configuration", {"rotation": [ONE, -ONE]}, "rotation: got .+, expected"),
    ("Geometry.hexagonal", {"a1": 0.0, "a2": 0.0}, "a1, a2: got .+, expected"),
    ("Geometry.hexagonal", {"b1": 0.0, "b2": 0.0}, "b1, b2: got .+, expected"),
    ("Study", {"variables": {"a1": 0.0, "a2": 0.0}}, "a1.*a2"),
    ("Study", {"variables": {"b1": 0.0, "b2": (0.0, 0.0)}}, "b1.*b2"),
    ("Study.evaluate", {"variables": {"a2": 5.0, "b1": 3.0, "zp": 4.0, "theta_z": 0.0}}, "zs: got no value"),
    *(("Study.evaluate", {"variables": POINT | {n: bad}}, f"{n}: got .+, expected") for n, bad in BAD_POINT.items()),
    ("Study.evaluate", {"variables": {"b3": 1.0}}, "variables: got the entry 'b3'"),
    ("trace", {"start": {"a2": 5.0, "b1": 3.0, "zp": 4.0, "theta_z": 0.0}}, "start: zs: got no value"),
    ("trace", {"start": {"a2": NAN, "b1": 3.0, "zp": 4.0, "zs": 2.0, "theta_z": 0.0}}, "start: a2: got nan"),
    ("trace", {"start": {"c1": 1.0}}, "start: variables: got the entry 'c1'"),
    *(
        (name, {"not_a_name": 1}, r"\w+: got the entry 'not_a_name'")
        for name in "About Actuator Loads Masses Objective Pose Region Speeds Study Tolerances Tool".split()
    ),
    ("Study", {"constraint": {}}, r".*got the entry 'constraint', expected only .*\(did you mean 'constraints'\?\)$"),
    ("Region", {"tilts": 0.1}, r".*got the entry 'tilts', expected only .*\(did you mean 'tilt'\?\)$"),
    ("Study", {"starts": 2**31 - 1}, "starts: got 2147483647, expected a whole number from 1 to 1000000"),
    ("sweep", {"threads": 4096}, "threads: got 4096"),
    ("sweep", {"threads": 0}, "threads: got 0"),
    ("sweep", {"over": {}}, "over: got {}, expected a mapping of one to 3 names"),
    (
        "sweep",
        {"over": dict.fromkeys(("x_p", "y_p", "z_p", "x_s"), (0, 1, 2))},
        "over: got .*mapping of one to 3 names",
    ),
    ("sweep", {"over": "x_p"}, "over: got 'x_p', expected a mapping"),
    ("sweep", {"over": {"xp": [0.0]}}, "over: got 'xp', expected one of theta_x.*did you mean 'x_p'"),
    ("sweep", {"over": {"x_p_deg": [0.1]}}, "over: got 'x_p_deg'"),
    (
        "sweep",
        {"over": {"theta_z": [0.1], "theta_z_deg": [5.0]}},
        "over: got both theta_z and theta_z_deg, expected one",
    ),
    *(
        ("sweep", {"over": {"x_p": bad}}, r"over\['x_p'\]: got .*, expected finite values of shape")
        for bad in ([], [[0.0]], 0.5, [INF])
    ),
    ("sweep", {"over": {"x_p": ["a"]}}, r"over\['x_p'\]: got"),
    ("sweep", {"over": {"x_p": (0.0, NAN, 3)}}, r"over\['x_p'\]: got nan, expected a finite number"),
    ("sweep", {"over": {"x_p": (0.0, 1.0)}}, r"over.*, expected an array of values, or \(low, high, count\)"),
    ("sweep", {"over": {"x_p": (0.0, 1.0, 2.5)}}, r"over\['x_p'\]: count: got 2.5, expected a whole number"),
    ("sweep", {"over": {"x_p": (0.0, 1.0, 0)}}, ".*count: got 0"),
    ("sweep", {"over": {"x_p": (0.0, 1.0, 1)}}, "over.* expected a count of 2 at least, or low = high"),
    (
        "sweep",
        {"over": dict.fromkeys(("x_p", "y_p"), (0, 1, 2**30))},
        "over: got 1073741824 x 1073741824 points, expected",
    ),
    ("sweep", {"over": {"x_p": (0, 1, 2**40)}, "chunk": None}, "over: got 1099511627776 points, expected what fits"),
    ("sweep", {"index": []}, r"index: got \[\], expected a name"),
    ("sweep", {"index": ["leg_ratio", "leg_ratio"]}, "index: .*expected different names"),
    (
        "sweep",
        {"internal_point": "carried", "relative": False, "over": {"x_s": [0.0]}},
        "over: .* expected O to be displacements",
    ),
    ("sweep", {"home": it.stack()}, "home: got a stack"),
    ("sweep_designs", {"design": {"a1": 0}, "over": {"a1": [1.0]}}, "design: got a1, which is swept"),
    ("sweep_designs", {"design": {"a1": 0}, "over": {"zs": [1.0]}}, "a2: got no value, expected a number"),
    ("sweep_designs", {"design": {"a1": 0, "a9": 2}}, "design: got the entry 'a9'"),
    ("sweep_designs", {"design": {"a1": INF}}, r"design\['a1'\]: got inf"),
    ("sweep_designs", {"design": {}, "over": {"x_p": [1.0]}}, "over: got 'x_p', expected one of a1"),
    (
        "sweep_designs",
        {"design": {"a1": 0, "b1": 1, "b2": 1, "zp": 2, "zs": 1}, "over": {"a2": [-1.0]}},
        "a2: got -1",
    ),
    ("sweep_figure", {"points": 1}, "points: got 1"),
    ("atlas", {"bounds": {"zs": (0, 1)}}, "bounds: got the entry 'zs', expected only a1"),
    ("atlas", {"bounds": {"a1": (3, 1)}}, r"bounds\['a1'\]: got \(3, 1\), expected 0 <= low <= high"),
    ("atlas", {"bounds": {"a1": (-1, 1)}}, r"bounds\['a1'\]: got -1"),
    ("atlas", {"bounds": {"zs_fraction": (0, 1.5)}}, "bounds.*expected 0 <= low <= high <= 1"),
    ("atlas", {"bounds": [1]}, "bounds: got"),
    ("tolerances_for", {"position": None, "rotation": None}, "position, rotation: got neither"),
    ("tolerances_for", {"position": -1.0}, "position: got -1"),
    ("tolerances_for", {"weights": (0, 0)}, "weights: got"),
    ("tolerances_for", {"weights": 1.0}, "weights: got"),
    ("admissible", {"of": PLACED, "vary": ("a2",)}, 'internal_point: got "best"'),
    ("admissible", {"of": MEAN_LEG}, ".*characteristic_length"),
    ("admissible_actuators", {"study": nd.Study.paper()}, "study: got one without actuators"),
    ("pareto", {"study": PLACED, "against": "tolerance"}, 'against: got "tolerance" for a study that places O anew'),
    ("error_samples", {"samples": 2**40}, "samples: got 1099511627776"),
    ("atlas", {"designs": 2**40, "chunk": 1}, "chunk: got 1 of 1099511627776 points, expected at least 262"),
    ("pareto", {"against": "radius_ratoi"}, r"against: got 'radius_ratoi', .* \(did you mean 'radius_ratio'\?\)"),
    (
        "pareto",
        {"against": "joint_spacing"},
        "against: got 'joint_spacing', which has no max, expected a .*varies$",
    ),
    ("Study", {"characteristic_length": "150 mm"}, ".*got '150 mm', expected .*a number: its unit is the length unit"),
    ("pareto", {"against": "leg_ratio at neutrl"}, r"against: .* \(did you mean 'leg_ratio at neutral'\?\)"),
    ("pareto", {"against": "stroke at neutral"}, r"stroke\.at: got \"neutral\", expected \"poses\""),
    ("pareto", {"against": "condition_number"}, "against: got 'condition_number' for a study of the index 'condition"),
    ("pareto", {"against": "condition_limit"}, "against: got 'condition_limit' for a study of the index 'condition"),
    ("pareto", {"against": "base_cone", "values": [35]}, 'values: got 35 radians, .*against="base_cone_deg"'),
    ("pareto", {"against": "base_cone_deg", "values": [200]}, ".*200 degrees"),
    ("pareto", {"against": "radius_ratio_deg"}, "against: got 'radius_ratio_deg'"),
    ("pareto", {"against": "base_cones_deg"}, "against: got 'base_cones_deg'.*did you mean 'base_cone'"),
    ("pareto", {"against": "tolerances"}, r"against: got 'tolerances'.*did you mean 'tolerance'"),
    (
        "pareto",
        {"against": "tolerance", "values": [0.1, -1.0]},
        "values: got .*, expected one or more limits from 0 on",
    ),
    ("pareto", {"values": []}, r"values: got \[\], expected one or more limits above 0"),
    ("pareto", {"values": [2.0, -1.0]}, r"values: got \[2.0, -1.0\], expected one or more limits above 0"),
    ("pareto", {"values": [2.0, NAN]}, r"values\[1\]: got nan, expected a finite number"),
    ("pareto", {"values": 2.0}, "values: got 2.0, expected a sequence of limits"),
    ("pareto", {"values": None, "points": 1}, "points: got 1, expected a whole number from 2"),
    ("prove_optimum", {"study": MANY_FREE}, "variables: got 7 that are free, expected one to 6"),
    (
        "prove_optimum",
        {"study": nd.Study("symmetric_nonplanar", characteristic_length="mean_leg")},
        "characteristic_length: got no number",
    ),
    (
        "prove_optimum",
        {"study": nd.Study(objective={"poses": [{"position": [0.1, 0, 0], "internal_point": "best"}]})},
        "poses: got O chosen at a pose",
    ),
    (
        "prove_optimum",
        {"study": nd.Study("symmetric", variables={"zp": (0.0, 5.0), "base_internal_radius": (0.0, 5.0)})},
        r"zp: got \[0, 5\]",
    ),
    ("prove_optimum", {"study": nd.Study(objective={"index": "speed"})}, "objective: got another index"),
    ("optimize", {"study": MANY_FREE, "certify": True, "warm": None}, "variables: got 7 that are free"),
    ("optimize", {"time_limit": 0.0}, "time_limit: got 0.0, expected seconds, more than 0"),
    ("optimize", {"start": 3}, "optimize: got the entry 'start', expected only study, .*did you mean 'starts'"),
    ("sweep", {"thread": 3}, "sweep: got the entry 'thread', expected only .*did you mean 'threads'"),
    ("prove_optimum", {"condition_number": 3.0, "gap": 1.0}, ".*more than 1 to be proved"),
    ("Result.certify", {"gap": 0.0}, "gap: got 0.0, expected a finite number at least 1e-09"),
    ("Result.certify", {"condition_number": 0.5}, "condition_number: got 0.5"),
    ("export", {"format": "mjfc"}, "format: got 'mjfc', .*did you mean 'mjcf'"),
    ("export", {"format": "urdf"}, "options: got the entry 'gravity', expected only leg_mass, platform_mass"),
    ("export", {"unit": "mile"}, "unit: got 'mile'"),
    ("export", {"gravity": "much"}, "gravity: got"),
    ("export", {"design": NO_DESIGN}, ".*got a result without a design"),
    ("export", {"design": it.design()._replace(configuration=AT_JOINT)}, ".*leg q1 has the length 0"),
    ("check", {"result": NO_DESIGN}, "result: got one without a design"),
    ("applicable_bounds", {"result": NO_DESIGN}, "result: got one without a design"),
    ("export", {"path": "none/a.xml"}, ".*expected a file in a folder that exists"),
    ("export", {"design": it.design()._replace(configuration=it.stack())}, ".*got a stack of configurations"),
    ("report", {"run": "nowhere", "path": None}, "nowhere: cannot be read"),
    ("report", {"path": None}, "path: got none, expected the file"),
    ("report", {"path": "none/it.html"}, ".*a file in a folder that exists"),
    ("load_certificate", {"run": "nowhere"}, "nowhere: cannot be read"),
    ("Trajectory.load", {"path": "none.csv"}, ".*cannot be read"),
    ("view", {"design": "nowhere.toml"}, "nowhere.toml: cannot be read"),
    ("view", {"design": nd.Study.paper()}, ".*expected a design file, a Design or a run"),
]


@pytest.mark.parametrize(("row", "entries", "words"), APART, ids=[f"{row} {str(e)[:50]!r}" for row, e, _ in APART])
def test_entries_apart(row, entries, words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    if row == "view":
        pytest.importorskip("viser", reason="the viewer needs viser")
    with bounded(), pytest.raises(ValueError, match=rf"(?s)^{words}") as refused:
        ROWS[row].call(**(ROWS[row].arguments() | entries))
    assert "\n" not in str(refused.value)


def test_shapes_that_do_not_broadcast_are_named():
    stack = it.c().moved(np.zeros((5, 9)))
    motion = dict.fromkeys(("omega", "pdot", "sdot", "alpha", "pddot", "sddot"), np.zeros(3))
    for name in motion:
        with pytest.raises(ValueError, match=rf"leading dimensions do not broadcast.*{name} \(2,\)"):
            nd.inverse_acceleration(it.g(), stack, **{**motion, name: np.ones((2, 3))})
    with pytest.raises(ValueError, match="leading dimensions do not broadcast"):
        nd.track(it.g(), np.ones((3, 9)), stack)
