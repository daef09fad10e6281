"""`ninedof workspace`: the workspace of a design, its table and its run folder."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import Annotated, Any

import typer

from ninedof.cli.chosen_design import named_design, with_length
from ninedof.cli.job_report import report_words, told, with_report
from ninedof.cli.long_run import CHUNKS, Finished, run_folder
from ninedof.cli.options import DesignOrPublished, Figures, Json, Lc, Out, Report, Resume, Threads
from ninedof.cli.remembered import given as given_file
from ninedof.cli.screen import DONE, INTERRUPTED, NO_RESULT, Screen
from ninedof.cli.workspace_limits import compare_poses, criteria_asked, rule_asked
from ninedof.cli.workspace_summary import draw, region_words, sentences, workspace_table
from ninedof.conditioning.characteristic_length import characteristic_length
from ninedof.design.indices import computed
from ninedof.design.region_stack import places_o
from ninedof.robot.configuration import Configuration, arrays_of
from ninedof.robot.geometry import triples
from ninedof.runs.command_file import Input
from ninedof.runs.folder import write_run
from ninedof.support.arguments import finite
from ninedof.support.arrays import thread_argument
from ninedof.workspace import CertifiedWorkspace, WorkspaceMap, certified_workspace
from ninedof.workspace import workspace as find_workspace
from ninedof.workspace.certified import GAPS, require_certifiable
from ninedof.workspace.question_words import asked_lines
from ninedof.workspace.region_share import box_about, region_share
from ninedof.workspace.study_question import box_around, built_ranges, narrowed

Ends = Annotated[tuple[float, float] | None, typer.Option(metavar="LOW HIGH")]
PLACE = 6
OF_THE_MAP = ("method", "tolerance", "resolution", "points", "seed", "index")
EXAMPLES = """[bold]Examples[/bold]

  ninedof workspace --legs 1.5 6.5 --condition 5 --singularity-free

  ninedof workspace runs/20260101-120000    the limits of the study, O as the design has it

  ninedof workspace runs/20260101-120000 --upper 1.5 3 --clearance 0 --no-figures

  ninedof workspace design.toml --legs 2.5 6.5 --x -2 2 --y -2 2 --z 3 7 --out run1

  ninedof workspace runs/20260101-120000 --certify --gap 0.02    bounds of the volume, proved

  ninedof workspace --archetype orientation --angle-deg 60 --legs 1.5 6.5 --json | jq .workspace.volume"""


def workspace(
    design: DesignOrPublished = None,
    archetype: Annotated[
        str, typer.Option(help="constant_orientation, orientation, reachable, inclusive or dexterous.")
    ] = "constant_orientation",
    x: Ends = None,
    y: Ends = None,
    z: Ends = None,
    legs: Annotated[
        tuple[float, float] | None, typer.Option(metavar="LOW HIGH", help="Limits of all nine legs; HIGH may be inf.")
    ] = None,
    external: Annotated[
        tuple[float, float] | None, typer.Option(metavar="LOW HIGH", help="Of the external legs, besides.")
    ] = None,
    upper: Annotated[
        tuple[float, float] | None, typer.Option(metavar="LOW HIGH", help="Of the upper internal legs, besides.")
    ] = None,
    lower: Annotated[
        tuple[float, float] | None, typer.Option(metavar="LOW HIGH", help="Of the lower internal legs, besides.")
    ] = None,
    condition: Annotated[float | None, typer.Option(help="Greatest condition number.")] = None,
    base_cone_deg: Annotated[float | None, typer.Option(help="Greatest angle at a base joint from home.")] = None,
    platform_cone_deg: Annotated[float | None, typer.Option(help="The same at a platform joint.")] = None,
    base_cone_axis: Annotated[
        tuple[float, float, float] | None,
        typer.Option(metavar="X Y Z", help="Axis of the cones of the base, in place of the legs at home."),
    ] = None,
    platform_cone_axis: Annotated[
        tuple[float, float, float] | None, typer.Option(metavar="X Y Z", help="The same at the platform.")
    ] = None,
    clearance: Annotated[float | None, typer.Option(help="Least distance of legs that share no joint.")] = None,
    singularity_free: Annotated[
        bool | None,
        typer.Option(
            "--singularity-free/--any-singularity", help="Connected with home, on its side of every singularity."
        ),
    ] = None,
    study_limits: Annotated[
        bool, typer.Option("--study-limits/--no-study-limits", help="Take the limits of the run's study.")
    ] = True,
    angle_deg: Annotated[float | None, typer.Option(help="Region: rotations of at most this angle.")] = None,
    tilt_deg: Annotated[float | None, typer.Option(help="Region: tilts of at most this angle.")] = None,
    torsion_deg: Annotated[float | None, typer.Option(help="Region: torsions of at most this angle.")] = None,
    orientations: Annotated[int | None, typer.Option(help="Number of rotations of a set.")] = None,
    position: Annotated[
        tuple[float, float, float] | None,
        typer.Option(metavar="X Y Z", help="Position of the platform, for orientation; the home position by default."),
    ] = None,
    internal_point: Annotated[
        str | None,
        typer.Option(
            help="Position of O: carried, shifted, held, best, or a fraction between the plates; "
            "by default as in the region of the run's study, else the design's."
        ),
    ] = None,
    lc: Lc = None,
    method: Annotated[str, typer.Option(help="octree, grid or sample.")] = "octree",
    tolerance: Annotated[float, typer.Option(help="Wanted error, as a share of the volume.")] = 1e-3,
    resolution: Annotated[int | None, typer.Option(help="Cells along each side before any is divided.")] = None,
    points: Annotated[int | None, typer.Option(help="Poses of the audit, or of each shift of a sample.")] = None,
    seed: Annotated[int | None, typer.Option(help="Of the audit and of a sample; 0 by default.")] = None,
    index: Annotated[
        list[str] | None, typer.Option(help=f"An index over the workspace, may be repeated: {', '.join(computed())}.")
    ] = None,
    certify: Annotated[
        bool, typer.Option("--certify", help="Prove bounds of the volume, and boxes where every pose is allowed.")
    ] = False,
    gap: Annotated[
        float | None, typer.Option(help="Of the bounds, relative to the upper one; 0.05 by default.")
    ] = None,
    time: Annotated[float | None, typer.Option(help="Seconds for the proof; 60 by default.")] = None,
    out: Out = None,
    resume: Resume = False,
    threads: Threads = None,
    figures: Figures = True,
    report: Report = True,
    json: Json = False,
) -> None:
    """Compute the workspace of a robot: its volume, its boundary and what limits it.

    A run brings the limits of its study that a single pose can meet; each option replaces its own. O keeps its place
    between the plates. Of a region study, the box is about the region, which is outlined, and O follows its rule.
    """
    screen = Screen(json)
    thread_argument(threads)
    reads = Input.of(design)
    given = with_length(named_design(design and given_file(design)), lc)
    options = {
        "leg_length": legs,
        "external_length": external,
        "upper_length": upper,
        "lower_length": lower,
        "condition_number": condition,
        "base_cone": _radians("base-cone", base_cone_deg),
        "platform_cone": _radians("platform-cone", platform_cone_deg),
        "base_cone_axis": base_cone_axis,
        "platform_cone_axis": platform_cone_axis,
        "leg_clearance": clearance,
        "singularity_free": singularity_free,
    }
    study = given.study
    home = given.configuration
    region_asked = None if study is None else study.objective.region
    criteria, own, left = criteria_asked(study if study_limits else None, float(home.position[2]), options)
    if study_limits and compare_poses(left, options):
        built = built_ranges(given.geometry, home, region_asked, given.leg_ranges)
        if built is not None:
            criteria = narrowed(criteria, *built)
            own.discard("leg_limits")
    if not criteria:
        raise ValueError("workspace: got no criterion, expected at least one of --legs, --condition, --clearance, ...")
    if method == "grid":
        for name, value in _given({"points": points, "seed": seed}).items():
            raise ValueError(f"--{name}: got {value}, expected none with --method grid")
    region = {
        "angle": _radians("angle", angle_deg),
        "tilt": _radians("tilt", tilt_deg),
        "torsion": _radians("torsion", torsion_deg),
    }
    length = given.characteristic_length
    if isinstance(length, str):
        length = float(characteristic_length(given.geometry, given.configuration, length))
    fixed_position = None if archetype != "orientation" else home.position if position is None else position
    turns = archetype not in ("constant_orientation", "orientation")
    others = {
        "archetype": archetype,
        "criteria": criteria,
        "characteristic_length": float(length),
        "region": _given(region) or None,
        "orientations": orientations,
        "internal_point": rule_asked(internal_point, given.geometry, home, region_asked, fixed_position, turns),
        "method": method,
        "tolerance": tolerance,
        "resolution": resolution,
        "points": points,
        "seed": seed,
        "index": index or None,
        "unit": given.unit or None,
    }
    about = None if region_asked is None else box_about(region_asked, home)
    proof = _given({"gap": gap, "time_limit": time})
    if certify:
        require_certifiable(archetype, others["internal_point"])
        finite("--gap", proof.get("gap", 0.5), *GAPS)
        finite("--time", proof.get("time_limit", 0.0), 0.0)
    elif proof:
        name, value = next(iter(proof.items()))
        raise ValueError(f"--{name.removesuffix('_limit')}: got {value:g} without --certify, expected both")
    asked = _given(others) | _place(home, archetype, {"x": x, "y": y, "z": z}, position, about)
    question = {"geometry": triples(given.geometry), "home": arrays_of(home), **asked}
    with run_folder(out, resume, reads) as directory:
        kept = Finished(directory / CHUNKS, {**question, "proof": proof if certify else None})

        def search() -> WorkspaceMap:
            with screen.poses(archetype.replace("_", " ")) as bar:
                return find_workspace(given.geometry, **asked, home=home, threads=threads, progress=bar.show)

        found = kept.result(0, WorkspaceMap, search)

    def words() -> None:
        for line in asked_lines(asked, home, own, left, given.unit):
            screen.print(line)
        screen.print(workspace_table(found))
        for sentence in sentences(found):
            screen.print(sentence)

    with told(screen, words, {"workspace": found.to_dict()}) as once:
        write_run(found, directory, None, question)  # at once: an interruption of what follows does not lose the map
        once()
    if certify and not found.interrupted:

        def prove() -> CertifiedWorkspace:
            with screen.boxes("proving") as bar:
                return certified_workspace(
                    given.geometry,
                    **{name: value for name, value in asked.items() if name not in OF_THE_MAP},
                    **proof,
                    home=home,
                    threads=threads,
                    progress=bar,
                )

        proved = kept.result(1, CertifiedWorkspace, prove)
        if found.method != "sample" and not found.interrupted:
            proved = proved.with_estimate(found.volume, found.error)
        found = replace(found, certified=proved)
        of_proof = partial(screen.print, "\n".join(proved.sentences()))
        with told(screen, of_proof, {"workspace": found.to_dict()}) as once:
            write_run(found, directory, None, question)
            once()
    share = None
    if region_asked is not None and places_o(region_asked) and not found.interrupted:
        share = region_share(region_asked, given.geometry, home, criteria, float(length))
        screen.print(region_words(region_asked, share, given.unit))
    stopped = found.interrupted or (found.certified is not None and found.certified.interrupted)
    drawn = figures and found.volume > 0.0 and not stopped and found.method != "sample"
    outlined = None if archetype == "orientation" else region_asked
    drawing = partial(draw, found, screen, home, outlined) if drawn else None
    data = {"workspace": found.to_dict()} | ({} if share is None else {"region": share._asdict()})
    with told(screen, lambda: None, data):
        record = write_run(found, directory, with_report(drawing, figures and report and not stopped, screen), question)
    arrays = "map.npz" if found.certified is None else "map.npz, certified.npz"
    names = sorted(path.stem for path in directory.glob("*.png"))
    figure = f", figure{'s' * (len(names) > 1)} {', '.join(names)} (PNG, SVG, PDF)" if drawn else ""
    screen.print(f"run folder {directory}: {record.name}, {arrays}{figure}{report_words(directory)}")
    screen.data(data | {"record": str(record)})
    if stopped:
        raise typer.Exit(INTERRUPTED)
    raise typer.Exit(DONE if found.volume > 0.0 else NO_RESULT)


def _given(entries: Mapping[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in entries.items() if value is not None}


def _radians(name: str, degrees: float | None) -> float | None:
    return None if degrees is None else math.radians(finite(f"--{name}-deg", degrees, 0.0, 180.0))


def _place(
    home: Configuration,
    archetype: str,
    box: Mapping[str, Any],
    position: tuple[float, float, float] | None,
    about: tuple[Any, Any] | None,
) -> dict[str, Any]:
    """Return the box, by default that about a region, or the fixed position and rotation, of an archetype."""
    if archetype == "orientation":
        if _given(box):
            raise ValueError("workspace: got a box, expected none for orientations at one position")
        return {"position": home.position if position is None else position, "rotation": home.rotation}
    if position is not None:
        raise ValueError(f"--position: got {position}, expected none but for --archetype orientation")
    low, high = box_around(home) if about is None else about
    around = [(low[k], high[k]) if box[name] is None else box[name] for k, name in enumerate("xyz")]
    rotation = {"rotation": home.rotation} if archetype == "constant_orientation" else {}
    return rotation | {"box": tuple(zip(*around, strict=True))}
