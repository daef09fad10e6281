"""The question of a study in words: what is least, over which poses, within which bounds and limits."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ninedof.design.actuators import price_words
from ninedof.design.study import Study
from ninedof.design.tables import end_text, limits_table, variables_table
from ninedof.redundancy.rules import MEANING, WORDS
from ninedof.sheet.pose_words import gravity_words, vector_words
from ninedof.sheet.tables import load_words
from ninedof.support.units import amount, per
from ninedof.tables.html import Html, html_of, joined, paragraphs

MOST_NAMES = 12  # of a catalogue; the study file has them all
MASSES = ("platform", "cylinder", "rod", "internal_point")
FAMILIES = {
    "hexagonal": "hexagonal plates, eqs. (37) and (38)",
    "symmetric": "flat joint triples with threefold symmetry",
    "symmetric_nonplanar": "joint triples with threefold symmetry, each at its own height",
    "general": "twelve free joints",
}


def question(study: Study) -> Html:
    """Return the question of a study."""
    return joined(paragraphs(sentences(study)), html_of((variables_table(study), limits_table(study))))


def sentences(study: Study) -> Iterator[str]:
    """Yield what is asked, in sentences."""
    family = f": {FAMILIES[study.family]}" if study.family in FAMILIES else ""
    yield f"Which design has the least {study.words}? The family of designs is “{study.family}”{family}."
    objective = study.objective
    if objective.region is not None:
        rule = objective.region.internal_point
        least = ", where the worst of the index and all limits is least" * (rule == "best")
        yield f"Every limit is to hold in all of this region. O is {WORDS[rule]}: {MEANING[rule]}{least}."
    elif objective.poses:
        yield f"Every limit is to hold at each of the {len(objective.poses)} poses; between them nothing is asked."
    else:
        yield "One pose is asked for, the neutral one."
    limits = {"any pose": objective.condition_limit, "the neutral pose": objective.neutral_condition_limit}
    for name, limit in limits.items():
        if limit is not None:
            yield f"The condition number at {name} is at most {limit:g}."
    length = study.characteristic_length
    if isinstance(length, str):
        words = f"chosen for each design: {length.replace('_', ' ')}"
    elif isinstance(length, tuple):
        words = amount(f"free from {end_text(length[0])} to {end_text(length[1])}", study.unit)
    else:
        words = amount(f"{length:g}", study.unit)
    unit = f"in {study.unit}" if study.unit else "in one unit, which the study does not name"
    yield f"Lengths are {unit}, angles in degrees. The characteristic length is {words}."
    if rows := study.actuators:
        price = "" if study.greatest_price is None else f", all nine for {price_words(study.greatest_price)} at most"
        how = "one of them for all legs" if study.actuators_for == "all" else "one of them for each kind of legs"
        names = ", ".join([row.name for row in rows[:MOST_NAMES]])
        names += f" and {len(rows) - MOST_NAMES} more" * (len(rows) > MOST_NAMES)
        yield f"Actuators are chosen from a catalogue of {len(rows)}, {how}{price}: {names}."
    if duty := " ".join(duty_sentences(study)):
        yield duty


def duty_sentences(study: Study) -> Iterator[str]:
    """Yield what the machine is for: tool, loads, masses, speeds and tolerances, where the study has them."""
    unit, loads, speeds, built = study.unit, study.loads, study.speeds, study.tolerances
    if study.tool:
        yield f"Poses, loads and speeds are of the {', '.join(study.tool.words(unit))}, in the frame of the plate."
    if loads.wrenches:
        words = "; ".join(load_words(k, load, unit, study.force_unit) for k, load in enumerate(loads.wrenches, start=1))
        yield f"{words[:1].upper()}{words[1:]}."
    given = {name.replace("_", " "): x for name in MASSES if (x := getattr(study.masses, name))}
    masses = [amount(f"{name} {x:g}", "kg" * bool(study.force_unit)) for name, x in given.items()]
    if masses:
        centre = amount(vector_words(study.masses.centre), unit)
        at = f", the platform's centre at {centre} in the frame of the plate" * (study.masses.platform > 0.0)
        yield f"Masses: {', '.join(masses)}{at}; {gravity_words(loads.gravity, study.force_unit)}."
    for name, linear, angular, time in (
        ("Speed", speeds.linear, speeds.angular, "s"),
        ("Acceleration", speeds.acceleration, speeds.angular_acceleration, "s²"),
    ):
        if linear or angular:
            shift = amount(f"{linear:g}", per(unit, time))
            yield f"{name} of the platform: at most {shift} and {math.degrees(angular):g}°/{time}."
    if built:
        joints, legs = (amount(f"{x:g}", unit) for x in (built.joints, built.legs))
        yield f"Tolerances, within which every machine keeps the limits: joint centres {joints}, leg lengths {legs}."
