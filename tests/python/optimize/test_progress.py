"""A long run: progress and interruption. Calls from several threads at once: project/test_threads_at_once.py."""

import itertools
import math
import os
import signal
import sys
import threading

import pytest
from interrupts import InterruptedPhase, interrupter

import ninedof as nd
from ninedof.cli.screen import best_words

LEAST = 3.762659078596047
HUGE = 10**6  # starts: minutes of work


def test_a_search_that_goes_on_reports_the_starts_it_adds():
    """Half of the starts or fewer agree: further batches, at most four in all."""
    seen = []
    result = nd.optimize(DISAGREEING, starts=4, progress=lambda *arguments: seen.append(arguments))
    assert result.starts_done == 16
    assert seen[-1][:2] == (16, 16)
    assert all(done <= total and total % 4 == 0 for done, total, _ in seen)
    assert all(a[1] <= b[1] for a, b in itertools.pairwise(seen))
    assert result.confidence == result.best.reached / 16
    one = nd.optimize(DISAGREEING, starts=1)
    assert one.starts_done == 1
    runs = [nd.optimize(DISAGREEING, starts=4, threads=threads) for threads in (1, 2, 3)]
    assert all(run.candidates[0].variables == result.candidates[0].variables for run in runs)
    assert all(run.evaluations == result.evaluations for run in runs)


DISAGREEING = nd.Study(
    family="symmetric",
    constraints={"radius_ratio": (None, 2.63), "leg_ratio": (None, 3.1), "leg_clearance": {"min": 0.05, "of": "zp"}},
)


def test_callback_may_call_the_library():
    inner = []
    nd.optimize(
        nd.Study.paper(), starts=1000, progress=lambda *a: inner.append(nd.optimize(nd.Study.paper(), starts=2))
    )
    assert inner
    assert all(r.condition_number == pytest.approx(LEAST, rel=1e-9) for r in inner)


@pytest.fixture
def no_forced_switch():
    """A thread keeps the GIL until it gives it away, and SIGINT raises KeyboardInterrupt."""
    interval, handler = sys.getswitchinterval(), signal.signal(signal.SIGINT, signal.default_int_handler)
    sys.setswitchinterval(1000.0)
    yield
    sys.setswitchinterval(interval)
    signal.signal(signal.SIGINT, handler)


def test_other_threads_run_meanwhile(no_forced_switch):
    """The GIL is released: another thread, which can run in the call only, ends the call."""
    ready, go = threading.Event(), threading.Lock()
    go.acquire()

    def interrupt_from_another_thread():
        ready.set()
        with go:
            os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=interrupt_from_another_thread)
    thread.start()
    ready.wait()
    go.release()  # without a switch to the other thread
    result = nd.optimize(nd.Study.paper(), starts=HUGE // 10, threads=1)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # too late now
    thread.join()
    assert result.interrupted
    assert result.starts_done < HUGE // 10


def test_own_signal_handler_is_called_and_decides():
    """A program with a SIGINT handler of its own, which raises nothing, is not stopped behind its back."""
    calls = []
    handler = signal.signal(signal.SIGINT, lambda *_: calls.append(1))
    try:
        with interrupter() as progress:
            result = nd.optimize(nd.Study.paper(), starts=2000, threads=1, progress=progress)
    finally:
        signal.signal(signal.SIGINT, handler)
    assert calls == [1]
    assert (result.status, result.starts_done) == ("optimal", 2000)


def test_the_runs_that_place_o_are_counted():
    """With several poses the best starts are run again with O free: the slow part, during which the bar stood still."""
    seen = []
    study = nd.Study(
        constraints={"radius_ratio": (None, 2.0)},
        objective={
            "poses": [{"position": (x, y, 0.2)} for x, y in itertools.product((-0.4, 0.4), repeat=2)],
            "internal_point": "best",
        },
        starts=16,
    )
    result = nd.optimize(study, progress=lambda *arguments: seen.append(arguments))
    assert result.starts_done == 16
    assert {total for _, total, _ in seen} == {24}  # 16 short runs and 8 to the end
    assert seen[-1][0] == 24
    assert seen[-1][2] <= result.objective * (1.0 + 1e-9)


def test_starts_of_a_region_are_counted_and_its_rounds_are_told():
    study = nd.Study(
        constraints={"radius_ratio": (None, 2.0)},
        objective={"region": {"box": [0.3, 0.3, 0.0], "tilt_deg": 5}},
        starts=8,
    )
    bar = InterruptedPhase()
    result = nd.optimize(study, progress=bar)
    assert result.region.rounds > 1
    assert bar.reports[-1][0] == bar.reports[-1][1] >= 8
    assert all(a[0] <= b[0] for a, b in itertools.pairwise(bar.reports))
    assert bar.phases[0] == "all starts, at 17 poses"
    assert bar.phases[1] == "round 1, at 17 poses"
    assert bar.phases[-1].startswith(f"round {result.region.rounds}, at ")
    assert len(bar.phases) == 1 + result.region.rounds
    assert " so far, passed by " in bar.phases[2]
    # The last round may only make values equal that are so to 1e-6: nothing is passed before it.
    assert all(" more" in words for words in bar.phases[2:-1])


@pytest.mark.parametrize("value", [None, math.inf, math.nan])
def test_the_screen_has_words_for_no_design(value):
    assert best_words(value) == "no design yet"
    assert best_words(3.0) == "best 3.000000"
