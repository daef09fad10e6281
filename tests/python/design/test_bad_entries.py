"""Every kind of entry refuses what it cannot be, and names itself, what came and what was expected.

One table of kinds; whole files with their errors; entries that do not go together.
"""

import math
import operator
import re

import numpy as np
import pytest

import ninedof as nd
from ninedof import poses

NAN, INF = math.nan, math.inf
NO_NUMBERS = ["1", True, np.bool_(True), 1j, {"x": 0.0}, 10**400, 10**5000]  # the last one longer than Python spells
NO_LISTS = [(), [[0.0, 1.0], [2.0, 3.0]], np.array(3.0), "ab"]
NO_BOUNDS = [None, NAN, INF, (INF, INF), (0.0, NAN), (2.0, 1.0), -1.0, (-1.0, 1.0), ("0", "1"), (False, True)]
NO_LIMITS = [2.0, None, {1.0, 2.0}, (2.0, 1.0), (None, NAN), (-3.0, -1.0), (None, 0.0), (INF, None), (None, "2")]
NO_LIMITS += [{"max": "2"}, {"max": [1.0]}, [{"max": 1.0}, 3]]
NO_LENGTHS = [0.0, -1.0, NAN, INF, None, [1.0], (), "longest", (2.0, 1.0), (0.0, 1.0), (1.0, INF), (1.0, NAN)]
NO_VECTORS = [
    1.0,
    (0.0, 1.0),
    (0.0, 1.0, 2.0, 3.0),
    (0.0, NAN, 0.0),
    (INF, 0.0, 0.0),
    (True, 0.0, 0.0),
    ("0", "0", "0"),
]
NO_VECTORS += [np.array([True, False, False]), (None, 0.0, 0.0), (1j, 0.0, 0.0), {"x": 0.0}, (10**400, 0, 0)]
KINDS = {  # what is refused; places, each a call and the way to the entry among its arguments
    "number": (
        [*NO_NUMBERS, [1.0], NAN, -INF, -1.0],
        "Pose weight, Region ball, Region tilt, Region.from_dict data.tilt_deg, Region cylinder.0: cylinder, "
        "poses.ball radius, Objective condition_limit, Objective neutral_condition_limit, "
        "Study constraints.leg_clearance.radius: constraints.leg_clearance.radius",
    ),
    "bound": (
        [*NO_NUMBERS, *NO_LISTS, *NO_BOUNDS, (None, 1.0), (1.0,), (0.0, 1.0, 2.0), (0, 10**400)],
        "Study variables.a2, Study variables.zs",
    ),
    "limit": (
        [*NO_LISTS, *NO_LIMITS, (None, True), (None, np.bool_(True)), (None, 10**400), (None, 1.0, 2.0)],
        "Study constraints.radius_ratio, Study constraints.leg_ratio, Study constraints.zs_fraction",
    ),
    "length": (
        [*NO_NUMBERS, *NO_LENGTHS, (False, True), ("natural", "optimal"), (1.0, 2.0, 3.0)],
        "Study characteristic_length",
    ),
    "vector": (
        [*NO_LISTS, *NO_VECTORS, (10**5000, 0, 0)],
        "Pose position, Pose rotation, Pose.from_dict data.rotation_deg, Region box, poses.box half, "
        "poses.ball tilt_deg, poses.path positions.1, poses.path rotations.1, Study constraints.base_cone.axis",
    ),
    "whole number": (
        [-1, 1.0, 1.5, "1", True, None, 2**63, NAN],
        "Study starts, Study seed, poses.box points, Study constraints.singularity_free.steps",
    ),
    "word": (
        ["hexagonl", "", None, 1, 0.5, True, ["worst"]],
        "Study family, Pose unit, Region internal_point, Objective index, Objective aggregate, "
        "Study constraints.height.at, Study constraints.stroke.of",
    ),
    "table": (
        [None, 3, "a1", [{}]],
        "Study variables, Study constraints, Study objective, Study.from_dict data.design, Objective region",
    ),
    "list of poses": ([None, 3, "held", {"position": [0, 0, 0]}, iter(())], "Objective poses"),
    "pose": ([3, None, "held", (0.1, 0, 0), {"positon": (0, 0, 0)}], "Objective poses.0"),
}
BESIDE = {  # what a place needs beside the entry: further arguments, entries of its table, values before and after it
    "poses.box": {"half": (1, 1, 1)},
    "poses.ball": {"radius": 1.0},
    "poses.path": {"positions": [[0, 0, 0], [1, 0, 0]]},
    "base_cone": {"max": 1},
    "height": {"max": 1},
    "stroke": {"max": 1},
    "cylinder": ([], [1.0]),
    "positions": ([[0, 0, 0]], []),
    "rotations": ([[0, 0, 0]], []),
    "poses": ([], []),
}
OPTIONAL = ("Objective region", "Study constraints.singularity_free.steps", "Study constraints.height.at")
OPTIONAL += ("Study constraints.stroke.of",)


