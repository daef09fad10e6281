"""Finished pieces of a run survive kills, Ctrl-C, damage and other questions: it goes on to the same bits.

SIGKILL as a file is written: sweep/test_chunks.py. The store: records/test_store.py. Commands: cli/test_go_on.py.
"""

import functools
import os
import shutil
from dataclasses import replace
from importlib import import_module

import numpy as np
import pytest
from interrupts import InterruptedPhase
from sweep_work import GRID, HOME, G, finished

import ninedof as nd
from ninedof import _core
from ninedof.optimize.pareto import solving
from ninedof.support.kept.store import Store
from ninedof.support.text import encode
from ninedof.sweep import points
from ninedof.sweep.atlas import AtlasWork
from ninedof.sweep.grid import GridWork
from ninedof.sweep.survey import Tally

PAPER = nd.Study.paper().with_solver(8)
PROVED = nd.Study(constraints={"radius_ratio": {"max": 2.0}, "leg_clearance": {"min": 0.1}}, starts=4)
"""A proof leaves the clearance out: the study without it is solved too, from which the proof begins."""
LINE = nd.Study(
    variables={"zp": (1.0, 6.0)},
    constraints={"radius_ratio": {"max": 2.0}},
    objective={"index": "frobenius", "region": {"path": [[0.0, 0.0, 0.0], [0.4, 0.0, 0.0]]}},
    starts=1,
)


class Killed(Exception):
    """Stands for the end of the process."""


class Stop:
    """A progress callback: Ctrl-C at a call of it."""

    def __init__(self, call):
        self._left = call

    def __call__(self, *_):
        self._left -= 1
        if self._left == 0:
            raise KeyboardInterrupt


# --- Runs: each takes `out`, `progress` and what makes another question -----------------------------------------------


def sweep(geometry=G, home=HOME, over=GRID, chunk=20, **options):
    return nd.sweep(geometry, home, over, chunk=chunk, **options)


def best_o(internal_point="best", **options):
    """Blocks of 2 rows of x_p: three pieces, the last one short."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(points, "BLOCK", 30)
        over = {"x_p": (0.5, 1.2, 5), "theta_x": (-0.4, 0.4, 3), "y_p": (-1.0, 1.0, 5)}
        return nd.sweep(G, HOME, over, internal_point=internal_point, chunk=1, **options)


def atlas(seed=3, **options):
    return nd.atlas(40_000, seed, chunk=4000, **options)


def figure(figure="7", **options):
    return nd.sweep_figure(figure, 9, **options)


def front(study=PAPER, against="radius_ratio", values=(1.5, 2.0, 3.0), points=3, **options):
    return nd.pareto(study, against, values, points=points, **options)


def derived_front(**options):
    return front(values=None, **options)


def front_in_a_region(**options):
    return front(replace(PAPER, objective={"region": {"box": [0.2, 0.0, 0.0]}}, starts=1), values=[2.0], **options)


def region(study=LINE, **options):
    return nd.optimize(study, **options)


def proof(study=PROVED, **options):
    return nd.optimize(study, certify=True, **options)


GRID_WORK, SOLVED = ((GridWork, "values"),), ((solving, "optimize"),)
SEARCHES = (
    (_core, "optimize"),
    (_core, "optimize_region"),
    (import_module("ninedof.optimize.optimize"), "prove"),
)
RUNS = {  # with functions, by owner and name, one of which is called for each piece
    sweep: GRID_WORK,
    best_o: GRID_WORK,
    atlas: ((AtlasWork, "values"),),
    figure: GRID_WORK,
    front: SOLVED,
    derived_front: SOLVED,
    front_in_a_region: SOLVED,
    region: SEARCHES,
    proof: SEARCHES,
}
SLOW = pytest.mark.slow(sanitized=True)


def case(run, *more):
    """A run of seconds is slow: `front` goes through the same pieces of an optimization in less."""
    marks = [SLOW] * (run in (front_in_a_region, region, proof))
    return pytest.param(run, *more, marks=marks, id=run.__name__ if len(more) < 2 else None)


def plain(result):
    """Everything but the times."""
    if isinstance(result, nd.SweepResult):
        return [result[name].tobytes() for name in result]

    def timeless(value):
        if isinstance(value, dict):
            return {name: timeless(entry) for name, entry in value.items() if name != "seconds"}
        return [timeless(entry) for entry in value] if isinstance(value, list) else value

    return encode(timeless(result.to_dict()))


def work_of(run, monkeypatch):
    """Return a list to which each piece that is computed adds its function's name."""
    names = []
    for owner, name in RUNS[run]:
        call = getattr(owner, name)
        monkeypatch.setattr(owner, name, lambda *a, call=call, name=name, **o: names.append(name) or call(*a, **o))
    return names


