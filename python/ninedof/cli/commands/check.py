"""`ninedof check`: a certificate of an optimum, read by a program that does not trust who wrote it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import typer

from ninedof.cli.answer import Answer
from ninedof.cli.options import Options
from ninedof.cli.screen import DONE, REFUSED, Screen, bold
from ninedof.proof.optimum import FILE, check_certificate

PLACE = 4
EXAMPLES = f"""[bold]Examples[/bold]

  ninedof optimize --certify --out proved       writes {FILE} into the run folder

  ninedof check proved"""


@dataclass(frozen=True, kw_only=True)
class Check(Options):
    """The options."""

    certificate: Annotated[Path, typer.Argument(help=f"A certificate, or a run folder that has {FILE}.")]


def check(asked: Check) -> Answer:
    """Check a certificate: that no design of its study has a condition number below the bound it states."""
    path = asked.certificate / FILE if asked.certificate.is_dir() else asked.certificate
    if not path.exists() and path != asked.certificate:
        raise ValueError(f"{asked.certificate}: got no {FILE}, expected a run folder of `ninedof optimize --certify`")
    with Screen(asked.json).points("reading the certificate") as bar:
        found = check_certificate(path, progress=bar)
    parts: list[Any] = [f"  {line}" if k else f"study of the certificate: {line}" for k, line in enumerate(found.study)]
    parts.append(bold("Proved" if found.proved else "Refused", f": {found.words}"))
    if found.proved:
        parts.append(f"{found.boxes} boxes of designs read, {found.recut} cut further by the checker")
    data = {"proved": found.proved, "words": found.words, "boxes": found.boxes, "study": found.study}
    return Answer(parts, data, DONE if found.proved else REFUSED)
