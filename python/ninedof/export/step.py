"""STEP (ISO 10303-21, AP214): the joints, p and O as named points, and the legs as lines, at the neutral pose.

Lengths keep the numbers of the design; the file declares their unit. A STEP file always has a unit: where the design
names none, the file says millimetres and its description says that this was assumed.
"""

from __future__ import annotations

import re
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


LEG = """\
DIRECTION('',{direction})
VECTOR('',@1,1.)
LINE('{name}',{start},@2)
TRIMMED_CURVE('{name}',@3,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE({length})),.T.,.PARAMETER.)"""
METRIC = "(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT({prefix},.METRE.))"
IMPERIAL = """\
(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))
DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.)
LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE({millimetres}),@1)
(CONVERSION_BASED_UNIT('{name}',@3)LENGTH_UNIT()NAMED_UNIT(@2))"""
CONTEXT = """\
(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))
(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())
UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE({accuracy}),{length},'distance_accuracy_value','')
(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((@3))\
GLOBAL_UNIT_ASSIGNED_CONTEXT(({length},@1,@2))REPRESENTATION_CONTEXT('','3D'))"""
# Not that of the platform: readers take a placement for one of the whole shape.
BASE_FRAME = """\
CARTESIAN_POINT('base frame',(0.0,0.0,0.0))
DIRECTION('',(0.0,0.0,1.0))
DIRECTION('',(1.0,0.0,0.0))
AXIS2_PLACEMENT_3D('base frame',@1,@2,@3)"""
PRODUCT = """\
APPLICATION_CONTEXT('core data for automotive mechanical design processes')
APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,@1)
PRODUCT_CONTEXT('',@1,'mechanical')
PRODUCT('{name}','{name}','',(@3))
PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,(@4))
PRODUCT_DEFINITION_FORMATION('','',@4)
PRODUCT_DEFINITION_CONTEXT('part definition',@1,'design')
PRODUCT_DEFINITION('design','',@6,@7)
PRODUCT_DEFINITION_SHAPE('','',@8)"""


def text(model: Model) -> str:
    """Return the file."""
    data = Entities()
    at = model.base_frame
    points = {name: data.add(f"CARTESIAN_POINT('{name}',{_reals(xyz)})") for name, xyz in at.items()}
    lines = {leg: _segment(data, leg, points[a], at[b] - at[a]) for leg, a, b in LEGS if np.any(at[a] != at[b])}
    groups = {"joints": list(points.values())}
    groups |= {title: [line for leg, line in lines.items() if leg.startswith(kind)] for kind, title in LEGS_OF.items()}
    sets = [_group(data, title, members) for title, members in groups.items() if members]
    largest = max(float(np.abs(xyz).max()) for xyz in at.values())
    unit = _length_unit(data, model.unit or ASSUMED)
    context = data.add(CONTEXT, accuracy=_real(ACCURACY * largest), length=unit)
    items = _list([*sets, data.add(BASE_FRAME)])
    shape = data.add(f"GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION('{model.name}',{items},{context})")
    data.add(f"SHAPE_DEFINITION_REPRESENTATION({data.add(PRODUCT, name=model.name)},{shape})")
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

    def add(self, entities: str, **values: str) -> str:
        """Add entities, a line each, in which @1 is the first of them; return the number of the last."""
        before = len(self.lines)
        for entity in (entities.format(**values) if values else entities).split("\n"):
            numbered = re.sub(r"@(\d)", lambda match: f"#{before + int(match[1])}", entity)
            self.lines.append(f"#{len(self.lines) + 1}={numbered};")
        return f"#{len(self.lines)}"


def _segment(data: Entities, name: str, start: str, way: Floats) -> str:
    length = float(np.linalg.norm(way))
    return data.add(LEG, name=name, start=start, direction=_reals(way / length), length=_real(length))


def _group(data: Entities, name: str, members: list[str]) -> str:
    """Add a set of points or curves, and put it on a layer of the same name."""
    number = data.add(f"GEOMETRIC_CURVE_SET('{name}',{_list(members)})")
    data.add(f"PRESENTATION_LAYER_ASSIGNMENT('{name}','',{_list(members)})")
    return number


def _length_unit(data: Entities, unit: str) -> str:
    if unit in PREFIXES:
        return data.add(METRIC, prefix=PREFIXES[unit])
    name, millimetres = CONVERTED[unit]
    return data.add(IMPERIAL, name=name, millimetres=_real(millimetres))


def _list(numbers: list[str]) -> str:
    return f"({','.join(numbers)})"


def _reals(values: Floats) -> str:
    return _list([_real(float(value)) for value in values])


def _real(value: float) -> str:
    """Return a real as STEP writes it: always with a point, the exponent after E."""
    mantissa, mark, exponent = repr(value).upper().partition("E")
    return (mantissa if "." in mantissa else mantissa + ".") + mark + exponent


FORMAT = Format("step", ".step", "STEP skeleton: points and axes", text, mark="'ninedof ")
