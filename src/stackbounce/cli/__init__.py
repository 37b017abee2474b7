"""The command line: ``stackbounce --help`` lists it."""

import os
import sys
import warnings
from collections.abc import Callable, Sequence
from importlib import import_module
from typing import Annotated, Any

import typer

from stackbounce.cli import balls, datasets, explorer, fit, highest, measure, paper, simulate, sweep
from stackbounce.cli.options import add_command
from stackbounce.cli.output import Unsolved
from stackbounce.errors import StackbounceError

__all__ = ["app", "main"]

# Before 0.29 typer used click itself, and its errors.
_WrongUsage: type[Any] = (
    getattr(typer, "TyperException", None) or import_module("click").ClickException
)

app = typer.Typer(
    name="stackbounce",
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


_COMMANDS: dict[str, Callable[..., None]] = {
    "simulate": simulate.run, "sweep": sweep.run, "measure": measure.run, "fit": fit.run,
    "highest": highest.run, "balls": balls.run, "datasets": datasets.run, "paper": paper.run,
    "app": explorer.run,
}  # fmt: skip
for _name, _run in _COMMANDS.items():
    add_command(app, _name, _run)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line.

    Parameters
    ----------
    arguments : sequence of str, optional
        Those after the program's name; default the ones that the process was started with.

    Returns
    -------
    int
        The exit status: 0; 2 after an error of the user, 1 after any other error, 3 if drops have
        no result (their status is EVENT_LIMIT or INVALID), 130 after an interruption. An error or a
        warning is printed in one line on stderr.

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
    os.environ["MPLBACKEND"] = "agg"  # nothing is shown, and matplotlib refuses an unknown name
    try:
        with warnings.catch_warnings():
            warnings.showwarning = lambda message, *_, **__: _say(str(message))
            try:
                code = app(arguments, prog_name="stackbounce", standalone_mode=False)
            except Unsolved as error:
                code = _failed(str(error), 3)
        sys.stdout.flush()
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except StackbounceError as error:
        return _failed(str(error))
    except OSError as error:
        return _failed(f"{error.filename or 'the disk'}: {error.strerror or error}")
    except _WrongUsage as error:
        return _failed(f"{error.format_message()} (see {_command(arguments)} --help)")
    except MemoryError:
        return _failed("out of memory: ask for fewer balls, drops or draws", 1)
    except (Exception, KeyboardInterrupt) as error:
        if not _follows_an_interruption(error):
            return _failed(f"unexpected {type(error).__name__}: {error} (please report it)", 1)
        code = 130
    if code == 130:
        typer.echo("stackbounce: interrupted", err=True)
    return int(code or 0)


def _follows_an_interruption(error: BaseException | None) -> bool:
    """Return whether Ctrl+C led to an error, as to one of a compiled module that was imported."""
    while error is not None and not isinstance(error, KeyboardInterrupt):
        error = error.__cause__ or error.__context__
    return error is not None


def _command(arguments: Sequence[str] | None) -> str:
    """Return the given command as typed, ``stackbounce fit``; only the program if it is unknown."""
    first = [*(sys.argv[1:] if arguments is None else arguments), ""][0]
    names = [command.name for command in app.registered_commands]
    return f"stackbounce {first}" if first in names else "stackbounce"


def _failed(message: str, code: int = 2) -> int:
    _say(f"error: {message}")
    return code


def _say(message: str) -> None:
    line = "".join(c if c.isprintable() else "?" for c in " ".join(message.split()))
    typer.echo(f"stackbounce: {line}", err=True)
