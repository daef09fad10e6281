"""Who may include or import whom.

The code is a stack of layers. A file uses files of its own layer or of lower ones, and no two files need each other.
The tables below are the rule; a new file gets its place there before it gets its first user. The checkers take a
mapping from path to text, so that test_layering.py can plant violations and see them caught.
"""

import ast
import re
from collections.abc import Iterable, Iterator, Mapping
from pathlib import PurePosixPath

# --- The rules: C++ ---------------------------------------------------------------------------------------------------

# Stems, lowest layer first. A private header of cpp/src that is not listed belongs to PRIVATE_LAYER.
CPP_LAYERS = (
    {"types", "error", "rotation", "dual", "parallel", "splitmix", "rows_of", "circle_roots", "householder"}
    | {"enclosure", "enclosed_motion", "first_root", "cramer", "eliminate", "negligible", "leg_pairs"},
    {"geometry", "configuration", "svd6", "pose", "leg_length_checks", "rotation_problem", "quaternion_monomials"},
    {"legs", "points", "blueprint", "trilateration", "assembly_modes"},
    {"polish_rotation", "elimination", "null_space_rotations", "two_leg_rotations", "internal_point", "closure"}
    | {"jacobian_blocks"},
    {"velocity", "acceleration", "null_space", "branch", "rate_matrix", "three_blocks"},
    {"conditioning", "sensitivity", "characteristic_length", "symmetric", "hexapod", "statics", "ellipsoid"}
    | {"singularity", "singularity_distance"},
    {"forward_position", "tracking", "accuracy", "error_sample"},
    {"design", "axis_family", "hexagonal_family", "symmetric_family", "general_family", "constraints", "objective"},
    {"optimize", "pareto", "redundancy", "redundancy_path", "redundancy_map"},
    {"batch"},
    {"workspace", "chart", "placement", "pairs", "cones", "limits", "sequence", "near_points", "checks", "rotations"}
    | {"pose_margins", "cell_lattice", "tetrahedra", "octree", "pieces", "surface", "summary", "inscribed", "solid_box"}
    | {"sampling", "best_points", "audit", "point_store"},
)
PRIVATE_LAYER = 8

# The closed form and the general path are each other's oracle: these may not meet, not even through a third file.
CPP_INDEPENDENT = {"symmetric": {"velocity", "legs", "conditioning"}}

# A library behind one source file, and what must not appear in cpp/include or cpp/src at all.
ONLY_IN = {"nlopt": "slsqp"}
NOWHERE = {"pybind11", "Python.h", "iostream"}

# --- The rules: Python ------------------------------------------------------------------------------------------------

# Modules of the package, lowest layer first; a folder stands for all files in it. `__init__` holds the public names.
PYTHON_LAYERS = (
    {"arrays", "checks", "extras"},
    {"chunks"},
    {"geometry", "configuration"},
    {"lengths"},
    {"redundancy_arguments"},
    {"conditioning", "kinematics", "velocity", "acceleration", "forward_position", "tracking", "redundancy"}
    | {"redundancy_map", "singularity", "statics", "accuracy", "ellipsoid"},
    {"angles", "bounds"},
    {"pose", "poses", "objective", "limits", "point"},
    {"study", "study_file"},
    {"check", "words"},  # look at a result that is handed to them; Result.check and Result.summary call them
    {"result", "warm", "optimize", "paper", "sweep", "atlas", "pareto", "workspace"},
    {"__init__"},
    {"records", "front_records", "workspace_records"},
    {"designs"},
    {"plot"},
    {"job", "report", "viewer", "export", "cluster"},
    {"commands"},
    {"cli"},
    {"__main__"},
)
CORE_USERS = {
    "__init__",
    "records",
    "geometry",
    "configuration",
    "lengths",
    "conditioning",
    "kinematics",
    "forward_position",
    "tracking",
    "redundancy",
    "redundancy_map",
    "velocity",
    "acceleration",
    "singularity",
    "statics",
    "accuracy",
    "ellipsoid",
    "limits",
    "study",
    "optimize",
    "sweep",
    "atlas",
    "workspace",
}

# Figures are drawn from records and never compute.
PYTHON_FORBIDDEN = {
    "plot": {"_core", "conditioning", "kinematics", "result", "optimize", "sweep", "atlas", "pareto"} | {"workspace"}
}

# `import ninedof` stays light: none of these at the top of a module that it loads.
HEAVY = {"matplotlib", "rich", "typer", "scipy", "xarray", "dask", "distributed"}


# --- The checkers -----------------------------------------------------------------------------------------------------


def layer_of(name: str, layers: Iterable[set[str]]) -> int | None:
    """Index of the layer that lists `name`, None where none does."""
    return next((index for index, names in enumerate(layers) if name in names), None)


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


def without_comments(text: str) -> str:
    return re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.DOTALL)


def included_headers(text: str) -> list[str]:
    """Our own headers that a C++ file includes: "ninedof/legs" for a public one, "slsqp" for a private one."""
    return re.findall(r'^\s*#\s*include\s*["<](ninedof/[\w/]+|(?!ninedof/)[\w/]+)\.hpp[">]', text, flags=re.MULTILINE)


