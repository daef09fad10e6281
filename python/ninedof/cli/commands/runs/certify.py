"""`ninedof certify`: prove that the machine of a run keeps its limits at every pose of its region."""

from __future__ import annotations

import math
from collections.abc import Mapping
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any

import ninedof as nd
from ninedof.cli.answer import Answer, write_and_print
from ninedof.cli.options import THREADS, Options, argument, option, struct, word_or_number
from ninedof.cli.screen import DONE, INTERRUPTED, NO_RESULT, Screen, bold
from ninedof.optimize.reserve import largest as largest_tolerance
from ninedof.optimize.reserve import machine_of
from ninedof.proof.machine import FOR_LIMITS, Certify
from ninedof.proof.machine_file import require_replayable
from ninedof.proof.machine_record import UNDECIDED, outward
from ninedof.records.proofs import certificate_file, earlier_file, kept_certificates, save_certificate
from ninedof.robot.geometry import LEGS
from ninedof.singularity.architecture import architecture_sentences
from ninedof.support.margins import margin_words
from ninedof.support.running import ended_by_time, goes_on
from ninedof.support.units import amount, with_unit
from ninedof.tables import Table, columns

LARGEST = "max"
EXAMPLES = """
  ninedof certify runs/20260101-120000                certify.json in the run folder
  ninedof certify runs/20260101-120000 --condition 3.4 --time 600
  ninedof certify runs/20260101-120000 --tolerance 0.05       of every machine built so exactly
  ninedof certify runs/20260101-120000 --certificate machine.certificate     for `ninedof check`
  ninedof certify runs/20260101-120000                again: goes on where time was over"""


@struct
class _Options(Options):
    run: str = argument("A run folder, or RUN#7: point 7 of a front, counted from 1.")
    condition: float | None = option("A bound of the condition number to be proved too.")
    gap: float = option("Relative width of the enclosure of the worst condition number.", 0.05)
    time: float = option("Seconds for the condition number; each limit has 5 at least.", 300.0)
    tolerance: str | None = option("Of joints and legs as built, a length, or max: the largest that is proved.")
    slack: float = option("By which limits may be violated, relative.", 1e-6)
    threads: int | None = option(THREADS)
    certificate: Path | None = option("Also write a file that `ninedof check` replays.")


def certify(options: _Options) -> Answer:
    """Prove that a machine keeps its limits at every pose of its region, not only at those looked at."""
    screen = options.screen
    run = options.run
    how: dict[str, Any] = {
        "condition_number": options.condition,
        "slack": options.slack,
        "time_limit": options.time,
        "threads": options.threads or 0,
    }
    tolerance: Any = options.tolerance
    if tolerance is not None:
        expected = f'a length from 0 on, or "{LARGEST}"'
        tolerance = word_or_number("--tolerance", tolerance, [LARGEST], expected)
        if tolerance != LARGEST and not 0.0 <= tolerance < math.inf:
            raise ValueError(f"--tolerance: got {options.tolerance!r}, expected {expected}")
    result = nd.load(run)
    if not isinstance(result, nd.Result):
        raise ValueError(
            f"{run}: got no design of a study, expected a run of `ninedof optimize` or RUN#7, a point of a front"
        )
    largest, timed = tolerance == LARGEST, False
    numbers = Certify(**how, gap=options.gap, tolerance=None if largest else tolerance)
    built = numbers.built(result.study, machine_of(result)[1])  # before anything is written
    file = certificate_file(run)
    try:
        earlier = nd.load_certificate(run) if file.exists() else None
    except ValueError as error:
        raise ValueError(f"{error}; once it is removed, the proof begins anew") from None
    goes_on()
    if largest:
        built, timed = _largest_of(result, how, screen)
    if options.certificate is not None:
        require_replayable(result.study, built)
    certificates = kept_certificates(file)
    if earlier is not None and earlier.tolerances != built:  # a proof of other machines is kept, and not gone on with
        other = save_certificate(earlier, _place_of(earlier, certificates, file))
        screen.print(f"the certificate for other tolerances is kept as {other}")
        earlier = None
    if earlier is None:
        fits = (one for one in certificates.values() if one.tolerances == built and result.is_certified_by(one))
        earlier = min(fits, key=lambda one: (not one.proved, one.condition[1]), default=None)
    states = []

    def keep(so_far: nd.MachineCertificate) -> None:
        with suppress(OSError):  # a full disk: the proof is worth more than its states
            states.append(save_certificate(so_far, file))

    try:
        with screen.bar("boxes", "certify") as bar:
            certificate = result.certify(
                **how, gap=options.gap, tolerance=built, resume=earlier, progress=bar, keep=keep
            )
    except KeyboardInterrupt:
        what = "what is proved so far is kept" if states else "the run folder is as it was"
        screen.print(bold("interrupted", f" before the limits were proved: {what}"))
        raise
    except ValueError as error:
        if not str(error).startswith("resume: "):
            raise
        raise ValueError(f"{file}: {str(error).removeprefix('resume: ')}") from None
    data = certificate.to_dict() | {"left": []}
    sentences = certificate.sentences() + result.study.tool.remark(result.study.unit)
    sentences += architecture_sentences(result, result.study.unit)
    if largest:
        sentences.append(_largest(certificate, timed))
    elif tolerance == 0.0:
        sentences += result.study.tolerances.remark()
    longest = max(options.time, FOR_LIMITS)
    longer: list[str] = []
    undecided = any(one.answer == UNDECIDED for one in certificate.limits)
    if certificate.limits_timed:
        longer = ["--time", f"{4.0 * longest:g}"]
        sentences.append(
            f"Each limit had {longest:g} s, and begins anew: a longer --time may decide it. "
            f"`ninedof sheet {run}` has the worst values that a search meets, unproved."
        )
    elif not certificate.left_count and not certificate.interrupted and undecided:
        smaller = "smaller tolerances may" * bool(built) or "a narrower region may"
        sentences.append(f"No longer --time decides what is undecided: its search came to an end; {smaller}.")
    if (certificate.left_count or longer) and not certificate.interrupted:
        ended_by_time(without="--time" if longer else "", instead=longer)
    answer = Answer([certificate_table(certificate), *sentences], data)
    write_and_print(screen, answer, partial(save_certificate, certificate, file))
    screen.print(f"certificate {file}, {certificate.seconds:.0f} s")
    data |= {"file": str(file)}
    if options.certificate is not None:
        result.save_certificate(certificate, options.certificate)
        screen.print(f"certificate {options.certificate}, for `ninedof check`")
        data |= {"certificate": str(options.certificate)}
    status = DONE if certificate.proved and not certificate.left_count else NO_RESULT
    return Answer([], data, INTERRUPTED if certificate.interrupted else status)


