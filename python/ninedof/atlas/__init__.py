"""An atlas of designs: hundreds of millions of them, counted and compared as they pass by.

`sample` says which designs, `tally` what is kept of them, `run` holds what a caller calls.
"""

from ninedof.atlas.run import atlas

__all__ = ["atlas"]
