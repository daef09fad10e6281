"""Chunks by threads, processes and a Dask cluster: the same bits, and a lost worker costs its chunk and not the run."""

import gc
import multiprocessing
import os
import pickle
import signal
import socket
import threading
import time
from concurrent.futures import BrokenExecutor, CancelledError, Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor

import pytest
import sweep_work as work
from sweep_work import GRID, HOME, G

import ninedof as nd
from ninedof.sweep import cluster as schedulers
from ninedof.sweep.axis import axes_of
from ninedof.sweep.index import indices_of
from ninedof.sweep.poses import COORDINATES, Poses
from ninedof.sweep.work import GridWork

SPAWN = multiprocessing.get_context("spawn")


def asked(index="condition_number", **options):
    return nd.sweep(G, HOME, GRID, index, chunk=20, **options)


@pytest.fixture(scope="module")
def expected():
    return asked()["condition_number"].tobytes()


@pytest.fixture(autouse=True)
def _notes(tmp_path, monkeypatch):
    monkeypatch.setenv("NINEDOF_TEST_NOTES", str(tmp_path))
    monkeypatch.setenv("NINEDOF_TEST_PARENT", str(os.getpid()))


def test_threads(expected):
    with ThreadPoolExecutor(3) as pool:
        assert asked(executor=pool)["condition_number"].tobytes() == expected


def test_processes(expected):
    with ProcessPoolExecutor(2, mp_context=SPAWN) as pool:
        found = asked(["condition_number", "leg_lengths", work.slow], executor=pool)
    assert found["condition_number"].tobytes() == found["slow"].tobytes() == expected
    assert found["leg_lengths"].tobytes() == asked("leg_lengths")["leg_lengths"].tobytes()


def test_designs_and_figures_by_processes():
    """By the closed form and robot by robot, in another process as here."""
    held, over = {"a1": 0.3, "a2": 5.0, "b1": 3.0, "zp": 4.0}, {"b2": (0.0, 1.0, 9), "zs": (2.0, 3.0, 7)}
    here = nd.sweep_designs(held, over, ["condition_number", "leg_ratio"])
    seven = nd.sweep_figure("7", 5)
    with ProcessPoolExecutor(2, mp_context=SPAWN) as pool:
        there = nd.sweep_designs(held, over, ["condition_number", "leg_ratio"], executor=pool, chunk=10)
        assert nd.sweep_figure("7", 5, executor=pool)["design"].tobytes() == seven["design"].tobytes()
        many = nd.atlas(30_000, chunk=7000, executor=pool)
    for name in here:
        assert there[name].tobytes() == here[name].tobytes()
    assert many["histogram"].tobytes() == nd.atlas(30_000)["histogram"].tobytes()


def test_tasks_are_small_whatever_the_grid():
    """Ranges travel as ranges, explicit values only as far as a chunk needs them."""
    poses = Poses(G, HOME, True, "held", 1.0)
    values = nd.sweep(G, HOME, {"x_p": (-1.0, 1.0, 100_000)})["x_p"]
    for over in ({"x_p": (-1.0, 1.0, 10**9)}, {"x_p": (0.0, 1.0, 464), "y_p": (0.0, 1.0, 464), "z_p": (0.0, 1.0, 464)}):
        grid = axes_of(over, COORDINATES)
        task = GridWork(poses, grid, indices_of("condition_number"), 65536).task(10**7, 10**7 + 65536)
        assert len(pickle.dumps(task)) < 4000
    grid = axes_of({"x_p": values}, COORDINATES)
    task = GridWork(poses, grid, indices_of("condition_number"), 100).task(50_000, 50_100)
    assert len(pickle.dumps(task)) < 5000
    assert task.grid.at(50_000, 50_100)["x_p"].tolist() == values[50_000:50_100].tolist()


# --- A process pool that breaks ---------------------------------------------------------------------------------------


def test_a_broken_pool_is_replaced_where_it_can_be(expected, tmp_path):
    made = []

    def make():
        made.append(ProcessPoolExecutor(2, mp_context=SPAWN))
        return made[-1]

    assert asked(work.FatalOnce(tmp_path), executor=make)["FatalOnce"].tobytes() == expected
    assert len(made) == 2


def test_without_a_replacement_the_rest_is_done_here(expected, tmp_path):
    with ProcessPoolExecutor(2, mp_context=SPAWN) as pool:
        with pytest.warns(RuntimeWarning, match="executor: it is broken .* the rest is computed in this process"):
            found = asked(work.fatal_to_workers, executor=pool, out=tmp_path / "out")
        assert found["fatal_to_workers"].tobytes() == expected
        with pytest.warns(RuntimeWarning, match="it is broken"):  # already when it is given
            assert asked(executor=pool)["condition_number"].tobytes() == expected


