"""Finished pieces of an optimization: a run that goes on behind them gives the same result, bit for bit."""

import os
import shutil
import signal

import pytest

import ninedof as nd
from ninedof import _core
from ninedof.chunks import Store
from ninedof.support.json import encode

LONG = pytest.mark.skipif("NINEDOF_LONG" not in os.environ, reason="half a minute")
REGION = {"box": [0.4, 0.0, 0.0]}
VARIABLES = {"zp": (1.0, 6.0)}
LIMITS = {"radius_ratio": {"max": 2.0}, "leg_ratio": {"max": 2.4}}


def study(rule):
    region = nd.Region(**REGION, internal_point=rule)
    return nd.Study(variables=VARIABLES, constraints=LIMITS, objective=nd.Objective(region=region), starts=2)


def plain(result):
    return encode({name: value for name, value in result.to_dict().items() if name != "seconds"})


class Killed(Exception):
    """Stands for the end of the process."""


@pytest.fixture(scope="module", params=["shifted", pytest.param("best", marks=LONG)])
def whole(request, tmp_path_factory):
    """A study, its result without a folder, and the folder of a second run with all pieces."""
    folder = tmp_path_factory.mktemp("pieces") / "chunks"
    asked = study(request.param)
    return asked, nd.optimize(asked), nd.optimize(asked, out=folder), folder


def test_pieces_change_nothing(whole):
    _, without, kept, _ = whole
    assert plain(kept) == plain(without)


def test_a_run_that_was_killed_goes_on_to_the_same_bits(whole, tmp_path, monkeypatch):
    """Killed as a piece is written: the piece is lost, those before it are not computed again."""
    asked, without, _, folder = whole
    count = len(list(folder.glob("chunk-*")))
    assert count > 1
    write, computed = Store.write, []

    def killed(store, k, arrays):
        if k == count // 2:
            raise Killed
        write(store, k, arrays)

    def counted(name):
        call = getattr(_core, name)
        monkeypatch.setattr(_core, name, lambda *arguments: computed.append(name) or call(*arguments))

    monkeypatch.setattr(Store, "write", killed)
    with pytest.raises(Killed):
        nd.optimize(asked, out=tmp_path)
    monkeypatch.setattr(Store, "write", write)
    for name in ("optimize", "optimize_placed", "search_region", "search_region_placed"):
        counted(name)
    assert plain(nd.optimize(asked, out=tmp_path)) == plain(without)
    assert len(computed) == count - count // 2
    assert plain(nd.optimize(asked, out=tmp_path)) == plain(without)
    assert len(computed) == count - count // 2


class Stopping:
    """Presses Ctrl-C in a later round."""

    def __init__(self, rounds):
        self.left = rounds

    def phase(self, _):
        self.left -= 1

    def __call__(self, *_):
        if self.left < 0:
            signal.raise_signal(signal.SIGINT)


def test_after_ctrl_c_no_finished_round_and_no_search_is_done_again(whole, tmp_path, monkeypatch):
    asked, without, _, folder = whole
    stopped = nd.optimize(asked, out=tmp_path, progress=Stopping(1))
    assert stopped.interrupted
    finished, computed = len(list(tmp_path.glob("chunk-*"))), []
    assert finished > 1
    for name in ("optimize", "optimize_placed", "search_region", "search_region_placed"):
        call = getattr(_core, name)
        monkeypatch.setattr(_core, name, lambda *given, call=call: computed.append(call) or call(*given))
    assert plain(nd.optimize(asked, out=tmp_path)) == plain(without)
    assert len(computed) == len(list(folder.glob("chunk-*"))) - finished


def test_a_damaged_piece_is_computed_again(whole, tmp_path):
    asked, without, _, given = whole
    folder = shutil.copytree(given, tmp_path / "chunks")
    piece = folder / "chunk-00000001"
    data = bytearray(piece.read_bytes())
    data[-40] ^= 4
    piece.write_bytes(data)
    assert plain(nd.optimize(asked, out=folder)) == plain(without)
    assert piece.read_bytes() != data


def test_another_question_is_refused(whole):
    asked, without, _, folder = whole
    for other in (asked.with_solver(5), asked.with_solver(None, 1)):
        with pytest.raises(ValueError, match=r"out: got .*another question \(it differs in study\)"):
            nd.optimize(other, out=folder)
    with pytest.raises(ValueError, match=r"it differs in warm"):
        nd.optimize(asked, out=folder, warm=without.best.variables)
    with pytest.raises(ValueError, match="out: got 7, expected a path"):
        nd.optimize(asked, out=7)


def test_a_proof_is_kept_with_its_certificate(tmp_path):
    asked = nd.Study.paper().with_solver(8)
    first = nd.optimize(asked, certify=True, out=tmp_path)
    again = nd.optimize(asked, certify=True, out=tmp_path)
    assert first.proof.certificate
    assert again.proof == first.proof  # with its seconds
    assert again.proof.certificate == first.proof.certificate
    assert again.to_dict() == first.to_dict()


@pytest.mark.parametrize("warm", [{"nope": 1.0}, {"zp": object()}, {"zp": "x"}])
def test_bad_designs_to_begin_with_leave_no_folder(tmp_path, warm):
    with pytest.raises(ValueError, match="warm"):
        nd.optimize(nd.Study.paper(), warm=warm, out=tmp_path / "run")
    assert not list(tmp_path.iterdir())
