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
class CheckOptions(Options):
    """The options."""

    certificate: Annotated[Path, typer.Argument(help=f"A certificate, or a run folder that has {FILE}.")]


def check(options: CheckOptions) -> Answer:
    """Check a certificate: that no design of its study has a condition number below the bound it states."""
    path = options.certificate / FILE if options.certificate.is_dir() else options.certificate
    if not path.exists() and path != options.certificate:
        raise ValueError(f"{options.certificate}: got no {FILE}, expected a run folder of `ninedof optimize --certify`")
    with Screen(options.json).bar("points", "reading the certificate") as bar:
        result = check_certificate(path, progress=bar)
    parts: list[Any] = ["study of the certificate:", *(f"  {line}" for line in result.study)]
    parts.append(bold("Proved" if result.proved else "Refused", f": {result.words}"))
    if result.proved:
        parts.append(f"{result.boxes} boxes of designs read, {result.recut} cut further by the checker")
    data = {"proved": result.proved, "words": result.words, "boxes": result.boxes, "study": result.study}
    return Answer(parts, data, DONE if result.proved else REFUSED)