def test_a_chunk_that_kills_every_pool_ends_the_run(tmp_path):
    made = []

    def make():
        made.append(ProcessPoolExecutor(1, mp_context=SPAWN))
        return made[-1]

    with pytest.raises(RuntimeError, match="executor: 4 broke one after the other"):
        asked(work.fatal_to_workers, executor=make)
    assert len(made) == 4


# --- Losses, played ---------------------------------------------------------------------------------------------------


class Played(Executor):
    """Runs a task at once, except where the script has another outcome for this submission."""

    def __init__(self, script):
        self.script, self.submitted, self.flying, self.most = dict(script), 0, 0, 0

    def submit(self, function, /, *arguments, **options):
        future, outcome = Future(), self.script.get(self.submitted)
        self.submitted += 1
        if outcome == "refused":
            raise BrokenExecutor("gone")
        if outcome == "cancelled":
            future.cancel()
            future.set_running_or_notify_cancel()
        elif isinstance(outcome, BaseException):
            future.set_exception(outcome)
        else:
            future.set_result(function(*arguments))
        return future


KilledWorker = type("KilledWorker", (Exception,), {"__module__": "distributed.scheduler"})
LOSSES = ["cancelled", CancelledError(), KilledWorker("task-1"), ConnectionResetError("reset"), EOFError()]


@pytest.mark.parametrize("loss", LOSSES, ids=lambda x: x if isinstance(x, str) else type(x).__name__)
def test_a_lost_chunk_is_submitted_again(loss, expected):
    executor = Played({0: loss, 5: loss, 21: loss})
    assert asked(executor=executor)["condition_number"].tobytes() == expected
    assert executor.submitted == 20 + 3


def test_a_chunk_is_lost_so_many_times_and_no_more(expected):
    with pytest.raises(RuntimeError, match=r"chunk \d+: its worker was lost 4 times, last with EOFError"):
        asked(executor=Played(dict.fromkeys(range(1000), EOFError())))


def test_an_executor_that_refuses_is_broken(expected):
    made = [Played({3: "refused"}), Played({}), Played({})]
    left = iter(made)
    assert asked(executor=lambda: next(left))["condition_number"].tobytes() == expected
    assert [e.submitted > 0 for e in made] == [True, True, False]


def test_a_fault_of_the_index_is_no_loss(tmp_path):
    with ThreadPoolExecutor(1) as pool, pytest.raises(ZeroDivisionError, match="of the index itself"):
        asked(work.faulty, executor=pool, out=tmp_path)
    with pytest.raises(ValueError, match=r"index wrong_shape: got shape \(3,\), expected \(20,\)"):
        asked(work.wrong_shape)


def test_few_chunks_fly_at_a_time(expected):
    class Counting(ThreadPoolExecutor):
        flying = most = 0
        lock = threading.Lock()

        def submit(self, *arguments, **options):
            future = super().submit(*arguments, **options)
            with self.lock:
                self.flying += 1
                self.most = max(self.most, self.flying)
            future.add_done_callback(self.landed)
            return future

        def landed(self, _):
            with self.lock:
                self.flying -= 1

    with Counting(1) as pool:
        assert nd.sweep(G, HOME, GRID, work.slow, chunk=5, executor=pool)["slow"].tobytes() == expected
    assert 2 <= pool.most <= 8


def test_an_interruption_recalls_what_waits():
    """The first chunk ends, the second is held up until the interruption has been through; the others never start."""
    through, calls, submitted = threading.Event(), [], []

    def gated(g, c, lc):
        calls.append(c)
        if len(calls) > 1:
            assert through.wait(60)
        return nd.condition_number(g, c, lc)

    def stop(done, *_):
        if done:
            raise KeyboardInterrupt

    class Watched(ThreadPoolExecutor):
        def submit(self, *arguments, **options):
            submitted.append(super().submit(*arguments, **options))
            return submitted[-1]

    with Watched(1) as pool:
        with pytest.raises(KeyboardInterrupt):
            asked(gated, executor=pool, progress=stop)
        through.set()
    assert len(submitted) >= 8
    assert len(calls) <= 2
    assert sum(f.cancelled() for f in submitted) == len(submitted) - len(calls)


@pytest.mark.parametrize("executor", [3, "dask", object(), [ThreadPoolExecutor]])
def test_what_is_no_executor_is_refused(executor):
    with pytest.raises(ValueError, match=r"executor: got .*, expected a concurrent.futures.Executor or a function"):
        asked(executor=executor)


def test_a_function_that_makes_no_executor_is_refused():
    with pytest.raises(ValueError, match="executor: got a function that makes 3, expected"):
        asked(executor=lambda: 3)


