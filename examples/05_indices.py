"""The condition number of the published design over a small workspace, in one call."""

import numpy as np

import ninedof as nd

geometry = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
home = nd.Configuration.neutral(zp=3.9828, zs=2.4435)

# A stack of 21 x 21 x 11 configurations: the platform shifted in x and y and turned about z, O where it was.
x, y = np.meshgrid(np.linspace(-0.5, 0.5, 21), np.linspace(-0.5, 0.5, 21))
angle = np.radians(np.linspace(-15.0, 15.0, 11))
tangent = np.zeros((*x.shape, angle.size, 9))  # (omega, dp, ds)
tangent[..., 2] = angle
tangent[..., 3] = x[..., None]
tangent[..., 4] = y[..., None]

kappa = nd.condition_number(geometry, home.moved(tangent))
print(f"{kappa.size} poses: condition number {kappa.min():.4f} to {kappa.max():.4f}, median {np.median(kappa):.4f}")
print(f"global conditioning index (mean of the inverse): {np.mean(1.0 / kappa):.4f}")
