"""The table "Measured" of bench/README.md, from a run of the C++ benchmark's summary.

    python bench/python/measured.py build/release/bench/cpp/ninedof_bench           # prints the section
    python bench/python/measured.py build/release/bench/cpp/ninedof_bench --write   # puts it into bench/README.md

The section names the commit, the machine and the compiler. Uncommitted changes are named too.
"""

import argparse
import os
import re
import subprocess
import sys
from pathlib import Path

from compare.machine import processor

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "bench" / "README.md"
HEADING = "## Measured\n"
WRITTEN = "Written by `python bench/python/measured.py build/release/bench/cpp/ninedof_bench --write`."


def commit():
    """The commit that was measured, with a word where files differ from it."""

    def git(*arguments):
        return subprocess.run(["git", *arguments], cwd=ROOT, check=True, capture_output=True, text=True).stdout.strip()

    changed = bool(git("status", "--porcelain", "--untracked-files=no"))
    return git("rev-parse", "--short=10", "HEAD") + (" and uncommitted changes" if changed else "")


def summary(program):
    """The table and the closing words of the summary, as `ninedof_bench` prints them."""
    command = [program, "--benchmark_filter=NONE"]
    printed = subprocess.run(command, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout
    table = re.search(r"^\| figure \|.*?(?=\n\n)", printed, flags=re.MULTILINE | re.DOTALL)
    if table is None:
        raise SystemExit(f"{program}: printed no table")
    return table.group(), printed[table.end() :].strip()


def section(program):
    """The whole section, heading included."""
    table, words = summary(program)
    machine = f"{processor()}, {os.cpu_count()} processors, Linux" if sys.platform == "linux" else processor()
    where = f"Commit {commit()}. {machine}. Release build for plain x86-64, one thread unless said."
    return f"{HEADING}\n{WRITTEN}\n\n{where} {words.replace(chr(10), ' ')}\n\n{table}\n\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("program", type=Path, help="the built benchmark: build/release/bench/cpp/ninedof_bench")
    parser.add_argument("--write", action="store_true", help="write the section into bench/README.md")
    options = parser.parse_args()
    text = section(options.program)
    if not options.write:
        print(text, end="")
        return
    page = PAGE.read_text(encoding="utf-8")
    start = page.index(HEADING)
    end = page.index("\n## ", start) + 1
    PAGE.write_text(page[:start] + text + page[end:], encoding="utf-8")


if __name__ == "__main__":
    main()
