"""A moving picture: the platform goes round with tilts, and O is where the condition number along the path is best.

python examples/19_moving_picture.py moving.gif

Without a file it prints what the picture shows.
"""

import sys

import numpy as np

import ninedof as nd
from ninedof.motion.rotations import from_vectors

FRAMES = 40

g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
turn = np.linspace(0.0, 2.0 * np.pi, FRAMES + 1)
position = np.stack([1.2 * np.cos(turn), 1.2 * np.sin(turn), 4.2 + 0.4 * np.sin(2.0 * turn)], axis=1)
rotation = from_vectors(np.radians(15.0) * np.stack([np.sin(turn), -np.cos(turn), np.sin(turn)], axis=1))

half = nd.Configuration(position, rotation, 0.5 * position)
best = nd.best_internal_path(g, position, rotation, smoothness=0.05).configuration
curves = {"O half way up": nd.condition_number(g, half), "O at its best": nd.condition_number(g, best)}
for name, kappa in curves.items():
    print(f"{name}: condition number {kappa.min():.3f} to {kappa.max():.3f}")


def write(file: str) -> None:
    from matplotlib.animation import FuncAnimation, PillowWriter
    from matplotlib.figure import Figure

    from ninedof import plot

    figure = Figure(figsize=(7.2, 3.6))
    space = figure.add_axes((0.0, 0.03, 0.56, 0.97), projection="3d")
    axes = figure.add_axes((0.65, 0.17, 0.32, 0.68))
    degrees = np.degrees(turn)
    for (name, kappa), color in zip(curves.items(), ("#9a9a9a", "#c2410c"), strict=True):
        axes.plot(degrees, kappa, color=color, lw=1.8, label=name)
    axes.set(xlabel="way round (deg)", ylabel="condition number", xlim=(0, 360), xticks=range(0, 361, 90))
    axes.legend(frameon=False, loc="lower center", bbox_to_anchor=(0.5, 0.98))
    (dot,) = axes.plot([], [], "o", color="#c2410c", ms=7)

    def draw(k: int) -> None:
        space.clear()
        robot = plot.Robot("", g, best[k])
        plot.mechanism(robot, ax=space, corners=([-3.7, -3.7, 0.0], [3.7, 3.7, 5.4]), legend=False)
        dot.set_data([degrees[k]], [curves["O at its best"][k]])

    FuncAnimation(figure, draw, frames=FRAMES).save(file, writer=PillowWriter(fps=14), dpi=100)


for name in sys.argv[1:]:
    if name.endswith(".gif"):
        write(name)
