"""Long work in chunks: each computed alone, anywhere, kept as soon as it is finished, and never twice.

`work` says what a chunk is, `store` keeps finished ones in a folder, `crew` hands them to an executor, `run` is what a
caller calls; `npz` keeps what came of it all.
"""

from ninedof.chunks.run import chunk_argument, kept, run
from ninedof.chunks.store import Store
from ninedof.chunks.work import Arrays, Work

__all__ = ["Arrays", "Store", "Work", "chunk_argument", "kept", "run"]
