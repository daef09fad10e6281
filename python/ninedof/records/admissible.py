"""Sets of admissible designs beside a run: admissible-a2-b1.npz."""

from __future__ import annotations

from pathlib import Path

from ninedof.proof.admissible_set import STATES, AdmissibleSet
from ninedof.proof.design_range import DesignRange
from ninedof.support.files import from_json_array, json_array, read_npz, write_npz
from ninedof.support.structs import Fixed

ARRAYS = ("low", "high", "state", "demand", "poses")
NUMBERS = ("designs", "boxes", "seconds", "interrupted")


def admissible_file(folder: Path, of: DesignRange) -> Path:
    """Return where the designs of a question lie."""
    return folder / f"admissible-{'-'.join(of.vary)}.npz"


def save_admissible(found: AdmissibleSet, file: Path) -> Path:
    """Write a set; return its path."""
    others = {"question": found.of.digest, "demands": found.demands, "shares": dict(found.shares)}
    others |= {name: getattr(found, name) for name in NUMBERS}
    return write_npz(file, {name: getattr(found, name) for name in ARRAYS} | {"others": json_array(others)})


def load_admissible(file: Path, of: DesignRange) -> AdmissibleSet | None:
    """Read the set of a question; None if there is none, or that of another question."""
    if not file.exists():
        return None
    arrays = read_npz(file)
    others = from_json_array(arrays["others"])
    if others["question"] != of.digest:
        return None
    return AdmissibleSet(
        of,
        arrays["low"],
        arrays["high"],
        arrays["state"],
        arrays["demand"],
        tuple((limit, part) for limit, part in others["demands"]),
        arrays["poses"],
        Fixed({name: others["shares"][name] for name in STATES}),
        *(others[name] for name in NUMBERS),
    )
