"""What is wrong with the places and imports of the Python files. The rules are in layering.py."""

import ast
import functools
from collections.abc import Collection, Iterable, Mapping
from pathlib import PurePosixPath

from layering import AT_RUN_TIME, CORE_USERS, HEAVY, PYTHON_ROOMS, TEST_ROOMS, cycles, reachable

CORE = "_core"


@functools.cache
def imports(text: str, package: str, *, run_time: bool = False, top_only: bool = False) -> frozenset[str]:
    """Dotted names that a module of this text imports, `package` being its own, for relative imports.

    With `run_time`, without those meant for the type checker alone; with `top_only`, only what runs on import.
    """
    out: set[str] = set()

    def visit(node: ast.AST) -> None:
        if run_time and isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test):
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

    visit(parsed(text))
    return frozenset(out)


@functools.cache
def parsed(text: str) -> ast.Module:
    return ast.parse(text)


def own_modules(names: Iterable[str], known: Collection[str]) -> set[str]:
    """The modules of the package behind dotted names: "ninedof.plot.style.INK" is plot/style, "ninedof.jacobian" is
    __init__, "ninedof.plot.save" plot/__init__."""
    out: set[str] = set()
    for name in names:
        first, *rest = name.split(".")
        if first != "ninedof":
            continue
        heads = ["/".join(rest[:k]) for k in range(len(rest), 0, -1)]
        found = (place for head in heads for place in (head, f"{head}/__init__") if place in known)
        out.add(next(found, "__init__"))
    return out


def room_of(module: str) -> str:
    return module.split("/")[0]


def with_packages(modules: Iterable[str]) -> set[str]:
    """The modules, and the packages that are loaded before them."""
    return {part for m in modules for part in (m, *(f"{p}/__init__" for p in PurePosixPath(m).parents if p.name))}


def python_violations(files: Mapping[str, str]) -> list[str]:
    """One sentence for each violation; paths relative to python/ninedof/."""
    out: list[str] = []
    known = {CORE, *(name.removesuffix(".py") for name in files)}
    every: dict[str, set[str]] = {}
    on_import: dict[str, set[str]] = {}
    heavy: dict[str, set[str]] = {}
    for name, text in files.items():
        module = name.removesuffix(".py")
        room = room_of(module)
        if room not in PYTHON_ROOMS:
            out.append(f"{name}: in no room; the rooms are {', '.join(PYTHON_ROOMS)}")
            continue
        package = ".".join(["ninedof", *PurePosixPath(name).parent.parts])
        used = own_modules(imports(text, package), known)
        top = imports(text, package, run_time=True, top_only=True)
        every[module] = used
        on_import[module] = with_packages(own_modules(top, known))
        heavy[module] = {other.split(".")[0] for other in top} & HEAVY
        if CORE in used and room not in CORE_USERS:
            out.append(f"{name}: imports {CORE}; only {', '.join(sorted(CORE_USERS))} may")
        for other in sorted(used - {CORE}):
            above = room_of(other)
            if above in PYTHON_ROOMS and PYTHON_ROOMS.index(above) > PYTHON_ROOMS.index(room):
                out.append(f"{name}: imports upward {other}")
        if room in AT_RUN_TIME:
            rooms = {room_of(other) for other in own_modules(imports(text, package, run_time=True), known)}
            out.extend(f"{name}: must not use {x}" for x in sorted(rooms - {room} - AT_RUN_TIME[room]))
    for module in sorted(reachable("__init__", on_import) | {"__init__"}):
        out.extend(f"{module}: loads {x} with public names" for x in sorted(heavy.get(module, ())))
    out.extend(cycles(every))
    return out


def misplaced_tests(names: Iterable[str]) -> list[str]:
    """Tests outside the rooms; paths relative to tests/python/."""
    return [f"{name}: in no room" for name in names if "/" not in name or name.split("/")[0] not in TEST_ROOMS]
