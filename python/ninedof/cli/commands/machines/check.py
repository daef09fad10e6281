"""`ninedof check`: a certificate, read by a program that does not trust who wrote it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ninedof.cli.answer import Answer
from ninedof.cli.options import Options, argument, option, struct
from ninedof.cli.screen import DONE, NO_RESULT, REFUSED, bold
from ninedof.proof.optimum import check_certificate
from ninedof.proof.optimum_proof import FILE
from ninedof.records.proofs import certificate_file
from ninedof.workspace.certified_record import CERTIFICATE

EXAMPLES = f"""
  ninedof optimize --certify --out proved       writes {FILE} into the run folder
  ninedof check proved
  ninedof admissible study.toml --vary a2 --vary b1 --certificate designs.certificate
  ninedof check designs.certificate
  ninedof workspace machine --certify --out space    writes {CERTIFICATE} into the run folder
  ninedof check space"""

MAKERS = (
    "of `ninedof optimize --certify` or `workspace --certify`, "
    "or a file of `certify` or `admissible` with --certificate FILE"
)
UNIT = "lengths in the study's unit, which a certificate does not name"


@struct
class _Options(Options):
    certificate: Path = argument(f"A certificate, or a run folder that has {FILE} or {CERTIFICATE}.")
    time: float | None = option("Seconds, no limit by default; a machine with limits of forces may take minutes.")


def check(options: _Options) -> Answer:
    """Check a certificate: of a bound of all designs, a machine and its limits, a set of designs, or a workspace."""
    path = options.certificate
    if path.is_dir():
        path = next((file for name in (FILE, CERTIFICATE) if (file := path / name).exists()), path)
    if path.is_dir():
        how = ""
        if certificate_file(path).exists():  # certify.json, which is not replayed
            how = f"; to write one, type: ninedof certify {path} --certificate FILE (with tolerances --tolerance 0 too)"
        raise ValueError(f"{path}: got a folder without {FILE} and {CERTIFICATE}, expected that {MAKERS}{how}")
    with options.screen.bar("boxes", "check") as bar:
        bar.phase("reading the certificate")  # shown at once: a machine is one box, which may take minutes
        result = check_certificate(path, time_limit=options.time, progress=bar)
    lines = [*result.study, UNIT] if result.study else []
    parts: list[Any] = ["study of the certificate:", *(f"  {line}" for line in lines)] if lines else []
    verdict = "Proved" if result.proved else "Incomplete" if result.incomplete else "Refused"
    parts.append(bold(verdict, f": {result.words}"))
    if result.words == "this is no certificate":
        parts.append(f"Expected {FILE} {MAKERS}. certify.json says what is proved of a machine, and not why.")
    if result.study:
        boxes = "1 box" if result.boxes == 1 else f"{result.boxes} boxes"
        parts.append(f"{boxes} read, {result.recut} cut further by the checker")
    data = {name: getattr(result, name) for name in ("proved", "incomplete", "words", "boxes", "study")}
    return Answer(parts, data, DONE if result.proved else NO_RESULT if result.incomplete else REFUSED)
