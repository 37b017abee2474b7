"""The command ``stackbounce validate``: contact laws beside published measurements."""

from typing import TYPE_CHECKING

from stackbounce.cli.report import write_report
from stackbounce.extras import need

if TYPE_CHECKING:
    from rich.console import Console

    from stackbounce.fitting.validation import Validation


def run(out: str, as_json: bool) -> None:
    """Try each contact law on published measurements: which law for which ball."""
    need("paper", "stackbounce validate")
    from stackbounce.fitting import validation

    write_report(out, as_json, validation.write, _print_verdicts)


def _print_verdicts(console: "Console", done: "Validation") -> None:
    from stackbounce.cli.tables import new_table

    table = new_table("Contact laws and published measurements", ["dataset", "laws"])
    for compared in done.comparisons:
        table.add_row(compared.series.name, compared.summary)
    console.print(table)
    console.print(f"\n{done.summary}\n")
