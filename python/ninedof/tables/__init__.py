"""Tables as data: what a result shows, once. The terminal, the page of a run, notebooks and plain text render it."""

from __future__ import annotations

from ninedof.tables.numbers import DEGREES, RIGHT, SHORT
from ninedof.tables.table import Column, Line, Table, columns, grouped

__all__ = ["DEGREES", "RIGHT", "SHORT", "Column", "Line", "Table", "columns", "grouped"]
