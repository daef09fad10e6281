"""Files of a run that a test changes, made to fit again: their digest would tell."""

from ninedof.support.kept.files import json_bytes
from ninedof.support.text import decode


def entries_of(path):
    """Return what a file says, without its digest: numbers that JSON has no form for are numbers."""
    return {name: value for name, value in decode(path.read_text()).items() if name != "digest"}


def write_sealed(path, entries):
    """Write entries as ninedof does, with the digest of what they are now."""
    path.write_bytes(json_bytes("record", entries))  # what they say of their format counts
