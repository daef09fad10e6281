"""Structs of the options of a command, and what those that several commands share mean."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, TypeVar, dataclass_transform

import typer

from ninedof.cli.screen import Screen
from ninedof.conditioning.characteristic_length import KINDS
from ninedof.conditioning.hexagonal import HEXAGONAL
from ninedof.design.study import FAMILIES, variable_kinds
from ninedof.redundancy.rules import RULES
from ninedof.support.units import DEG

Two = tuple[float, float]
Three = tuple[float, float, float]
T = TypeVar("T")

VARIABLES = dict.fromkeys(
    name + DEG * (kind == "angle") for family in FAMILIES for name, kind in variable_kinds(family).items()
)
"""Of all families, angles in degrees."""
HEXAGON = (*HEXAGONAL, "theta_z_deg")

THREADS = "Threads; one per processor by default. The result does not depend on it."
DESIGN = "a design file (TOML), a run folder (its best design), or RUN#7 (point 7 of a front, counted from 1)"
ONE_DESIGN = f"A{DESIGN[1:]}."
DESIGN_OR_PUBLISHED = f"A{DESIGN[1:]}; the published design if none is given."
LC = "Characteristic length: a number, optimal, natural, mean_leg or platform_radius; the design's."
PLOT = "Draw the plates over each other: a .png, .svg or .pdf file."
STARTS = "Starts, in place of the study's."
REPORT = "Write the report, with the figures."
LOAD = 'A load "mx my mz fx fy fz" on the platform: moment about p and force; of the study. Repeatable.'
MASS = "Mass of the platform, in place of that of the study: its weight acts too."
CENTRE = "Its centre in the frame of the plate; of the study."
GRAVITY = "Force per mass, base axes; of the study, or 0 0 -9.81: newtons for kg."
LEG_ERROR = "Tolerance of the leg lengths; of the study."
JOINT_ERROR = "Tolerance of the joint centres, a radius; of the study."
LEG_STIFFNESS = "Stiffness of each leg, force/length."
SCHEDULER = "Address of a Dask scheduler, as tcp://host:8786; its workers compute"
LEG_LIMITS = "Limits of all nine legs; those of the run's study by default."


def option(
    words: str | None, default: Any = None, *names: str, metavar: str | None = None, values: Iterable[str] = ()
) -> Any:
    """Return a field of a struct that is an option, with its words in --help; `...` as the default: it is required.

    A shell completes the values, of which the option may have others too.
    """

    def complete(incomplete: str) -> list[str]:
        return [value for value in values if value.startswith(incomplete)]

    mark = typer.Option(default, *names, help=words, metavar=metavar, autocompletion=complete if values else None)
    return field(default=default, metadata={"typer": mark})


def typed(name: str) -> str:
    """Return an option as it is typed: --leg-mass for leg_mass."""
    return f"--{name.replace('_', '-')}"


def word_or_number(option: str, text: str, words: Collection[str], expected: str) -> str | float:
    """Return one of some words as it is, all else as a number."""
    try:
        return text if text in words else float(text)
    except ValueError:
        raise ValueError(f"{option}: got {text!r}, expected {expected}") from None


def changes_option(texts: Sequence[str]) -> dict[str, float | str]:
    """Return the values of --set NAME=VALUE, and the texts of NAME=+10%."""
    changes: dict[str, float | str] = {}
    for text in texts:
        name, equals, value = (part.strip() for part in text.partition("="))
        if not equals or name in changes:
            raise ValueError(f"--set: got {text!r}, expected NAME=VALUE or NAME=+10%, each name once")
        try:
            changes[name] = value if value.endswith("%") else float("" if value.startswith("+") else value)
        except ValueError:
            how = "without a plus" if value.startswith("+") else "with a number"
            raise ValueError(f"--set: got {text!r}, expected NAME=VALUE {how}, or NAME=+10%") from None
    return changes


def length_option(text: str) -> float | str:
    """Return the characteristic length given by --lc."""
    return word_or_number("--lc", text, KINDS, f"a number or one of {', '.join(KINDS)}")


def numbers(text: str) -> list[float]:
    """Return the finite numbers of a text, divided by blanks or commas; none if one of its words is no number."""
    try:
        values = [float(word) for word in text.replace(",", " ").split()]
    except ValueError:
        return []
    return values if all(map(math.isfinite, values)) else []


def several(option: str, text: str, expected: str) -> list[float]:
    """Return the numbers of an option that takes as many as `expected` has words, in quotes."""
    values, count = numbers(text), len(expected.split())
    if len(values) != count:
        raise ValueError(f'{option}: got {text!r}, expected {count} numbers "{expected}"')
    return values


def rule_option(text: str) -> str | float:
    """Return the rule for O given by --internal-point, or a fraction."""
    return word_or_number("--internal-point", text, RULES, f"{', '.join(RULES)} or a fraction")


def rule_for_o(otherwise: str) -> Any:
    """Return an option that takes a rule for O."""
    words = "Position of O: carried, shifted, held, best, or a fraction between the plates; by default as in the region"
    return option(f"{words} of the run's study, else {otherwise}.", values=RULES)


def loads_option(texts: Iterable[str] | None) -> list[list[float]]:
    """Return the loads given by --load."""
    return [several("--load", text, "mx my mz fx fy fz") for text in texts or ()]


def triple(words: str) -> Any:
    """Return an option that takes three numbers."""
    return option(words, metavar="X Y Z")


def ends(words: str | None = None, *names: str) -> Any:
    """Return an option that takes the two ends of a range."""
    return option(words, None, *names, metavar="LOW HIGH")


def argument(words: str, default: Any = ..., metavar: str | None = None) -> Any:
    """Return a field of a struct that is an argument."""
    return field(default=default, metadata={"typer": typer.Argument(default, help=words, metavar=metavar)})


@dataclass_transform(kw_only_default=True, frozen_default=True)
def struct(kind: type[T]) -> type[T]:
    """Make a class the struct of the options of a command: each of its fields is an `option` or an `argument`."""
    return dataclass(frozen=True, kw_only=True)(kind)


@struct
class Options:
    """Options of a command that prints."""

    json: bool = option("Print the result as JSON on standard output, text on standard error.", False, "--json")

    @cached_property
    def screen(self) -> Screen:
        """The screen that the command prints on."""
        return Screen(self.json)

    def values_of(self, *names: str) -> dict[str, Any]:
        """Return the options of some names that were typed, by name."""
        return {name: value for name in names if (value := getattr(self, name)) is not None}

    def refuse(self, where: str, *names: str) -> None:
        """Raise for options that have no effect where they are given."""
        for name, value in self.values_of(*names).items():
            if value is not False:
                several = value if isinstance(value, list | tuple) else [value]
                got = "it" if value is True else " ".join(f"{x:g}" if isinstance(x, float) else str(x) for x in several)
                raise ValueError(f"{typed(name)}: got {got}, expected none {where}")


@struct
class JobOptions(Options):
    """Options of a command that makes a run folder."""

    out: Path | None = option(
        "Run folder; runs/<time> by default. The same command goes on with an unfinished run there."
    )
    figures: bool = option("Draw the figures.", True, "--figures/--no-figures")
    report: bool = option(REPORT, True, "--report/--no-report")


@struct
class HexagonalOptions(Options):
    """Sides and heights of a hexagonal design, and the characteristic length."""

    a1: float | None = option("Base side (eq. 37).")
    a2: float | None = option("Base side.")
    b1: float | None = option("Platform side (eq. 38).")
    b2: float | None = option("Platform side.")
    zp: float | None = option("Height of the platform.")
    zs: float | None = option("Height of the internal point.")
    theta_z_deg: float | None = option("Twist of the platform, degrees; 0 by default.")
    lc: str | None = option(LC, values=KINDS)
