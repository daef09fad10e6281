"""Digests of plain values: a file that holds its own is known to be as it was written."""

from __future__ import annotations

import errno
import os
from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path
from typing import Any

from ninedof.support.files import write_whole
from ninedof.support.json import encode

DIGEST = "digest"  # the entry of a file


def digest_of(value: Any, salt: str = "") -> str:
    """Return the digest of plain values, and of a text before them; the order of entries does not count."""
    return sha256((salt + encode(value, sort_keys=True)).encode()).hexdigest()


def sealed(data: Mapping[str, Any]) -> dict[str, Any]:
    """Return the entries of a file with the digest of all of them."""
    return {**data, DIGEST: digest_of(data)}


def write_sealed(path: Path, data: Mapping[str, Any], most: int) -> Path:
    """Write the entries of a file with their digest, whole or not at all; return its path.

    Raises
    ------
    OSError
        If it cannot be written, or would have more bytes than are read again.

    """
    text = encode(sealed(data)) + "\n"
    if len(text) > most:
        raise OSError(errno.EFBIG, f"{len(text)} bytes, expected at most {most}", os.fspath(path))
    return write_whole(path, text.encode())


def unsealed(data: Mapping[str, Any], name: object, required: bool = False) -> dict[str, Any]:
    """Return the entries of a file without their digest.

    Raises
    ------
    ValueError
        If they are not those that were sealed; without a digest only where one is required.

    """
    entries = {key: value for key, value in data.items() if key != DIGEST}
    if (DIGEST in data or required) and data.get(DIGEST) != digest_of(entries):
        raise ValueError(f"{name}: got a file that was changed or damaged since it was written, expected it as it was")
    return entries
