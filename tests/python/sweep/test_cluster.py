"""Chunks by threads, processes and a Dask cluster: the same bits; an error of the executor leaves finished chunks.

Admissible designs by processes and a cluster too, as these are here.
"""

import gc
import json
import pickle
import socket
import threading
from concurrent.futures import BrokenExecutor, CancelledError, Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from types import SimpleNamespace

import pytest
import sweep_work as work
from sweep_work import GRID, HOME, G, finished

import ninedof as nd
from ninedof.cli import scheduler as schedulers
from ninedof.design.indices import indices_of
from ninedof.support.kept import chunks
from ninedof.sweep.axis import axes_of
from ninedof.sweep.grid import GridWork
from ninedof.sweep.points import COORDINATES, Poses


def sweep(index="condition_number", **options):
    return nd.sweep(G, HOME, GRID, index, chunk=20, **options)


@pytest.fixture(scope="module")
def expected():
    return sweep()["condition_number"].tobytes()


@pytest.fixture(scope="module")
def processes(forks):
    with ProcessPoolExecutor(2, mp_context=forks) as pool:
        yield pool


@pytest.fixture(scope="module")
def threads():
    with ThreadPoolExecutor(3) as pool:
        yield pool


@pytest.mark.parametrize("executor", ["threads", "processes", "dask_pool"])
def test_an_executor_gives_the_same_bits(executor, request, expected):
    asked = ["condition_number", "leg_lengths", work.slow]
    result = sweep(asked, executor=request.getfixturevalue(executor))
    assert result["condition_number"].tobytes() == result["slow"].tobytes() == expected
    assert result["leg_lengths"].tobytes() == sweep("leg_lengths")["leg_lengths"].tobytes()


def test_designs_and_figures_by_processes(processes):
    """Closed form and one robot at a time, in another process as in this one."""
    held, over = {"a1": 0.3, "a2": 5.0, "b1": 3.0, "zp": 4.0}, {"b2": (0.0, 1.0, 9), "zs": (2.0, 3.0, 7)}
    here = nd.sweep_designs(held, over, ["condition_number", "leg_ratio"])
    seven = nd.sweep_figure("7", 5)
    there = nd.sweep_designs(held, over, ["condition_number", "leg_ratio"], executor=processes, chunk=10)
    assert nd.sweep_figure("7", 5, executor=processes)["design"].tobytes() == seven["design"].tobytes()
    many = nd.atlas(30_000, chunk=7000, executor=processes)
    for name in here:
        assert there[name].tobytes() == here[name].tobytes()
    assert many["histogram"].tobytes() == nd.atlas(30_000)["histogram"].tobytes()


PLATES = {"a1": 0.0, "a2": (2.0, 10.0), "b1": (1.0, 5.0), "b2": 0.0, "zp": 5.0, "zs": 3.0}


def admissible(executor):
    study = nd.Study(variables=PLATES, constraints={"leg_ratio": (None, 2.2), "radius_ratio": (None, 2.5)})
    return nd.admissible(study, ("a2", "b1"), resolution=0.05, executor=executor)


def test_what_is_sent_is_small_whatever_the_grid():
    """Ranges are sent as ranges, and of explicit values only those that a chunk needs."""
    poses = Poses(G, HOME, True, "held", 1.0)
    values = nd.sweep(G, HOME, {"x_p": (-1.0, 1.0, 100_000)})["x_p"]
    for over in ({"x_p": (-1.0, 1.0, 10**9)}, {"x_p": (0.0, 1.0, 464), "y_p": (0.0, 1.0, 464), "z_p": (0.0, 1.0, 464)}):
        work = GridWork(poses, axes_of(over, COORDINATES), indices_of("condition_number"), 65536)
        assert len(pickle.dumps(work.part(10**7, 10**7 + 65536))) < 4000
    part = GridWork(poses, axes_of({"x_p": values}, COORDINATES), work.indices, 100).part(50_000, 50_100)
    assert len(pickle.dumps(part)) < 5000
    assert part.grid.at(50_000, 50_100)["x_p"].tolist() == values[50_000:50_100].tolist()


# --- Workers that are lost --------------------------------------------------------------------------------------------


class Broken(Executor):
    """Runs tasks at once, but for one submission: it raises, or its future ends with an exception or is cancelled."""

    _max_workers = 1

    def __init__(self, at, outcome):
        self.at, self.outcome, self.submitted = at, outcome, 0

    def submit(self, function, /, *arguments, **options):
        future, self.submitted = Future(), self.submitted + 1
        if self.submitted - 1 != self.at:
            future.set_result(function(*arguments))
        elif self.outcome == "refused":
            raise BrokenExecutor("gone")
        elif self.outcome == "cancelled":
            future.cancel()
            future.set_running_or_notify_cancel()
        else:
            future.set_exception(self.outcome)
        return future


