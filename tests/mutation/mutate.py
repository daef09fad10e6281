"""Mutation testing of the core: how many small faults in its formulas do the C++ tests notice?

    python tests/mutation/mutate.py BUILD [--count 150] [--seed 1] [--minutes 60] [--threads 2]

BUILD is a build of the C++ tests in which each source is compiled alone (the preset dev, or one with -O1). A mutant is
one changed operator, constant or statement of one source. Only that source is compiled, put before the library, and
tested by the suites of its room, then, where these see nothing, by those of the other rooms. Nothing in the tree is
written to; what survives is printed with its line.
"""

import argparse
import concurrent.futures
import json
import random
import re
import shlex
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ROOMS = ("robot", "kinematics", "conditioning", "position", "singularity", "statics")
# What is replaced by what. Operators have blanks about them here: the formatter sees to it.
SWAPS = (
    (" + ", " - "),
    (" - ", " + "),
    (" * ", " / "),
    (" / ", " * "),
    (" += ", " -= "),
    (" -= ", " += "),
    (" < ", " >= "),
    (" > ", " <= "),
    (" <= ", " < "),
    (" >= ", " > "),
    (" == ", " != "),
    (" != ", " == "),
    (" && ", " || "),
    (" || ", " && "),
    ("std::max", "std::min"),
    ("std::min", "std::max"),
    ("std::sin", "std::cos"),
    ("std::cos", "std::sin"),
    ("true", "false"),
    ("false", "true"),
)
NUMBER = re.compile(r"(?<![\w.])(\d+\.\d+(?:e-?\d+)?|\d+e-?\d+|\d+)(?![\w.])")
NEGATED = re.compile(r"(?<=[=(,{] )-(?=[\w(])|(?<=[({])-(?=[\w(])|(?<=return )-(?=[\w(])")
STATEMENT = re.compile(r"^\s+[\w.\[\]>()-]+(?: = | [+*/-]= |\().*;(?: *//.*)?$")


@dataclass(frozen=True)
class Mutant:
    """One changed line of a source."""

    source: str
    line: int
    before: str
    after: str

    def __str__(self) -> str:
        return f"{self.source}:{self.line}: {self.before.strip()}  ->  {self.after.strip() or '(removed)'}"


def other_number(text: str) -> str:
    """The next integer; a real number a thousandth larger, a tolerance ten times as large."""
    if text.isdigit():
        return str(int(text) + 1)
    value = float(text)
    return repr(value * (10.0 if 0.0 < value < 1e-3 else 1.001) if value else 1e-3)


def mutants_of(source: Path) -> list[Mutant]:
    """All mutants of a source, one for each place and change."""
    name, out = str(source.relative_to(ROOT)), []
    for number, line in enumerate(source.read_text().splitlines(), 1):
        code = line.split("//")[0]
        if not code.strip() or code.lstrip().startswith(("#", "template", "using", "namespace")) or '"' in code:
            continue
        changed = {
            code[: at.start()] + new + code[at.end() :]
            for old, new in SWAPS
            for at in re.finditer(rf"(?<!\w){re.escape(old)}(?!\w)" if old.isalpha() else re.escape(old), code)
        }
        changed |= {code[: at.start()] + other_number(at[0]) + code[at.end() :] for at in NUMBER.finditer(code)}
        changed |= {code[: at.start()] + code[at.end() :] for at in NEGATED.finditer(code)}
        if STATEMENT.match(code):
            changed.add("")
        out += [Mutant(name, number, line, after) for after in sorted(changed)]
    return out


def suites(room: str) -> str:
    """The names of the suites of a room, for doctest."""
    return ",".join(sorted(path.stem for path in (ROOT / "tests/cpp" / room).glob("*.cpp")))


