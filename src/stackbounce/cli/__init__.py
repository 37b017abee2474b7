"""The command line: ``stackbounce --help`` lists it."""

import os
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from stackbounce.errors import InvalidValue, StackbounceError

if TYPE_CHECKING:
    from rich.console import Console

__all__ = ["app", "main"]

app = typer.Typer(
    name="stackbounce",
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)

AsJson = Annotated[bool, typer.Option("--json", help="Print JSON, for machines.")]


@app.callback(invoke_without_command=True)
def stackbounce(
    context: typer.Context,
    version: Annotated[bool, typer.Option("--version", help="Print the version.")] = False,
) -> None:
    """What happens when a stack of balls hits the floor."""
    if version:
        from stackbounce.version import __version__

        typer.echo(f"stackbounce {__version__}")
    elif context.invoked_subcommand is None:
        typer.echo(context.get_help())


What = Annotated[
    list[str],
    typer.Argument(
        metavar="SCENARIO|BALLS",
        help="A scenario file in TOML, or balls of the catalogue, the lowest first.",
        show_default=False,
    ),
]
Height = Annotated[
    str | None, typer.Option(metavar="LENGTH", help="Height fallen from rest, such as 0.63m.")
]
Speed = Annotated[str | None, typer.Option(metavar="SPEED", help="Impact speed, such as 3.53m/s.")]
Gap = Annotated[
    list[str] | None,
    typer.Option(metavar="LENGTH", help="Gap between two balls; once per pair, lowest first."),
]
Contact = Annotated[
    list[str] | None,
    typer.Option(
        metavar="LAW",
        help="Contact below a ball, such as 'Spring stiffness=2.5kN/m'; once per ball, "
        "lowest first. Laws: Rigid, Spring, Hertz, PowerLaw, Dashpot, Viscoelastic, "
        "HuntCrossley, Hysteretic; none for no floor.",
    ),
]
Gravity = Annotated[
    str | None,
    typer.Option(metavar="ACCELERATION", help="Gravity during the run, such as 9.81m/s^2."),
]
Until = Annotated[
    str | None,
    typer.Option(metavar="TIME", help="Stop at this time, not when the balls have parted."),
]
Tolerance = Annotated[
    float, typer.Option(metavar="NUMBER", help="Relative error to aim at under laws not linear.")
]
Plot = Annotated[
    Path | None, typer.Option(metavar="FILE", readable=False, help="Draw it: .svg, .png or .pdf.")
]


@app.command(epilog="For example: stackbounce simulate basketball tennis --height 0.63m --gap 2mm")
def simulate(
    what: What,
    height: Height = None,
    speed: Speed = None,
    gap: Gap = None,
    contact: Contact = None,
    gravity: Gravity = None,
    until: Until = None,
    rtol: Tolerance = 1e-12,
    plot: Plot = None,
    as_json: AsJson = False,
) -> None:
    """Drop a stack of balls and tell how each one bounces."""
    from stackbounce import plots
    from stackbounce import simulate as run
    from stackbounce.calibrate import separate
    from stackbounce.cli import machine, output, scenario, show
    from stackbounce.units import quantity

    if plot is not None:
        output.check_picture(plot)
    chosen = scenario.read(
        what, height=height, speed=speed, gaps=gap, contacts=contact, gravity=gravity
    )
    end = None if until is None else quantity(until, "s", "--until")
    result = run(chosen.drop, until=end, rtol=rtol)
    textbook = None if chosen.drop.rigid else run(separate(chosen.drop))
    if plot is not None:
        output.draw(lambda: plots.bounce(result), plot)
    if as_json:
        typer.echo(machine.text(machine.simulation(chosen, result, textbook)))
    else:
        show.simulation(_console(), chosen, result, textbook)
        if plot is not None:
            typer.echo(f"Picture: {plot}")