LOSSES = {
    "refused": BrokenExecutor,
    "cancelled": CancelledError,
    ConnectionResetError("reset"): ConnectionResetError,
    EOFError(): EOFError,
}


@pytest.mark.parametrize(("outcome", "error"), LOSSES.items(), ids=[kind.__name__ for kind in LOSSES.values()])
def test_an_error_of_the_executor_is_raised_and_the_next_call_goes_on(outcome, error, expected, tmp_path, monkeypatch):
    monkeypatch.setattr(chunks, "IN_FLIGHT", 8)
    with pytest.raises(error) as raised:
        sweep(executor=Broken(15, outcome), out=tmp_path)
    assert raised.value.__notes__ == [f"Finished pieces are kept in {tmp_path}: the same call goes on from there."]
    pieces = len(finished(tmp_path))
    assert pieces >= 7
    rest = Broken(-1, None)
    assert sweep(executor=rest, out=tmp_path)["condition_number"].tobytes() == expected
    assert rest.submitted == 20 - pieces


def test_an_error_of_the_index_is_raised(tmp_path):
    with ThreadPoolExecutor(1) as pool, pytest.raises(ZeroDivisionError, match="of the index itself"):
        sweep(work.faulty, executor=pool, out=tmp_path)
    with pytest.raises(ValueError, match=r"index wrong_shape: got shape \(3,\), expected \(20,\)"):
        sweep(work.wrong_shape)


@pytest.mark.slow(sanitized=True)
def test_a_bounded_number_of_chunks_waits_at_the_executor(expected, monkeypatch):
    monkeypatch.setattr(chunks, "IN_FLIGHT", 8)

    class Counting(ThreadPoolExecutor):
        waiting = most = 0
        lock = threading.Lock()

        def submit(self, *arguments, **options):
            future = super().submit(*arguments, **options)
            with self.lock:
                self.waiting += 1
                self.most = max(self.most, self.waiting)
            future.add_done_callback(self.finished)
            return future

        def finished(self, _):
            with self.lock:
                self.waiting -= 1

    with Counting(1) as pool:
        assert nd.sweep(G, HOME, GRID, work.slow, chunk=5, executor=pool)["slow"].tobytes() == expected
    assert 2 <= pool.most <= 8


def test_an_interruption_cancels_what_waits():
    """The first chunk ends, the second waits until the interruption is over; the others never start."""
    interrupted, calls, submitted = threading.Event(), [], []

    def gated(g, c, lc):
        calls.append(c)
        if len(calls) > 1:
            assert interrupted.wait(60)
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
            sweep(gated, executor=pool, progress=stop)
        interrupted.set()
    assert len(submitted) >= 8
    assert len(calls) <= 2
    assert sum(f.cancelled() for f in submitted) == len(submitted) - len(calls)


# --- Dask -------------------------------------------------------------------------------------------------------------


QUIET = {  # a cluster looks at itself all the time, which costs more than the chunks
    "distributed.admin.tick.interval": "1 s",
    "distributed.admin.system-monitor.interval": "1 hour",
    "distributed.worker.profile.enabled": False,
}


@pytest.fixture(scope="module")
def cluster(forks):
    distributed = pytest.importorskip("distributed", reason="dask[distributed] is not installed: the extra `cluster`")
    dask = pytest.importorskip("dask")
    with (
        dask.config.set(QUIET | {"distributed.worker.multiprocessing-method": forks.get_start_method()}),
        distributed.LocalCluster(
            n_workers=2,
            threads_per_worker=1,
            processes=True,
            memory_limit=None,
            dashboard_address=":0",  # another worker of the tests may have a cluster too
            host="127.0.0.1",
        ) as local,
        distributed.Client(local) as client,
    ):
        yield client


@pytest.fixture(scope="module")
def dask_pool(cluster):
    return cluster.get_executor()


def test_dask_finds_admissible_designs(cluster, run, tmp_path):
    with ThreadPoolExecutor(1) as pool:
        result, expected = admissible(cluster.get_executor()), admissible(pool)
    assert (result.low.tobytes(), result.state.tobytes()) == (expected.low.tobytes(), expected.state.tobytes())
    assert result.shares == expected.shares
    file, address = tmp_path / "study.toml", cluster.scheduler_info()["address"]
    result.study.save(file)
    status, out, _ = run(f"admissible {file} --vary a2 --vary b1 --resolution 0.05 --json --scheduler {address}")
    assert status == 0
    assert json.loads(out)["shares"] == pytest.approx(result.shares)


