"""The optimizer beside SciPy's SLSQP and differential evolution, on the same function, in one process.

    python bench/python/against_scipy.py [--quick]

Two problems: the paper's (hexagons, base at most twice the platform) and planar triples with radius_ratio <= 2 and
leg_ratio <= 3. SciPy minimises the condition number as this package computes it, compiled, through the shortest way
there is from Python, with the study's own margins as constraints, the same bounds and, for SLSQP, the same 64 starts.
No point is computed twice for it. SLSQP runs twice: with finite differences, SciPy's default, and with our exact
gradients. SciPy runs on one thread; the ratios are to ours on one thread.

Two ratios, like with like. Whole run: the same number of starts to their ends, which is what trust in the answer costs.
Until 1e-6: until a design within 1e-6 of the best value anyone found is first seen, which nobody knows at that moment;
for ours the time of a whole run, checks included, of the fewest starts (1, 2, 4, ...) that find it.
"""

import argparse
import math
import statistics
import warnings
from dataclasses import dataclass
from time import perf_counter

import numpy as np
from scipy.optimize import NonlinearConstraint, differential_evolution, minimize

import ninedof as nd

QUALITY = 1e-6  # relative to the best value found by anyone
FEASIBLE = 1e-8
MEMORY = 256  # points remembered, so that an objective and its constraints cost one evaluation


def paper():
    return nd.Study.paper()


def planar():
    """The room of the theory note: radii from 0.05 to 12."""
    triples = ("base_external", "base_internal", "platform_external", "platform_internal")
    variables = {f"{t}_radius": (0.05, 12.0) for t in triples} | {"zp": (0.05, 20.0), "zs": (0.05, 20.0)}
    variables |= {f"{t}_angle": (-math.pi, math.pi) for t in triples[1:]}
    return nd.Study(
        family="symmetric",
        variables=variables,
        constraints={"radius_ratio": (None, 2.0), "leg_ratio": (None, 3.0)},
    )


class Function:
    """The condition number and the margins of a study over its free variables, counted and timed."""

    def __init__(self, study):
        self.problem = study.problem()
        bounds = list(study.variables.values())
        self.free = np.array([k for k, b in enumerate(bounds) if isinstance(b, tuple)])
        self.bounds = [bounds[k] for k in self.free]
        self.full = np.array([0.0 if isinstance(b, tuple) else b for b in bounds])
        names = list(study.variables)
        self.heights = names.index("zp"), names.index("zs")
        self.begin = perf_counter()
        self.memory, self.evaluations, self.inside = {}, 0, 0.0
        self.best, self.history = math.inf, []  # (seconds, value) of every better allowed design

    def at(self, x):
        """Condition number, its gradient, margins, their gradients."""
        key = x.tobytes()
        if key not in self.memory:
            self.full[self.free] = x
            begin = perf_counter()
            core = self.problem.evaluate(self.full)
            self.inside += perf_counter() - begin
            self.evaluations += 1
            zp, zs = (self.full[k] for k in self.heights)
            kappa = min(core.objective, 1e9)  # SciPy takes no infinity
            margins = [one.value for one in core.margins] + [1.0 - zs / zp]
            below = np.zeros_like(self.full)  # gradient of 1 - zs/zp
            below[[*self.heights]] = zs / zp**2, -1.0 / zp
            slopes = np.array([*(one.gradient for one in core.margins), below])[:, self.free]
            if len(self.memory) >= MEMORY:
                self.memory.clear()
            self.memory[key] = kappa, kappa * core.gradient[self.free], np.array(margins), slopes
            inside = all(low <= v <= high for v, (low, high) in zip(x, self.bounds, strict=True))
            if kappa < self.best and inside and min(margins) >= -FEASIBLE:
                self.best = kappa
                self.history.append((perf_counter() - self.begin, kappa))
        return self.memory[key]

    def reached(self, value):
        """Seconds until a design this good was seen, None if never."""
        return next((t for t, kappa in self.history if kappa <= value), None)


@dataclass
class Line:
    name: str
    best: float
    evaluations: int
    seconds: float
    inside: float | None  # seconds spent in our function
    reached: object  # value -> seconds or None
    good: object = None  # value -> how many starts ended there