@app.command(
    epilog="For example: stackbounce sweep basketball tennis --over balls.0.mass=50g:500g:100:log "
    "--over gaps.0=0mm:5mm:50 --out map.zarr --plot map.png"
)
def sweep(
    what: What,
    over: Annotated[
        list[str],
        typer.Option(
            metavar="PATH=VALUES",
            help="A number that varies: balls.0.mass=50g:500g:40 (start, stop, how many), "
            "contacts.0.stiffness=1kN/m:1MN/m:40:log (in even ratios) or gaps.0=0mm,1mm,5mm; "
            "once per number. Balls, contacts and gaps count from 0, the lowest.",
            show_default=False,
        ),
    ],
    out: Annotated[
        Path,
        typer.Option(
            metavar="FILE",
            readable=False,
            help="File to write all results to: a Zarr store such as map.zarr, or NetCDF such as "
            "map.nc. Stopped, the same command goes on where it was.",
            show_default=False,
        ),
    ],
    height: Height = None,
    speed: Speed = None,
    gap: Gap = None,
    contact: Contact = None,
    gravity: Gravity = None,
    until: Until = None,
    rtol: Tolerance = 1e-12,
    cluster: Annotated[
        str | None,
        typer.Option(metavar="ADDRESS", help="Solve on this cluster: its dask scheduler."),
    ] = None,
    show: Annotated[
        str,
        typer.Option(
            metavar="NAME",
            help="What --plot draws: rebound_ratio, collisions, energy_retained, first_touch or "
            "last_release; of one ball or contact with its number, such as rebound_ratio.0.",
        ),
    ] = "rebound_ratio",
    plot: Plot = None,
    as_json: AsJson = False,
) -> None:
    """Drop a stack for all combinations of other numbers in it, into a Zarr or NetCDF file."""
    from stackbounce.cli import machine, output, scenario, swept
    from stackbounce.units import quantity

    if plot is not None:
        output.check_picture(plot)
    chosen = scenario.read(
        what, height=height, speed=speed, gaps=gap, contacts=contact, gravity=gravity
    )
    if plot is not None:
        swept.check_picture(chosen.drop, over, show)
    end = None if until is None else quantity(until, "s", "--until")
    done = swept.run(chosen.drop, over, out, cluster=cluster, until=end, rtol=rtol)
    if plot is not None:
        output.draw(lambda: swept.picture(done, show), plot)
    if as_json:
        typer.echo(machine.text(swept.summary(done, out)))
    else:
        swept.tell(_console(), done, out, plot)


@app.command(
    epilog="For example: stackbounce measure bounces.wav --mass 57g --height 1m --save ball.toml, "
    "then: stackbounce simulate ball.toml"
)
def measure(
    files: Annotated[
        list[Path],
        typer.Argument(
            metavar="FILE...",
            readable=False,
            help="Sound, force waveform, video track, times of bounces or press curve, as Tracker, "
            "phyphox, Vernier, PASCO, oscilloscopes and spreadsheets write them.",
            show_default=False,
        ),
    ],
    mass: Annotated[
        str | None, typer.Option(metavar="MASS", help="Of the ball, such as 57g.")
    ] = None,
    diameter: Annotated[
        str | None, typer.Option(metavar="LENGTH", help="Of the ball, such as 66mm.")
    ] = None,
    name: Annotated[
        str | None, typer.Option(metavar="NAME", help="Of the ball, for --save.")
    ] = None,
    height: Height = None,
    speed: Speed = None,
    time_constant: Annotated[
        str | None,
        typer.Option(metavar="TIME", help="Of a piezo sensor's droop, such as 0.1s: undoes it."),
    ] = None,
    gravity: Annotated[
        str | None,
        typer.Option(metavar="ACCELERATION", help="Where it was measured, such as 9.81m/s^2."),
    ] = None,
    holds: Annotated[
        str | None,
        typer.Option(
            metavar="KIND",
            help="What the file holds, where it is unsure: sound, knocks, bounces, track, "
            "waveform or 'press curve'.",
        ),
    ] = None,
    column: Annotated[
        list[str] | None,
        typer.Option(
            metavar="COLUMN=MEANING",
            help="What a column is, by its name or its number from 1: 2=force; once per column.",
        ),
    ] = None,
    unit: Annotated[
        list[str] | None,
        typer.Option(metavar="COLUMN=UNIT", help="Unit of a column: x=cm; once per column."),
    ] = None,
    table: Annotated[str | None, typer.Option(metavar="NAME", help="Which table of a zip.")] = None,
    which_run: Annotated[
        str | None, typer.Option("--run", metavar="RUN", help="Which of several runs in a file.")
    ] = None,
    save: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            readable=False,
            help="Write the ball as a scenario for simulate: ball.toml.",
        ),
    ] = None,
    plot: Plot = None,
    as_json: AsJson = False,
) -> None:
    """Find restitutions, stiffnesses, speeds and heights in what was measured, with errors."""
    from stackbounce.cli import machine, measured, output

    if plot is not None:
        output.check_picture(plot)
        if len(files) > 1:
            raise InvalidValue(f"--plot draws one file, got {len(files)}")
    ball = measured.numbers(mass=mass, diameter=diameter)
    about = measured.numbers(
        height=height, speed=speed, time_constant=time_constant, gravity=gravity
    )
    if save is not None:
        measured.check_save(save, ball)
    reading = {
        "holds": holds,
        "names": measured.pairs(column, "--column", "COLUMN=MEANING, such as 2=force"),
        "units": measured.pairs(unit, "--unit", "COLUMN=UNIT, such as x=cm"),
        "table": table,
        "run": which_run,
    }
    weight = {key: ball[key] for key in ("mass",) if key in ball}
    done = measured.run(files, reading, weight | about)
    saved = {} if save is None else measured.save(done, save, **ball, name=name)
    if plot is not None:
        output.draw(lambda: measured.picture(done), plot)
    if as_json:
        typer.echo(machine.text(measured.summary(done, saved)))
        return
    measured.tell(_console(), done)
    if save is not None:
        typer.echo(f"Ball: {save}; now: stackbounce simulate {save}")
    if plot is not None:
        typer.echo(f"Picture: {plot}")


