"""Names of files and XML that a stranger chose: no name becomes structure, no document grows or reads other files."""

import csv
import io
import json
import re
from xml.etree import ElementTree

import pytest

import ninedof as nd
from ninedof.export.export import formats
from ninedof.records.record import write_run

DESIGN = nd.Design(
    nd.Geometry.hexagonal(a1=0.0, a2=581.24, b1=290.62, b2=0.0), nd.Configuration.neutral(398.28, 244.35), 100.0, "mm"
)
NAMES = (
    '"><script>ran=1<',
    "--><!-- ]]>&amp;",
    "=cmd|' C'!A0",
    "*! int main(){} *!\"; x('",
    "\\input{x}$x$%{title}",
    "');ENDSEC;",
    "@SUM(1)+1-1",
)


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("format", formats())
def test_the_name_of_a_file_stays_a_name(tmp_path, format):
    pytest.importorskip("ezdxf") if format == "dxf" else None
    row = formats()[format]
    plain = nd.export(DESIGN, format, tmp_path / f"{'n' * 8}{row.suffix}").read_text(encoding="utf-8")
    for name in NAMES:
        folder = tmp_path / "out"
        folder.mkdir(exist_ok=True)
        nd.export(DESIGN, format, folder / f"{name}{row.suffix}")
        for file in folder.iterdir():
            text = file.read_text(encoding="utf-8")
            assert not re.search("[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e]", text)
            if file.suffix in (".xml", ".urdf", ".sdf"):
                twin, expected = (ElementTree.fromstring(one) for one in (text, plain))
                assert [item.tag for item in twin.iter()] == [item.tag for item in expected.iter()]
            elif file.suffix == ".json":
                json.loads(text)
            elif file.suffix == ".csv":
                assert text == plain
            elif format in ("c", "latex"):
                assert len(text.splitlines()) == len(plain.splitlines())
            elif format == "step":
                assert text.count("'") == plain.count("'")
                assert len(text.split(";")) == len(plain.split(";"))
            file.unlink()


def test_no_cell_of_a_table_is_a_formula(tmp_path):
    """A spreadsheet computes a cell that begins with =, +, - or @; only numbers may begin with a sign."""
    path = nd.export(DESIGN, "csv", tmp_path / "=1+1.csv")
    tables = [path.read_text(), nd.sheet(DESIGN).to_csv()]
    home = DESIGN.configuration
    circle = nd.Trajectory.circle(home, radius=5.0, duration=1.0, points=5, unit="mm")
    followed = nd.follow(DESIGN.geometry, circle, home)
    write_run(followed, tmp_path, question={"design": "=1+1"})
    tables += [(tmp_path / name).read_text() for name in ("legs.csv", "poses.csv")]
    cells = 0
    for text in tables:
        for cell in (cell for row in csv.reader(io.StringIO(text)) for cell in row if cell):
            assert cell[0] not in "=@\t\r"
            if cell[0] in "+-":
                float(cell)
            cells += 1
    assert cells > 300
    for unit in ("=1+1", "@x", "mm\n=1"):
        with pytest.raises(ValueError, match="unit: got"):
            nd.export(nd.Design(DESIGN.geometry, home, 1.0, unit), "csv", path)
        with pytest.raises(ValueError, match="unit: got"):
            nd.Trajectory.circle(home, radius=5.0, unit=unit)


BOMB = "<!DOCTYPE x [<!ENTITY a 'aaaaaaaaaa'>" + "".join(
    f"<!ENTITY {b} '{10 * f'&{a};'}'>" for a, b in zip("abcdefgh", "bcdefghi", strict=True)
)


@pytest.mark.parametrize("head", [BOMB + "]>", "<!DOCTYPE x [<!ENTITY i SYSTEM 'file:///etc/hostname'>]>"])
def test_no_document_grows_or_reads_another_file(tmp_path, head):
    good = nd.export(DESIGN, "mjcf", tmp_path / "good.xml").read_text()
    bad = tmp_path / "bad.xml"
    bad.write_text(head + good.replace('data="mm"', 'data="&i;"').replace("<worldbody>", "<worldbody>&i;"))
    with pytest.raises(ValueError, match=r"bad\.xml: not an XML file"):
        nd.load(bad)


@pytest.mark.parametrize("text", ["", "<", "<a>" * 50_000, "\x00", "<mujoco>&x;</mujoco>"])
def test_what_is_no_xml_is_one_line(tmp_path, text):
    path = tmp_path / "it.xml"
    path.write_text(text)
    with pytest.raises(ValueError, match=r"it\.xml: not an XML file") as refused:
        nd.load(path)
    assert "\n" not in str(refused.value)
