"""Sets of admissible designs: how much of a box is undecided after some seconds, as in docs/admissible.md.

    python bench/python/admissible.py               # all questions, five minutes
    python bench/python/admissible.py --only paper  # those that have this in their name

The baseline halves boxes: each is looked at with the same bounds, counts where all of it is decided, and is halved
across its longest side where not, the largest first, on as many threads. Prints markdown. Ends with status 1 where the
two disagree about a design drawn at random.
"""

import argparse
import os
import sys
import time
from collections import deque
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
from compare.machine import processor

import ninedof as nd

ROOT = Path(__file__).resolve().parents[2]
DRAWN = 2000  # designs of which both are asked
WHOLE = 1.0 - 1e-9
PAPER = nd.Study(
    variables={"a1": 0.0, "a2": (0.5, 12.0), "b1": (0.5, 6.0), "b2": 0.0, "zp": 4.9752, "zs": 3.1681},
    constraints={"radius_ratio": (None, 2.0)},
)
REQUIREMENT = nd.Study.load(ROOT / "examples" / "18_requirement.toml")
QUESTIONS = {  # study, what varies, options, seconds
    "paper's class, κ ≤ 3.9110: a2, b1": (PAPER, ("a2", "b1"), {"condition_number": 3.9110}, (1, 5)),
    "18_requirement: a2, b1": (REQUIREMENT, ("a2", "b1"), {"at": {"zp": 500.0, "zs": 330.0}}, (10, 60)),
    "18_requirement: a2, b1, zp": (REQUIREMENT, ("a2", "b1", "zp"), {"at": {"zs": 330.0}}, (60,)),
}


def halved(study, vary, options, seconds):
    """The undecided share of the volume by plain halving, and the boxes that are decided, with their state."""
    names, ends = list(vary), [study.variables[name] for name in vary]
    waiting, decided, share, start = deque([(tuple(ends), 1.0)]), [], 1.0, time.perf_counter()

    def look(box):
        found = nd.admissible(study, dict(zip(names, box, strict=True)), resolution=1.0, threads=1, **options)
        return next((state for state in ("inside", "outside") if found.shares[state] > WHOLE), None)

    with ThreadPoolExecutor() as pool:
        while waiting and time.perf_counter() - start < seconds:
            now = [waiting.popleft() for _ in range(min(64, len(waiting)))]
            for (box, size), state in zip(now, pool.map(lambda one: look(one[0]), now), strict=True):
                if state is not None:
                    decided.append((box, state))
                    share -= size
                    continue
                widths = [(b - a) / (high - low) for (a, b), (low, high) in zip(box, ends, strict=True)]
                k = widths.index(max(widths))
                middle = 0.5 * sum(box[k])
                for half in ((box[k][0], middle), (middle, box[k][1])):
                    waiting.append(((*box[:k], half, *box[k + 1 :]), 0.5 * size))
    return share, decided


def disagreements(found, decided):
    """How many designs drawn at random one calls inside and the other outside."""
    ends = np.array(found.of.ranges)
    drawn = np.random.default_rng(1).uniform(ends[:, 0], ends[:, 1], (DRAWN, len(ends)))
    theirs = np.full(DRAWN, "undecided", dtype=object)
    for box, state in decided:
        low, high = np.array(box).T
        theirs[((low <= drawn) & (drawn <= high)).all(axis=1)] = state
    return sum({one, other} == {"inside", "outside"} for one, other in zip(found.state_of(drawn), theirs, strict=True))


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--only", default="", help="questions that have this in their name")
    chosen = parser.parse_args().only
    print(f"{processor()}, {os.cpu_count()} processors.\n")
    print("| question | after | inside | outside | undecided | undecided by halving |")
    print("| --- | --- | --- | --- | --- | --- |")
    wrong = 0
    for name, (study, vary, options, times) in QUESTIONS.items():
        if chosen not in name:
            continue
        for seconds in times:
            found = nd.admissible(study, vary, time_limit=seconds, resolution=0.0, **options)
            share, decided = halved(study, vary, options, seconds)
            wrong += disagreements(found, decided)
            shares = " | ".join(f"{found.shares[state]:.3%}" for state in ("inside", "outside", "undecided"))
            print(f"| {name} | {found.seconds:.1f} s | {shares} | {share:.3%} |", flush=True)
    if wrong:
        print(f"\n{wrong} designs are inside for one and outside for the other")
    sys.exit(int(wrong > 0))


if __name__ == "__main__":
    main()
