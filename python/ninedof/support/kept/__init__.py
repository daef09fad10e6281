"""Kept things: files that are whole and checked, the folder of a run with its question, long work in chunks."""
