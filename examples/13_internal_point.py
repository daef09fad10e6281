"""What nine legs for six coordinates buy: the internal point put where it serves, along a path of the platform."""

import numpy as np

import ninedof as nd

geometry = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
t = np.linspace(0.0, 2.0 * np.pi, 61)
position = np.stack([1.2 * np.sin(t), 0.8 * np.cos(t), 4.0 + 0.05 * t], axis=-1)

middle = nd.Configuration(position, internal_point=0.5 * position)
best = nd.best_internal_point(geometry, position)
smooth = nd.best_internal_path(geometry, position, smoothness=0.05)

rank = np.linalg.matrix_rank(nd.null_motion(geometry, middle))
print(f"motions of O that the platform does not notice: {rank.min()}")
print(f"{'O':24}{'condition number: mean':>24}{'worst':>8}{'longest step of O':>20}")
for name, c in (
    ("half way up", middle),
    ("best at each pose", best.configuration),
    ("best, smooth", smooth.configuration),
):
    kappa = nd.condition_number(geometry, c)
    step = np.linalg.norm(np.diff(c.internal_point, axis=0), axis=1).max()
    print(f"{name:24}{kappa.mean():24.4f}{kappa.max():8.4f}{step:20.4f}")
