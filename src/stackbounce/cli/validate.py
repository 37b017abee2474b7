"""The command ``stackbounce validate``: contact laws beside published measurements."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from stackbounce.cli.options import AsJson
from stackbounce.cli.output import console, print_json
from stackbounce.errors import InvalidValue
from stackbounce.extras import need

if TYPE_CHECKING:
    from rich.console import Console

    from stackbounce.fitting.validation import Validation

__all__ = ["run"]


def run(
    out: Annotated[
        str, typer.Option(metavar="DIR", help="Folder to write to.", show_default=False)
    ],
    as_json: AsJson = False,
) -> None:
    """Try each contact law on published measurements: which law for which ball."""
    need("paper", "stackbounce validate")
    from stackbounce.fitting import validation

    if not out:  # Path("") is the current folder
        raise InvalidValue("--out must name a folder, got ''")
    folder = Path(out)
    done = validation.write(folder, lambda line: typer.echo(line, err=True))
    if as_json:
        print_json(done.as_dict())
    else:
        _print_verdicts(console(), done, folder / "index.html")


def _print_verdicts(console: "Console", done: "Validation", page: Path) -> None:
    from stackbounce.cli.tables import new_table

    table = new_table("Contact laws and published measurements", ["dataset", "laws"])
    for one in done.comparisons:
        table.add_row(one.series.name, one.summary)
    console.print(table)
    console.print(f"\n{done.summary}")
    console.print(f"\nOpen {page}", soft_wrap=True)
