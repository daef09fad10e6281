"""Proofs beside the record of a run: certify.json, certify-7.json of point 7, admissible-a2-b1.npz."""

from __future__ import annotations

import os
from pathlib import Path

from ninedof.design.study import Study
from ninedof.proof.admissible_set import PIECES, AdmissibleSet
from ninedof.proof.design_range import DesignRange
from ninedof.proof.machine_record import FORMAT, MachineCertificate
from ninedof.records.load import split
from ninedof.support.arguments import path_argument
from ninedof.support.files import (
    Arrays,
    from_json_array,
    json_array,
    json_bytes,
    read_json,
    read_npz,
    write_npz,
    write_whole,
)
from ninedof.support.store import folder_of
from ninedof.support.structs import Fixed, entries_of

ASKED = ("vary", "ranges", "condition_number", "moved")
NUMBERS = ("designs", "boxes", "seconds", "interrupted")


def certificate_file(run: str | os.PathLike[str]) -> Path:
    """Return where the certificate of a run, or of one of its points, lies."""
    place, point = split(os.fspath(run))
    return folder_of(place) / (f"certify-{point}.json" if point else "certify.json")


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


def admissible_file(folder: Path, of: DesignRange) -> Path:
    """Return where the designs of a question lie."""
    return folder / f"admissible-{'-'.join(of.vary)}.npz"


def save_admissible(found: AdmissibleSet, file: Path) -> Path:
    """Write a set; return its path."""
    others = {"question": found.of.digest, "demands": found.demands, "shares": dict(found.shares)}
    others |= {name: getattr(found, name) for name in NUMBERS}
    others["asked"] = {name: getattr(found.of, name) for name in ASKED} | {"at": dict(found.of.at)}
    return write_npz(file, {name: getattr(found, name) for name in PIECES} | {"others": json_array(others)})


def load_admissible(file: Path, of: DesignRange) -> AdmissibleSet | None:
    """Read the set of a question; None if there is none, or that of another question."""
    if not file.exists():
        return None
    return _read(read_npz(file), of)


def latest_admissible(run: str | os.PathLike[str], study: Study) -> AdmissibleSet | None:
    """Read the set of a study, of two variables or more, that was written last into a run; None without one."""
    folder = folder_of(split(os.fspath(run))[0])
    for file in sorted(folder.glob("admissible-*.npz"), key=lambda one: one.stat().st_mtime, reverse=True):
        arrays = read_npz(file)
        asked = from_json_array(arrays["others"]).get("asked")
        if asked is None or len(asked["vary"]) < 2:  # none in files of earlier versions
            continue
        entries = entries_of(DesignRange, asked, skipped=["study"])
        of = DesignRange(study, **entries | {"at": Fixed(entries["at"])})
        if (found := _read(arrays, of)) is not None:
            return found
    return None


def _read(arrays: Arrays, of: DesignRange) -> AdmissibleSet | None:
    others = from_json_array(arrays["others"])
    if others["question"] != of.digest:
        return None
    entries = entries_of(AdmissibleSet, others, skipped=("of", *PIECES))
    entries |= {name: arrays[name] for name in PIECES} | {"shares": Fixed(entries["shares"])}
    return AdmissibleSet(of, **entries)
