"""Output: the terminal, JSON, and files, whose paths are checked before anything is computed."""

import contextlib
import functools
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import typer

from stackbounce.errors import FileError, InvalidValue, counted
from stackbounce.extras import need
from stackbounce.files import check_own, check_place, write_file
from stackbounce.library_types import Console

SUFFIXES = (".svg", ".png", ".pdf")
"""The kinds of picture."""


class Unsolved(Exception):
    """Drops that have no result; raised after everything else has been printed and written."""


def check_solved(counts: Mapping[str, int]) -> None:
    """Raise `Unsolved` if drops, counted by the name of their `Status`, have no result.

    Examples
    --------
    >>> check_solved({"FINISHED": 8, "INVALID": 2})
    Traceback (most recent call last):
    stackbounce.cli.output.Unsolved: no result for 2 of 10 drops: 2 INVALID
    """
    wrong = {name: counts[name] for name in ("EVENT_LIMIT", "INVALID") if counts.get(name)}
    if wrong:
        listed = ", ".join(f"{count} {name}" for name, count in wrong.items())
        drops = f"{sum(wrong.values())} of {counted(sum(counts.values()), 'drop')}"
        raise Unsolved(f"no result for {drops}: {listed}")


def check_picture(path: Path | None, overwrite: bool, option: str = "--plot") -> None:
    """Refuse a picture's path that `check_file` refuses, or one without matplotlib."""
    check_file(path, overwrite, option, SUFFIXES)
    if path is not None:
        need(option, "matplotlib")


def check_file(
    path: Path | None,
    overwrite: bool,
    option: str,
    suffixes: Sequence[str],
    read: Sequence[str] = (),
) -> None:
    """Refuse a file's path with another suffix, or where it cannot be written.

    Raises
    ------
    InvalidValue
        If it has another suffix.
    FileError
        If the folder does not exist, or `path` is one, or a file that may not be replaced.
    """
    if path is None:
        return
    if path.suffix.lower() not in suffixes:
        raise InvalidValue(f"{option} must end in {', '.join(suffixes)}, got {path}")
    if path.is_dir():
        raise FileError(f"{path} cannot be written: it is a folder")
    check_place(path)
    check_own(path, overwrite, read)


def draw_picture(path: Path | None, overwrite: bool, kind: str, *what: Any, **options: Any) -> None:
    """Write a picture of `stackbounce.plots` into a file, if one is asked for.

    The suffix of the file names its format.
    """
    if path is not None:
        from stackbounce import plots
        from stackbounce.plots.style import render

        draw = functools.partial(getattr(plots, kind), *what, **options)
        write_file(path, render(draw, path.suffix.lower().removeprefix(".")), overwrite)


def console() -> Console:
    """Return the console for tables: as wide as the terminal, at most 100 columns."""
    from rich.console import Console

    width = Console().width if sys.stdout.isatty() else 100
    return Console(width=min(width, 100), markup=False, highlight=False, emoji=False)


@contextlib.contextmanager
def progress_bar(what: str) -> Iterator[Any]:
    """Show a progress bar on stderr, if that is a terminal, until all is done."""
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TimeRemainingColumn

    console = Console(stderr=True)
    columns = ("{task.description}", BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    if not console.is_terminal:
        yield lambda *_: None
        return
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task(what, total=None)
        yield lambda done, total: bar.update(task, completed=done, total=total)


def print_json(value: object) -> None:
    """Print dicts, lists, dataclasses, arrays, strings and numbers as JSON.

    Numbers are in SI units, null for what is not finite.

    Examples
    --------
    >>> print_json({"peak_force": float("inf")})
    {
      "peak_force": null
    }
    """
    from stackbounce.json_values import as_json

    typer.echo(as_json(value, indent=2))


def print_files(*pictures: Path | None, best: Path | None = None) -> None:
    """Print the paths of the best stack and of the pictures that were written."""
    if best is not None:
        typer.echo(f"Best stack: {best}; now: stackbounce simulate {best}")
    for picture in filter(None, pictures):
        typer.echo(f"Picture: {picture}")
