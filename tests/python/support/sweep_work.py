"""Indices for the tests of sweeps, in a module of their own: other processes must be able to import them."""

import faulthandler
import os
import signal
import stat
import time
from pathlib import Path

import numpy as np

import ninedof as nd

G = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
HOME = nd.Configuration.neutral(zp=3.9828, zs=2.4435)
GRID = {"x_p": (-1.0, 1.0, 23), "theta_y": (-0.6, 0.9, 17)}  # 391 points


def note(folder, c):
    """Leave a file for each call, named after the first configuration of the chunk."""
    (Path(folder) / f"{os.getpid()}-{time.monotonic_ns()}").write_text(repr(c.position[0].tolist()))


def noted(g, c, lc):
    """The condition number, slowly, with every call noted where NINEDOF_TEST_NOTES says."""
    note(os.environ["NINEDOF_TEST_NOTES"], c)
    time.sleep(0.01)
    return nd.condition_number(g, c, lc)


def slow(g, c, lc):
    time.sleep(0.02)
    return nd.condition_number(g, c, lc)


class FatalOnce:
    """Kills its process the first time it is called; a file marks that it was."""

    def __init__(self, folder):
        self.mark = Path(folder) / "killed"
        self.__qualname__ = "FatalOnce"

    def __call__(self, g, c, lc):
        try:
            self.mark.touch(exist_ok=False)
        except FileExistsError:
            return nd.condition_number(g, c, lc)
        os.kill(os.getpid(), signal.SIGKILL)
        raise AssertionError


def faulty(g, c, lc):
    raise ZeroDivisionError("a fault of the index itself")


def wrong_shape(g, c, lc):
    return np.zeros(3)


def finished(folder):
    """The numbers of the chunks that a folder has."""
    return {int(file.stem) for file in (Path(folder) / "pieces").glob("[0-9]*.npz")}


def killed_in_a_write():
    """From now on the fourth file is written by half, and its process killed: the question, two chunks, and a third."""
    real, calls = os.fsync, []

    def fsync(file):
        if stat.S_ISDIR(os.fstat(file).st_mode):
            return real(file)
        calls.append(file)
        if len(calls) == 4:
            os.ftruncate(file, os.fstat(file).st_size // 2)
            os.kill(os.getpid(), signal.SIGKILL)
        return real(file)

    os.fsync = fsync


def main(folder, notes, errors, before):
    """A sweep that is killed, with index `noted`, in a process whose errors go to a file."""
    errors_to(errors)
    os.environ["NINEDOF_TEST_NOTES"] = str(notes)
    before()
    nd.sweep(G, HOME, GRID, noted, out=folder, chunk=20)


def errors_to(file):
    """Write the standard error of this process to a file, that of a crash too."""
    os.dup2(os.open(file, os.O_WRONLY | os.O_CREAT), 2)
    faulthandler.enable()
