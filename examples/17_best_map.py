"""What a free internal point is worth all over a plane: the best condition number beside that of an O that is fixed.

`--figure FILE` draws both maps.
"""

import sys

import numpy as np

import ninedof as nd

geometry = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
home = nd.Configuration.neutral(zp=3.9828, zs=2.4432)
x = np.linspace(-2.0, 2.0, 121)
plane = np.stack([*np.meshgrid(x, x, indexing="ij"), np.full((x.size, x.size), 3.9828)], axis=-1)

best = nd.best_internal_map(geometry, plane)
fixed = nd.condition_number(geometry, nd.Configuration(plane, internal_point=home.internal_point))

print(f"{plane[..., 0].size} poses, {best.searched} of them searched, the others reached from their neighbours")
print(f"the audit found {best.audit.missed} of {best.audit.poses} poses with a better point elsewhere")
print("O            condition number: mean    worst")
for name, kappa in (("fixed", fixed), ("best", best.value)):
    print(f"{name:12}{kappa.mean():23.4f}{kappa.max():9.2f}")

if "--figure" in sys.argv:
    from ninedof.plot import style

    with style.settings():
        figure = style.new_figure(8.6, 3.7)
        figure.set_layout_engine("constrained")
        levels = np.geomspace(3.9, 16.0, 60)
        axes = figure.subplots(1, 2, sharey=True)
        for ax, kappa, title in zip(axes, (fixed, best.value), ("O fixed", "O best at each pose"), strict=True):
            filled = ax.contourf(x, x, kappa.T, levels, cmap="viridis_r", norm="log", extend="max")
            lines = ax.contour(x, x, kappa.T, (4.0, 4.3, 5.0, 6.0, 8.0, 12.0), colors="black", linewidths=0.6)
            ax.clabel(lines, fmt="%g")
            ax.set(title=title, xlabel="x of the platform", aspect="equal")
        axes[0].set_ylabel("y of the platform")
        bar = figure.colorbar(filled, ax=axes, ticks=(4, 5, 6, 8, 10, 12, 16), format="%g")
        bar.set_label("condition number")
        figure.savefig(sys.argv[sys.argv.index("--figure") + 1])
