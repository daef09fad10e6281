"""`ninedof resume`: go on with a run that was interrupted or killed."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Annotated

import typer

from ninedof.cli.remembered import resuming
from ninedof.cli.screen import NO_RESULT
from ninedof.proof.machine_record import PROVED, VIOLATED
from ninedof.runs.command_file import FILE, Asked, read_command
from ninedof.runs.machine_file import load_certificate
from ninedof.support.arguments import shown
from ninedof.support.command import running
from ninedof.support.printable import one_line

WITH_FOLDER = ("optimize", "pareto", "sweep", "atlas", "workspace")  # those with --out and --resume
CERTIFY = "certify"
PLACE = 6
EXAMPLES = """[bold]Examples[/bold]

  ninedof resume runs/20260101-120000      after Ctrl-C, a kill or a loss of power: goes on with the same command"""


def resume(
    context: typer.Context,
    run: Annotated[Path, typer.Argument(help="The folder of a run that was interrupted or killed.")],
) -> None:
    """Go on with an interrupted run: its command, with the study it had then. What was kept is not done again.

    Kept are solved studies, points of a front and blocks of a table; what was under way begins anew.
    A proof that ended before all was decided goes on too, for the time that its command has.
    """
    files = _commands(run)
    found = next((one for one in map(read_command, files) if one.status is None), None)
    found = found or next((one for one in map(_improvable, files) if one is not None), None)
    if found is None:
        typer.echo(one_line(f"{run}: the run has ended, there is nothing to resume{''.join(map(_why_not, files))}"))
        return
    name = found.arguments[0]
    command = getattr(context.find_root().command, "commands", {}).get(name)
    if command is None or name not in (*WITH_FOLDER, CERTIFY):
        raise ValueError(f"{run / FILE}: got the command {shown(name)}, expected one that can be resumed")
    rest = list(found.own_arguments())[1:]
    if any(word.partition("=")[0] == "--scheduler" for word in found.arguments):
        print("the run was on a cluster: it goes on here; its own command with --resume goes on there", file=sys.stderr)
    own = ["--resume"] if name == CERTIFY else [f"--out={run}", "--resume"]
    with TemporaryDirectory(prefix="ninedof-") as beside:
        stands_for = None if found.input is None else found.input.write(Path(beside))
        if name == CERTIFY:  # its folder is what it reads
            stands_for = f"{run}#{found.input.point}" if found.input is not None and found.input.point else str(run)
        with (
            resuming(found, stands_for),
            running("ninedof", found.arguments),
            command.make_context(name, [*own, *rest], parent=context) as inner,
        ):
            command.invoke(inner)


def _commands(run: Path) -> list[Path]:
    """Return the files of the commands of a run."""
    files = [file for file in (run / FILE, *sorted(run.glob(f"{CERTIFY}*.{FILE}"))) if file.is_file()]
    if not files:
        what = "no folder" if not run.is_dir() else f"a folder without {FILE}"
        raise ValueError(f"run: got {run}, {what}, expected the folder of an interrupted run")
    return files


def _improvable(file: Path) -> Asked | None:
    """Return the command of a proof that has ended, if more time helps, as one that has not; also if it is gone."""
    found = read_command(file)
    if found.status != NO_RESULT or not _of_certificate(file):
        return None
    again = replace(found, status=None)
    if not _certificate_of(file).exists():
        return again
    proof = load_certificate(_certificate_of(file))
    return again if proof.left_count and all(one.answer != VIOLATED for one in proof.limits) else None


def _why_not(file: Path) -> str:
    """Return what a proof that has ended does not prove; "" where that is nothing."""
    if read_command(file).status != NO_RESULT or not _of_certificate(file):
        return ""
    proof = load_certificate(_certificate_of(file))
    limits = ", ".join(f"{one.name.replace('_', ' ')} {one.answer}" for one in proof.limits if one.answer != PROVED)
    return f" (not proved, and no matter of time: {limits})"


def _of_certificate(file: Path) -> bool:
    return file.name != FILE


def _certificate_of(file: Path) -> Path:
    return file.with_name(f"{file.name.removesuffix(f'.{FILE}')}.json")
