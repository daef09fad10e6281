"""Independent check of a result: recomputes every number and tests the claim of an optimum.

`verdict` has the public function `check`. `rules` has every constraint from its definition, without the core. No result
of the library is computed by this package.
"""

from ninedof.verify.verdict import Check, Finding, check

__all__ = ["Check", "Finding", "check"]
