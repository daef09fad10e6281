"""Other processes for the tests of chunks: forked from one that has imported all that they need."""

import multiprocessing
import os
import sys
from multiprocessing import forkserver
from pathlib import Path

import pytest
import sweep_work as work

import ninedof as nd


@pytest.fixture(scope="session")
def _server():
    """An interpreter that starts anew would import for longer than it computes: this one has imported, and forks."""
    context = multiprocessing.get_context("forkserver")
    path = [str(Path(nd.__file__).parents[1]), str(Path(work.__file__).parent), os.environ.get("PYTHONPATH", "")]
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PYTHONPATH", os.pathsep.join(path))
        context.set_forkserver_preload(["sweep_work", "distributed"])
        forkserver.ensure_running()
    yield context
    forkserver._forkserver._stop()


@pytest.fixture(scope="module")
def forks(_server):
    """Context of multiprocessing. Its processes run the main script again, here that of pytest, but for this patch."""
    with pytest.MonkeyPatch.context() as patch:
        patch.delattr(sys.modules["__main__"], "__file__", raising=False)
        yield _server