def slsqp(study, starts, exact):
    """Multi-start; a start that SciPy gives up on counts like any other."""
    f, ends = Function(study), []
    jac = {"jac": lambda x: f.at(x)[1]} if exact else {}
    limit = {"type": "ineq", "fun": lambda x: f.at(x)[2]} | ({"jac": lambda x: f.at(x)[3]} if exact else {})
    for start in starts[:, f.free]:
        end = minimize(
            lambda x: f.at(x)[0],
            start,
            method="SLSQP",
            bounds=f.bounds,
            constraints=[limit],
            options={"maxiter": 500, "ftol": 1e-12},
            **jac,
        )
        ends.append(f.at(end.x)[0] if f.at(end.x)[2].min() >= -FEASIBLE else math.inf)
    seconds = perf_counter() - f.begin
    gradients = "our gradients" if exact else "finite differences"
    return Line(
        f"SLSQP, {len(starts)} starts, {gradients}",
        f.best,
        f.evaluations,
        seconds,
        f.inside,
        f.reached,
        lambda value: f"{sum(e <= value for e in ends)}/{len(ends)}",
    )


def evolution(study, generations):
    """Differential evolution as SciPy ships it, polish included."""
    f = Function(study)
    limits = NonlinearConstraint(lambda x: f.at(x)[2], 0.0, np.inf)
    end = differential_evolution(
        lambda x: f.at(x)[0], f.bounds, constraints=limits, maxiter=generations, tol=1e-9, seed=0
    )
    name = f"differential evolution, {end.nit} generations"
    return Line(name, f.best, f.evaluations, perf_counter() - f.begin, f.inside, f.reached)


def ours(study, threads, repeats):
    """Medians of whole runs, each after one to warm up."""

    def median(starts):
        runs = [nd.optimize(study, starts=starts, threads=threads) for _ in range(repeats + 1)][1:]
        return statistics.median(r.seconds for r in runs), runs[0]

    seconds, result = median(study.starts)
    on = "1 thread" if threads == 1 else "all threads"

    def reached(value):
        for starts in (2**k for k in range(12)):
            some, found = median(starts)
            if found.condition_number is not None and found.condition_number <= value:
                return some
        return None

    def ended(value):
        return f"{sum(c.reached for c in result.candidates if c.condition_number <= value)}/{result.starts_done}"

    name = f"ninedof, {result.starts_done} starts, {on}"
    return Line(name, result.condition_number, result.evaluations, seconds, None, reached, ended)


def compare(title, study, quick):
    repeats = 3 if quick else 21
    study = study.with_solver(starts=8 if quick else None)
    starts = np.asarray(study.problem().starts(study.starts, study.seed))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # SciPy's, about steps across kinks and bounds
        lines = [
            ours(study, 1, repeats),
            ours(study, None, repeats),
            slsqp(study, starts, exact=False),
            slsqp(study, starts, exact=True),
            evolution(study, 30 if quick else 1000),
        ]
    least = min(line.best for line in lines)
    good = least * (1.0 + QUALITY)
    reached = [line.reached(good) for line in lines]
    header = ("", "above best", "ended there", "evaluations", "whole run", "ratio", "in f", "until 1e-6", "ratio")
    rows = [header]
    for line, found in zip(lines, reached, strict=True):
        rows.append(
            (
                line.name,
                f"{line.best / least - 1.0:.1e}",
                line.good(good) if line.good else "",
                str(line.evaluations),
                duration(line.seconds),
                f"{line.seconds / lines[0].seconds:.3g}",
                duration(line.inside) if line.inside is not None else "",
                "never" if found is None else duration(found),
                "" if found is None or reached[0] is None else f"{found / reached[0]:.3g}",
            )
        )
    widths = [max(len(r[k]) for r in rows) for k in range(len(header))]
    print(f"\n{title}: best value {least:.9f}")
    for r in rows:
        print("  ".join([r[0].ljust(widths[0]), *(c.rjust(w) for c, w in zip(r[1:], widths[1:], strict=True))]))


def duration(seconds):
    for size, unit in ((1e-3, "us"), (1.0, "ms")):
        if seconds < size:
            return f"{1e3 * seconds / size:.1f} {unit}"
    return f"{seconds:.2f} s"


def main():
    parser = argparse.ArgumentParser(description="The optimizer beside SciPy's, on the same function.")
    parser.add_argument("--quick", action="store_true", help="8 starts and 30 generations: a test of this program")
    quick = parser.parse_args().quick
    for title, study in (("hexagons, radius_ratio <= 2", paper), ("planar triples, ratio 2, legs 3", planar)):
        compare(title, study(), quick)
    print("\nin f: the part of the whole run inside the compiled function. ended there: starts that end within 1e-6.")


if __name__ == "__main__":
    main()
