"""Finished pieces of an optimization: a run that goes on behind them gives the same result, bit for bit."""

import shutil

import pytest
from interrupts import InterruptedPhase

import ninedof as nd
from ninedof import _core
from ninedof.support.store import Store
from ninedof.support.text import encode

REGION = {"path": [[0.0, 0.0, 0.0], [0.4, 0.0, 0.0]]}
VARIABLES = {"zp": (1.0, 6.0)}
LIMITS = {"radius_ratio": {"max": 2.0}}
PROVED = nd.Study(constraints={"radius_ratio": {"max": 2.0}, "leg_clearance": {"min": 0.1}}, starts=4)
"""A proof leaves the clearance out: the study without it is solved too, from which the proof begins."""


def study(rule):
    objective = nd.Objective(index="frobenius", region=nd.Region(**REGION, internal_point=rule))
    return nd.Study(variables=VARIABLES, constraints=LIMITS, objective=objective, starts=1)


def plain(result):
    """Everything but the times."""

    def timeless(value):
        return {name: timeless(x) for name, x in value.items() if name != "seconds"} if type(value) is dict else value

    return encode(timeless(result.to_dict()))


def optimize(asked, **options):
    return nd.optimize(asked, certify=asked is PROVED, **options)


class Killed(Exception):
    """Stands for the end of the process."""


@pytest.fixture(scope="module", params=["shifted", "proved"])
def whole(request, tmp_path_factory):
    """A study, its result without a folder, and the folder of a second run with all pieces."""
    folder = tmp_path_factory.mktemp("pieces") / "run"
    asked = PROVED if request.param == "proved" else study(request.param)
    return asked, optimize(asked), optimize(asked, out=folder), folder


def count_calls(monkeypatch):
    """Return a list to which every search and proof of the core adds its name."""
    computed = []
    for name in ("optimize", "optimize_region", "prove_optimum"):
        call = getattr(_core, name)
        monkeypatch.setattr(_core, name, lambda *given, call=call, name=name: computed.append(name) or call(*given))
    return computed


@pytest.mark.slow
@pytest.mark.parametrize("whole", ["shifted", "best", "proved"], indirect=True)
def test_pieces_change_nothing(whole):
    asked, without, kept, folder = whole
    assert plain(kept) == plain(without)
    assert len(list(folder.glob("pieces/*.npz"))) == (3 if asked is PROVED else 1)


@pytest.mark.slow(sanitized=True)
def test_a_run_that_was_killed_goes_on_to_the_same_bits(whole, tmp_path, monkeypatch):
    """Killed as a piece is written: the piece is lost, those before it are not computed again."""
    asked, without, _, folder = whole
    count = len(list(folder.glob("pieces/*.npz")))
    keep = Store.keep

    def killed(store, k, arrays):
        if k == count // 2:
            raise Killed
        keep(store, k, arrays)

    monkeypatch.setattr(Store, "keep", killed)
    with pytest.raises(Killed):
        optimize(asked, out=tmp_path)
    monkeypatch.setattr(Store, "keep", keep)
    computed = count_calls(monkeypatch)
    for _ in range(2):
        assert plain(optimize(asked, out=tmp_path)) == plain(without)
        searches = [name for name in computed if name.startswith("optimize")]
        assert len(searches) == 1  # of a proof, that without the clearance


@pytest.mark.slow(sanitized=True)
def test_after_ctrl_c_what_is_finished_is_not_done_again(whole, tmp_path, monkeypatch):
    """A study over a region is one piece: it begins anew."""
    asked, without, _, _ = whole
    if asked is PROVED:
        with pytest.raises(KeyboardInterrupt):  # between two calls of the core
            optimize(asked, out=tmp_path, progress=InterruptedPhase("proving"))
    else:
        bar = InterruptedPhase("round 1, ")
        assert optimize(asked, out=tmp_path, progress=bar).interrupted
    assert len(list(tmp_path.glob("pieces/*.npz"))) == (2 if asked is PROVED else 0)
    computed = count_calls(monkeypatch)
    assert plain(optimize(asked, out=tmp_path)) == plain(without)
    assert ("optimize_region" in computed) == (asked is not PROVED)
    assert "optimize" not in computed


@pytest.mark.slow(sanitized=True)
def test_what_the_time_ended_is_not_kept(whole, tmp_path):
    """The next call, with any limit, solves it anew; what is finished does not depend on the limit."""
    asked, without, _, folder = whole
    ended = optimize(asked, out=tmp_path, time_limit=1e-9)
    assert (ended.status, ended.interrupted) == ("stopped", False)
    assert not list(tmp_path.glob("pieces/*.npz"))
    assert plain(optimize(asked, out=tmp_path, time_limit=600.0)) == plain(without)
    assert plain(optimize(asked, out=folder, time_limit=1e-9)) == plain(without)


def test_a_damaged_piece_is_computed_again(whole, tmp_path):
    asked, without, _, given = whole
    folder = shutil.copytree(given, tmp_path / "run")
    piece = folder / "pieces" / "00000000.npz"
    data = bytearray(piece.read_bytes())
    data[-40] ^= 4
    piece.write_bytes(data)
    assert plain(optimize(asked, out=folder)) == plain(without)
    assert piece.read_bytes() != data


def test_another_question_is_refused(whole):
    asked, without, _, folder = whole
    certify = asked is PROVED
    for other in (asked.with_solver(5), asked.with_solver(None, 1)):
        with pytest.raises(
            ValueError, match=r"out: got .*another question: study\.solver\.(starts|seed) is \d+ there and \d+ here"
        ):
            nd.optimize(other, certify=certify, out=folder)
    with pytest.raises(ValueError, match=r"another question: warm is \[\] there"):
        nd.optimize(asked, certify=certify, out=folder, warm=without.best.variables)
    with pytest.raises(ValueError, match="out: got 7, expected a path"):
        nd.optimize(asked, out=7)


@pytest.mark.slow(sanitized=True)
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
