"""The time of a choice of actuators: a catalogue of 12 rows, three kinds of legs, over a region.

.venv/bin/python bench/python/actuators.py [--duty]

The study is that of examples/18_requirement.toml without its limit of strokes. `--duty` adds a load and a speed, and
forces and rates are held too. Other processes of the machine change the seconds; those of the processor less.
"""

import sys
import time
from dataclasses import replace
from pathlib import Path

import ninedof as nd

EXAMPLES = Path(__file__).parents[2] / "examples"
ROWS = """
S100  160  260  400 400 110
S120  180  300  400 300 125
S150  220  370  400 300 140
M150  260  410  800 350 190
M200  320  520  800 350 210
M250  380  630  800 350 235
M300  440  740  800 350 255
L200  420  620 1500 300 310
L250  480  730 1500 300 330
L300  540  840 1500 300 360
XL350 620  970 2500 250 520
XL400 700 1100 2500 250 560
"""


def main(duty: bool) -> None:
    """Choose, and print what it took."""
    rows = [nd.Actuator(name, *map(float, numbers)) for name, *numbers in map(str.split, ROWS.strip().splitlines())]
    study = nd.Study.load(EXAMPLES / "18_requirement.toml")
    limits = {name: limit for name, limit in study.constraints.items() if name != "stroke_ratio"}
    study = replace(study, constraints=limits, actuators=rows)
    if duty:
        study = replace(study, loads={"wrenches": [[0, 0, 0, 0, 0, -300]]}, speeds={"linear": 200.0})
    begin, processor = time.perf_counter(), time.process_time()
    result = nd.optimize(study)
    seconds, of_processor = time.perf_counter() - begin, time.process_time() - processor
    print(f"{result.status}, {result.objective:.6f}: {seconds:.0f} s, {of_processor:.0f} s of the processor")
    print(*result.actuators.words if result.actuators else [result.reason], sep="\n")


if __name__ == "__main__":
    main("--duty" in sys.argv)
