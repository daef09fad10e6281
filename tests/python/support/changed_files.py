"""Files of a run that a test changes, made to fit again: their digest would tell."""

import json

from ninedof.support.files import json_bytes


def entries_of(path):
    """Return what a file says, without its digest."""
    return {name: value for name, value in json.loads(path.read_text()).items() if name != "digest"}


def write_sealed(path, entries):
    """Write entries as ninedof does, with the digest of what they are now."""
    path.write_bytes(json_bytes("record", entries))  # what they say of their format counts
