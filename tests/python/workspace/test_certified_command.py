"""`ninedof workspace --certify`: its words, its run folder, its figure."""

import json

import numpy as np
import pytest
from interrupts import interrupted_on_entry

import ninedof as nd

ASKED = "workspace --legs 2.5 6.5 --condition 5 --tolerance 1e-2 --x -2.5 2.5 --y -2.5 2.5 --z 3 7"


@pytest.mark.slow
def test_the_proof_is_said_and_kept(run, tmp_path):
    folder = tmp_path / "run"
    code, out, _ = run(f"{ASKED} --certify --gap 0.2 --out {folder}")
    assert code == 0
    words = " ".join(out.split())
    assert "Proved: the workspace has a volume between" in words
    assert "goes on beyond the box" in words
    assert "lies between the bounds" in words
    assert {"map.npz", "certified.npz", "certified_workspace.png", "certified_workspace.svg"} <= {
        file.name for file in folder.iterdir()
    }
    found = nd.load(folder)
    proved = found.certified
    assert proved.volume[0] <= found.volume <= proved.volume[1]
    assert proved.estimate == (found.volume, found.error)
    assert proved.gap <= 0.2
    recorded = json.loads((folder / "record.json").read_text())
    assert recorded["results"]["workspace"]["certified"]["volume"] == list(proved.volume)
    assert "certified.npz" in recorded["files"]
    assert "Proved: the workspace has a volume" in (folder / "report.html").read_text()
    copied = nd.load(nd.save(found, tmp_path / "copy").parent)
    assert np.array_equal(copied.certified.cuts, proved.cuts)
    assert nd.load(folder).to_dict()["certified"] == found.to_dict()["certified"]
    proved.with_estimate(1.001 * found.volume, found.error).save(folder / "certified.npz")
    with pytest.raises(ValueError, match=r"certified\.npz: got what is proved of another map"):
        nd.load(folder)


def test_a_map_alone_has_no_proof(run, tmp_path):
    assert run(f"{ASKED} --no-figures --out {tmp_path / 'run'}")[0] == 0
    assert nd.load(tmp_path / "run").certified is None


def test_sections_show_every_state(published):
    proved = nd.certified_workspace(
        published, ([-4, -4, 0], [4, 4, 8]), criteria={"leg_limits": (2.5, 6.5), "condition_number": 5.0}, gap=0.3
    )
    section = proved.section("z", 4.81, 120)
    assert section.axes == ("x", "y")
    assert section.state.shape == (len(section.vertical), len(section.horizontal))
    assert set(np.unique(section.state)) == {-1, 0, 1}
    x, y = np.meshgrid(section.horizontal, section.vertical)
    at = np.stack([x, y, np.full_like(x, 4.81)], axis=-1)
    assert np.array_equal(section.state, proved.state(at.reshape(-1, 3)).reshape(x.shape))
    for low_x, low_y, high_x, high_y in section.inner:
        covered = (x >= low_x) & (x <= high_x) & (y >= low_y) & (y <= high_y)
        assert (section.state[covered] == 1).all()
    figure = nd.plot.certified_workspace([nd.plot.Section(section, home=(0.0, 0.0))], "mm")
    assert figure.axes[0].get_xlabel() == "x (mm)"
    beside = nd.certified_workspace(published, ([-1, -1, 4], [1, 1, 5]), criteria={"leg_limits": (2.5, 6.5)})
    axes = nd.plot.certified_workspace([nd.plot.Section(beside.section("z", 4.5, 40))]).axes[0]
    assert beside.beyond == "something"
    assert np.abs([*axes.get_xlim(), *axes.get_ylim()]).max() <= 1.0 + 1e-12  # white past the box would say too much
    with pytest.raises(ValueError, match="axis: got 'w'"):
        proved.section("w", 0.0)
    with pytest.raises(ValueError, match="at: got 100"):
        proved.section("z", 100.0)


def test_an_interruption_of_the_proof_keeps_the_map(run, tmp_path):
    with interrupted_on_entry("certified_workspace"):
        assert run(f"{ASKED} --certify --gap 1e-6 --no-figures --out {tmp_path / 'run'}")[0] == 130
    found = nd.load(tmp_path / "run")
    assert found.volume > 0.0
    assert found.certified is None or found.certified.interrupted
