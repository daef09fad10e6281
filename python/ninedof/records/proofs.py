"""Proofs beside the record of a run: certify.json, certify-7.json of point 7, admissible-a2-b1.npz."""

from __future__ import annotations

import os
from contextlib import suppress
from itertools import chain, count
from pathlib import Path

from ninedof.design.study import Study
from ninedof.proof.admissible.result import AdmissibleSet
from ninedof.proof.design_range import DesignRange
from ninedof.proof.machine_record import MachineCertificate
from ninedof.records.load import split
from ninedof.support.arguments import path_argument
from ninedof.support.kept.files import json_bytes, read_json, write_whole
from ninedof.support.kept.store import folder_of


def certificate_file(run: str | os.PathLike[str]) -> Path:
    """Return where the certificate of a run, or of one of its points, lies."""
    place, point = split(os.fspath(run))
    return folder_of(place) / (f"certify-{point}.json" if point else "certify.json")


def earlier_file(file: Path) -> Path:
    """Return where a proof is kept that another one of the same name follows: a name that is free."""
    names = (f"{file.stem}-earlier{k}{file.suffix}" for k in chain([""], (f"-{n}" for n in count(2))))
    return next(path for path in map(file.with_name, names) if not path.exists())


def kept_certificates(file: Path) -> dict[Path, MachineCertificate]:
    """Return the certificates for other tolerances that are kept beside one; without those that cannot be read."""
    out = {}
    for path in sorted(file.parent.glob(f"{file.stem}-earlier*{file.suffix}")):
        with suppress(ValueError):
            out[path] = load_certificate(path)
    return out


def save_certificate(certificate: MachineCertificate, file: str | os.PathLike[str]) -> Path:
    """Write a certificate; return its path."""
    return write_whole(Path(file), json_bytes("certificate", certificate.to_dict()))


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
    return MachineCertificate.from_dict(read_json(file, "certificate"))


def admissible_file(folder: Path, of: DesignRange) -> Path:
    """Return where the designs of a question lie."""
    return folder / f"admissible-{'-'.join(of.vary)}.npz"


def load_admissible(file: Path, of: DesignRange) -> AdmissibleSet | None:
    """Read the set of a question; None if there is none, or that of another question."""
    designs = AdmissibleSet.load(file) if file.exists() else None
    return designs if designs is not None and designs.of.digest == of.digest else None


def latest_admissible(run: str | os.PathLike[str], study: Study) -> AdmissibleSet | None:
    """Read the set of a study, of two variables or more, that was written last into a run; None without one."""
    folder = folder_of(split(os.fspath(run))[0])
    files = sorted(folder.glob("admissible-*.npz"), key=lambda one: one.stat().st_mtime, reverse=True)
    sets = (AdmissibleSet.load(file) for file in files)
    return next((one for one in sets if len(one.vary) > 1 and one.study.to_dict() == study.to_dict()), None)
