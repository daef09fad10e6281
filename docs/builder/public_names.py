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
    "atlas": "Many designs at once",
    "paper": "The paper",
    "records": "Files and run folders",
    "export": "Exports",
    "report": "The report",
    "viewer": "The viewer",
}
MODULES = {"poses": "Sets of poses: ninedof.poses", "plot": "Figures: ninedof.plot"}


def room(name: str) -> str:
    """Return the room in which a public name is defined."""
    return (f"{getattr(nd, name).__module__}.robot").split(".")[1]  # a class of the core is in `ninedof` itself


def by_room() -> dict[str, list[str]]:
    """Return the public names of each room: rooms in the order of `ROOMS`, those without a title last."""
    found: dict[str, list[str]] = {name: [] for name in ROOMS}
    for name in nd.__all__:
        found.setdefault(room(name), []).append(name)
    return {name: sorted(names, key=str.lower) for name, names in found.items() if names}


def pages() -> dict[str, str]:
    """Return the Markdown of each page; the first digits of its name put it in its place."""
    rooms = {
        name: entry(ROOMS.get(name, name.capitalize()), [directive(public) for public in names])
        for name, names in by_room().items()
    }
    modules = {name: entry(title, [module_directive(name)]) for name, title in MODULES.items()}
    return {f"{k:02}-{name}": text for k, (name, text) in enumerate((rooms | modules).items(), 1)}


def directive(name: str) -> str:
    """Return what asks autodoc for a public name."""
    if not inspect.isclass(getattr(nd, name)):
        return f".. autofunction:: ninedof.{name}\n"
    return f".. autoclass:: ninedof.{name}\n   :members:\n   :undoc-members:\n"


def module_directive(name: str) -> str:
    """Return what asks autodoc for a module, without what is a public name of the package itself."""
    module = getattr(nd, name)
    elsewhere = [n for n in module.__all__ if getattr(module, n) is getattr(nd, n, None)]
    lines = [f".. automodule:: ninedof.{name}", "   :members:"]
    return "\n".join(lines + [f"   :exclude-members: {', '.join(elsewhere)}"] * bool(elsewhere)) + "\n"


def entry(title: str, directives: list[str]) -> str:
    """Return a page: its title, and directives in the language of autodoc."""
    return "\n".join([f"# {title}\n", "```{eval-rst}", *directives, "```", ""])