def cpp_layer(path: PurePosixPath) -> int | None:
    listed = layer_of(path.stem, CPP_LAYERS)
    is_public = "include" in path.parts
    return listed if listed is not None or is_public else PRIVATE_LAYER


def cpp_violations(files: Mapping[str, str]) -> list[str]:
    """What is wrong with the includes of the C++ files, one sentence each; paths relative to cpp/."""
    out: list[str] = []
    headers: dict[str, set[str]] = {}
    for name, text in files.items():
        path = PurePosixPath(name)
        code = without_comments(text)
        own = cpp_layer(path)
        if own is None:
            out.append(f"{name}: no layer; list it in CPP_LAYERS")
            continue
        used = {f"include/{h}.hpp" if h.startswith("ninedof/") else f"src/{h}.hpp" for h in included_headers(code)}
        for other in sorted(used):
            if other not in files:
                out.append(f"{name}: includes {other}, which does not exist")
                continue
            layer = cpp_layer(PurePosixPath(other))
            if layer is not None and layer > own:
                out.append(f"{name} [{own}]: includes upward {other} [{layer}]")
            if "include" in path.parts and other.startswith("src/"):
                out.append(f"{name}: a public header includes the private {other}")
        if path.suffix == ".hpp":
            headers[name] = used
        for library, home in ONLY_IN.items():
            if re.search(library, code, flags=re.IGNORECASE) and name != f"src/{home}.cpp":
                out.append(f"{name}: mentions {library}, which stays behind src/{home}.cpp")
        out.extend(f"{name}: mentions {word}" for word in sorted(NOWHERE) if word in code)
    for stem, apart in CPP_INDEPENDENT.items():
        for name, text in files.items():
            if PurePosixPath(name).stem != stem:
                continue
            direct = {f"include/{h}.hpp" for h in included_headers(without_comments(text))}
            everything = direct.union(*(reachable(header, headers) for header in direct))
            met = apart & {PurePosixPath(header).stem for header in everything}
            out.extend(f"{name}: not independent of {other}" for other in sorted(met))
    out.extend(cycles(headers))
    return out


def imports(tree: ast.Module, package: str, *, top_only: bool) -> set[str]:
    """Dotted names that a module imports; those meant for the type checker alone are left out.

    `package` is the dotted package of the module, for relative imports. With `top_only`, only what runs on import.
    """
    out: set[str] = set()

    def visit(node: ast.AST) -> None:
        if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test):
            return
        if top_only and isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
            return
        if isinstance(node, ast.Import):
            out.update(alias.name for alias in node.names)
        if isinstance(node, ast.ImportFrom):
            parents = package.split(".")[: len(package.split(".")) - node.level + 1] if node.level else []
            base = ".".join([*parents, *([node.module] if node.module else [])])
            out.update(f"{base}.{alias.name}" for alias in node.names)
        for child in ast.iter_child_nodes(node):
            visit(child)

    visit(tree)
    return out


def own_modules(names: Iterable[str], known: set[str]) -> set[str]:
    """The modules of the package behind dotted names: "ninedof.plot.style" is plot, "ninedof.jacobian" is __init__."""
    out: set[str] = set()
    for name in names:
        first, *rest = name.split(".")
        if first == "ninedof":
            out.add(rest[0] if rest and rest[0] in known else "__init__")
    return out


def python_violations(files: Mapping[str, str]) -> list[str]:
    """What is wrong with the imports of the Python files, one sentence each; paths relative to python/ninedof/."""
    out: list[str] = []
    module_of = {name: PurePosixPath(name).with_suffix("").parts[0] for name in files}
    known = {"_core"}.union(module_of.values(), *PYTHON_LAYERS)
    every: dict[str, set[str]] = {module: set() for module in module_of.values()}
    on_import: dict[str, set[str]] = {module: set() for module in module_of.values()}
    heavy: dict[str, set[str]] = {module: set() for module in module_of.values()}
    for name, text in files.items():
        module = module_of[name]
        own = layer_of(module, PYTHON_LAYERS)
        if own is None:
            out.append(f"{name}: no layer; list it in PYTHON_LAYERS")
            continue
        package = ".".join(["ninedof", *PurePosixPath(name).parent.parts])
        tree = ast.parse(text)
        used = own_modules(imports(tree, package, top_only=False), known) - {module}
        top = imports(tree, package, top_only=True)
        every[module] |= used
        on_import[module] |= own_modules(top, known) - {module}
        heavy[module] |= {other.split(".")[0] for other in top} & HEAVY
        if "_core" in used and module not in CORE_USERS:
            out.append(f"{name}: imports _core; only {', '.join(sorted(CORE_USERS))} may")
        for other in sorted(used - {"_core"}):
            layer = layer_of(other, PYTHON_LAYERS)
            if layer is not None and layer > own:
                out.append(f"{name} [{own}]: imports upward {other} [{layer}]")
        out.extend(f"{name}: must not use {x}" for x in sorted(PYTHON_FORBIDDEN.get(module, set()) & used))
    for module in sorted(reachable("__init__", on_import) | {"__init__"}):
        out.extend(f"{module}: loads {x} on `import ninedof`" for x in sorted(heavy.get(module, ())))
    out.extend(cycles(every))
    return out
