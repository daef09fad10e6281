"""Which robots have the nine leg lengths of the published design? All 32 modes, and the one a controller follows.

With --figure FILE, three of them are drawn.
"""

import sys

import numpy as np

import ninedof as nd

geometry = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
home = nd.Configuration.neutral(zp=3.9828, zs=2.4435)
lengths = nd.leg_lengths(geometry, home)

modes = nd.forward_position(geometry, lengths)
print(f"{modes.count} configurations have the legs of the neutral pose ({modes.status}); half hang under the base")

upright = modes[modes.internal_point[:, 2] > 0]
tilt = np.degrees(np.arccos(np.clip(upright.rotation[:, 2, 2], -1.0, 1.0)))
o = (upright.rotation.mT @ (upright.internal_point - upright.position)[..., None])[..., 0]  # O seen from the platform
rows = np.column_stack([upright.position[:, 2], tilt, np.sign(o[:, 2]), nd.condition_number(geometry, upright)])
kinds, where, counts = np.unique(rows.round(4), axis=0, return_index=True, return_counts=True)
print("modes      zp    tilt   O seen from the platform   condition number")
for k in np.argsort(-kinds[:, 0]):
    zp, degrees, side, kappa = kinds[k]
    print(f"{counts[k]:5}{zp:8.4f}{degrees:8.1f}   {'above' if side > 0 else 'below':24}{kappa:19.2f}")

# A controller knows where the robot was: a circle of the platform, a turn of it, and O going its own way.
t = np.linspace(0.0, 2.0 * np.pi, 200)
path = home.moved(
    np.stack([0 * t, 0 * t, 0.3 * np.sin(t), np.sin(t), np.cos(t) - 1, 0 * t, 0 * t, 0 * t, 0.4 * np.sin(t)], axis=-1)
)
now = nd.track(geometry, nd.leg_lengths(geometry, path), home)
print(f"tracked {np.sum(now.status == 'tracked')} of {t.size} steps, certificate at most {now.certificate.max():.3f},")
print(f"largest error of the platform {np.abs(now.position - path.position).max():.1e}")

if "--figure" in sys.argv:
    from ninedof import plot

    picks = [where[k] for k in np.argsort(-kinds[:, 0])[:3]]
    panels = [
        plot.Robot(f"zp {upright.position[k, 2]:.3f}, tilt {tilt[k]:.0f}°", geometry, upright[k], rows[k, 3])
        for k in picks
    ]
    plot.mechanisms(panels).savefig(sys.argv[sys.argv.index("--figure") + 1])
