"""The arithmetic floor: the least time in which one core can do the kernel's operations."""

import json
import subprocess


def measure(folder, path):
    """What ninedof_floor found out, None where it is not built."""
    program = None if folder is None else folder / "ninedof_floor"
    if program is None or not program.is_file():
        return None
    return json.loads(subprocess.run([str(program), str(path)], check=True, capture_output=True, text=True).stdout)


def floors(facts):
    """For each level, ns a pose: multiplications and additions; divisions and roots; the longer of both; their sum."""
    count = next(c for c in facts["operations"] if c["lanes"] == 1)  # what a pose needs, not waiting for its neighbours
    out = {}
    for level, t in facts["throughput"].items():
        m, a = count["multiplies"], count["additions"]
        pairs = min(m, a)
        streams = pairs * t["both"] + (m - pairs) * t["multiply"] + (a - pairs) * t["add"]
        slow = count["divisions"] * t["divide"] + count["roots"] * t["root"]
        out[level] = {"arithmetic": streams, "divisions": slow, "floor": max(streams, slow), "sum": streams + slow}
    return out
