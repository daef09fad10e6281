"""Reads the design back from an MJCF file that `mjcf` wrote, or that MuJoCo saved after reading such a file.

The joints are the sites of base and platform, the neutral configuration is where the bodies "platform" and "O" stand;
so a file whose sites were moved gives the design with the joints moved.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from xml.etree import ElementTree
from xml.parsers import expat

import numpy as np

from ninedof.conditioning.characteristic_length import length_argument
from ninedof.export.bodies import from_metres
from ninedof.export.mjcf import MARK
from ninedof.export.reading import Read
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import TRIPLES, Geometry
from ninedof.support.arguments import shown
from ninedof.support.arrays import Floats
from ninedof.support.units import unit_argument


def read(path: Path) -> Read:
    """Return the design; ValueError if the file is not such a file or lacks a part."""
    data = path.read_bytes()
    try:
        _without_entities(data)
        root = ElementTree.fromstring(data)  # noqa: S314 what defusedxml refuses is refused the line before
    except (ElementTree.ParseError, expat.ExpatError) as error:
        raise ValueError(f"not an XML file: {error}") from None
    texts = {item.get("name"): item.get("data", "") for item in root.iterfind("custom/text")}
    if root.tag != "mujoco" or texts.get("format") != MARK:
        raise ValueError(f"got no {MARK!r} mark, expected an MJCF file written by `ninedof export --to mjcf`")
    unit = unit_argument("" if texts.get("unit") == "none" else texts.get("unit"))
    sites = {item.get("name"): item for item in root.iter("site")}
    bodies = {item.get("name"): item for item in root.iter("body")}
    triples = {
        name: from_metres(np.array([_position(sites, f"{name}{i}") for i in (1, 2, 3)]), unit) for name in TRIPLES
    }
    p, s = (from_metres(_position(bodies, name), unit) for name in ("platform", "O"))
    c = Configuration(position=p, rotation=_rotation(bodies["platform"]), internal_point=s)
    return Geometry(**triples), c, _length(texts.get("characteristic_length", "1.0")), unit


def _without_entities(data: bytes) -> None:
    """Raise for a document type: it may define entities that grow without end, or name other files."""

    def refused(*_: object) -> None:
        raise ValueError("got a document type, expected an MJCF file without one")

    parser = expat.ParserCreate()
    parser.StartDoctypeDeclHandler = refused
    parser.Parse(data, True)


def _position(items: Mapping[str | None, ElementTree.Element], name: str) -> Floats:
    if name not in items:
        raise ValueError(f"got no body or site {name!r}, expected the file whole")
    return _numbers(items[name], "pos", 3, (0.0, 0.0, 0.0))


def _rotation(body: ElementTree.Element) -> Floats:
    """Return Q from its first two columns, as `mjcf` writes it, or from a quaternion, as MuJoCo saves it."""
    if body.get("xyaxes") is not None:
        x, y = _numbers(body, "xyaxes", 6).reshape(2, 3)
        return np.stack([x, y, np.cross(x, y)], axis=-1)
    w, *v = _numbers(body, "quat", 4, (1.0, 0.0, 0.0, 0.0))
    square = w * w + np.dot(v, v)
    if not square > 0.0:
        raise ValueError("platform: got a quaternion of length 0, expected a rotation")
    x, y, z = v
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + (2.0 / square) * (w * cross + cross @ cross))


def _numbers(item: ElementTree.Element, key: str, count: int, default: tuple[float, ...] | None = None) -> Floats:
    text = item.get(key)
    if text is None and default is not None:
        return np.array(default)
    try:
        found = np.array([float(part) for part in (text or "").split()])
    except ValueError:
        found = np.empty(0)
    if found.shape != (count,):
        raise ValueError(f"{item.get('name')}: got {key}={shown(text)}, expected {count} numbers")
    return found


def _length(text: str) -> float | str:
    try:
        return length_argument(float(text))
    except ValueError:
        return length_argument(text)
