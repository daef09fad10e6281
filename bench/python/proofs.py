"""Proofs of optima: how tight they are, how fast, and how fast their certificates are replayed.

    python bench/python/proofs.py                     # the table of docs/certificate.md, some minutes
    python bench/python/proofs.py --only requirement  # those that have this in their name

Prints markdown; seconds are CPU seconds of all threads. Ends with status 1 where a gap is not reached, or a certificate
is not proved by the checker.
"""

import argparse
import sys
import time
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

from compare.machine import processor

import ninedof as nd

ROOT = Path(__file__).resolve().parents[2]
HEXAGON = {"a1": 0.0, "a2": (0.01, 50.0), "b1": (0.01, 2.0), "b2": 0.0, "zp": (0.01, 50.0), "zs": (0.01, 50.0)}
CAP = nd.Study(variables=HEXAGON, constraints={"radius_ratio": (None, 2.5)})


def example(name):
    return nd.Study.load(ROOT / "examples" / f"{name}.toml")


REQUIREMENT = example("18_requirement")
TILTED = replace(REQUIREMENT, objective={"region": {"box": (60.0, 60.0, 40.0), "tilt_deg": 30.0}})
SIX = replace(REQUIREMENT, variables=dict(REQUIREMENT.variables) | {"a1": (0.0, 600.0), "b2": (0.0, 250.0)})


def paper(**ends):
    """The paper's problem with other bounds of some variables."""
    study = nd.Study.paper()
    return replace(study, variables=dict(study.variables) | ends)


FROM_ZERO = nd.Study(
    "symmetric",
    variables=dict.fromkeys(("base_internal_radius", "platform_internal_radius"), (0.0, 12.0)),
    constraints={"radius_ratio": (None, 2.0), "leg_ratio": (None, 3.0)},
)
STUDIES = {  # study, gap
    "01_paper": (example("01_paper"), 1e-12),
    "the paper's with b1 ≤ 2, radius ratio ≤ 2.5": (CAP, 1e-8),
    "the paper's with theta_z from -1 to 1 rad": (paper(theta_z=(-1.0, 1.0)), 1e-12),
    "the paper's with zp ≤ 2.5": (paper(zp=(0.05, 2.5)), 1e-8),
    "the paper's with zp and zs from 0": (paper(zp=(0.0, 80.0), zs=(0.0, 80.0)), 1e-12),
    **{
        f"the paper's with the length {word}": (replace(nd.Study.paper(), characteristic_length=word), 1e-10)
        for word in ("optimal", "natural", "mean_leg", "platform_radius")
    },
    "symmetric, internal radii from 0, radius ratio ≤ 2, leg ratio ≤ 3": (FROM_ZERO, 0.4),
    "09_near_isotropic": (example("09_near_isotropic"), 2e-3),
    "values/nonplanar_any_height": (example("values/nonplanar_any_height"), 2e-3),
    "18_requirement, over its region": (REQUIREMENT, 1e-3),
    "18_requirement, tilts of 30 degrees": (TILTED, 2e-2),
    "18_requirement, six free variables": (SIX, 0.2),
}


def timed(work, *arguments, **options):
    start = time.process_time()
    return work(*arguments, **options), time.process_time() - start


def replayed(proof, folder):
    """What the checker makes of the certificate of a proof, in words, and whether nothing is wrong with it."""
    if not proof.certificate:
        return "none | |", True
    file = proof.save(Path(folder) / "optimum.certificate")
    found, seconds = timed(nd.check_certificate, file)
    return f"{file.stat().st_size / 1e6:.3g} MB | {seconds:.1f} s |", found.proved


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--only", default="", help="studies that have this in their name")
    chosen = parser.parse_args().only
    print(f"{processor()}; seconds of CPU.\n")
    print("| study | best known | gap | proved: none below | boxes | seconds | certificate | replayed in |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    wrong = 0
    for name, (study, gap) in STUDIES.items():
        if chosen not in name:
            continue
        best = nd.optimize(study).objective
        proof, seconds = timed(nd.prove_optimum, study, best, gap=gap)
        with TemporaryDirectory() as folder:
            words, right = replayed(proof, folder)
        wrong += not (proof.complete and right)
        print(
            f"| {name} | {best:.7f} | {gap:g} | {proof.lower_bound:.7f} | {proof.boxes:.2g} | {seconds:.1f} | {words}",
            flush=True,
        )
    sys.exit(int(wrong > 0))


if __name__ == "__main__":
    main()
