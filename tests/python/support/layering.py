"""The rules of layering: rooms in order, and who may use what. layering_cpp and layering_python hold the checkers.

A room is a folder and a layer: a file uses files of its own room and of rooms before it, and no two files need each
other. The same names serve headers, sources, bindings, Python modules, tests and benchmarks. A room may hold rooms.
The checkers take a mapping from path to text, so that test_layering.py can plant violations and see them caught.
"""

from collections.abc import Iterator, Mapping

# --- C++ --------------------------------------------------------------------------------------------------------------

CPP_ROOMS = (
    "math",
    "robot",
    "kinematics",
    "conditioning",
    "families",
    "position",
    "singularity",
    "statics",
    "dynamics",
    "batch",
    "limits",
    "domains",
    "sheet",
    "redundancy",
    "motion",
    "problem",
    "proof",
    "optimize",
    "workspace",
)
SUPPORT = "support"  # what bindings, tests or benchmarks share among themselves
CPP_OUTSIDE = {"cpp/bindings/module.cpp"}  # lists the rooms

# The closed form and the general path are each other's oracle, and so are a proof and its checker: files of these
# names, and in folders of these names, may not meet those, not even through a third file.
CPP_INDEPENDENT = {
    "symmetric": {"velocity", "legs", "conditioning"},
    "checker": {"interval", "dual", "symmetric", "axis_pieces", "axis_rows", "combination", "box_bound", "axis_domain"},
}

# A library behind one source file, and what must not appear in cpp/include or cpp/src at all.
ONLY_IN = {"nlopt": "cpp/src/math/slsqp.cpp"}
NOWHERE = {"pybind11", "Python.h", "iostream"}

# --- Python -----------------------------------------------------------------------------------------------------------

# As in C++ where both have the room, but for conditioning, which comes before kinematics: `jacobian` takes the kind of
# a characteristic length. kinematics stands for the core's position too. `__init__` holds the public names; what
# follows it is not loaded by `import ninedof`.
PYTHON_ROOMS = (
    "support",
    "tables",
    "robot",
    "conditioning",
    "kinematics",
    "singularity",
    "statics",
    "redundancy",
    "motion",
    "design",
    "sheet",
    "proof",
    "optimize",
    "workspace",
    "sweep",
    "plot",
    "paper",
    "export",
    "records",
    "report",
    "viewer",
    "__init__",
    "cli",
    "__main__",
)
CORE_USERS = {
    "support",
    "robot",
    "conditioning",
    "kinematics",
    "singularity",
    "statics",
    "redundancy",
    "motion",
    "design",
    "sheet",
} | {
    "proof",
    "optimize",
    "workspace",
    "sweep",
    "__init__",
    "records",
}

# Figures are drawn from what is handed to them and never compute. Imports for the type checker alone are free.
AT_RUN_TIME = {"plot": {"support", "robot"}}

# `import ninedof` stays light: none of these at the top of a module that it loads.
HEAVY = {"matplotlib", "rich", "typer", "scipy", "xarray", "dask", "distributed", "viser"}

# Tests lie in the rooms of the package; those of documents, examples and of the whole in a room of their own,
# and so do those that attack every entry point.
TEST_ROOMS = {*PYTHON_ROOMS, "project", "entry"}


def reachable(start: str, graph: Mapping[str, set[str]]) -> set[str]:
    """All nodes that paths from `start` lead to; `start` itself only where it is on a cycle."""
    found: set[str] = set()
    ahead = list(graph.get(start, ()))
    while ahead:
        node = ahead.pop()
        if node not in found:
            found.add(node)
            ahead.extend(graph.get(node, ()))
    return found


def cycles(graph: Mapping[str, set[str]]) -> Iterator[str]:
    for node in sorted(graph):
        if node in reachable(node, graph):
            yield f"circular: {node} needs itself through others"
