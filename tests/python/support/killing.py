"""Commands killed at random moments and typed again, until one comes to its end: what its record then says.

As a program: `python killing.py [KILLS] [SEED]` kills every kind of command as often, and prints what came of it.
"""

import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

STUDY = """
[design]
family = "hexagonal"
[variables]
zp = [1.0, 6.0]
[constraints]
radius_ratio = { max = 2.0 }
leg_ratio = { max = 2.2 }
[objective.region]
box = [0.2, 0.2, 0.2]
tilt_deg = 10.0
[solver]
starts = 8
"""
PLACED = STUDY.replace("tilt_deg = 10.0", 'tilt_deg = 10.0\ninternal_point = "best"').replace("2.2", "2.4")
OWN = "--no-figures"
COMMANDS = {
    "sweep": f"sweep --over x_p=-1:1:300 --over y_p=-1:1:300 --chunk 4096 --index leg_ratio {OWN}",
    "atlas": f"atlas --designs 8000000 {OWN}",
    "front": f"pareto --against radius_ratio --points 5 --starts 8 {OWN}",
    "region": f"optimize study.toml {OWN}",
    "placed": f"optimize placed.toml {OWN}",
    "proof": f"optimize --starts 8 --certify {OWN}",
    "workspace": f"workspace --legs 2.5 6.5 --condition 8 {OWN}",
    "bounds": f"workspace --legs 2.5 6.5 --certify --gap 0.2 --tolerance 0.01 {OWN}",
    "certificate": "certify solved --gap 0.3 --time 1000",
}
OF_TIME = {"seconds", "created", "files", "digest"}  # and what covers them
AFTER = 0.2  # seconds: before, Python itself is loaded


class Lost(AssertionError):
    """A run that did not come back as it would have been."""


class Killer:
    """A folder in which commands are run, undisturbed or killed."""

    def __init__(self, folder, seed, program=None):
        self.folder, self._random = Path(folder), random.Random(seed)
        self._program = program or [sys.executable, "-m", "ninedof"]
        (self.folder / "study.toml").write_text(STUDY)
        (self.folder / "placed.toml").write_text(PLACED)
        self.kills = 0

    def undisturbed(self, kind):
        """Run a command to its end; return what it wrote, and how long it took."""
        begin = time.perf_counter()
        out = self._out(kind, "whole")
        self._expect_end(subprocess.run(self._first(kind, out), **self._how()))
        return written(out), time.perf_counter() - begin

    def killed(self, kind, seconds, kills):
        """Kill a command so often, each time somewhere in `seconds`; return what it wrote in the end."""
        out, again = self._out(kind, "killed"), 0
        command = self._first(kind, out)
        while again < kills:
            running = subprocess.Popen(command, **self._how())
            try:
                running.wait(AFTER + self._random.random() * seconds)
            except subprocess.TimeoutExpired:
                running.kill()
                again += 1
                self.kills += 1
            running.communicate()
            if running.returncode not in (-9, 0, 3):
                raise Lost(f"{kind}: status {running.returncode} of {' '.join(command)}")
            if running.returncode >= 0:
                break
        if running.returncode < 0:
            self._expect_end(subprocess.run(command, **self._how()))
        return written(out), again

    def _first(self, kind, out):
        words = COMMANDS[kind].split()
        return [*self._program, *words] if kind == "certificate" else [*self._program, *words, "--out", out.name]

    def _out(self, kind, name):
        if kind != "certificate":
            out = self.folder / f"{kind}-{name}"
            shutil.rmtree(out, ignore_errors=True)
            return out
        out = self.folder / "solved"
        if not out.exists():
            self._expect_end(subprocess.run(self._first("region", out), **self._how()))
        for file in out.glob("certify*"):
            file.unlink()
        return out

    def _how(self):
        return {"cwd": self.folder, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "env": dict(os.environ)}

    def _expect_end(self, done):
        if done.returncode not in (0, 3):
            raise Lost(f"status {done.returncode}: {done.args}\n{done.stderr.decode()}")


def written(out):
    """Return all that a run wrote but for times: its records, arrays and pieces by name."""
    found = {}
    for file in sorted(out.rglob("*")):
        if file.suffix == ".json":
            found[file.name] = untimed(json.loads(file.read_text()))
        elif file.parent.name == "pieces" and not file.name.startswith(".part-"):
            found[file.name] = None  # the right number of them
        elif file.suffix == ".npz" and file.name not in ("map.npz", "certified.npz"):
            found[file.name] = file.read_bytes()
    return found


def untimed(value):
    """Return plain values without times, and without the name of the folder in the command."""
    if isinstance(value, dict):
        return {key: untimed(v) for key, v in value.items() if key not in OF_TIME and key != "command"}
    return [untimed(v) for v in value] if isinstance(value, list) else value


def main(kills=200, seed=0):
    """Spread the kills over all commands and print a line for each."""
    each = -(-kills // len(COMMANDS))
    with tempfile.TemporaryDirectory() as folder:
        for k, kind in enumerate(COMMANDS):
            killer = Killer(folder, seed + k)
            whole, seconds = killer.undisturbed(kind)
            runs = same = 0
            while killer.kills < each:
                got, _ = killer.killed(kind, max(seconds - AFTER, 0.1), min(4, each - killer.kills))
                runs += 1
                same += got == whole
            print(
                f"{kind}: {seconds:.1f} s undisturbed, {killer.kills} kills in {runs} runs, {same} of them equal to "
                "the undisturbed one",
                flush=True,
            )


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
