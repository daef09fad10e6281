"""The command line: parses, calls one function, prints."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from ninedof.design.indices import computed

app = typer.Typer(
    add_completion=False,
    no_args_is_help=False,
    rich_markup_mode="rich",
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    help="Optimum design of the nine-degree-of-freedom parallel manipulator of Zanganeh and Angeles.",
    epilog="Without a command: [bold]ninedof optimize[/bold], the paper's design problem.",
)

Json = Annotated[
    bool, typer.Option("--json", help="Print the result as JSON on standard output, words on standard error.")
]
Threads = Annotated[
    int | None, typer.Option(help="Threads; one a processor by default. The result does not depend on it.")
]

StudyFile = Annotated[Path | None, typer.Argument(help="A study file (TOML). The paper's study if none is given.")]
Out = Annotated[Path | None, typer.Option(help="Run folder to create; runs/<time> by default.")]
Starts = Annotated[int | None, typer.Option(help="Starts, in place of the study's.")]
Figures = Annotated[bool, typer.Option("--figures/--no-figures", help="Draw the figures.")]


@app.command(
    epilog="[bold]Examples[/bold]\n\n"
    "  ninedof optimize                         the paper's problem, beside the published optimum\n\n"
    "  ninedof optimize study.toml --out run1   a study of your own, run folder run1\n\n"
    "  ninedof optimize --json --no-figures | jq .optimization.status"
)
def optimize(
    study: StudyFile = None,
    out: Out = None,
    starts: Starts = None,
    seed: Annotated[int | None, typer.Option(help="Seed, in place of the study's.")] = None,
    threads: Threads = None,
    figures: Figures = True,
    check: Annotated[bool, typer.Option("--check", help="Verify the best design by other means, and say how.")] = False,
    json: Json = False,
) -> None:
    """Find the best design of a study: by default, the one of least condition number."""
    from ninedof.cli import commands

    raise typer.Exit(commands.optimize(study, out, starts, seed, threads, figures, json, check))


@app.command(
    epilog="[bold]Examples[/bold]\n\n"
    "  ninedof pareto --against radius_ratio    how the paper's optimum falls as the base may grow\n\n"
    "  ninedof pareto study.toml --against stroke --value 0.1 --value 0.2 --value 0.4"
)
def pareto(
    study: StudyFile = None,
    against: Annotated[
        str, typer.Option(help="The limit that is swept: a constraint, or condition_limit.")
    ] = "radius_ratio",
    value: Annotated[
        list[float] | None, typer.Option(help="A limit to solve; give it several times. Found by the tool if left out.")
    ] = None,
    points: Annotated[int, typer.Option(help="How many limits, where the tool finds them.")] = 13,
    out: Out = None,
    starts: Starts = None,
    threads: Threads = None,
    figures: Figures = True,
    json: Json = False,
) -> None:
    """Trade the condition number against a limit: the least of it for each value."""
    from ninedof.cli import commands

    raise typer.Exit(commands.pareto(study, against, value, points, out, starts, threads, figures, json))


@app.command(
    epilog="[bold]Examples[/bold]\n\n"
    "  ninedof evaluate --a1 0 --a2 5.8124 --b1 2.9062 --b2 0 --zp 3.9828 --zs 2.4435\n\n"
    "  ninedof evaluate design.toml --lc optimal\n\n"
    "  ninedof evaluate runs/20260101-120000    the best design of a run"
)
def evaluate(
    design: Annotated[
        Path | None, typer.Argument(help="A design file (TOML), a run folder or its record.json.")
    ] = None,
    a1: Annotated[float | None, typer.Option(help="Base side (eq. 37).")] = None,
    a2: Annotated[float | None, typer.Option(help="Base side.")] = None,
    b1: Annotated[float | None, typer.Option(help="Platform side (eq. 38).")] = None,
    b2: Annotated[float | None, typer.Option(help="Platform side.")] = None,
    zp: Annotated[float | None, typer.Option(help="Height of the platform.")] = None,
    zs: Annotated[float | None, typer.Option(help="Height of the internal point.")] = None,
    theta_z_deg: Annotated[float | None, typer.Option(help="Twist of the platform, degrees; 0 by default.")] = None,
    lc: Annotated[
        str | None,
        typer.Option(
            help="Characteristic length: a number, optimal, natural, mean_leg or platform_radius; 1 by default."
        ),
    ] = None,
    json: Json = False,
) -> None:
    """Print the indices of one design and configuration."""
    from ninedof.cli import commands

    sides = {"a1": a1, "a2": a2, "b1": b1, "b2": b2, "zp": zp, "zs": zs}
    raise typer.Exit(commands.evaluate(design, sides, theta_z_deg, lc, json))


Resume = Annotated[bool, typer.Option("--resume", help="Go on with the interrupted run in --out.")]
Scheduler = Annotated[
    str | None, typer.Option(help="Address of a Dask scheduler whose workers compute, as tcp://host:8786.")
]


@app.command(
    epilog="[bold]Examples[/bold]\n\n"
    "  ninedof sweep figure-6                   the condition number against displacement, as in the paper's Fig. 6\n\n"
    "  ninedof sweep --over x_p=-1:1:201 --over theta_z_deg=-60:60:121\n\n"
    "  ninedof sweep design.toml --over z_s=-1:1:401 --index singular_values --index leg_lengths\n\n"
    "  ninedof sweep --over a1=0:3:31 --over b2=0:3:31      designs in place of configurations"
)
def sweep(
    what: Annotated[
        str | None,
        typer.Argument(
            help="figure-6, figure-7, or a design: a file (TOML), a run folder or its record.json. The published "
            "design at its best zs if none is given."
        ),
    ] = None,
    over: Annotated[
        list[str] | None,
        typer.Option(
            help="NAME=LOW:HIGH:COUNT or NAME=VALUE,VALUE,..., up to three times. Names: x_p y_p z_p theta_x theta_y "
            "theta_z x_s y_s z_s, or a1 a2 b1 b2 zp zs of designs. Angles in radians, or in degrees with _deg behind "
            "the name."
        ),
    ] = None,
    index: Annotated[
        list[str] | None,
        typer.Option(
            help=f"What is computed, condition_number by default; may be repeated. One of {', '.join(computed())}."
        ),
    ] = None,
    absolute: Annotated[
        bool, typer.Option("--absolute", help="Values are the coordinates themselves, not displacements.")
    ] = False,
    internal_point: Annotated[
        str | None, typer.Option(help="Where O is while the platform moves: held (default), carried or best.")
    ] = None,
    a1: Annotated[float | None, typer.Option(help="Base side (eq. 37).")] = None,
    a2: Annotated[float | None, typer.Option(help="Base side.")] = None,
    b1: Annotated[float | None, typer.Option(help="Platform side (eq. 38).")] = None,
    b2: Annotated[float | None, typer.Option(help="Platform side.")] = None,
    zp: Annotated[float | None, typer.Option(help="Height of the platform.")] = None,
    zs: Annotated[float | None, typer.Option(help="Height of the internal point.")] = None,
    theta_z_deg: Annotated[float | None, typer.Option(help="Twist of the platform, degrees; 0 by default.")] = None,
    lc: Annotated[str | None, typer.Option(help="Characteristic length: a number or a kind.")] = None,
    points: Annotated[int | None, typer.Option(help="Points of each curve of a figure.")] = None,
    chunk: Annotated[int | None, typer.Option(help="Points a chunk. The result does not depend on it.")] = None,
    out: Out = None,
    resume: Resume = False,
    scheduler: Scheduler = None,
    threads: Threads = None,
    figures: Figures = True,
    json: Json = False,
) -> None:
    """Compute an index over one to three coordinates of the configuration, or variables of the design."""
    from ninedof.cli import commands

    sides = {"a1": a1, "a2": a2, "b1": b1, "b2": b2, "zp": zp, "zs": zs}
    options = commands.SweepOptions(over or (), index or (), absolute, internal_point, lc, points, chunk, threads)
    raise typer.Exit(commands.sweep(what, sides, theta_z_deg, options, out, resume, scheduler, figures, json))


@app.command(
    epilog="[bold]Examples[/bold]\n\n"
    "  ninedof atlas                                        a million designs\n\n"
    "  ninedof atlas --designs 100000000 --out atlas        a hundred million; --resume after an interruption"
)
def atlas(
    designs: Annotated[int, typer.Option(help="How many designs.")] = 1_000_000,
    seed: Annotated[int, typer.Option(help="Shifts the sequence of designs.")] = 0,
    out: Out = None,
    resume: Resume = False,
    scheduler: Scheduler = None,
    figures: Figures = True,
    json: Json = False,
) -> None:
    """Survey the hexagonal family: how its designs are distributed, the best for each size of the base."""
    from ninedof.cli import commands

    raise typer.Exit(commands.atlas(designs, seed, out, resume, scheduler, figures, json))


Ends = Annotated[tuple[float, float] | None, typer.Option(metavar="LOW HIGH")]


@app.command(
    epilog="[bold]Examples[/bold]\n\n"
    "  ninedof workspace --legs 2.5 6.5 --condition 5 --singularity-free\n\n"
    "  ninedof workspace design.toml --legs 2.5 6.5 --x -2 2 --y -2 2 --z 3 7 --out run1\n\n"
    "  ninedof workspace --archetype orientation --angle-deg 60 --legs 2.5 6.5 --json | jq .workspace.volume"
)
def workspace(
    design: Annotated[
        Path | None, typer.Argument(help="A design file (TOML) or a run folder; the published design if none is given.")
    ] = None,
    archetype: Annotated[
        str, typer.Option(help="constant_orientation, orientation, reachable, inclusive or dexterous.")
    ] = "constant_orientation",
    x: Ends = None,
    y: Ends = None,
    z: Ends = None,
    legs: Annotated[
        tuple[float, float] | None, typer.Option(metavar="LOW HIGH", help="Limits of all nine legs.")
    ] = None,
    condition: Annotated[float | None, typer.Option(help="Greatest condition number.")] = None,
    base_cone_deg: Annotated[float | None, typer.Option(help="Greatest angle at a base joint from home.")] = None,
    platform_cone_deg: Annotated[float | None, typer.Option(help="The same at a platform joint.")] = None,
    clearance: Annotated[float | None, typer.Option(help="Least distance of legs that share no joint.")] = None,
    singularity_free: Annotated[
        bool, typer.Option("--singularity-free", help="Connected with home, on its side of every singularity.")
    ] = False,
    angle_deg: Annotated[float | None, typer.Option(help="Region: rotations of at most this angle.")] = None,
    tilt_deg: Annotated[float | None, typer.Option(help="Region: tilts of at most this angle.")] = None,
    torsion_deg: Annotated[float | None, typer.Option(help="Region: torsions of at most this angle.")] = None,
    orientations: Annotated[int | None, typer.Option(help="How many rotations make a set.")] = None,
    position: Annotated[
        tuple[float, float, float] | None,
        typer.Option(metavar="X Y Z", help="Of orientation: where the platform is; the home position by default."),
    ] = None,
    internal_point: Annotated[
        str | None, typer.Option(help="Where O is: best, or a fraction between the plates; 0.5 by default.")
    ] = None,
    lc: Annotated[str | None, typer.Option(help="Characteristic length: a number, or a kind taken at home.")] = None,
    method: Annotated[str, typer.Option(help="octree, grid or sample.")] = "octree",
    tolerance: Annotated[float, typer.Option(help="Error wanted, as a share of the volume.")] = 1e-3,
    resolution: Annotated[int | None, typer.Option(help="Cells along each side before any is divided.")] = None,
    points: Annotated[int | None, typer.Option(help="Poses of the audit, or of each shift of a sample.")] = None,
    seed: Annotated[int | None, typer.Option(help="Of the audit and of a sample; 0 by default.")] = None,
    out: Out = None,
    threads: Threads = None,
    figures: Figures = True,
    json: Json = False,
) -> None:
    """Find where a robot can work: the volume, its boundary and what limits it."""
    from ninedof.cli import commands

    criteria = {
        "leg_limits": legs,
        "condition_number": condition,
        "base_cone": base_cone_deg,
        "platform_cone": platform_cone_deg,
        "leg_clearance": clearance,
        "singularity_free": singularity_free,
    }
    options = commands.WorkspaceOptions(
        archetype=archetype,
        box={"x": x, "y": y, "z": z},
        position=position,
        criteria=criteria,
        region_deg={"angle": angle_deg, "tilt": tilt_deg, "torsion": torsion_deg},
        orientations=orientations,
        internal_point=internal_point,
        lc=lc,
        search={"method": method, "tolerance": tolerance, "resolution": resolution, "points": points, "seed": seed},
        threads=threads,
    )
    raise typer.Exit(commands.workspace(design, options, out, figures, json))


@app.command(epilog="[bold]Example[/bold]\n\n  ninedof paper --json | jq '.[].verdict'")
def paper(threads: Threads = None, json: Json = False) -> None:
    """Print every number of the paper beside ours, with a verdict each."""
    from ninedof.cli import commands

    raise typer.Exit(commands.paper(threads, json))


def _version(value: bool) -> None:
    if value:
        from ninedof import __version__

        typer.echo(__version__)
        raise typer.Exit


@app.callback()
def _root(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version and leave.")
    ] = False,
) -> None:
    pass


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line; bad input ends in one line on standard error and status 2."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    asks_about_itself = bool(given) and given[0] in ("-h", "--help", "--version")
    if not given or given[0].endswith(".toml") or (given[0].startswith("-") and not asks_about_itself):
        given.insert(0, "optimize")
    try:
        app(given, prog_name="ninedof")
    except ValueError as error:
        typer.echo(f"ninedof: {error}", err=True)
        raise SystemExit(2) from None
    except BrokenPipeError:  # the reader went away, `ninedof paper | head`
        sys.stderr.close()
        raise SystemExit(0) from None
    except OSError as error:
        typer.echo(f"ninedof: {error}", err=True)
        raise SystemExit(1) from None
    except KeyboardInterrupt:
        typer.echo("ninedof: interrupted", err=True)
        raise SystemExit(130) from None
