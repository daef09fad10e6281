"""The check of a result: everything computed once more another way, and the claim of an optimum put to the test.

`verdict` holds what a caller sees; the other files each hold one question.
"""

from ninedof.verify.verdict import Check, Finding, check

__all__ = ["Check", "Finding", "check"]
