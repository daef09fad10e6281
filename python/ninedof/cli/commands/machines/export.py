"""`ninedof export`: a design as a file of another program."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import ninedof as nd
from ninedof.cli.answer import Answer
from ninedof.cli.options import ONE_DESIGN, Options, argument, option, struct, typed
from ninedof.cli.posed import named_design, searching
from ninedof.export.bodies import body_masses
from ninedof.export.export import formats
from ninedof.export.model import Format
from ninedof.support.arguments import choice
from ninedof.support.kept.files import own_or_new
from ninedof.support.units import UNITS

BODIES = {"platform": "platform", "cylinder": "each cylinder", "rod": "each rod", "internal_point": "O"}
DRAWN = {
    "inertia": "inertia of the platform",
    "cylinder_centre": "centre of each cylinder",
    "rod_centre": "centre of each rod",
    "cylinder_inertia": "inertia of each cylinder",
    "rod_inertia": "inertia of each rod",
}
"""What is that of the bodies as they are drawn, where a study does not state it."""
EXAMPLES = """
  ninedof export runs/20260101-120000 --to mjcf
  ninedof export runs/20260101-120000 --to urdf --out machine.urdf --platform-mass 12
  ninedof export design.toml --out joints.csv"""

WORDS = "; ".join(f"{name}: {row.words}" for name, row in formats().items())


@struct
class _Options(Options):
    design: str = argument(ONE_DESIGN)
    to: str | None = option(f"{WORDS}. Follows from the suffix of --out if that is given.", values=formats())
    out: Path | None = option("The file; in this folder, with the name of the design, by default.")
    leg_mass: float | None = option("mjcf, urdf, sdf: mass of a leg, kg; that of the study, or 1, by default.")
    platform_mass: float | None = option(
        "mjcf, urdf, sdf: mass of the platform, kg; that of the study, or 5, by default."
    )
    gravity: float | None = option("mjcf: downward, m/s²; 0 by default.")
    unit: str | None = option(
        "The length unit (mm, cm, m, in, ft); that of the study or file by default.", values=UNITS
    )


def export(options: _Options) -> Answer:
    """Write a design as a file of another program: simulators, CAD, controllers, documents."""
    out = options.out
    row = _by_suffix(out) if options.to is None else formats()[choice("--to", options.to, formats())]
    if out is not None and out.suffix.lower() in {one.suffix for one in formats().values()} - {row.suffix}:
        raise ValueError(f"--out: got {out} with --to {row.name}, expected a file that ends in {row.suffix}")
    chosen = named_design(options.design)
    path = Path(options.design)
    stem = path.resolve().name if path.is_dir() else path.stem
    file = out or Path(stem.replace("#", "-") + row.suffix)  # "front-7" for "runs/front#7"
    if file.resolve() == path.resolve():
        raise ValueError(f"--out: got {file}, the design itself, expected another file")
    more = options.values_of("leg_mass", "platform_mass", "gravity")
    for key in more.keys() - row.options:
        what = ", ".join(map(typed, row.options)) or "no option"
        raise ValueError(f"{typed(key)}: got {more[key]:g} with --to {row.name}, which takes {what}")
    own_or_new("--out", file, row.mark)
    if row.beside is not None:
        own_or_new("--out", file.with_suffix(row.beside[0]), row.beside[1])
    with searching(options.screen, "export", chosen):
        written = nd.export(chosen.machine, row.name, file, unit=options.unit, **more)
    lines = [f"{row.words}: {written}"]
    if "leg_mass" in row.options:
        masses, assumed = body_masses(chosen.study, options.leg_mass, options.platform_mass)
        each = (f"{name} {getattr(masses, key):g} kg{' (assumed)' * (key in assumed)}" for key, name in BODIES.items())
        drawn = [name for key, name in DRAWN.items() if not np.any(getattr(masses, key))]
        rest = f"; as drawn: {', '.join(drawn)}" * bool(drawn)
        lines.append(f"masses: {', '.join(each)}{rest}")
    return Answer(lines, {"format": row.name, "file": str(written)})


def _by_suffix(out: Path | None) -> Format:
    if out is None:
        raise ValueError(f"--to: got nothing, expected one of {', '.join(formats())}")
    suffixes = {row.suffix: row for row in formats().values()}
    if out.suffix.lower() not in suffixes:
        raise ValueError(f"--out: got {out}, expected --to with a format, or a file that ends in {', '.join(suffixes)}")
    return suffixes[out.suffix.lower()]
