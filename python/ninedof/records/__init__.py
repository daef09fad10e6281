"""Everything that is kept: `record` writes and reads run folders, `load` returns what a path names.

Files and their digests are in `support.kept.files`, the pieces of a run that goes on in `support.kept.store`.
"""