def arguments(call, way, bad):
    """The arguments of a call with the entry at the end of the way."""
    for place, step in reversed(list(zip([call, *way], way, strict=False))):
        if step.isdigit():
            before, after = BESIDE[place]
            bad = [*before, bad, *after]
        else:
            bad = {**BESIDE.get(place, {}), step: bad}
    return bad


@pytest.mark.parametrize(
    ("kind", "place"), [(kind, at) for kind, (_, places) in KINDS.items() for at in places.split(", ")]
)
def test_a_kind_of_entry(kind, place):
    place, _, name = place.partition(": ")
    call, _, way = place.partition(" ")
    name = re.sub(r"\.(\d)", r"[\1]", name or re.sub("^(data|variables)[.]", "", way))
    for bad in KINDS[kind][0]:
        if bad is not None or place not in OPTIONAL:
            with pytest.raises(ValueError, match=rf"(?s)^{re.escape(name)}[.\w\[\]]*: got .+, expected .+"):
                operator.attrgetter(call)(nd)(**arguments(call, way.split("."), bad))


HINTS = {
    "variable": (lambda: nd.Study(variables={"thetaz": 0.0}), "variables: got the entry 'thetaz'", "theta_z"),
    "constraint": (lambda: nd.Study(constraints={"radius_ration": 1}), "constraints: got the entry", "radius_ratio"),
    "word": (lambda: nd.Pose(internal_point="bets"), "internal_point: got 'bets'", "best"),
    "scale": (lambda: nd.Pose(unit="lenght"), "unit: got 'lenght'", "length"),
    "family": (lambda: nd.Study("hexagonl"), "family: got 'hexagonl'", "hexagonal"),
    "offset": (lambda: nd.Study().vector({"thetaz": 0.0}), "variables: got the entry 'thetaz'", "theta_z"),
}


@pytest.mark.parametrize(("make", "got", "hint"), HINTS.values(), ids=HINTS)
def test_slips_get_a_suggestion(make, got, hint):
    with pytest.raises(ValueError, match=rf"^{got}.*, expected .*did you mean '{hint}'"):
        make()


