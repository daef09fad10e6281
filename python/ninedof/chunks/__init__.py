"""Finished pieces of long work in a folder, each written whole or not at all, and never computed twice."""

from ninedof.chunks.store import Store

__all__ = ["Store"]
