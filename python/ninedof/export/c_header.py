"""C: a header of constants with the inverse kinematics, C99, that needs the standard library alone.

Every name begins with that of the machine, and the guard ends with a sum of the contents: a program takes the headers
of several machines, and two of one name do not compile, where an equal guard would leave the second out.
"""

from __future__ import annotations

import re
import zlib
from collections.abc import Iterable

from ninedof.export.model import Format, Model
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import triples
from ninedof.support.arrays import Floats
from ninedof.support.extras import versions

NEUTRAL = """\
typedef struct {
  double p[3];    /* origin of the platform frame, base frame */
  double Q[3][3]; /* rotation, platform frame to base frame; rows */
  double O[3];    /* internal point, base frame */
} ninedof_pose;

static const ninedof_pose ninedof_neutral = {
"""

INVERSE_KINEMATICS = """\
static inline double ninedof_norm(double x, double y, double z) {
  return sqrt(x * x + y * y + z * z);
}

static inline void ninedof_rotate(const ninedof_pose *pose, const double u[3], double out[3]) {
  int i;
  for (i = 0; i < 3; ++i) out[i] = pose->Q[i][0] * u[0] + pose->Q[i][1] * u[1] + pose->Q[i][2] * u[2];
}

/* Lengths of the legs l1 l2 l3 q1 q2 q3 r1 r2 r3 at a pose. */
static inline void ninedof_leg_lengths(const ninedof_pose *pose, double lengths[9]) {
  const double *p = pose->p, *s = pose->O;
  int i;
  for (i = 0; i < 3; ++i) {
    const double *r = ninedof_base_external[i], *r_hat = ninedof_base_internal[i];
    double u[3], u_tilde[3];
    ninedof_rotate(pose, ninedof_platform_external[i], u);
    ninedof_rotate(pose, ninedof_platform_internal[i], u_tilde);
    lengths[i] = ninedof_norm(p[0] + u[0] - r[0], p[1] + u[1] - r[1], p[2] + u[2] - r[2]);
    lengths[i + 3] = ninedof_norm(s[0] - p[0] - u_tilde[0], s[1] - p[1] - u_tilde[1], s[2] - p[2] - u_tilde[2]);
    lengths[i + 6] = ninedof_norm(s[0] - r_hat[0], s[1] - r_hat[1], s[2] - r_hat[2]);
  }
}
"""

TOOL = """
   The platform frame is that of the tool: p is the tool's point, Q has its axes."""

WITHIN = """\
/* 0 if every leg is between its shortest and its longest length, those that the poses of the study need, else the
   number of the first that is not, from 1. */
static inline int ninedof_first_out_of_range(const double lengths[9]) {
  int k;
  for (k = 0; k < 9; ++k)
    if (!(lengths[k] >= ninedof_shortest[k] && lengths[k] <= ninedof_longest[k])) return k + 1;
  return 0;
}
"""


def text(model: Model) -> str:
    """Return the file. Constants are the shortest decimals that read back to the same bits."""
    g, c = model.tool.robot(model.geometry, model.configuration)
    words = [
        f'static const char ninedof_{key}[] = "{word}";\n'
        for key, word in {"name": model.name, "unit": model.unit}.items()
    ]
    parts = [*words, "\n", *(_matrix(name, rows) for name, rows in triples(g).items()), _neutral(c)]
    parts.append(_row("neutral_lengths", model.neutral_lengths))
    if model.leg_ranges:
        shortest, longest = zip(*model.leg_ranges, strict=True)
        parts += [_row("shortest", shortest), _row("longest", longest)]
        if model.permitted_ranges:
            low, high = zip(*model.permitted_ranges, strict=True)
            parts += [_row("permitted_shortest", low), _row("permitted_longest", high)]
        parts += ["\n", WITHIN]
    name = re.sub(r"\W", "_", model.name, flags=re.ASCII)
    body = re.sub(r"\bninedof_", f"ninedof_{name}_", "".join([*parts, "\n", INVERSE_KINEMATICS]))
    guard = f"ninedof_{name}_{zlib.crc32(body.encode()):08x}_h"
    return f"{_head(model)}#ifndef {guard}\n#define {guard}\n\n#include <math.h>\n\n{body}\n#endif\n"


def _head(model: Model) -> str:
    unit = model.unit or "not named"
    return (
        f"/* {model.name}: joints and inverse kinematics, written by ninedof {versions()['ninedof']}.\n"
        f"   Unit of lengths: {unit}. Joints 1, 2, 3 are rows: those of the base in the base frame, those of the\n"
        "   platform in the platform frame. Legs in the order l1 l2 l3 q1 q2 q3 r1 r2 r3: external, upper internal,\n"
        f"   lower internal.{TOOL * bool(model.tool)} */\n"
    )


def _matrix(name: str, rows: Floats) -> str:
    lines = ",\n".join(f"  {_braces(row)}" for row in rows)
    return f"static const double ninedof_{name}[3][3] = {{\n{lines}}};\n"


def _neutral(c: Configuration) -> str:
    rotation = ",\n   ".join(_braces(row) for row in c.rotation)
    return f"\n{NEUTRAL}  {_braces(c.position)},\n  {{{rotation}}},\n  {_braces(c.internal_point)}}};\n"


def _row(name: str, values: Iterable[float]) -> str:
    numbers = [repr(float(value)) for value in values]
    lines = ",\n".join(f"  {', '.join(numbers[k : k + 3])}" for k in (0, 3, 6))
    return f"static const double ninedof_{name}[9] = {{\n{lines}}};\n"


def _braces(values: Iterable[float]) -> str:
    return f"{{{', '.join(repr(float(value)) for value in values)}}}"


FORMAT = Format("c", ".h", "C header of constants with the inverse kinematics", text)
