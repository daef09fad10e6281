"""Where the published robot can work with legs of 2.5 to 6.5, and what a better place for O is worth.

With --figure FILE the workspace is drawn in three sections.
"""

import sys

import numpy as np

import ninedof as nd

geometry = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
home = nd.Configuration.neutral(zp=4.8, zs=2.4)
box = ([-2.5, -2.5, 3.0], [2.5, 2.5, 7.0])
criteria = {
    "leg_limits": (2.5, 6.5),
    "condition_number": 5.0,
    "leg_clearance": 0.1,
    "singularity_free": True,
}

found = nd.workspace(geometry, box, criteria=criteria, home=home)
print(f"{found.status}: volume {found.volume:.3f}, error {found.error:.4f}, unseen at most {found.unseen:.4f}")
print(f"looked at {found.evaluations} poses in {found.levels.shape[0]} levels; runs to the box: {found.box_limits}")
print(f"ball of radius {found.ball_radius:.3f} about {np.round(found.ball_centre, 2) + 0.0}")
print(f"box of sides {np.round(found.box_high - found.box_low, 2)}")
kappa = found.worst_condition_number
print(f"global conditioning index {found.conditioning_index:.4f}, worst condition number {kappa:.3f}")
print("boundary: " + ", ".join(f"{name} {100 * share:.1f} %" for name, share in found.limits(grouped=True).items()))

print(f"{'O':34}{'volume':>8}{'index':>8}")
rules = {
    "half way between the plates": 0.5,
    "six tenths of the way": 0.6,
    "fixed in the base": [0.0, 0.0, 2.4],
    "carried as a point of the platform": {"platform": [0.0, 0.0, -2.4]},
}
for name, rule in rules.items():
    w = nd.workspace(geometry, box, criteria=criteria, home=home, internal_point=rule)
    print(f"{name:34}{w.volume:8.3f}{w.conditioning_index:8.4f}")

turning = nd.workspace(
    geometry, archetype="orientation", position=home.position, region={"angle": 1.2}, criteria=criteria, home=home
)
share = turning.volume / (8.0 * np.pi**2)
print(f"orientations at home: {100 * share:.2f} % of SO(3), any turn by {turning.ball_radius:.3f}")

if "--figure" in sys.argv:
    from ninedof import plot

    sections = []
    for name, at, drawn in (("y", 0.0, [0, 2]), ("x", 0.0, [1, 2]), ("z", 4.8, [0, 1])):
        off = at - found.ball_centre["xyz".index(name)]
        ball = (found.ball_centre[drawn], np.sqrt(found.ball_radius**2 - off**2))
        box_inside = (found.box_low[drawn], found.box_high[drawn])
        plane = found.slice(name, at, smooth=True)
        sections.append(plot.Section(plane, ball, box_inside, home=home.position[drawn]))
    figure = plot.workspace(found, sections)
    figure.savefig(sys.argv[sys.argv.index("--figure") + 1])