@app.command()
def balls(as_json: AsJson = False) -> None:
    """List the catalogue: the paper's balls, each figure with its source."""
    from stackbounce.cli import machine, show

    if as_json:
        typer.echo(machine.text(machine.catalogue()))
    else:
        show.catalogue(_console())


@app.command()
def paper(
    out: Annotated[
        str, typer.Option(metavar="DIR", help="Folder to write to.", show_default=False)
    ],
    as_json: AsJson = False,
) -> None:
    """Recompute the paper: its figures, its tables, and an audit of every number in it."""
    from stackbounce import cross2007
    from stackbounce.cli import machine, show

    if not out:  # as a path it would be this folder
        raise InvalidValue("--out must name a folder, got ''")
    folder = Path(out)
    audit = cross2007.write(folder, lambda line: typer.echo(line, err=True))
    if as_json:
        typer.echo(machine.text(audit.as_dict()))
    else:
        show.audit(_console(), audit, folder / "index.html")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line.

    Parameters
    ----------
    arguments : sequence of str, optional
        Those after the program's name; default the ones that the process was started with.

    Returns
    -------
    int
        0; 2 after an error of the user's and 1 after any other, in one line on stderr; 130 after an
        interruption.

    Examples
    --------
    >>> main(["--version"])
    stackbounce ...
    0
    """
    if sys.stdout is None:
        return _failed("there is no standard output to write to: it is closed", 1)
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="replace")
    try:
        code = app(arguments, prog_name="stackbounce", standalone_mode=False)
        sys.stdout.flush()
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except StackbounceError as error:
        return _failed(str(error))
    except OSError as error:
        return _failed(f"{error.filename or 'the disk'}: {error.strerror or error}")
    except typer.TyperException as error:
        return _failed(f"{error.format_message()} (see stackbounce --help)")
    except KeyboardInterrupt:
        code = 130
    except MemoryError:
        return _failed("out of memory: ask for fewer balls", 1)
    except Exception as error:
        return _failed(f"unexpected {type(error).__name__}: {error} (please report it)", 1)
    if code == 130:
        typer.echo("stackbounce: interrupted", err=True)
    return int(code or 0)


def _failed(message: str, code: int = 2) -> int:
    line = "".join(c if c.isprintable() else "?" for c in " ".join(message.split()))
    typer.echo(f"stackbounce: error: {line}", err=True)
    return code


def _console() -> "Console":
    from rich.console import Console

    width = Console().width if sys.stdout.isatty() else 100
    return Console(width=min(width, 100), markup=False, highlight=False, emoji=False)
