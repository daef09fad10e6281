"""What all tests share: one hypothesis profile and the paper's robot."""

import contextlib
import ctypes
import functools
import gc
import shlex
import signal
from importlib import import_module

import pytest
import typer.main
from hypothesis import HealthCheck, settings
from sizes import size

import ninedof as nd
from ninedof.cli.app import main

# A job in the background ignores SIGINT, and so would the programs that tests start and interrupt.
signal.signal(signal.SIGINT, signal.default_int_handler)

# The same examples in every run: a failure found by chance must not vanish by chance. No deadline: sanitizers are slow.
settings.register_profile(
    "fixed",
    derandomize=True,
    deadline=None,
    database=None,
    max_examples=size(20, 60),
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture],
)
settings.load_profile("fixed")


def pytest_collection_finish(session):
    """What is loaded by now stays to the end: no collection of garbage needs to look through it again."""
    gc.collect()
    gc.freeze()


@pytest.fixture(scope="module", autouse=True)
def _memory_goes_back():
    """A worker runs thousands of tests: what those of a file have made goes back to the system with its last one.

    What is left stays, as above: to look through all of it again after each file took a fifth of the time of the tests.
    """
    yield
    gc.collect()
    gc.freeze()
    with contextlib.suppress(AttributeError, OSError, TypeError):  # of glibc alone
        ctypes.CDLL(None).malloc_trim(0)


@pytest.fixture(scope="session", autouse=True)
def _commands_are_built_once():
    """Most of the time of a short command line is that of building all commands, the same ones every time."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(typer.main, "get_command", functools.cache(typer.main.get_command))
        yield


@pytest.fixture(scope="session")
def published():
    """The published optimum in the reading that reproduces it: base side 5.8124, platform side 2.9062."""
    return nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)


@pytest.fixture(scope="session")
def neutral():
    return nd.Configuration.neutral(zp=3.9828, zs=2.3745)


@pytest.fixture(scope="session")
def stack():
    """Five configurations around the neutral one, none singular."""
    return nd.Configuration.neutral(zp=3.9828, zs=[1.9, 2.1, 2.3, 2.5, 2.7], theta_z=[0.0, 0.1, -0.2, 0.3, 0.4])


@pytest.fixture
def few_samples(monkeypatch):
    """Sheets look at few poses of a region: for tests of what is said, which is the same."""
    monkeypatch.setattr(import_module("ninedof.sheet.sheet"), "SAMPLES", 300)


@pytest.fixture
def run(capsys):
    """Run a command line here; return its exit status and what it prints on standard output and standard error."""

    def run_line(line):
        with pytest.raises(SystemExit) as end:
            main(shlex.split(line))
        return end.value.code, *capsys.readouterr()

    return run_line
