"""Methods in processes of their own, and what a round of one takes."""

import importlib
import importlib.util
import multiprocessing
import os
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from statistics import median
from time import perf_counter

import numpy as np

from compare import data

# One core for each: libraries that would start threads of their own are told not to.
ONE_THREAD = {
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "MKL_NUM_THREADS": "1",
    "XLA_FLAGS": "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1",
}

_run = None  # in a process of a method: what it prepared


def _prepare(path, method, count):
    global _run
    if method.needs == "jax" and hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})  # XLA counts the processors it may use
    os.chdir(path.parent)  # CasADi compiles where it is
    robot, poses = data.read(path)
    prepare = getattr(importlib.import_module(f"compare.{method.module}"), method.function)
    _run = prepare(robot, poses.first(count), **method.options)
    return _run().copy()


def _time():
    begin = perf_counter()
    _run()
    return perf_counter() - begin


@contextmanager
def environment(values):
    before = dict(os.environ)
    os.environ.update(values)
    try:
        yield
    finally:
        os.environ.clear()
        os.environ.update(before)


class InPython:
    def __init__(self, method, path, count):
        self.method, self.count = method, count
        folder = str(Path(__file__).parents[1])
        before = filter(None, os.environ.get("PYTHONPATH", "").split(os.pathsep))
        kept = os.pathsep.join([folder, *map(os.path.abspath, before)])
        # A fresh interpreter, so that it reads its own NINEDOF_SIMD. It starts with the first piece of work.
        self._pool = ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn"))
        with environment(ONE_THREAD | method.environment | {"PYTHONPATH": kept}):
            self.values = self._pool.submit(_prepare, path, method, count).result()

    def seconds(self):
        return self._pool.submit(_time).result()

    def close(self):
        self._pool.shutdown()


class InCpp:
    def __init__(self, method, path, count, folder):
        self.method, self.count = method, count
        self._command = [str(folder / method.program), str(path), str(count)]
        out = path.with_suffix(".out")
        subprocess.run([*self._command, str(out)], check=True, capture_output=True)
        self.values = np.fromfile(out)

    def seconds(self):
        return float(subprocess.run(self._command, check=True, capture_output=True, text=True).stdout)

    def close(self):
        pass


def start(method, path, poses, folder):
    """A method ready to run, or why it cannot."""
    count = max(1, round(poses * method.share))
    if method.program:
        if folder is None or not (folder / method.program).is_file():
            return "not built"
        return InCpp(method, path, count, folder)
    if method.needs and importlib.util.find_spec(method.needs) is None:
        return "not installed"
    return InPython(method, path, count)


def require_agreement(name, values, ours, loses):
    """A benchmark of wrong numbers is worthless: ends the program unless the values are ours."""
    if values.shape != ours.shape:
        sys.exit(f"{name}: got shape {values.shape}, expected {ours.shape}; nothing was timed")
    error = np.abs(values / ours - 1.0)
    allowed = 1e-12 * np.maximum(1.0, ours) ** loses
    if not (error <= allowed).all():
        k = int(np.argmax(np.where(np.isnan(error), np.inf, error / allowed)))
        sys.exit(f"{name}: pose {k} has {values[k]!r}, ours is {ours[k]!r}; nothing was timed")
    return float(error.max())


def has_level(level):
    """Whether this build and this processor have a level of instructions."""
    command = [sys.executable, "-c", "from ninedof import _core; _core.simd_level()"]
    return subprocess.run(command, env=os.environ | {"NINEDOF_SIMD": level}, capture_output=True).returncode == 0


def one_round(worker, enough=1.0, most=7):
    """Seconds of a run: the median of several where a run is short, so that a hiccup of the machine weighs on none."""
    taken = [worker.seconds()]
    while len(taken) < most and sum(taken) < enough:
        taken.append(worker.seconds())
    return median(taken)
