"""Long work in chunks: each computed alone, anywhere, kept in a folder as soon as it is finished, and never twice.

`work` says what a chunk is, `store` keeps finished ones in a folder, `run` computes the missing ones.
"""

from ninedof.chunks.run import run
from ninedof.chunks.store import Store
from ninedof.chunks.work import Work, chunk_argument
from ninedof.support.files import Arrays

__all__ = ["Arrays", "Store", "Work", "chunk_argument", "run"]
