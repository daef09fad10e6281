"""How much memory a run of tests takes."""

import contextlib
import resource
import sys

MOST = 2**30  # bytes above what the process has had before


def peak():
    """The most memory that this process has had, in bytes."""
    found = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return found if sys.platform == "darwin" else 1024 * found


@contextlib.contextmanager
def small():
    """Fail where what is done in here raises the peak by more than `MOST`."""
    before = peak()
    yield
    grown = peak() - before
    print(f"peak of memory: {before / 2**20:.0f} MB before, {grown / 2**20:.0f} MB more after")
    assert grown < MOST
