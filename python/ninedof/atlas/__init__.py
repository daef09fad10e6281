"""Surveys of hundreds of millions of designs, which are counted and compared and not kept.

`sample` draws the designs, `tally` counts them, `run` has the public function.
"""

from ninedof.atlas.run import atlas

__all__ = ["atlas"]
