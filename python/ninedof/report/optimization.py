"""The pages of an optimization and of a trade-off, with the question of the study in words."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from ninedof.design.actuators import price_words
from ninedof.design.domains.region import region_lines
from ninedof.design.study import Study
from ninedof.design.tables import end_text, limits_table, variables_table
from ninedof.optimize.candidate import Candidate
from ninedof.optimize.pareto import Front
from ninedof.optimize.pareto.front import front_table, limit_text, preferred
from ninedof.optimize.result import Result, Status
from ninedof.optimize.tables import SHOWN, agreement_words, best_prices, candidates_table
from ninedof.proof.machine_record import MachineCertificate
from ninedof.redundancy.rules import MEANING, WORDS
from ninedof.report import origin, proof, scene
from ninedof.report.page import Page
from ninedof.report.scene import quick_body
from ninedof.sheet.pose_words import gravity_words, vector_words
from ninedof.sheet.sheet import Sheet
from ninedof.sheet.tables import load_words, sheet_parts
from ninedof.support.units import amount, per
from ninedof.tables.html import Html, beside, bullets, facts, html_of, joined, paragraphs, tag

NO_CLAIM = "The best design found is shown below. It is not claimed to be an optimum."


def of_result(
    result: Result,
    record: Any,
    run: str = "RUN",
    again: Html | None = None,
    certificate: MachineCertificate | None = None,
    other_proofs: Sequence[str] = (),
) -> Page:
    """Return the page of an optimization; `again` says how to reproduce it, where its study alone does not.

    `other_proofs` is a sentence on a certificate for other tolerances, if there is one.
    `run` is the run in the commands of the page: "RUN#7" for a point of a front.
    """
    best, study = result.best, result.study
    sections = {"question": question(study), "answer": _answer(result)}
    view, sheet, machine, words = None, None, None, f"{study.words}: no design"
    if best is not None and result.status != Status.UNBOUNDED:  # without a least value there is no design to build
        sheet = result.sheet()
        body, hint = quick_body(result, run)
        sections |= {"machine": paragraphs([hint]), "sheet": sheet_html(sheet)}
        machines = [design_machine("best design", best, study, sheet, body)]
        others = enumerate(result.candidates[1:SHOWN], start=2)
        machines += [design_machine(f"optimum no. {k}", other, study) for k, other in others]
        view = scene.scene(machines, study.unit)
        machine, words = (best.geometry, best.configuration), result.words
    sections["proof"] = proof.of_result(result, certificate, other_proofs)
    sections["again"] = again or origin.of_study(study, "ninedof optimize study.toml", record)
    headline, good = words[:1].upper() + words[1:], result.status == Status.OPTIMAL
    return Page("optimization", headline, _key_figures(result, sheet), sections, view, good, machine)


def sheet_html(sheet: Sheet) -> Html:
    """Return the engineering sheet."""
    return joined(*map(html_of, sheet_parts(sheet)))


def design_machine(
    title: str, one: Candidate, study: Study, sheet: Sheet | None = None, body: Mapping[str, Any] | None = None
) -> dict[str, Any]:
    """Return a design for the view: with the worst poses of its sheet and a body, or at its neutral pose."""
    region = study.objective.region
    lines = [] if region is None else region_lines(region, one.configuration)
    poses = [("neutral pose", one.configuration)] if sheet is None else scene.worst_poses(sheet)
    return scene.machine(title, one.geometry, one.characteristic_length, poses, lines, body, study.tool)


def _answer(result: Result) -> Html:
    if result.best is None:
        causes = ", ".join(result.causes) or "none found"
        return joined(paragraphs([_sentence(result.reason)]), facts([("status", result.status), ("causes", causes)]))
    claim = [_sentence(result.reason)] if result.status != Status.OPTIMAL else []
    claim += [NO_CLAIM] if result.status == Status.STOPPED else []
    agreement = paragraphs(map(_sentence, agreement_words(result)))
    side = joined(_prices(result, result.best), tag("h3", "What the search shows"), agreement)
    return joined(paragraphs(claim), beside(html_of(candidates_table(result)), side))


def _prices(result: Result, best: Candidate) -> Html:
    if not best.active:
        return joined(tag("h3", "Limits reached"), paragraphs(["No limit and no bound is reached."]))
    free = (f"{name} is on its bound or limit; it has no price" for name in best.active if name not in best.prices)
    sentences = [_sentence(words.replace("_", " ")) for words in (*best_prices(result), *free)]
    return joined(tag("h3", "Limits reached, and what relaxing them gains"), bullets(sentences))


def _key_figures(result: Result, sheet: Sheet | None) -> list[tuple[object, object]]:
    best = result.best
    if best is None or sheet is None:
        return [("status", result.status), ("because of", ", ".join(result.causes) or "none found")]
    rows: list[tuple[object, object]] = [("status", result.status), ("objective", f"{best.objective:.6f}")]
    if abs(best.neutral_condition_number - best.objective) > 1e-9:
        rows.append(("condition number, neutral pose", f"{best.neutral_condition_number:.6f}"))
    if result.actuators is not None:
        rows.append(("actuators", result.actuators.chosen.words))
    rows.append(("limits reached", ", ".join(name.replace("_", " ") for name in best.active) or "none"))
    return rows


def _sentence(text: str) -> str:
    """Return a message as a sentence; names of symbols keep their letter."""
    ended = text if text.endswith((".", "?", "!")) else f"{text}."
    first = ended.split(maxsplit=1)[0].rstrip(":")
    return ended[0].upper() + ended[1:] if first.isalpha() and len(first) > 1 else ended


def of_front(front: Front, record: Any, run: str = "RUN") -> Page:
    """Return the page of a trade-off; `run` is the run in its commands."""
    limit = front.limit_name.replace("_", " ")
    sentence = f"What does each value of {limit} cost? The study below is solved once for each."
    sections = {
        "question": joined(paragraphs([sentence]), question(front.study)),
        "answer": html_of(front_table(front)),
        "proof": proof.of_front(front),
        "again": origin.of_front(front, record),
    }
    first, shown, hint, start = preferred(front), None, "", 0
    machines: list[dict[str, Any]] = []
    for k, (x, result, value) in enumerate(zip(front.limits, front.results, front.objectives, strict=True), start=1):
        if result.best is None or math.isnan(value):
            continue
        sheet, body = None, None
        if first is not None and k == first.number:
            start, shown, sheet = len(machines), result.best, result.sheet()
            body, words = quick_body(result, f"{run}#{k}")
            hint = f"Point {k}. {words}"
            sentence = f"Of point {k}, {first.words}. Each point has its own: ninedof sheet {run}#1 for the first."
            sections["sheet"] = joined(paragraphs([sentence]), sheet_html(sheet))
        title = f"point {k}: {limit} {limit_text(front, x)}"
        machines.append(design_machine(title, result.best, result.study, sheet, body))
    if machines:
        sections["machine"] = paragraphs([hint])
    values = [x for x in front.objectives if not math.isnan(x)]
    figures = [
        ("limits solved", len(front)),
        ("objective", f"{max(values):.6f} to {min(values):.6f}" if values else "no design"),
        ("interrupted", "yes" if front.interrupted else "no"),
    ]
    headline = f"{front.study.words[:1].upper()}{front.study.words[1:]} against {limit}"
    view = scene.scene(machines, front.study.unit, start) if machines else None
    machine = None if shown is None else (shown.geometry, shown.configuration)
    return Page("trade-off", headline, figures, sections, view, bool(values) and not front.interrupted, machine)


# --- The question of a study ------------------------------------------------------------------------------------------

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
    bodies = {name.replace("_", " "): x for name in MASSES if (x := getattr(study.masses, name))}
    masses = [amount(f"{name} {x:g}", "kg" * bool(study.force_unit)) for name, x in bodies.items()]
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