@functools.cache
def whole(run):
    """What a run gives without a folder, and how many pieces it computes."""
    with pytest.MonkeyPatch.context() as patch:
        names = work_of(run, patch)
        return plain(run()), len(names)


@pytest.fixture(scope="module")
def folder_of(tmp_path_factory):
    """Makes the folder of a run with all its pieces, once."""

    @functools.cache
    def made(run):
        folder = tmp_path_factory.mktemp("pieces") / "run"
        assert plain(run(out=folder)) == whole(run)[0], "pieces change nothing"
        return folder

    return made


def assert_goes_on(run, folder, pieces, monkeypatch):
    """The run there has so many pieces and nothing else; it ends as a whole one does, and computes the others alone."""
    result, count = whole(run)
    assert finished(folder) == set(range(pieces))
    assert len(list((folder / "pieces").iterdir())) == pieces, "no arrays, no file that is half written"
    with monkeypatch.context() as patch:
        names = work_of(run, patch)
        for _ in range(2):
            assert plain(run(out=folder)) == result
            assert len(names) == count - pieces
    assert finished(folder) == set(range(count))


@pytest.mark.parametrize("run", [case(run) for run in RUNS if run not in (front_in_a_region, region)])  # of one piece
def test_killed_as_a_piece_is_written(run, tmp_path, monkeypatch):
    """The piece is lost, those before it are not computed again."""
    keep, last = Store.keep, whole(run)[1] // 2

    def killed(store, k, arrays):
        if k == last:
            raise Killed
        keep(store, k, arrays)

    with monkeypatch.context() as patch:
        patch.setattr(Store, "keep", killed)
        with pytest.raises(Killed):
            run(out=tmp_path)
    assert_goes_on(run, tmp_path, last, monkeypatch)


STOPS = [  # how a run is ended by Ctrl-C, and its pieces by then
    case(sweep, lambda: Stop(1), 0),
    case(sweep, lambda: Stop(6), 5),
    case(best_o, lambda: Stop(2), 1),
    case(atlas, lambda: Stop(4), 3),
    case(figure, lambda: Stop(5), 4),
    case(front, lambda: Stop(1), 1),
    case(front, lambda: Stop(4), 4),
    case(derived_front, lambda: Stop(3), 3),
    case(front_in_a_region, lambda: Stop(1), 1),
    case(region, lambda: InterruptedPhase("round 1, "), 0),
    case(proof, lambda: InterruptedPhase("proving"), 2),  # between two calls of the core
]


@pytest.mark.parametrize(("run", "stop", "pieces"), STOPS)
def test_ctrl_c_keeps_what_is_finished(run, stop, pieces, tmp_path, monkeypatch):
    if RUNS[run] is SOLVED or run is region:
        assert run(out=tmp_path, progress=stop()).interrupted
    else:
        with pytest.raises(KeyboardInterrupt):
            run(out=tmp_path, progress=stop())
    assert_goes_on(run, tmp_path, pieces, monkeypatch)


def test_a_chunk_that_is_being_added_up_is_kept(tmp_path, monkeypatch):
    with monkeypatch.context() as patch:
        patch.setattr(Tally, "plus", Stop(1))
        with pytest.raises(KeyboardInterrupt):
            atlas(out=tmp_path)
    assert_goes_on(atlas, tmp_path, 1, monkeypatch)


def one_bit(path):
    data = bytearray(path.read_bytes())
    data[-40] ^= 4
    path.write_bytes(data)


def of_a_neighbour(path):
    shutil.copy(path.with_name("00000002.npz"), path)


def shorter(path):
    path.write_bytes(path.read_bytes()[:-7])


def other_numbers(path):
    with np.load(path) as arrays:
        np.savez(path, **{name: np.zeros_like(array) for name, array in arrays.items()})


DAMAGES = [case(sweep, damage) for damage in (of_a_neighbour, shorter, other_numbers, os.unlink)]


