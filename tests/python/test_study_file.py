"""A study as a TOML file: what is written is read back, and every bad entry is named with its file."""

import math

import pytest

import ninedof as nd

INF = math.inf


@pytest.fixture
def write(tmp_path):
    def to_file(text):
        path = tmp_path / "study.toml"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    return to_file


STUDIES = {
    "paper": nd.Study.paper(),
    "nothing": nd.Study(),
    "everything": nd.Study(
        variables={"a1": (0, INF), "a2": 3.0, "b1": (0.1, 0.3), "zs": (1e-12, 1e12), "theta_z": (-INF, 1 / 3)},
        constraints={"radius_ratio": (1, 2), "leg_ratio": (None, 3.3), "zs_fraction": (0.1, None)},
        characteristic_length=0.1 + 0.2,
        starts=3,
        seed=2**62,
    ),
    "open constraint": nd.Study(constraints={"radius_ratio": (None, None), "leg_ratio": (None, INF)}),
}


@pytest.mark.parametrize("study", STUDIES.values(), ids=STUDIES.keys())
def test_round_trip(study, tmp_path):
    study.save(tmp_path / "study.toml")
    assert nd.Study.load(tmp_path / "study.toml") == study
    assert nd.Study.load(str(tmp_path / "study.toml")) == study
    assert nd.Study.from_dict(study.to_dict()) == study


def test_the_example_of_the_interface(write):
    text = """
        [design]
        family = "hexagonal"
        characteristic_length = 1.0
        [variables]
        a1 = [0.0, 60.0]
        a2 = [0, 60]
        theta_z = 0.0
        [constraints]
        radius_ratio = { max = 2.0 }
        leg_ratio = { max = 3.0 }
        zs_fraction = { min = 0.2, max = 0.9 }
        [objective]
        index = "condition_number"
        [solver]
        starts = 32
        seed = 5
    """
    limits = {"radius_ratio": (None, 2.0), "leg_ratio": (None, 3.0), "zs_fraction": (0.2, 0.9)}
    assert nd.Study.load(write(text)) == nd.Study(constraints=limits, starts=32, seed=5)


def test_empty_file_is_the_study_without_constraints(write):
    assert nd.Study.load(write("")) == nd.Study()
    assert nd.Study.load(write("# nothing\r\n[design]\r\n")) == nd.Study()


BAD_FILES = {
    "unknown table": ('[desgin]\nfamily = "hexagonal"', "desgin.*did you mean 'design'"),
    "unknown design key": ('[design]\nfamly = "hexagonal"', "design.*famly.*did you mean 'family'"),
    "unknown variable": ("[variables]\ntheta = 0.0", "variables.*theta.*did you mean 'theta_z'"),
    "unknown constraint": ("[constraints]\nradius_rato = { max = 2 }", "radius_rato.*did you mean 'radius_ratio'"),
    "unknown limit": ("[constraints]\nradius_ratio = { maxi = 2 }", "radius_ratio.*maxi.*did you mean 'max'"),
    "unknown solver key": ("[solver]\nstart = 3", "solver.*start.*did you mean 'starts'"),
    "unknown objective key": ("[objective]\nindx = 'x'", "objective.*indx.*did you mean 'index'"),
    "unknown index": ("[objective]\nindex = 'manipulability'", "objective.index.*manipulability"),
    "entry outside tables": ("a1 = 3", "a1"),
    "table as number": ("variables = 3", "variables.*table"),
    "array of tables": ('[[design]]\nfamily = "hexagonal"', "design.*table"),
    "constraint as number": ("[constraints]\nradius_ratio = 2", "radius_ratio.*table"),
    "family as number": ("[design]\nfamily = 3", "family.*3"),
    "length as text": ('[design]\ncharacteristic_length = "one"', "characteristic_length.*one"),
    "length nan": ("[design]\ncharacteristic_length = nan", "characteristic_length.*nan"),
    "variable as text": ('[variables]\na1 = "3"', "a1.*'3'"),
    "bound as text": ('[variables]\na1 = [0, "3"]', "a1.*'3'"),
    "three bounds": ("[variables]\na1 = [0, 1, 2]", r"a1.*\[0, 1, 2\]"),
    "no bounds": ("[variables]\na1 = []", r"a1.*\[\]"),
    "variable nan": ("[variables]\nzs = nan", "zs.*nan"),
    "bound nan": ("[variables]\nzs = [nan, 1.0]", "zs.*nan"),
    "low > high": ("[variables]\na1 = [2, 1]", "a1.*low <= high"),
    "variable bool": ("[variables]\na1 = true", "a1.*True"),
    "bound bool": ("[variables]\na1 = [false, true]", "a1.*False"),
    "variable date": ("[variables]\na1 = 1979-05-27", "a1.*1979"),
    "variable as table": ("[variables.a1]\nmin = 0", "a1.*min"),
    "huge whole number": (f"[variables]\na1 = {'9' * 400}", "a1.*999"),
    "limit bool": ("[constraints]\nleg_ratio = { max = true }", "leg_ratio.*True"),
    "limit nan": ("[constraints]\nleg_ratio = { max = nan }", "leg_ratio.*nan"),
    "limit low > high": ("[constraints]\nleg_ratio = { min = 3, max = 2 }", "leg_ratio.*low <= high"),
    "starts as decimal": ("[solver]\nstarts = 1.5", "starts.*1.5"),
    "starts bool": ("[solver]\nstarts = true", "starts.*True"),
    "no starts": ("[solver]\nstarts = 0", "starts.*0"),
    "seed as text": ('[solver]\nseed = "1"', "seed.*'1'"),
    "not toml": ("a1 = = 3", "not a TOML file.*line 1"),
    "twice": ("[solver]\nstarts = 1\nstarts = 2", "not a TOML file"),
    "too deep": ("a = " + "[" * 5000 + "]" * 5000, "TOML"),
    "binary": (bytes(range(256)), "not UTF-8 text"),
    "utf-16": ("[design]".encode("utf-16"), "not UTF-8 text"),
    "zeros": (b"\0\0\0\0", "not a TOML file"),
}


@pytest.mark.parametrize(("text", "says"), BAD_FILES.values(), ids=BAD_FILES.keys())
def test_bad_file(write, text, says):
    path = write(text)
    with pytest.raises(ValueError, match=rf"(?s)^{path}: .*{says}"):
        nd.Study.load(path)


def test_unreadable_file(tmp_path):
    for path, says in ((tmp_path / "none.toml", "No such file"), (tmp_path, "directory")):
        with pytest.raises(ValueError, match=rf"^{path}: cannot be read \(.*{says}"):
            nd.Study.load(path)


@pytest.mark.parametrize("data", [{"design": 1}, {"variables": []}, {"solver": {"starts": "x"}}, {"x": {}}], ids=str)
def test_bad_dictionary(data):
    with pytest.raises(ValueError, match=r"got .+, expected .+"):
        nd.Study.from_dict(data)
