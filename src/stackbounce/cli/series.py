"""``stackbounce fit`` of a table of bounces or of a published data set."""

import functools
import shlex
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from stackbounce.cli import output
from stackbounce.cli.tables import table_of
from stackbounce.errors import FileError, InvalidValue, StackbounceError, a_or_an
from stackbounce.library_types import Console
from stackbounce.model.laws import LAWS
from stackbounce.units import quantity

if TYPE_CHECKING:
    from stackbounce.fitting.series import SeriesFit, StackTable

PREFIX = "dataset:"
_TABLES = (".csv", ".tsv", ".txt", ".dat", ".xlsx")
_OF_DROPS = (
    "data", "measured", "vary", "tie", "height", "speed", "gap", "gravity", "interval", "sample",
    "starts", "draws", "save", "corner",
)  # fmt: skip
_BALL = {"mass": "kg", "diameter": "m"}
_ALONE = "Rigid"  # the law without --compare and --contact: one restitution


def is_series(what: Sequence[str]) -> bool:
    """Return whether what is to be fitted is a table of bounces or a data set, and no drop.

    Examples
    --------
    >>> is_series(["heights.csv"]), is_series(["dataset:all"]), is_series(["basketball", "tennis"])
    (True, True, False)
    """
    path = Path(what[0])
    suffix = path.suffix.lower()
    named = what[0].startswith(PREFIX) or suffix in _TABLES
    return len(what) == 1 and (named or (suffix != ".toml" and path.is_file()))


def stack_of(what: str, given: Mapping[str, Any]) -> "StackTable | None":
    """Return the drops of a table with a column for each ball of a stack; None if it is none."""
    from stackbounce.fitting.series import read_stack

    return None if what.startswith(PREFIX) else read_stack(what, given["error"] or ())


def fit_series(
    what: str, plot: Path | None, overwrite: bool, as_json: bool, given: Mapping[str, Any]
) -> None:
    """Fit laws to a table of bounces, print what they say, and draw and write it."""
    from stackbounce.fitting import series

    for name in _OF_DROPS:
        if given[name]:
            raise InvalidValue(f"--{name} is of a drop; {what} is a table of bounces")
    if given["out"] == "":
        raise InvalidValue("--out must name a folder, got ''")
    units = {name: unit for name, unit in _BALL.items() if given[name] is not None}
    ball = {name: quantity(given[name], unit, f"--{name}") for name, unit in units.items()}
    every = what == f"{PREFIX}all"
    try:
        done = series.fit_series(
            what,
            laws=tuple(LAWS) if given["compare"] else given["contact"] or [_ALONE],
            errors=given["error"] or (),
            **ball,
            progress=functools.partial(typer.echo, err=True) if every else lambda _: None,
        )
    except (FileError, InvalidValue) as error:
        held = _held(what)
        if not held:
            raise
        raise InvalidValue(
            f"{what} holds {a_or_an(held)}, no table of bounces: stackbounce measure "
            f"{shlex.quote(what)} analyses it"
        ) from error
    output.draw_picture(plot, overwrite, "restitutions", done)
    if given["out"]:
        series.write(done, Path(given["out"]))
    if as_json:
        output.print_json(done.as_dict())
        return
    _print(output.console(), done, compared=given["compare"])
    output.print_files(plot)
    if given["out"]:
        typer.echo(f"Open {Path(given['out']) / 'index.html'}")
    print_citation(given["cite"], done)


def print_citation(asked: bool, found: Any) -> None:
    """Print how to cite what a fit found, if that is asked for."""
    if asked:
        from stackbounce.fitting.cite import cite

        typer.echo(f"\n{cite(found)}")


def _held(file: str) -> str:
    """Return which kind of measurement a file holds, if `measure` knows it by itself."""
    from stackbounce.measure import read

    try:
        held = str(read(file).attrs["holds"])
    except StackbounceError:
        return ""
    return "" if held == "table" else held


def _print(console: Console, done: "SeriesFit", *, compared: bool) -> None:
    """Print the laws of each ball, what follows, and what was assumed."""
    for found in done.comparisons:
        speeds = f"from {found.series.speeds.min():.3g} to {found.series.speeds.max():.3g} m/s"
        title = f"{found.series.title}: {found.series.values.size} restitutions {speeds}"
        console.print(table_of(found.table.drop(columns="verdict"), title))
        console.print()
        if compared:
            console.print(found.summary)
        elif found.outcomes[0].verdict != "agrees":
            law = found.outcomes[0].short_name
            console.print(f"{law} does not follow it: --compare fits every contact law.")
    for name, reason in done.left_out.items():
        console.print(f"Left out: {name}: {reason}.")
    if compared and done.comparisons:
        console.print(done.summary)
    for note in done.notes:
        console.print(f"Note: {note}")
