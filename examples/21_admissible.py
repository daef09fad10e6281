"""All designs that fulfil a requirement, not one optimum: which they are, what excludes the others, and room for error.

`--figure FILE` draws them. Most of the designs are decided in a second; more time decides more.
"""

import sys
from pathlib import Path

import ninedof as nd

study = nd.Study.load(Path(__file__).with_name("18_requirement.toml"))
optimum = nd.optimize(study, starts=2)
designs = nd.admissible(optimum, {"a2": None, "b1": None}, time_limit=10.0, resolution=0.02)

print(f"proved: {designs.shares['inside']:.1%} of the designs keep every limit at every pose, ", end="")
print(f"{designs.shares['outside']:.1%} break one; {designs.shares['undecided']:.1%} are not decided")
print("excluded by " + ", ".join(f"{name} {share:.1%}" for name, share in designs.excluded.items()))

# The optimum lies on its limits. A design in the middle of the largest box proved can be built with errors.
box = max(designs.inside.tolist(), key=lambda box: (box[0][1] - box[0][0]) * (box[1][1] - box[1][0]))
robust = {name: 0.5 * (low + high) for name, (low, high) in zip(designs.vary, box, strict=True)}
room = designs.around(robust)
for name, (low, high) in room.items():
    print(f"{name} = {robust[name]:.1f} mm may be {low:.1f} to {high:.1f} mm, all at once")

if "--figure" in sys.argv:
    nd.plot.admissible(designs).savefig(sys.argv[sys.argv.index("--figure") + 1])
