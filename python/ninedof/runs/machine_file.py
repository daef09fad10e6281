"""The certificate of a machine beside the record of its run: certify.json, or certify-7.json for point 7."""

from __future__ import annotations

import os
from pathlib import Path

from ninedof.proof.machine_record import MachineCertificate
from ninedof.runs.objects import split
from ninedof.support.arguments import path_argument
from ninedof.support.json import decode
from ninedof.support.reading import JSON, read_text
from ninedof.support.seal import unsealed, write_sealed


def certificate_file(run: str | os.PathLike[str]) -> Path:
    """Return where the certificate of a run, or of one of its points, lies."""
    place, point = split(os.fspath(run))
    folder = place if place.is_dir() else place.parent
    return folder / (f"certify-{point}.json" if point else "certify.json")


def begun_file(file: Path) -> Path:
    """Return where the certificate so far of a run lies that has not ended, beside the file of its certificate."""
    return file.with_name(f"{file.stem}.begun.json")


def save_certificate(certificate: MachineCertificate, file: str | os.PathLike[str]) -> Path:
    """Write a certificate; return its path."""
    return write_sealed(Path(file), certificate.to_dict(), JSON)


def load_certificate(run: str | os.PathLike[str]) -> MachineCertificate:
    """Read the certificate of a machine.

    Parameters
    ----------
    run : path
        A run folder or "RUN#7", with what `ninedof certify` has written there; or the file itself.

    Returns
    -------
    MachineCertificate

    Raises
    ------
    ValueError
        If there is none, or it is not whole; the message names the file.

    """
    file = path_argument("run", run)
    place = split(os.fspath(run))[0]
    if place.is_dir() or not file.name.startswith("certify"):  # a folder may have such a name too
        if not place.exists():
            raise ValueError(f"{os.fspath(run)}: cannot be read (No such file or directory)")
        file = certificate_file(run)
    try:
        data = decode(read_text(file, JSON))
    except OSError as error:
        raise ValueError(f"{file}: cannot be read ({error.strerror})") from None
    except ValueError as error:
        raise ValueError(f"{file}: not a JSON file: {error}") from None
    entries = unsealed(data, file, required=True) if isinstance(data, dict) else {}
    try:
        return MachineCertificate.from_dict(entries)
    except ValueError as error:
        raise ValueError(f"{file}: {error}") from None
