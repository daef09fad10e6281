"""`ninedof admissible`: all designs that fulfil a requirement, proved."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import ninedof as nd
from ninedof.cli.answer import Answer
from ninedof.cli.options import SCHEDULER, THREADS, VARIABLES, Options, argument, changes_option, option, struct
from ninedof.cli.scheduler import executor_at
from ninedof.cli.screen import DONE, INTERRUPTED, Screen
from ninedof.proof.admissible.admissible import ENOUGH
from ninedof.proof.admissible.result import UNDECIDED, NoRoom, half_widths, room_words
from ninedof.proof.design_range import MOST_VARIED, DesignRange, design_range
from ninedof.records.load import split
from ninedof.records.proofs import admissible_file, earlier_file, load_admissible
from ninedof.support.kept.store import folder_of
from ninedof.support.running import ended_by_time, goes_on
from ninedof.support.units import amount, plain_name
from ninedof.tables import Table, columns

TIME, RESOLUTION = 300.0, 0.01
SIDES = ("down", "up")
DESIGNS = Path("designs")  # --out that is named where none was given
WORDS = {"exists": "yes", "none": "no"}
Ranges = Mapping[str, tuple[float, float] | None]
EXAMPLES = """
  ninedof admissible runs/20260101-120000 --vary a2 --vary b1
  ninedof admissible runs/20260101-120000 --vary a2=400:850 --vary b1 --condition 4.2 --time 300
  ninedof admissible study.toml --vary a2 --vary b1 --set zp=480 --set zs=320 --out designs
  ninedof admissible runs/20260101-120000 --vary a2 --vary b1 --set zs=-5%
  ninedof admissible study.toml --vary a2 --vary b1 --vary zp --set zs=320 --scheduler tcp://head:8786
  ninedof admissible runs/20260101-120000 --around    how far each dimension may go
  ninedof admissible runs/20260101-120000 --vary a2 --vary b1 --around --proportions a2=2,b1=1"""


@struct
class _Options(Options):
    of: str = argument("A study file, a run folder, or RUN#7 of a front.", metavar="STUDY|RUN")
    vary: list[str] | None = option(
        "A variable that varies, NAME or NAME=LOW:HIGH; angles NAME_deg=LOW:HIGH. Needed, but with --around alone.",
        values=VARIABLES,
    )
    set: list[str] | None = option(
        "Another variable: zs=320, or zs=+10%. Of one that varies: which design is marked and where "
        "--around begins. Repeatable.",
        values=VARIABLES,
    )
    condition: float | None = option("A bound of the condition number besides the limits.")
    time: float | None = option(
        f"Seconds, {TIME:g} by default, with --scheduler of each root; what is proved by then is kept."
    )
    resolution: float | None = option(f"The least size of a box, as a part of each range; {RESOLUTION:g} by default.")
    around: bool = option(
        "How far each variable may go at once, from the design; without --vary this alone, of all free variables.",
        False,
        "--around",
    )
    proportions: str | None = option("With --around: half widths in these proportions, a2=2,b1=1.")
    certificate: Path | None = option("A file of the boxes with reasons for `ninedof check`.")
    out: Path | None = option("A folder for the answer; that of the run by default.")
    threads: int | None = option(THREADS)
    scheduler: str | None = option(f"{SCHEDULER} the 64 roots of the box.")


def admissible(options: _Options) -> Answer:
    """Divide a box of designs into those proved to keep every limit at every pose, those proved not to, and the rest.

    The other variables have the values of the run or of the study. The same command again goes on. For a study with
    actuators: for which of their rows there is a design.
    """
    screen = options.screen
    of, folder = _of(options)
    vary, at = dict(map(_vary, options.vary or ())), changes_option(options.set or ())
    if options.proportions is not None and not options.around:
        raise ValueError("--proportions: got it without --around, expected both")
    if isinstance(of, nd.Study) and of.actuators:
        return _rows(screen, of, options, vary, at)
    if not vary:
        return _around_alone(screen, of, options, at)
    question = design_range(of, vary, at, options.condition)
    if options.proportions is not None:
        half_widths(question, _proportions(options.proportions))
    file = None if folder is None else admissible_file(folder, question)
    earlier = None if file is None else load_admissible(file, question)
    goes_on(DESIGNS if file is None else None)
    how = _how(options) | {"at": at, "condition_number": options.condition, "resume": earlier}
    bars = screen.bar("boxes" if options.scheduler is None else "points", "designs")
    with executor_at(options.scheduler) as executor, bars as bar:
        designs = nd.admissible(of, vary, **how, executor=executor, progress=bar)
    data: dict[str, Any] = {name: getattr(designs, name) for name in ("shares", "excluded", "designs", "boxes")}
    screen.print(*designs.sentences(), *_marked(question, at))
    ended = designs.seconds - (earlier.seconds if earlier else 0.0) >= how["time_limit"] and not designs.interrupted
    if ended and designs.shares[UNDECIDED] > ENOUGH:
        screen.print("The time ended the search: a longer --time may decide more.")
        if file is not None:
            ended_by_time()
    if file is None and designs.interrupted:
        screen.print("Without --out nothing of it is kept.")
    own = isinstance(of, nd.Result) and not at
    if own and designs.state_of([[designs.of.at[name] for name in designs.vary]]) == [UNDECIDED]:
        why = " yet" if ended or designs.interrupted else ": an optimum reaches limits or ends of ranges exactly"
        screen.print(f"The design of the run is not decided itself{why}.")
    if file is not None:
        file.parent.mkdir(parents=True, exist_ok=True)
        if earlier is None and file.exists():  # that of another question
            other = file.replace(earlier_file(file))
            screen.print(f"the designs of another question are kept as {other}")
        designs.save(file)
        if drawn := len(designs.vary) > 1:
            nd.plot.save(nd.plot.admissible(designs), file.parent, file.stem)
        screen.print(f"designs {file}" + f", figure {file.stem} (PNG, SVG, PDF)" * drawn)
        data["file"] = str(file)
    if options.certificate is not None:
        designs.save_certificate(options.certificate)
        screen.print(f"certificate {options.certificate}")
        data["certificate"] = str(options.certificate)
    if options.around and not designs.interrupted:
        data |= _around(screen, designs, options)
    return Answer([], data, INTERRUPTED if designs.interrupted else DONE)


def _marked(question: DesignRange, at: Iterable[str]) -> list[str]:
    """Return what --set of variables that vary means; nothing where there are none."""
    names = [name for name in map(plain_name, at) if name in question.vary and name not in question.moved]
    verb = "vary" if len(names) > 1 else "varies"
    return [f"{' and '.join(names)} {verb}: --set says which design is marked and where --around begins."] * bool(names)


def _rows(screen: Screen, study: nd.Study, options: _Options, vary: Ranges, at: Mapping[str, Any]) -> Answer:
    """Return for which rows of its actuators a study has designs; nothing is kept."""
    alone = "for a study with actuators: its answer is printed alone"
    options.refuse(alone, "condition", "around", "proportions", "certificate", "out", "scheduler")
    if both := [name for name in at if plain_name(name) in map(plain_name, vary)]:
        raise ValueError(f"--set: got {both[0]}, which varies, expected variables that do not: no design is marked")
    with screen.bar("boxes", "actuators") as bar:
        answer = nd.admissible_actuators(study, vary, at=at, **_how(options), progress=bar)
    heads = columns("legs", "actuator", "a design exists", "for example")
    rows = [(one.kind, one.row.name, WORDS.get(one.state, one.state), _example(one, study)) for one in answer.rows]
    data = {"rows": [one.to_dict() for one in answer.rows]}
    undecided = any(one.state == UNDECIDED for one in answer.rows)
    more = ["Undecided: a longer --time may decide it."] if undecided else []
    return Answer(
        [Table(f"Of designs with {answer.of}", heads, rows), *more, *study.tolerances.remark()],
        data,
        INTERRUPTED if answer.interrupted else DONE,
    )


def _how(options: _Options) -> dict[str, Any]:
    return {
        "time_limit": TIME if options.time is None else options.time,
        "resolution": RESOLUTION if options.resolution is None else options.resolution,
        "threads": options.threads or 0,
    }


def _example(one: nd.AdmissibleRow, study: nd.Study) -> str:
    values = ((name, f"{name} = {study.shown(name, value):.5g}") for name, value in (one.design or {}).items())
    return ", ".join(amount(words, study.unit_of(name)) for name, words in values)


def _of(options: _Options) -> tuple[nd.Study | nd.Result, Path | None]:
    if (place := Path(options.of)).suffix == ".toml" and place.is_file():
        return nd.Study.load(place), options.out
    result = nd.load(options.of)
    if not isinstance(result, nd.Result):
        raise ValueError(f"{options.of}: got no design of a study, expected a study file, a run or RUN#7 of a front")
    return result, options.out or folder_of(split(options.of)[0])


def _vary(text: str) -> tuple[str, tuple[float, float] | None]:
    name, equals, ends = text.partition("=")
    try:
        low, high = (float(end) for end in ends.split(":")) if equals else (0.0, 0.0)
    except ValueError:
        raise ValueError(f"--vary: got {text}, expected NAME or NAME=LOW:HIGH") from None
    return name, (low, high) if equals else None


def _around_alone(screen: Screen, of: nd.Study | nd.Result, options: _Options, at: Mapping[str, Any]) -> Answer:
    """Say how far all free variables may go at once; designs are not divided, and nothing is kept."""
    study = of if isinstance(of, nd.Study) else of.study
    free = study.free_variables
    if not options.around:
        raise ValueError(f"--vary: got none, expected one to four of {', '.join(study.variables)}, or --around")
    if not 1 <= len(free) <= MOST_VARIED:
        names = f": {', '.join(free)}" if free else ""
        raise ValueError(f"--vary: got none with {len(free)} free variables{names}, expected one to four")
    alone = "with --around and no --vary: designs are not divided"
    options.refuse(alone, "certificate", "out", "scheduler", "time", "resolution", "threads")
    designs = nd.admissible(of, free, at=at, condition_number=options.condition, time_limit=0.0)
    return Answer(study.tolerances.remark(), _around(screen, designs, options))


def _proportions(text: str) -> dict[str, float]:
    pairs = [part.partition("=") for part in text.split(",")]
    try:
        out = {name.strip(): float(value) for name, _, value in pairs}
    except ValueError:
        out = {}
    if len(out) < len(pairs):
        raise ValueError(f"--proportions: got {text!r}, expected NAME=NUMBER,NAME=NUMBER, each name once")
    return out


def _around(screen: Screen, designs: nd.AdmissibleSet, options: _Options) -> dict[str, Any]:
    """Print how far the design may go; that it lies on a limit is an answer too."""
    proportions = None if options.proportions is None else _proportions(options.proportions)
    held = f", at {designs.of.held}" if designs.of.held else ""
    try:
        with screen.bar("boxes", "around") as bar:
            room = designs.around(proportions=proportions, progress=bar)
    except NoRoom as error:
        words = f": {error.reason}" if error.reason else ""
        screen.print(f"No box around {designs.of.values(designs.vary)}{held} is proved{words}.")
        return {"around": None, "reason": error.reason}
    screen.print(f"Proved around {designs.of.values(designs.vary)}{held}: {room_words(designs.of, room)}.")
    ends = [
        (f"{name} {side}", end) for name, two in room.ended_by.items() for side, end in zip(SIDES, two, strict=True)
    ]
    screen.print(Table("What ends each side; designs beyond a limit break it", columns("", "ended by"), ends))
    return {"around": {name: list(ends) for name, ends in room.items()}, "ended_by": room.ended_by}