def test_a_chunk_that_dask_gives_up_ends_the_run_and_the_next_call_goes_on(cluster, expected, tmp_path):
    """A scheduler that allows no failure reports KilledWorker at once."""
    killed = pytest.importorskip("distributed.scheduler").KilledWorker
    index = work.FatalOnce(tmp_path)
    before, executor = cluster.run_on_scheduler(allow_failures, 0), cluster.get_executor()
    try:
        with pytest.raises(killed):
            sweep(index, executor=executor, out=tmp_path / "out")
        assert sweep(index, executor=executor, out=tmp_path / "out")["FatalOnce"].tobytes() == expected
    finally:
        cluster.run_on_scheduler(allow_failures, before)
    assert (tmp_path / "killed").exists()
    cluster.wait_for_workers(2, timeout=60)


def allow_failures(count, dask_scheduler):
    before, dask_scheduler.allowed_failures = dask_scheduler.allowed_failures, count
    return before


def test_the_command_line_uses_a_scheduler(cluster, run, tmp_path):
    out = tmp_path / "run"
    address = cluster.scheduler_info()["address"]
    assert run(f"sweep --over x_p=-1:1:23 --scheduler {address} --out {out} --no-figures")[0] == 0
    result = nd.SweepResult.load(out / "sweep.npz")
    assert result["condition_number"].shape == (23,)


@pytest.mark.parametrize(
    ("address", "words"),
    [
        ("nonsense", "missing port number"),
        ("tcp://127.0.0.1:1", "imed out"),
        ("tcp://127.0.0.1:SILENT", "timed out"),
        ("tcp://127.0.0.1:BANNER", ""),
        ("tls://127.0.0.1:SILENT", "TLS expects"),
    ],
)
def test_a_missing_scheduler_is_reported_in_one_line(run, tmp_path, monkeypatch, address, words):
    pytest.importorskip("distributed", reason="dask[distributed] is not installed: the extra `cluster`")
    monkeypatch.setattr(schedulers, "TIMEOUT", 0.2)
    out = tmp_path / "run"
    connections = []
    with socket.create_server(("127.0.0.1", 0)) as server:
        where, _, port = address.rpartition(":")
        if port.isupper():
            address = f"{where}:{server.getsockname()[1]}"
        if port == "BANNER":  # SILENT accepts connections and sends nothing
            threading.Thread(target=_answer, args=(server, connections), daemon=True).start()
        status, _, err = run(f"sweep --over x_p=0:1:3 --scheduler {address} --out {out}")
    for connection in connections:
        connection.close()
    gc.collect()  # a client that was not closed would warn now
    assert status == 2
    assert err.startswith(f"ninedof: --scheduler: got '{address}', where no scheduler answers (")
    assert words in err
    assert err.count("\n") == 1
    assert not out.exists()


def _answer(server, connections):
    """Take one connection and send what another program sends."""
    connections.append(server.accept()[0])
    connections[0].sendall(b"HTTP/1.1 400 Bad Request\r\n")


def test_a_scheduler_that_is_lost_ends_the_run_with_what_to_do_next(run, tmp_path, monkeypatch):
    """What dask raises when the scheduler is killed while it works; the chunks so far are kept."""

    class Lost(Executor):
        count = 0

        def submit(self, perform, *task):
            self.count += 1
            future = Future()
            if self.count > 2:
                future.set_exception(CancelledError())
            else:
                future.set_result(perform(*task))
            return future

    async def connect(address, timeout):
        return SimpleNamespace(abort=lambda: None)

    client = SimpleNamespace(get_executor=Lost, close=lambda timeout: None)
    dask = SimpleNamespace(comm=SimpleNamespace(connect=connect), Client=lambda address, **_: client)
    monkeypatch.setattr(schedulers, "optional", lambda *_: dask)
    monkeypatch.chdir(tmp_path)
    line = "sweep --over x_p=-1:1:23 --chunk 5 --no-figures --out 'my run'"
    status, _, err = run(f"{line} --scheduler tcp://127.0.0.1:8786")
    assert status == 4
    (last,) = (words for words in err.splitlines() if words.startswith("ninedof: "))
    assert last.startswith(
        "ninedof: --scheduler: lost tcp://127.0.0.1:8786 (CancelledError). Finished pieces are kept in"
    )
    assert finished(tmp_path / "my run") == {0, 1}
    assert run(line)[0] == 0
    assert nd.load("my run")["condition_number"].shape == (23,)
