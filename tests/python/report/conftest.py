"""One region study, its run folder and its page, solved and written once; the sheet of a design is computed once."""

import chromium
import pytest

import ninedof as nd

STUDY = nd.Study(
    variables={"a1": 0.0, "b2": 0.0, "theta_z": 0.0, "zp": 4.0},
    constraints={"radius_ratio": (None, 2.0), "base_cone": {"max_deg": 45}},
    objective={"region": {"box": [0.2, 0.2, 0.1], "tilt_deg": 5.0}},
    starts=2,
    unit="m",
    characteristic_length=1.0,
)


SHEETS = {}


@pytest.fixture(scope="module", autouse=True)
def _sheets_are_computed_once():
    compute = nd.Result.sheet

    def sheet(result):
        key = (result.study.words, result.objective)
        SHEETS[key] = SHEETS.get(key) or compute(result, samples=1000)
        return SHEETS[key]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(nd.Result, "sheet", sheet)
        yield


@pytest.fixture(scope="session")
def result():
    return nd.optimize(STUDY)


@pytest.fixture(scope="session")
def folder(result, tmp_path_factory):
    """A run folder whose name would be HTML, with one figure."""
    place = tmp_path_factory.mktemp("runs") / "<b>a&b"
    nd.save(result, place)
    (place / "mechanism.svg").write_text("<svg xmlns='http://www.w3.org/2000/svg'/>")
    (place / "mechanism.png").write_bytes(b"\x89PNG" + bytes(200))
    return place


@pytest.fixture(scope="module")
def page(folder, _sheets_are_computed_once):
    return nd.report(folder)


@pytest.fixture(scope="module")
def browser(tmp_path_factory):
    pytest.importorskip("websockets", reason="needs websockets, of the extra viewer")
    profile = tmp_path_factory.mktemp("chromium") / "profile"
    with chromium.page("about:blank", profile, options=chromium.FLAT) as opened:
        opened.listen()
        yield opened