@pytest.mark.parametrize(("run", "damage"), DAMAGES + [case(run, one_bit) for run in RUNS])
def test_a_damaged_piece_is_computed_again_and_no_other(run, damage, folder_of, tmp_path, monkeypatch):
    folder, (result, count) = shutil.copytree(folder_of(run), tmp_path / "run"), whole(run)
    damage(folder / "pieces" / f"{count // 2:08d}.npz")
    names = work_of(run, monkeypatch)
    for _ in range(2):
        assert plain(run(out=folder)) == result
        assert len(names) == 1


WARM = {"a1": 0.0, "a2": 5.8, "b1": 2.9, "b2": 0.0, "zp": 4.0, "zs": 2.4}
OTHERS = [
    (
        sweep,
        {"over": {**GRID, "x_p": (-1.0, 1.0 + 1e-15, 23)}},
        r"over\[0\].high is 1.0 there and 1.000000000000001 here",
    ),
    (sweep, {"over": dict(reversed(GRID.items()))}, r"over\[0\].name is .* there"),
    (sweep, {"index": "manipulability"}, r"index\[0\] is 'condition_number' there and 'manipulability' here"),
    (sweep, {"home": nd.Configuration.neutral(3.9828, 2.4436)}, "home.internal_point.* is .*2.4435.* and .*2.4436.*"),
    (sweep, {"geometry": nd.Geometry.hexagonal(0.0, 5.8125, 2.9062, 0.0)}, "geometry."),
    (sweep, {"relative": False}, "relative is True there and False here"),
    (sweep, {"internal_point": "carried"}, "internal_point is 'held' there and 'carried' here"),
    (sweep, {"characteristic_length": "optimal"}, "characteristic_length is 1.0 there and 'optimal' here"),
    (atlas, {"seed": 4}, "seed is 3 there and 4 here"),
    (figure, {"figure": "6"}, "kind is 'Fig. 7' there and 'Fig. 6' here"),
    (front, {"against": "leg_ratio"}, "against is 'radius_ratio' there and 'leg_ratio' here"),
    (front, {"values": [2.0]}, "values is .* there"),
    *(
        (run, {"study": study.with_solver(5)}, "study.solver.starts is")
        for run, study in ((region, LINE), (proof, PROVED))
    ),
    *(
        (run, {"study": study.with_solver(None, 1)}, "study.solver.seed")
        for run, study in ((region, LINE), (proof, PROVED))
    ),
    *((run, {"warm": WARM}, r"warm is \[\] there") for run in (region, proof)),
]


@pytest.mark.parametrize(("run", "changes", "words"), [case(*row) for row in OTHERS])
def test_another_question_is_refused(run, changes, words, folder_of):
    folder = folder_of(run)
    before = {path: path.read_bytes() for path in folder.rglob("*.*")}
    with pytest.raises(ValueError, match=rf"out: got .*another question: {words}.*; expected a new folder"):
        run(out=folder, **changes)
    assert {path: path.read_bytes() for path in folder.rglob("*.*")} == before


@SLOW
@pytest.mark.parametrize("run", [region, proof])
def test_what_the_time_ended_is_not_kept(run, folder_of, tmp_path):
    """The next call, with any limit, solves it anew; what is finished does not depend on the limit."""
    result, _ = whole(run)
    ended = run(out=tmp_path, time_limit=1e-9)
    assert (ended.status, ended.interrupted) == ("stopped", False)
    assert not finished(tmp_path)
    assert plain(run(out=tmp_path, time_limit=600.0)) == result
    assert plain(run(out=folder_of(run), time_limit=1e-9)) == result


@SLOW
def test_a_proof_is_kept_with_its_certificate(tmp_path):
    first, again = (nd.optimize(nd.Study.paper(), starts=8, certify=True, out=tmp_path) for _ in range(2))
    assert first.proof.certificate
    assert again.proof == first.proof  # with its seconds
    assert again.proof.certificate == first.proof.certificate
    assert again.to_dict() == first.to_dict()


@pytest.mark.parametrize("warm", [{"nope": 1.0}, {"zp": object()}, {"zp": "x"}])
def test_bad_designs_to_begin_with_leave_no_folder(tmp_path, warm):
    with pytest.raises(ValueError, match="warm"):
        nd.optimize(nd.Study.paper(), warm=warm, out=tmp_path / "run")
    assert not list(tmp_path.iterdir())
