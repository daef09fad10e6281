"""What a larger base buys: the least condition number for each size of the base, all else free."""

import numpy as np

import ninedof as nd

study = nd.Study(constraints={"radius_ratio": (None, 2.0)})
front = nd.pareto(study, against="footprint", values=[0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5])

print(f"{'base radius':>12}{'condition number':>18}")
for result in front:
    radius = np.linalg.norm(result.geometry.base_external[:, :2], axis=1).max()  # of a hexagon: that of all its joints
    print(f"{radius:12.3f}{result.condition_number:18.6f}")
