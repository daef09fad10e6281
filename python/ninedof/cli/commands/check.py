"""`ninedof check`: a certificate of an optimum, read by a program that does not trust who wrote it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated

import typer

from ninedof.cli.options import Json
from ninedof.cli.screen import DONE, REFUSED, Screen, bold
from ninedof.proof.optimum import FILE, check_certificate
from ninedof.support.reading import PROOF, read_file

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
    if found.proved:
        for line in _study_of(read_file(path, PROOF)):
            screen.print(line)
    screen.print(bold("Proved" if found.proved else "Refused", f": {found.words}"))
    if found.proved:
        screen.print(f"{found.boxes} boxes of designs read, {found.recut} cut further by the checker")
    screen.data({"proved": found.proved, "words": found.words, "boxes": found.boxes})
    raise typer.Exit(DONE if found.proved else REFUSED)


def _study_of(certificate: bytes) -> Iterator[str]:
    """Return what a certificate that was checked says of its study: that in the same folder may be another."""
    lines = certificate.partition(b"\ntree ")[0].decode().splitlines()[2:]
    for kind, name, *ends in map(str.split, lines):
        if kind == "family":
            yield f"study of the certificate: {name} designs with 0 < zs < zp"
        elif kind == "characteristic_length":
            yield f"  characteristic length {_plain(name)}"
        elif kind in ("variable", "limit"):
            low, high = map(_plain, ends)
            yield f"  {name} {low}" if low == high else f"  {name} from {low} to {high}"


def _plain(hexadecimal: str) -> str:
    return repr(float.fromhex(hexadecimal)).removesuffix(".0")
