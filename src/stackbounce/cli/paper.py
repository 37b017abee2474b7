"""The command ``stackbounce paper``."""

from pathlib import Path
from typing import TYPE_CHECKING

import typer

from stackbounce.cli.output import console, print_json
from stackbounce.errors import InvalidValue
from stackbounce.extras import need

if TYPE_CHECKING:
    from stackbounce.cross2007 import Audit


def run(out: str, as_json: bool) -> None:
    """Recompute the paper: its figures, its tables, and an audit of every number in it."""
    need("paper", "stackbounce paper")
    from stackbounce import cross2007

    if not out:  # Path("") is the current folder
        raise InvalidValue("--out must name a folder, got ''")
    done = cross2007.write(Path(out), lambda line: typer.echo(line, err=True))
    if as_json:
        print_json(done.as_dict())
        return
    _print_audit(done)
    console().print(f"Open {Path(out) / 'index.html'}", soft_wrap=True)


def _print_audit(done: "Audit") -> None:
    """Print how many rows of the audit have which verdict."""
    from stackbounce.cli.tables import new_table

    table = new_table("Audit of the paper", ["verdict"], ["rows"])
    for verdict, count in (done.counts | {"all": len(done.rows)}).items():
        table.add_row(verdict, str(count))
    unexplained = sum(not row.explained for row in done.rows)
    console().print(table, f"\nRows that disagree without an explanation: {unexplained}", sep="\n")