class Build:
    """Compiles and tests mutants beside a finished build."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        commands = json.loads((folder / "compile_commands.json").read_text())
        self.commands = {entry["file"]: entry["command"] for entry in commands}
        self.tests = sorted(map(str, (folder / "tests/cpp").rglob("ninedof_tests.dir/**/*.o")))
        cache = (folder / "CMakeCache.txt").read_text()
        nlopt = re.search(r"^NLopt_DIR:PATH=(.*)$", cache, re.MULTILINE)
        prefix = Path(nlopt[1]).parents[2] if nlopt else Path("/usr")
        self.libraries = [str(folder / "cpp/libninedof.a"), f"-L{prefix}", f"-L{prefix / 'lib'}", "-lnlopt", "-pthread"]

    def program(self, mutant: Mutant, folder: Path) -> Path | None:
        """The test program with the mutant in it; none if it does not compile."""
        source = ROOT / mutant.source
        lines = source.read_text().splitlines()
        lines[mutant.line - 1] = mutant.after
        changed = folder / source.name
        changed.write_text("\n".join(lines) + "\n")
        words = shlex.split(self.commands[str(source)])
        if words[0].endswith("ccache"):
            words = words[1:]
        words[words.index("-o") + 1] = str(folder / "mutant.o")
        words = [str(changed) if word == str(source) else word for word in words if not word.startswith("-W")]
        if not succeeds([*words, f"-I{source.parent}"], cwd=self.folder, seconds=300):
            return None
        program = folder / "tests"
        link = [words[0], "-o", str(program), str(folder / "mutant.o"), *self.tests, *self.libraries]
        return program if succeeds(link, cwd=self.folder, seconds=300) else None

    def fate(self, mutant: Mutant) -> str:
        """How it ends: "stillborn", "killed" by its room, "killed elsewhere" or "survived"."""
        own = mutant.source.split("/")[2]
        with tempfile.TemporaryDirectory() as name:
            program = self.program(mutant, Path(name))
            if program is None:
                return "stillborn"
            for room in (own, *(room for room in ROOMS if room != own)):
                if not self.passes(program, room):
                    return "killed" if room == own else "killed elsewhere"
        return "survived"

    def passes(self, program: Path, room: str) -> bool:
        """Whether the suites of a room notice nothing. A test that hangs has noticed."""
        return succeeds([str(program), f"--test-suite={suites(room)}", "--abort-after=1"], cwd=self.folder, seconds=240)


def succeeds(command: list[str], cwd: Path, seconds: float) -> bool:
    """Whether a program ends well and in time."""
    try:
        return subprocess.run(command, cwd=cwd, capture_output=True, timeout=seconds, check=False).returncode == 0
    except subprocess.TimeoutExpired:
        return False


def main() -> int:
    """Draws the mutants, tests them and prints the count of each fate and all that survive."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path)
    parser.add_argument("--count", type=int, default=150)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--sources", nargs="*", help="stems of sources; all of the chosen rooms by default")
    given = parser.parse_args()

    build = Build(given.build.resolve())
    sources = [path for room in ROOMS for path in sorted((ROOT / "cpp/src" / room).rglob("*.cpp"))]
    sources = [path for path in sources if not given.sources or path.stem in given.sources]
    pool = [mutant for path in sources for mutant in mutants_of(path)]
    drawn = random.Random(given.seed).sample(pool, min(given.count, len(pool)))
    print(f"{len(pool)} mutants in {len(sources)} sources; {len(drawn)} drawn with seed {given.seed}", flush=True)

    end = time.monotonic() + 60.0 * given.minutes
    count: dict[str, int] = {}

    def judge(mutant: Mutant) -> tuple[Mutant, str]:
        return mutant, build.fate(mutant) if time.monotonic() < end else "not tried"

    with concurrent.futures.ThreadPoolExecutor(given.threads) as threads:
        for mutant, fate in threads.map(judge, drawn):
            count[fate] = count.get(fate, 0) + 1
            if fate != "not tried":
                print(f"{fate}: {mutant}", flush=True)
    born = sum(n for fate, n in count.items() if fate not in ("stillborn", "not tried"))
    killed = born - count.get("survived", 0)
    print(count, f"killed {killed} of {born}" + (f": {killed / born:.1%}" if born else ""))
    return 0


if __name__ == "__main__":
    sys.exit(main())