LIMITS = {  # text of a limit: its error
    "radius_ratio = { maxi = 2 }": "radius_ratio: got the entry 'maxi'.*did you mean 'max'",
    "radius_ratio = 2": "radius_ratio: got 2, expected .*a table",
    "radius_ratio = { max = 2, of = 'zp' }": "radius_ratio: got the entry 'of'",
    "radius_ratio = { max_deg = 2 }": "radius_ratio: got the entry 'max_deg'",
    "stroke = { max = 2, of = 'zs' }": "stroke.of: got 'zs'.*did you mean 'zp'",
    "stroke = { max = 2, off = 'zp' }": "stroke: got the entry 'off'.*did you mean 'of'",
    "stroke = { of = 'zp' }": "stroke: got of alone, expected max too",
    "height = { at = 'neutral' }": "height: got at alone, expected min or max too",
    "height = { max = 1, at = 'home' }": "height.at: got 'home', expected one of poses, neutral",
    "height = [{ max = 1 }, 3]": r"height\[1\]: got 3, expected .*a table",
    "height = [{ max = 1 }, { max = 2 }]": 'height.at: got "poses" twice, expected one limit',
    "height = [{ max = 1 }, { max = -2, at = 'neutral' }]": r"height\[1\]: .*-2.*low <= high",
    "stroke = [{ max = 1 }, { min = 1, at = 'neutral' }]": r"stroke\[1\]: got the entry 'min'",
    "base_cone = { max = 45 }": "base_cone.max: got 45 radians.*degrees are given as max_deg",
    "base_cone = { max_deg = 181 }": "base_cone.max: .*181 degrees, expected at most pi",
    "base_cone = { max_deg = -3 }": r"base_cone: got \(None, -3.0\) degrees",
    "base_cone = { max = inf, axis = [0, 0, 1] }": "base_cone.max: got inf.*at most pi",
    "base_cone = { max = 1, max_deg = 45 }": "base_cone.max: got both max and max_deg",
    "base_cone = { max = 1, axis = [0, 0, 0] }": "base_cone.axis: got .*a direction",
    "base_cone = { axis = [0, 0, 1] }": "base_cone: got axis alone",
    "base_cone = { max = 1, steps = 3 }": "base_cone: got the entry 'steps'",
    "leg_clearance = { min = 1, radius = 1 }": "leg_clearance.min: got both min and radius",
    "leg_clearance = { radius = -12.0 }": "leg_clearance.radius: got -12",
    "singularity_free = { min = 1.0 }": "singularity_free: .*between 0 and 1",
    "singularity_free = { min = 0 }": "singularity_free: .*between 0 and 1",
    "singularity_free = { steps = 4, at = 'neutral' }": "singularity_free.steps: got 4, expected none",
}
FILES = {f"[constraints]\n{text}": f"constraints.{words}" for text, words in LIMITS.items()} | {  # of a file
    '[desgin]\nfamily = "hexagonal"': "study: got the entry 'desgin'.*did you mean 'design'",
    '[design]\nfamly = "hexagonal"': "design: got the entry 'famly'.*did you mean 'family'",
    "[variables]\ntheta = 0.0": "variables: got the entry 'theta'.*did you mean 'theta_z'",
    "[variables]\nzp_deg = 3": "variables: got the entry 'zp_deg'",
    "[variables]\na1 = 1979-05-27": "a1: got .*1979",
    f"[variables]\na1 = {'9' * 400}": "a1: got 999",
    "[variables]\ntheta_z = 1.0\ntheta_z_deg = 30": "theta_z: got both theta_z and theta_z_deg, expected one",
    "[variables]\ntheta_z_deg = '30'": "theta_z_deg: got '30', expected a number",
    "[variables]\ntheta_z_deg = [30, -30]": r"theta_z_deg: got \[30, -30\], expected low <= high",
    "[constraints]\nradius_rato = { max = 2 }": "constraints: got the entry.*did you mean 'radius_ratio'",
    "[constraints]\nstroke = { max = 1, at = 'neutral' }": 'stroke.at: got "neutral", .*differences between poses',
    "[constraints]\nbase_cone = { max = 1, at = 'neutral' }": "base_cone.axis at neutral: got none, expected an axis",
    "[solver]\nstart = 3": "solver: got the entry 'start'.*did you mean 'starts'",
    "a1 = 3": "study: got the entry 'a1'",
    '[[design]]\nfamily = "hexagonal"': "design: got .*expected a table",
    "[geometry]\na1 = 3": "study: got a design",
    "[objective]\nindx = 'x'": "objective: got the entry 'indx'.*did you mean 'index'",
    "[objective]\nindex = 'manipulability'": "objective.index: got 'manipulability'",
    "[objective]\naggregate = 'wurst'": "objective.aggregate: .*did you mean 'worst'",
    "[objective]\nweight = 1.5": "objective.weight: got 1.5",
    "[objective]\ncondition_limit = 0.5": "objective.condition_limit: got 0.5",
    "[objective]\nunit = 'zs'": "objective.unit: got 'zs'.*did you mean 'zp'",
    "[objective.poses]\nposition = [0, 0, 0]": "objective.poses: got .*position",
    "[[objective.poses]]\npositon = [0, 0, 0]": r"objective.poses\[0\]: .*did you mean 'position'",
    "[[objective.poses]]\nposition = [0, nan, 0]": r"objective.poses\[0\].position: got nan",
    "[[objective.poses]]\nrotation = [0, 0, 1]\nrotation_deg = [0, 0, 1]": r"objective.poses\[0\].rotation: got both",
    "[objective.box]\npoints = 3": "objective.box.half: got nothing",
    "[objective.box]\nhalf = [0, 0, 0]\npoint = 3": "objective.box: .*did you mean 'points'",
    "[objective]\nbox = [0.1, 0.1, 0.1]": "objective.box: got .*expected a mapping",
    "[objective.path]\npositions = [[0, 0, 0]]": "objective.path.positions: got 1 corners, expected at least two",
    "[objective.region]\nbal = 1": "objective.region: got the entry 'bal', .*did you mean 'ball'",
    "[objective.region]\nball = 1\nbox = [1, 1, 1]": "objective.region.ball: got box and ball, expected one of",
    "[objective.region]\npath = [[0, 0, 0], [0, 0, 0]]": "objective.region.path: got 2 corners",
    "[objective.region]\ntilt_deg = 200": "objective.region.tilt: got .*200 degrees, expected at most pi, 180 degrees",
    "[objective.region]\nyaw = 0.1\nyaw_deg = 5": "objective.region.yaw: got both yaw and yaw_deg",
    "[objective.region]\ninternal_point = 'carried'": "objective.region.internal_point: got 'carried', expected one of",
    "unit = 'inch'": "unit: got 'inch', expected the name of a length unit, one of mm, cm, m, in, ft",
    "unit = 1000": "unit: got 1000, expected the name",
    "unit = 'zp'": r'unit: got \'zp\'.*scale of pose shifts.*\[objective\] unit = "zp"',
    "[objective]\nunit = 'mm'": r'objective\.unit: got \'mm\'.*length, zp.*top of the file.*unit = "mm"',
    "[[objective.poses]]\nunit = 'mm'": r"objective\.poses\[0\]\.unit: got 'mm'.*top of the file",
    "[solver]\nunit = 'mm'": r"solver\.unit: got 'mm', expected no unit here.*before the tables",
    "a1 = = 3": "not a TOML file.*line 1",
    "[solver]\nstarts = 1\nstarts = 2": "not a TOML file",
    f"[variables]\na1 = {'9' * 5000}": "not a TOML file",
    "a = " + "[" * 5000 + "]" * 5000: "not a TOML file",
    bytes(range(256)): "cannot be read .not UTF-8 text",
    "[design]".encode("utf-16"): "cannot be read .not UTF-8 text",
    b"\0\0\0\0": "not a TOML file",
}


