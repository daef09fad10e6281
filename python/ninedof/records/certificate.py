"""The certificate of a machine beside the record of its run: certify.json, or certify-7.json for point 7."""

from __future__ import annotations

import os
from pathlib import Path

from ninedof.proof.machine_record import FORMAT, MachineCertificate
from ninedof.records.load import split
from ninedof.support.arguments import path_argument
from ninedof.support.files import json_bytes, read_json, write_whole


def certificate_file(run: str | os.PathLike[str]) -> Path:
    """Return where the certificate of a run, or of one of its points, lies."""
    place, point = split(os.fspath(run))
    folder = place if place.is_dir() else place.parent
    return folder / (f"certify-{point}.json" if point else "certify.json")


def save_certificate(certificate: MachineCertificate, file: str | os.PathLike[str]) -> Path:
    """Write a certificate; return its path."""
    return write_whole(Path(file), json_bytes(certificate.to_dict()))


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
        If there is none, or it was changed; the message names the file.

    """
    file = path_argument("run", run)
    place = split(os.fspath(run))[0]
    if place.is_dir() or not file.name.startswith("certify"):  # a folder may have such a name too
        if not place.exists():
            raise ValueError(f"{os.fspath(run)}: cannot be read (No such file or directory)")
        file = certificate_file(run)
    return MachineCertificate.from_dict(read_json(file, FORMAT))
