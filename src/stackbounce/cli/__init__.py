"""The command line: ``stackbounce --help`` lists it."""

import os
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from stackbounce.cli import design_commands, fit, measure_command
from stackbounce.cli.options import (
    AsJson,
    Contact,
    Gap,
    Gravity,
    Height,
    Plot,
    Speed,
    Tolerance,
    What,
)
from stackbounce.cli.output import console
from stackbounce.errors import InvalidValue, StackbounceError

__all__ = ["app", "main"]

app = typer.Typer(
    name="stackbounce",
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


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


Until = Annotated[
    str | None,
    typer.Option(metavar="TIME", help="Stop at this time, not when the balls have parted."),
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
    from stackbounce.calibration import separate
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
        show.simulation(console(), chosen, result, textbook)
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
        swept.tell(console(), done, out, plot)


app.command(name="measure", epilog=measure_command.EPILOG)(measure_command.measure)
app.command(name="fit", epilog=fit.EPILOG)(fit.run)
for _command_of in design_commands.COMMANDS:
    app.command(epilog=design_commands.COMMANDS[_command_of])(_command_of)


@app.command()
def balls(as_json: AsJson = False) -> None:
    """List the catalogue: the paper's balls, each figure with its source."""
    from stackbounce.cli import machine, show

    if as_json:
        typer.echo(machine.text(machine.catalogue()))
    else:
        show.catalogue(console())


@app.command()
def paper(
    out: Annotated[
        str, typer.Option(metavar="DIR", help="Folder to write to.", show_default=False)
    ],
    study: Annotated[
        bool,
        typer.Option(
            "--study",
            help="All of Table II by one model after the other, too: a minute or two more.",
        ),
    ] = False,
    as_json: AsJson = False,
) -> None:
    """Recompute the paper: its figures, its tables, and an audit of every number in it."""
    from stackbounce import cross2007
    from stackbounce.cli import machine, show

    if not out:  # as a path it would be this folder
        raise InvalidValue("--out must name a folder, got ''")
    folder = Path(out)
    audit = cross2007.write(folder, lambda line: typer.echo(line, err=True), study=study)
    if as_json:
        typer.echo(machine.text(audit.as_dict()))
    else:
        show.audit(console(), audit, folder / "index.html")


@app.command(name="app", epilog="For a class: stackbounce app --host 0.0.0.0")
def explore(
    host: Annotated[
        str,
        typer.Option(
            metavar="ADDRESS",
            help="Where to listen: on this machine alone by default; 0.0.0.0 for a class.",
        ),
    ] = "127.0.0.1",
    port: Annotated[
        int | None,
        typer.Option(
            metavar="PORT",
            help="By default the first free one from 8050; 0 for any.",
            show_default=False,
        ),
    ] = None,
    browser: Annotated[
        bool, typer.Option("--browser/--no-browser", help="Open the page in the browser.")
    ] = True,
    workers: Annotated[
        int | None,
        typer.Option(
            metavar="COUNT",
            help="Processes that compute; by default one for each core, 2 to 8.",
            show_default=False,
        ),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Open the explorer in the browser: see it happen, slowly."""
    import dataclasses

    from stackbounce.cli import machine
    from stackbounce.errors import whole
    from stackbounce.version import __version__
    from stackbounce.web import LIMITS
    from stackbounce.web.serve import serve

    def tell(address: str) -> None:
        told = machine.text({"stackbounce": __version__, "address": address})
        typer.echo(told if as_json else f"The explorer: {address} (Ctrl+C ends it)")

    cores = min(max(os.cpu_count() or 1, 2), 8)
    count = cores if workers is None else whole("--workers", workers, 1, 64)
    limits = dataclasses.replace(LIMITS, workers=count)
    serve(host, port, limits, browser=browser, tell=tell)


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
        return _failed(f"{error.format_message()} (see {_command(arguments)} --help)")
    except KeyboardInterrupt:
        code = 130
    except MemoryError:
        return _failed("out of memory: ask for fewer balls", 1)
    except Exception as error:
        return _failed(f"unexpected {type(error).__name__}: {error} (please report it)", 1)
    if code == 130:
        typer.echo("stackbounce: interrupted", err=True)
    return int(code or 0)


def _command(arguments: Sequence[str] | None) -> str:
    """Return the command that was asked for, as it is typed; without its name, the program."""
    first = [*(sys.argv[1:] if arguments is None else arguments), ""][0]
    names = [one.name or getattr(one.callback, "__name__", "") for one in app.registered_commands]
    return f"stackbounce {first}" if first in names else "stackbounce"


def _failed(message: str, code: int = 2) -> int:
    line = "".join(c if c.isprintable() else "?" for c in " ".join(message.split()))
    typer.echo(f"stackbounce: error: {line}", err=True)
    return code
