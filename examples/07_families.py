"""Triangles, hexagons or free joint triples: what more freedom in the plates is worth under the same limits."""

import math

import ninedof as nd

LIMITS = {"radius_ratio": (None, 2.0), "leg_ratio": (None, 3.0)}
SIDES = dict.fromkeys(("a1", "a2", "b1", "b2"), (0.0, 60.0)) | {"theta_z": (-math.pi, math.pi)}
TRIPLES = ("base_external", "base_internal", "platform_external", "platform_internal")

studies = {
    # External and internal legs share their joints, the prototype of Fig. 2.
    "triangles": nd.Study(family="hexagonal", variables=SIDES | {"a1": 0.0, "b2": 0.0}, constraints=LIMITS),
    "hexagons": nd.Study(family="hexagonal", variables=SIDES, constraints=LIMITS),
    # Every triple of joints with a radius and an angle of its own.
    "free triples": nd.Study(
        family="symmetric",
        variables={f"{t}_radius": (0.05, 12.0) for t in TRIPLES} | {"zp": (0.05, 20.0), "zs": (0.05, 20.0)},
        constraints=LIMITS,
    ),
}

# No planar design with legs of at most 3 to 1 can do better, whatever its radii (proved).
slope = 2.0 * math.sqrt(2.0) / 3.0
bound = slope + math.sqrt(1.0 + slope**2)

print(f"{'plates':14}{'condition number':>18}  binding")
for name, study in studies.items():
    result = nd.optimize(study)
    print(f"{name:14}{result.condition_number:18.6f}  {', '.join(result.active)}")
print(f"{'proved bound':14}{bound:18.6f}")