@pytest.mark.parametrize(("text", "words"), FILES.items(), ids=[f"{str(text)[:60]!r}" for text in FILES])
def test_a_file_is_named_with_its_error(tmp_path, text, words):
    path = tmp_path / "study.toml"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(ValueError, match=rf"(?s)^{path}: {words}"):
        nd.Study.load(path)


def test_files_that_cannot_be_read(tmp_path):
    for path, words in ((tmp_path / "none.toml", "No such file"), (tmp_path, "directory")):
        with pytest.raises(ValueError, match=rf"^{path}: cannot be read \(.*{words}"):
            nd.Study.load(path)


LINE, REGION = [[0, 0, 0], [1, 0, 0]], nd.Region(box=(0.1, 0.1, 0.1))
APART = {  # entries that do not go together
    "too many points": (lambda: poses.box((1, 1, 1), points=100), "points"),
    "far too many points": (lambda: poses.ball(1.0, points=10**9), "points"),
    "tilt twice": (lambda: poses.box((1, 1, 1), tilt=(0, 0, 0), tilt_deg=(0, 0, 0)), "tilt: got both"),
    "tilt negative": (lambda: poses.box((1, 1, 1), tilt_deg=(-1, 0, 0)), "tilt_deg"),
    "path of nothing": (lambda: poses.path([]), "positions"),
    "path of one point": (lambda: poses.path(LINE, points=1), "points"),
    "rotations too few": (lambda: poses.path(LINE, rotations=[[0, 0, 0]]), "rotations"),
    "rotations twice": (lambda: poses.path(LINE, rotations=LINE, rotations_deg=LINE), "rotations: got both"),
    "turning without moving": (
        lambda: poses.path([[0, 0, 0], *LINE], rotations=[[0, 0, 0], [0, 0, 1], [0, 0, 1]]),
        r"positions\[1\]",
    ),
    "six legs at poses": (lambda: nd.Objective(index="six_legged", poses=(nd.Pose(),)), "poses"),
    "six legs over a region": (lambda: nd.Objective(index="six_legged", region=REGION), "region"),
    "a mean beside a region": (
        lambda: nd.Objective(region=REGION, aggregate="mean_inverse", poses=[nd.Pose()]),
        "poses: got poses beside a mean over a region",
    ),
    "a mean where O is best": (
        lambda: nd.Objective(region=nd.Region(ball=1, internal_point="best"), aggregate="weighted"),
        "aggregate",
    ),
}


@pytest.mark.parametrize(("make", "words"), APART.values(), ids=APART)
def test_entries_that_do_not_go_together(make, words):
    with pytest.raises(ValueError, match=rf"^{words}.*, expected "):
        make()