def _place_of(
    certificate: nd.MachineCertificate, certificates: Mapping[Path, nd.MachineCertificate], file: Path
) -> Path:
    """Return where a certificate is kept: a new place, or that of one that proves no more of the same machines."""
    for path, one in certificates.items():
        same = (one.machine, one.tolerances, one.slack) == (
            certificate.machine,
            certificate.tolerances,
            certificate.slack,
        )
        if same and one.proved <= certificate.proved and one.condition[1] >= certificate.condition[1]:
            return path
    return earlier_file(file)


def _largest_of(result: nd.Result, how: dict[str, Any], screen: Screen) -> tuple[nd.Tolerances, bool]:
    """Return the largest tolerances, and if time decided; an interruption prints those proved so far."""
    try:
        with screen.bar("boxes", "certify") as bar:
            return largest_tolerance(result, {**how, "progress": bar})
    except KeyboardInterrupt as stop:
        so_far = next((one for one in stop.args if one), None)
        words = _tolerance_words(so_far, result.study.unit) if so_far else "none"
        screen.print(bold("interrupted", f": the largest tolerances proved so far: {words}"))
        raise


def _tolerance_words(built: nd.Tolerances, unit: str) -> str:
    joints, legs = (amount(f"{x:.4g}", unit) for x in (built.joints, built.legs))
    return f"joints {joints}, legs {legs}"


def _largest(certificate: nd.MachineCertificate, timed: bool) -> str:
    if built := certificate.tolerances:
        words = _tolerance_words(built, certificate.unit)
        longer = " The time ended the search: a longer --time may prove larger ones." * timed
        return f"The largest tolerances that were proved{'' if timed else ', to 5 %'}: {words}.{longer}"
    if timed:
        return "No tolerance was proved. The time ended the search: a longer --time may prove some."
    tight = min(certificate.limits, key=lambda limit: limit.margin)
    return (
        f"No tolerance was proved: {tight.name.replace('_', ' ')} leaves no reserve. `[tolerances]` in a study makes "
        "`ninedof optimize` leave one."
    )


def certificate_table(certificate: nd.MachineCertificate) -> Table:
    """Return what is proved of legs, limits and condition number at every pose."""
    heads = columns("at every pose", "limit", ">proved", ">margin", "")
    unit, rows = certificate.unit, list[Any]()
    for leg, (low, high) in zip(LEGS, certificate.lengths, strict=True):
        rows.append((with_unit(leg, unit), "", f"{outward(low, False)} to {outward(high, True)}", "", ""))
    for one in certificate.limits:
        word = "≤" if one.side == "max" else "≥"
        limit = "> 0" if one.limit == 0.0 else f"{word} {one.shown(one.limit):.6g}"
        on_limit = abs(one.margin) <= certificate.slack * (one.limit if one.kind == "sign" else 1.0)
        margin = f"within {certificate.slack:g}" if on_limit else margin_words(one.margin, one.kind)
        proved = f"{word} {one.worded(9 if on_limit else 6)}"
        if not math.isfinite(one.value[one.side == "max"]):
            proved, margin = f"{one.outward(one.value[one.side == 'min'], one.side == 'min', 6)} met so far", ""
        name = with_unit(one.name.replace("_", " "), one.unit(unit, certificate.force_unit))
        rows.append((name, limit, proved, margin, one.answer))
    high = certificate.condition[1]
    if not any(one.name == "condition_number" for one in certificate.limits):
        proved = f"≤ {outward(high, True)}" if math.isfinite(high) else "not yet"
        rows.append(("condition number", "", proved, "", ""))
    return Table("", heads, rows)
