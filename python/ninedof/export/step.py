"""STEP (ISO 10303-21, AP214): the joints, p and O as named points, and the legs as lines, at the neutral pose.

Lengths keep the numbers of the design; the file declares their unit. A STEP file always has a unit: where the design
names none, the file says millimetres and its description says that this was assumed.
"""

from __future__ import annotations

from datetime import UTC, datetime

import numpy as np

from ninedof.export.model import LEGS, Format, Model
from ninedof.support.arrays import Floats
from ninedof.support.extras import versions

PREFIXES = {"mm": ".MILLI.", "cm": ".CENTI.", "m": "$"}
CONVERTED = {"in": ("INCH", 25.4), "ft": ("FOOT", 304.8)}
"""Name, and the millimetres of one."""
ASSUMED = "mm"
ACCURACY = 1e-9  # of coordinates, relative to the largest
LEGS_OF = {"l": "external legs", "q": "upper internal legs", "r": "lower internal legs"}
"""By the first letter of the leg."""


def text(model: Model) -> str:
    """Return the file."""
    data = Entities()
    at = model.base_frame
    points = {name: data.point(name, xyz) for name, xyz in at.items()}
    lines = {leg: data.segment(leg, points[a], at[a], at[b]) for leg, a, b in LEGS if np.any(at[a] != at[b])}
    groups = {"joints": list(points.values())}
    groups |= {title: [line for leg, line in lines.items() if leg.startswith(kind)] for kind, title in LEGS_OF.items()}
    sets = [data.group(title, members) for title, members in groups.items() if members]
    largest = max(float(np.abs(xyz).max()) for xyz in at.values())
    context = data.context(model.unit or ASSUMED, ACCURACY * largest)
    name = f"'{model.name}'"
    shape = data.add(
        f"GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION({name},{_list([*sets, data.base_frame()])},{context})"
    )
    data.add(f"SHAPE_DEFINITION_REPRESENTATION({data.product(name)},{shape})")
    return "\n".join([*_header(model), "DATA;", *data.lines, "ENDSEC;", "END-ISO-10303-21;", ""])


def _header(model: Model) -> list[str]:
    assumed = f"; the design names no unit of length, {ASSUMED} is assumed"
    program = f"'ninedof {versions()['ninedof']}'"
    now = datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%S")
    return [
        "ISO-10303-21;",
        "HEADER;",
        f"FILE_DESCRIPTION(('Joints and leg axes at the neutral pose{'' if model.unit else assumed}'),'2;1');",
        f"FILE_NAME('{model.name}.step','{now}',(''),(''),{program},{program},'');",
        "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));",
        "ENDSEC;",
    ]


class Entities:
    """The numbered lines of the data section."""

    def __init__(self) -> None:
        self.lines: list[str] = []

    def add(self, entity: str) -> str:
        """Add one entity and return its number."""
        number = f"#{len(self.lines) + 1}"
        self.lines.append(f"{number}={entity};")
        return number

    def point(self, name: str, xyz: Floats) -> str:
        """Add a named point."""
        return self.add(f"CARTESIAN_POINT('{name}',{_reals(xyz)})")

    def direction(self, xyz: Floats) -> str:
        """Add a direction."""
        return self.add(f"DIRECTION('',{_reals(xyz)})")

    def segment(self, name: str, start: str, a: Floats, b: Floats) -> str:
        """Add the line from the point `start`, which is at a, to b."""
        length = float(np.linalg.norm(b - a))
        vector = self.add(f"VECTOR('',{self.direction((b - a) / length)},1.)")
        line = self.add(f"LINE('{name}',{start},{vector})")
        ends = f"(PARAMETER_VALUE(0.)),(PARAMETER_VALUE({_real(length)}))"
        return self.add(f"TRIMMED_CURVE('{name}',{line},{ends},.T.,.PARAMETER.)")

    def group(self, name: str, members: list[str]) -> str:
        """Add a set of points or curves, and put it on a layer of the same name."""
        number = self.add(f"GEOMETRIC_CURVE_SET('{name}',{_list(members)})")
        self.add(f"PRESENTATION_LAYER_ASSIGNMENT('{name}','',{_list(members)})")
        return number

    def base_frame(self) -> str:
        """Add the base frame. Not that of the platform: readers take a placement for one of the whole shape."""
        origin, axes = self.point("base frame", np.zeros(3)), np.eye(3)
        return self.add(
            f"AXIS2_PLACEMENT_3D('base frame',{origin},{self.direction(axes[2])},{self.direction(axes[0])})"
        )

    def context(self, unit: str, accuracy: float) -> str:
        """Add the units and the accuracy of the points."""
        length = self._length_unit(unit)
        angle = self.add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))")
        solid = self.add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())")
        measure = f"LENGTH_MEASURE({_real(accuracy)})"
        uncertainty = self.add(f"UNCERTAINTY_MEASURE_WITH_UNIT({measure},{length},'distance_accuracy_value','')")
        return self.add(
            f"(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(({uncertainty}))"
            f"GLOBAL_UNIT_ASSIGNED_CONTEXT({_list([length, angle, solid])})REPRESENTATION_CONTEXT('','3D'))"
        )

    def _length_unit(self, unit: str) -> str:
        prefix = PREFIXES.get(unit, PREFIXES[ASSUMED])
        metric = self.add(f"(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT({prefix},.METRE.))")
        if unit in PREFIXES:
            return metric
        name, millimetres = CONVERTED[unit]
        power = self.add("DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.)")
        factor = self.add(f"LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE({_real(millimetres)}),{metric})")
        return self.add(f"(CONVERSION_BASED_UNIT('{name}',{factor})LENGTH_UNIT()NAMED_UNIT({power}))")

    def product(self, name: str) -> str:
        """Add the product that the shape is one of; return the definition of its shape."""
        application = self.add("APPLICATION_CONTEXT('core data for automotive mechanical design processes')")
        protocol = f"'international standard','automotive_design',2000,{application}"
        self.add(f"APPLICATION_PROTOCOL_DEFINITION({protocol})")
        discipline = self.add(f"PRODUCT_CONTEXT('',{application},'mechanical')")
        product = self.add(f"PRODUCT({name},{name},'',({discipline}))")
        self.add(f"PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,({product}))")
        formation = self.add(f"PRODUCT_DEFINITION_FORMATION('','',{product})")
        stage = self.add(f"PRODUCT_DEFINITION_CONTEXT('part definition',{application},'design')")
        definition = self.add(f"PRODUCT_DEFINITION('design','',{formation},{stage})")
        return self.add(f"PRODUCT_DEFINITION_SHAPE('','',{definition})")


def _list(numbers: list[str]) -> str:
    return f"({','.join(numbers)})"


def _reals(values: Floats) -> str:
    return _list([_real(float(value)) for value in values])


def _real(value: float) -> str:
    """Return a real as STEP writes it: always with a point, the exponent after E."""
    mantissa, mark, exponent = repr(value).upper().partition("E")
    return (mantissa if "." in mantissa else mantissa + ".") + mark + exponent


FORMAT = Format("step", ".step", "STEP skeleton: points and axes", text, mark="'ninedof ")
