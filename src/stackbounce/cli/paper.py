"""The command ``stackbounce paper``: the paper recomputed."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from stackbounce.cli.options import AsJson
from stackbounce.cli.output import console, print_json
from stackbounce.errors import InvalidValue
from stackbounce.extras import need

if TYPE_CHECKING:
    from rich.console import Console

    from stackbounce.cross2007 import Audit

__all__ = ["run"]


def run(
    out: Annotated[
        str, typer.Option(metavar="DIR", help="Folder to write to.", show_default=False)
    ],
    as_json: AsJson = False,
) -> None:
    """Recompute the paper: its figures, its tables, and an audit of every number in it."""
    need("paper", "stackbounce paper")
    from stackbounce import cross2007

    if not out:  # Path("") is the current folder
        raise InvalidValue("--out must name a folder, got ''")
    folder = Path(out)
    audit = cross2007.write(folder, lambda line: typer.echo(line, err=True))
    if as_json:
        print_json(audit.as_dict())
    else:
        print_audit(console(), audit, folder / "index.html")


def print_audit(console: "Console", done: "Audit", page: Path) -> None:
    """Print how many rows of the audit have which verdict, and where its page lies."""
    from stackbounce.cli.tables import new_table

    table = new_table("Audit of the paper", ["verdict"], ["rows"])
    for verdict, count in (done.counts | {"all": len(done.rows)}).items():
        table.add_row(verdict, str(count))
    console.print(table)
    unexplained = sum(not row.explained for row in done.rows)
    console.print(f"\nRows that disagree without an explanation: {unexplained}")
    console.print(f"Open {page}", soft_wrap=True)
