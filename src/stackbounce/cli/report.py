"""Commands that write a folder of pages, with a table of what came out."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import typer

from stackbounce.cli.output import console, print_json
from stackbounce.errors import InvalidValue


def write_report(
    out: str, as_json: bool, write: Callable[..., Any], print_done: Callable[..., None]
) -> None:
    """Write a report into a folder, and print what came out.

    Parameters
    ----------
    out : str
        The folder of ``--out``.
    as_json : bool
        Whether machines read it.
    write : callable
        Takes the folder and a function that tells the progress, and returns the report.
    print_done : callable
        Takes the console and the report, and prints its table.
    """
    if not out:  # Path("") is the current folder
        raise InvalidValue("--out must name a folder, got ''")
    done = write(Path(out), lambda line: typer.echo(line, err=True))
    if as_json:
        print_json(done.as_dict())
        return
    print_done(console(), done)
    console().print(f"Open {Path(out) / 'index.html'}", soft_wrap=True)
