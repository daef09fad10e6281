"""Other processes for the tests of chunks: forked from one that has imported all that they need."""

import multiprocessing
import os
import sys
from multiprocessing import forkserver
from pathlib import Path

import pytest
import sweep_work as work

import ninedof as nd


@pytest.fixture(scope="package")
def forks():
    """Context of multiprocessing. An interpreter that starts anew would import for longer than it computes."""
    context = multiprocessing.get_context("forkserver")
    path = [str(Path(nd.__file__).parents[1]), str(Path(work.__file__).parent), os.environ.get("PYTHONPATH", "")]
    with pytest.MonkeyPatch.context() as patch:
        # A process of a pool runs the main script again, here that of pytest, which it does not need.
        patch.delattr(sys.modules["__main__"], "__file__", raising=False)
        patch.setenv("PYTHONPATH", os.pathsep.join(path))
        context.set_forkserver_preload(["sweep_work", "distributed"])
        forkserver.ensure_running()
        yield context
    forkserver._forkserver._stop()
