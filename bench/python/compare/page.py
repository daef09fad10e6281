"""docs/comparison.md."""

import os
import shlex
import textwrap
from pathlib import Path

from compare import exact
from compare.machine import processor, versions


def template(name):
    return Path(__file__).with_name(f"{name}.md").read_text(encoding="utf-8")


def table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(row) + " |" for row in lines)


def time(nanoseconds):
    return f"{nanoseconds / 1e3:.3g} µs" if nanoseconds >= 1e3 else f"{nanoseconds:.3g} ns"


def times(results):
    rows = []
    for line in results.lines:
        if line.missing:
            rows.append([line.method.name, line.method.note, line.missing, "", "", "", ""])
            continue
        rows.append(
            [
                line.method.name,
                line.method.note,
                f"{line.count:,}".replace(",", " "),
                time(line.median),
                time(line.worst),
                f"{results.ratio(line):.3g}",
                "same bits" if line.error == 0.0 else f"{line.error:.1e}",
            ]
        )
    head = ["method", "how", "poses", "a pose, median", "worst round", "ratio to ours", "differs by at most"]
    return table(head, rows)


def counted(facts):
    rows = []
    for c in facts["operations"]:
        keys = ("multiplies", "additions", "divisions", "roots", "others")
        rows.append([str(c["lanes"]), *(f"{c[key]:.0f}" for key in keys)])
    head = [
        "poses in step",
        "multiplications",
        "additions",
        "divisions",
        "square roots",
        "comparisons, selections, signs",
    ]
    return table(head, rows)


def floor_table(results):
    rows = []
    for level, f in results.floors().items():
        t, measured = results.facts["throughput"][level], results.level(level).median
        each = 1.0 / t["both"]
        rows.append(
            [
                level,
                f"{2.0 * each:.1f}",
                f"{2.0 / t['fused']:.1f}" if t["fused"] > 0.0 else "none",
                f"{1.0 / t['divide']:.2g}, {1.0 / t['root']:.2g}",
                time(f["arithmetic"]),
                time(f["divisions"]),
                time(f["floor"]),
                time(measured),
                f"{100.0 * f['floor'] / measured:.0f} %",
                f"{100.0 * f['sum'] / measured:.0f} %",
            ]
        )
    head = [
        "level",
        "10⁹ multiplications and additions a second",
        "the same, fused",
        "10⁹ divisions, roots a second",
        "multiplications, additions",
        "divisions, roots",
        "floor",
        "measured",
        "share of the floor",
        "if nothing overlapped",
    ]
    return table(head, rows)


def floor_section(results):
    if results.facts is None:
        return "\nThe arithmetic floor and plain Eigen were left out: `ninedof_floor` was not built.\n"
    return "\n" + template("floor").format(counts=counted(results.facts), floors=floor_table(results))


def accuracy_section(results):
    rows = []
    if results.facts is not None:
        a = results.facts["accuracy"]
        names = {"random": "the poses above", "near_singular": "the same, O 1 to 10⁻⁹ from a singular plane"}
        for key, name in names.items():
            rows.append(
                [
                    name,
                    "function of one configuration, C++",
                    f"{results.poses:,}".replace(",", " "),
                    f"{a[key]['error']:.1e}",
                    f"{a[key]['most_condition']:.1e}",
                    f"{100.0 * a[key]['handed_over'] / results.poses:.2g} %",
                ]
            )
    name = f"extended precision ({exact.digits()} digits), numpy"
    rows.append(["the first of them", name, str(results.exact_poses), f"{results.exact_error:.1e}", "", ""])
    return table(
        ["poses", "beside", "how many", "error / max(1, κ/1000)", "largest κ", "left to the accurate path"], rows
    )


def ratios(results):
    """The figures aimed at, as far as this run has them."""
    ours = results.ours()
    shown = [f"{ours.median:.0f} ns a pose through Python at level {results.levels[-1]}"]
    for line in results.lines:
        if line.missing or line.method.norm != "2":
            continue
        if line.method.name == "numpy":
            shown.append(f"{results.ratio(line):.0f} times vectorized numpy")
        if line.method.name == "plain Eigen, base":
            shown.append(f"{results.ratio(line):.0f} times plain Eigen")
        if line.method.cores == 2:
            shown.append(f"{1.0 / results.ratio(line):.2f} times as many on two cores")
    return shown[0] + "; " + ", ".join(shown[1:])


def measured(results):
    machine = f"{processor()}, {os.cpu_count()} processors"
    return textwrap.fill(f"Measured on: {machine}; {versions(results.facts)}; {results.rounds} rounds.", 110)


def text(results, arguments):
    return template("page").format(
        poses=f"{results.poses:,}".replace(",", " "),
        command=shlex.join(["python", "bench/python/comparison.py", *arguments]),
        measured=measured(results),
        summary=textwrap.fill("In short: " + ratios(results) + ".", 110),
        times=times(results),
        floor=floor_section(results),
        accuracy=accuracy_section(results),
    )
