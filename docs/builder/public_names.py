"""The reference of the Python package: a page for each room, filled by autodoc from the docstrings."""

from __future__ import annotations

import inspect

import ninedof as nd

ROOMS = {
    "robot": "Robot and configuration",
    "kinematics": "Velocities, accelerations, assembly modes",
    "conditioning": "Condition number and other indices",
    "singularity": "Singularities",
    "statics": "Forces, stiffness, accuracy",
    "redundancy": "The best internal point",
    "motion": "Along a path",
    "design": "Studies and designs",
    "proof": "Proof",
    "optimize": "Optimization and trade-offs",
    "workspace": "Workspace",
    "sheet": "The engineering sheet",
    "sweep": "Sweeps",
    "paper": "The paper",
    "records": "Files and run folders",
    "export": "Exports",
    "report": "The report",
    "viewer": "The viewer",
    "poses": "Sets of poses: ninedof.poses",
    "plot": "Figures: ninedof.plot",
}


def by_room() -> dict[str, list[str]]:
    """Return the directives of autodoc for each room: rooms in the order of `ROOMS`, those without a title last."""
    rooms: dict[str, list[str]] = {name: [] for name in ROOMS}
    for name in sorted(nd.__all__, key=str.lower):
        thing = getattr(nd, name)
        room = f"{thing.__module__}.robot".split(".")[1]  # a class of the core is in `ninedof` itself
        kind = "class" if inspect.isclass(thing) else "function"
        rooms.setdefault(room, []).append(f".. auto{kind}:: ninedof.{name}")
    for name in ("poses", "plot"):
        module = getattr(nd, name)
        elsewhere = ", ".join(n for n in module.__all__ if getattr(module, n) is getattr(nd, n, None))
        rooms[name].append(f".. automodule:: ninedof.{name}\n   :exclude-members: {elsewhere}")
    return rooms


def pages() -> dict[str, str]:
    """Return the Markdown of each page; the first digits of its name put it in its place."""
    return {
        f"{k:02}-{name}": "\n\n".join([f"# {ROOMS.get(name, name)}", "```{eval-rst}", *directives, "```\n"])
        for k, (name, directives) in enumerate(by_room().items(), 1)
    }
