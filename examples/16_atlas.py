"""An atlas of the hexagonal family: how conditioned designs are, and the best for each size of the base.

    python 16_atlas.py [NUMBER OF DESIGNS] [--figure FILE]

A million designs by default; a hundred million take seconds, and no more memory.
"""

import sys

import numpy as np

import ninedof as nd

count = int(sys.argv[1]) if len(sys.argv) > 1 and sys.argv[1].isdigit() else 1_000_000
found = nd.atlas(count)

counts = found["histogram"].sum(axis=0)
print(f"{count:,} designs; condition number")
for limit in (10, 100, 1000):
    below = counts[: np.searchsorted(found["condition_number"], limit * (1 + 1e-12)) - 1].sum()
    print(f"  below {limit:5}: {100 * below / count:8.4f} %")

print("best of all designs with a base of at most so many platforms:")
for ratio in (0.5, 1.0, 2.0, 4.0):
    k = int(np.nanargmin(found["best"][: np.searchsorted(found["radius_ratio"], ratio)]))
    sides = "  ".join(f"{name} {v:.3f}" for name, v in zip(found["variable"], found["design"][k], strict=True))
    print(f"  {ratio:4} {found['best'][k]:9.4f}   {sides}")
proved = nd.optimize(nd.Study.paper()).condition_number
print(f"  the optimizer, at 2: {proved:.6f}, which none of them beats")

if "--figure" in sys.argv:
    from ninedof import plot

    plot.atlas(found, (2.0, proved)).savefig(sys.argv[sys.argv.index("--figure") + 1])