# --- Dask -------------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def cluster():
    distributed = pytest.importorskip("distributed", reason="dask[distributed] is not installed: the extra `cluster`")
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, host="127.0.0.1"
        ) as found,
        distributed.Client(found) as client,
    ):
        yield client


def test_dask_gives_the_same_bits(cluster, expected):
    found = asked(["condition_number", "singular_values", work.slow], executor=cluster.get_executor())
    assert found["condition_number"].tobytes() == found["slow"].tobytes() == expected
    assert found["singular_values"].tobytes() == asked("singular_values")["singular_values"].tobytes()


def test_dask_surveys_designs(cluster):
    found, expected = (nd.atlas(60_000, chunk=9000, executor=e) for e in (cluster.get_executor(), None))
    for name in expected:
        assert found[name].tobytes() == expected[name].tobytes()


def test_dask_loses_a_worker_in_mid_run(cluster, expected, tmp_path):
    """SIGKILL to one of two workers while both compute: its chunks are done again, the others stand."""
    processes = list(cluster.run(os.getpid).values())
    assert len(processes) == 2
    killed = []

    def kill(done, *_):
        if done >= 60 and not killed:
            killed.append(processes[0])
            os.kill(processes[0], signal.SIGKILL)

    found = asked(work.slow, executor=cluster.get_executor(), out=tmp_path, progress=kill)
    assert killed
    assert found["slow"].tobytes() == expected
    cluster.wait_for_workers(2, timeout=60)
    deadline = time.monotonic() + 60
    while killed[0] in (now := list(cluster.run(os.getpid).values())) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert len(now) == 2


def test_dask_gives_up_a_chunk_and_it_is_submitted_again(cluster, expected, tmp_path):
    """A scheduler that allows no failure reports KilledWorker at once; the chunk is submitted again."""
    before, executor = cluster.run_on_scheduler(allow_failures, 0), Watched(cluster.get_executor())
    try:
        assert asked(work.FatalOnce(tmp_path), executor=executor)["FatalOnce"].tobytes() == expected
    finally:
        cluster.run_on_scheduler(allow_failures, before)
    assert {type(f.exception()).__name__ for f in executor.submitted} == {"NoneType", "KilledWorker"}
    assert (tmp_path / "killed").exists()
    cluster.wait_for_workers(2, timeout=60)


class Watched:
    """Passes everything on and keeps the futures."""

    def __init__(self, executor):
        self.executor, self.submitted = executor, []

    def submit(self, *arguments):
        self.submitted.append(self.executor.submit(*arguments))
        return self.submitted[-1]


def allow_failures(count, dask_scheduler):
    before, dask_scheduler.allowed_failures = dask_scheduler.allowed_failures, count
    return before


def test_the_command_line_uses_a_scheduler(cluster, tmp_path, capsys):
    from ninedof.cli.app import main

    out = tmp_path / "run"
    address = cluster.scheduler_info()["address"]
    with pytest.raises(SystemExit) as end:
        main(["sweep", "--over", "x_p=-1:1:23", "--scheduler", address, "--out", str(out), "--no-figures"])
    assert end.value.code == 0
    found = nd.SweepResult.load(out / "sweep.npz")
    assert found["condition_number"].shape == (23,)


@pytest.mark.parametrize(
    ("address", "words"),
    [
        ("nonsense", "got 'nonsense', expected one as tcp://host:8786"),
        ("foo://127.0.0.1:8786", "got 'foo://127.0.0.1:8786', expected one as"),
        ("tcp://127.0.0.1:99999", "expected one as"),
        ("tcp://127.0.0.1:1", "got tcp://127.0.0.1:1, where no scheduler answers (Connection refused)"),
        ("tcp://127.0.0.1:SILENT", "where no scheduler answers (timed out)"),
    ],
)
def test_a_missing_scheduler_is_said_in_one_line(tmp_path, capsys, monkeypatch, address, words):
    pytest.importorskip("distributed", reason="dask[distributed] is not installed: the extra `cluster`")
    from ninedof.cli.app import main

    monkeypatch.setattr(schedulers, "PATIENCE", 0.2)
    out = tmp_path / "run"
    with socket.create_server(("127.0.0.1", 0)) as silent:  # listens and says nothing
        address = address.replace("SILENT", str(silent.getsockname()[1]))
        with pytest.raises(SystemExit) as end:
            main(["sweep", "--over", "x_p=0:1:3", "--scheduler", address, "--out", str(out)])
    gc.collect()  # a client half made would speak up now
    assert end.value.code == 2
    err = capsys.readouterr().err
    assert err.startswith("ninedof: --scheduler: got ")
    assert words in err
    assert err.count("\n") == 1
    assert not out.exists()
