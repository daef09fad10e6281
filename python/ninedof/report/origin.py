"""The origin of a run, to reproduce it: its command, its study file, its versions."""

from __future__ import annotations

import math
import re
import shlex
from base64 import b64encode
from collections.abc import Mapping
from typing import Any

from ninedof.design.study import Study
from ninedof.optimize.pareto import Front
from ninedof.optimize.pareto.limits import with_degrees
from ninedof.support.text import encode
from ninedof.support.units import degrees_of
from ninedof.tables.html import Html, facts, joined, listing, paragraphs, tag

SAME = "The same study and seed give the same bits, for any number of threads, with the same versions."
SAME_LIMITS = (
    "The same limits, starts and seed. Limits that the run selected itself are solved in another order here, so last "
    "digits may differ."
)
LIST = re.compile(r"\[\n((?: +[-+.\w]+,?\n)+) *\]")  # of numbers, one to a line
POSE, FEW = re.compile(r"\[\[objective\.poses\]\]\n(?:\w+ = .*\n)*\n?"), 6


def of_front(front: Front, record: Any, point: str = "") -> Html:
    """Return how to solve a front again, or the whole front of a point, whose starts come from its neighbours."""
    command = ["ninedof", "pareto", "study.toml", "--against", with_degrees(front.against)]
    for limit in front.limits:
        if math.isfinite(limit):
            command += ["--value", repr(degrees_of(limit) if front.unit == "rad" else limit)]
    sentence = (
        f"Point {point} of a front was solved with its neighbours' designs as starts: this solves the whole front."
    )
    again = of_study(front.study, shlex.join(command), record, SAME_LIMITS)
    return joined(paragraphs([sentence] if point else []), again)


def of_study(study: Study, command: str, record: Any, note: str = SAME) -> Html:
    """Return how to solve a study again; `record` has the versions and the time, `note` says what is the same."""
    import tomli_w

    text = _flat(tomli_w.dumps(study.to_dict()))
    rest = "".join(poses := POSE.findall(text)[FEW:])  # on paper, from which nobody copies, the first poses and a count
    paper = text.replace(rest, f"# and {len(poses)} more, on the screen\n\n") if rest else ""
    data = b64encode(text.encode()).decode()
    file = tag("a", "study.toml", href=f"data:text/plain;base64,{data}", download="study.toml")
    save = "From this page alone: save" if record.command else "Save"
    return joined(
        _made_by(record),
        tag("p", f"{save} the study file below as ", file, ", then:"),
        listing(command),
        _versions(record, [("starts", study.starts), ("seed", study.seed)]),
        paragraphs([note], class_="note"),
        tag("h3", "study.toml"),
        *(
            [tag("div", listing(text), class_="screen"), tag("div", listing(paper), class_="paper")]
            if paper
            else [listing(text)]
        ),
    )


def of_question(question: Mapping[str, Any], record: Any) -> Html:
    """Return what was asked of a run without a study."""
    text = paragraphs(["" if record.command else "The record does not hold what was asked."])
    if question:
        words = paragraphs(["Everything that was asked, as the record of the run has it:"])
        text = joined(words, listing(_flat(encode(question))))
    return joined(_made_by(record), text, _versions(record, []))


def _flat(text: str) -> str:
    """Return TOML or JSON with each list of numbers in one line."""
    return LIST.sub(lambda match: f"[{', '.join(match[1].replace(',', ' ').split())}]", text)


def _made_by(record: Any) -> Html:
    """Return the command line of the run, where the record has it."""
    if not record.command:
        return Html()
    return joined(paragraphs(["The command that made it:"]), listing(record.command))


def _versions(record: Any, more: list[tuple[str, object]]) -> Html:
    return facts(
        [("written", record.created.replace("T", " ").replace("+00:00", " UTC")), *more, *record.versions.items()]
    )
