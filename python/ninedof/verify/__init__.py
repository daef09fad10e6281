"""The check of a result: every number computed again in another way, and the claim of an optimum tested.

`verdict` is what a caller uses; each other file answers one question. Nothing of the product uses this package: it is a
second opinion. `rules` holds every constraint from its definition, independent of the core.
"""

from ninedof.verify.verdict import Check, Finding, check

__all__ = ["Check", "Finding", "check"]
