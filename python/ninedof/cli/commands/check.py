"""`ninedof check`: a certificate of an optimum, read by a program that does not trust who wrote it."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ninedof.cli.options import Json
from ninedof.cli.screen import DONE, REFUSED, Screen, bold
from ninedof.proof.optimum import FILE, check_certificate

PLACE = 4
EXAMPLES = f"""[bold]Examples[/bold]

  ninedof optimize --certify --out proved       writes {FILE} into the run folder

  ninedof check proved"""


def check(
    certificate: Annotated[Path, typer.Argument(help=f"A certificate, or a run folder that has {FILE}.")],
    json: Json = False,
) -> None:
    """Check a certificate: that no design of its study has a condition number below the bound it states."""
    screen = Screen(json)
    path = certificate / FILE if certificate.is_dir() else certificate
    if not path.exists() and path != certificate:
        raise ValueError(f"{certificate}: got no {FILE}, expected a run folder of `ninedof optimize --certify`")
    with screen.points("reading the certificate") as bar:
        found = check_certificate(path, progress=bar)
    for k, line in enumerate(found.study):
        screen.print(f"  {line}" if k else f"study of the certificate: {line}")
    screen.print(bold("Proved" if found.proved else "Refused", f": {found.words}"))
    if found.proved:
        screen.print(f"{found.boxes} boxes of designs read, {found.recut} cut further by the checker")
    screen.data({"proved": found.proved, "words": found.words, "boxes": found.boxes, "study": found.study})
    raise typer.Exit(DONE if found.proved else REFUSED)
