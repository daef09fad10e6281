"""The condition number of a million poses beside other packages and beside what the processor can do at most.

    python bench/python/comparison.py                                          # what is installed
    python bench/python/comparison.py --cpp build/cpp/bench/cpp --write-docs   # with plain Eigen and the floor

Every method gets the same poses, and its numbers are compared with ours before anything is timed: a wrong one ends the
program. Then all of them are run in turns, round by round, so that whatever else the machine does falls on all.
"""

import argparse
import sys
import tempfile
from pathlib import Path

from compare import data, exact, figure, floor, page, runner
from compare.methods import methods
from compare.results import Line, Results

ROOT = Path(__file__).resolve().parents[2]


def available_levels():
    """The levels of instructions that this build and this processor have, by asking for each."""
    found = []
    for level in ("base", "v3", "v4"):
        if runner.has_level(level):
            found.append(level)
    return found


def measure(poses, rounds, folder, scratch):
    path = scratch / "poses.bin"
    data.write(path, poses)
    robot, configurations = data.read(path)
    levels = available_levels()
    results = Results(poses=poses, rounds=rounds, levels=levels)
    running, ours = [], {}
    try:
        for method in methods(levels):
            worker = runner.start(method, path, poses, folder)
            if isinstance(worker, str):
                results.lines.append(Line(method, 0, worker))
                continue
            running.append(worker)
            reference = ours.setdefault(method.norm, worker.values)  # ours comes first in either norm
            error = runner.require_agreement(method.name, worker.values, reference[: worker.count], method.loses)
            results.lines.append(Line(method, worker.count, "", error))
        lines = [line for line in results.lines if not line.missing]
        for done in range(rounds):
            print(f"round {done + 1} of {rounds}", file=sys.stderr)
            for line, worker in zip(lines, running, strict=True):
                line.nanoseconds.append(1e9 * runner.one_round(worker) / worker.count)
    finally:
        for worker in running:
            worker.close()
    some = min(poses, 400)
    results.exact_poses = some
    results.exact_error = exact.worst_error(robot, configurations.first(some), ours["2"][:some])
    results.facts = floor.measure(folder, path)
    require_accuracy(results)
    return results


def require_accuracy(results):
    found = {"extended precision": results.exact_error}
    if results.facts is not None:
        found |= {name: entry["error"] for name, entry in results.facts["accuracy"].items()}
    for name, error in found.items():
        if not error <= 1e-11:
            sys.exit(f"{name}: error {error:.2e} times max(1, kappa / 1000), expected at most 1e-11")


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--poses", type=int, default=1_000_000, help="how many (1000000)")
    parser.add_argument("--rounds", type=int, default=5, help="how often each method is run (5)")
    parser.add_argument("--cpp", type=Path, help="where ninedof_floor was built: build/cpp/bench/cpp")
    parser.add_argument("--write-docs", action="store_true", help="rewrite docs/comparison.md and its image")
    given = parser.parse_args(arguments)
    if given.poses < 1 or given.rounds < 1:
        parser.error("--poses and --rounds: expected at least 1")
    folder = given.cpp.resolve() if given.cpp else None
    with tempfile.TemporaryDirectory() as scratch:
        results = measure(given.poses, given.rounds, folder, Path(scratch))
    text = page.text(results, sys.argv[1:] if arguments is None else arguments)
    if given.write_docs:
        (ROOT / "docs" / "comparison.md").write_text(text, encoding="utf-8")
        figure.draw(results, ROOT / "docs" / "images" / "comparison.png")
    print(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
