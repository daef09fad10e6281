"""What is wrong with the places and includes of the C++ files. The rules are in layering.py."""

import functools
import re
from collections.abc import Collection, Iterator, Mapping
from pathlib import PurePosixPath

from layering import CPP_INDEPENDENT, CPP_OUTSIDE, CPP_ROOMS, NOWHERE, ONLY_IN, SUPPORT, cycles, reachable

PUBLIC, PRIVATE = "cpp/include/ninedof", "cpp/src"
BESIDE = ("cpp/bindings", "tests/cpp", "bench/cpp")  # trees that use the core and have a room `support`
TREES = (PUBLIC, PRIVATE, *BESIDE)


@functools.cache
def tree_of(name: str) -> str:
    return next(tree for tree in TREES if name.startswith(f"{tree}/"))


@functools.cache
def room_of(name: str) -> str | None:
    """The room that a file lies in, None outside all of them."""
    tree = tree_of(name)
    folder = PurePosixPath(name).relative_to(tree).parts[:-1]
    if folder and (folder[0] in CPP_ROOMS or (folder[0] == SUPPORT and tree in BESIDE)):
        return folder[0]
    return None


@functools.cache
def without_comments(text: str) -> str:
    return re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.DOTALL)


@functools.cache
def first_comment(text: str) -> str:
    """The comment that a file begins with, as one line."""
    block = re.match(r"\s*((?:\s*//[^\n]*\n?)+|/\*.*?\*/)", text, flags=re.DOTALL)
    return " ".join(re.sub(r"^\s*(///?|/?\*+/?)", "", block[1], flags=re.MULTILINE).split()) if block else ""


def found_at(header: str, user: str, files: Collection[str]) -> str | None:
    """The file behind "ninedof/robot/legs.hpp", "math/rows_of.hpp" or, beside the core, "support/support.hpp"."""
    places = [f"cpp/include/{header}", *(f"{tree}/{header}" for tree in (tree_of(user), PRIVATE) if tree != PUBLIC)]
    return next((place for place in places if place in files), None)


def included_headers(text: str) -> list[str]:
    """The headers in quotes that a file includes, and those of ours in angles."""
    code = without_comments(text)
    return re.findall(r'^\s*#\s*include\s*(?:"|<(?=ninedof/))([^">]+)[">]', code, flags=re.MULTILINE)


def declared(name: str, files: Mapping[str, str]) -> bool:
    """Whether a source has a header of its stem in its room, or says where else it is declared."""
    stem, room = PurePosixPath(name).stem, room_of(name)
    for other in files:
        if other.startswith((f"{PUBLIC}/{room}/", f"{PRIVATE}/{room}/")) and other.endswith(f"/{stem}.hpp"):
            return True
    said = re.search(r"Declared in `?([\w/]+\.hpp)`?\.", first_comment(files[name]))
    return said is not None and found_at(said[1], name, files) is not None


def wrong_includes(name: str, files: Mapping[str, str], used: Collection[str]) -> Iterator[str]:
    room = room_of(name)
    for other in sorted(used):
        above = room_of(other)
        if tree_of(name) in BESIDE or above is None:  # a binding may call the batch of its subject, a test any oracle
            continue
        if CPP_ROOMS.index(above) > CPP_ROOMS.index(room):
            yield f"{name}: includes upward {other}"
        if tree_of(name) == PUBLIC and tree_of(other) != PUBLIC:
            yield f"{name}: a public header includes the private {other}"


def classes(text: str) -> Iterator[str]:
    """The classes that a file defines in namespaces with a name; clang-format keeps them at the beginning of lines."""
    spaces: list[str] = []
    for line in text.splitlines():
        if opened := re.match(r"(?:inline )?namespace ?([\w: ]*) \{$", line):
            spaces.append(opened[1])
        elif line.startswith("}  // namespace"):
            spaces.pop()
        elif (defined := re.match(r"(?:struct|class) (\w+)(?: final)?(?: : .*)? \{", line)) and all(spaces):
            yield "::".join((*spaces, defined[1]))


def cpp_violations(files: Mapping[str, str]) -> list[str]:
    """One sentence for each violation; paths relative to the repository."""
    out: list[str] = []
    headers: dict[str, set[str]] = {}
    defining: dict[str, str] = {}  # the file of each class; the linker takes a second one for the first
    for name, text in files.items():
        if name not in CPP_OUTSIDE and room_of(name) is None:
            out.append(f"{name}: in no room; the rooms are {', '.join(CPP_ROOMS)}")
            continue
        code = without_comments(text)
        places = {header: found_at(header, name, files) for header in included_headers(text)}
        out.extend(f"{name}: includes {header}, which does not exist" for header, at in places.items() if at is None)
        used = {at for at in places.values() if at is not None}
        if name not in CPP_OUTSIDE:
            out.extend(wrong_includes(name, files, used))
        if name.endswith(".hpp"):
            headers[name] = used
        if tree_of(name) not in (PUBLIC, PRIVATE):
            continue
        for defined in classes(text):
            if defining.setdefault(defined, name) != name:
                out.append(f"{name}: defines {defined}, as {defining[defined]} does")
        for library, home in ONLY_IN.items():
            if re.search(library, code, flags=re.IGNORECASE) and name != home:
                out.append(f"{name}: mentions {library}, which stays behind {home}")
        out.extend(f"{name}: mentions {word}" for word in sorted(NOWHERE) if word in code)
        if name.endswith(".cpp") and not declared(name, files):
            out.append(f"{name}: no header of its name; its first comment must say `Declared in <header>.`")
    for stem, apart in CPP_INDEPENDENT.items():
        for name in files:
            path = PurePosixPath(name)
            if tree_of(name) not in (PUBLIC, PRIVATE) or stem not in (path.stem, path.parent.name):
                continue
            direct = {found_at(header, name, files) or "" for header in included_headers(files[name])}
            everything = direct.union(*(reachable(header, headers) for header in direct))
            met = apart & {PurePosixPath(header).stem for header in everything}
            out.extend(f"{name}: not independent of {other}" for other in sorted(met))
    out.extend(cycles(headers))
    return out
