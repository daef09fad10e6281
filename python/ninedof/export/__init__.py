"""Designs as files of other programs: simulators, CAD, documents; and designs read from such files."""
