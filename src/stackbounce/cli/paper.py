"""The command ``stackbounce paper``: the paper recomputed."""

from typing import TYPE_CHECKING

from stackbounce.cli.report import write_report
from stackbounce.extras import need

if TYPE_CHECKING:
    from rich.console import Console

    from stackbounce.cross2007 import Audit


def run(out: str, as_json: bool) -> None:
    """Recompute the paper: its figures, its tables, and an audit of every number in it."""
    need("paper", "stackbounce paper")
    from stackbounce import cross2007

    write_report(out, as_json, cross2007.write, _print_audit)


def _print_audit(console: "Console", done: "Audit") -> None:
    """Print how many rows of the audit have which verdict."""
    from stackbounce.cli.tables import new_table

    table = new_table("Audit of the paper", ["verdict"], ["rows"])
    for verdict, count in (done.counts | {"all": len(done.rows)}).items():
        table.add_row(verdict, str(count))
    console.print(table)
    unexplained = sum(not row.explained for row in done.rows)
    console.print(f"\nRows that disagree without an explanation: {unexplained}")
