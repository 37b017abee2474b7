"""The commands ``stackbounce paper`` and ``stackbounce validate``, which write pages."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from stackbounce.cli.output import console, print_json
from stackbounce.errors import InvalidValue
from stackbounce.extras import need

if TYPE_CHECKING:
    from stackbounce.cross2007 import Audit
    from stackbounce.fitting.validation import Validation


def paper(out: str, as_json: bool) -> None:
    """Recompute the paper: its figures, its tables, and an audit of every number in it."""
    need("paper", "stackbounce paper")
    from stackbounce import cross2007

    _write(out, as_json, cross2007.write, _print_audit)


def validate(out: str, as_json: bool) -> None:
    """Try each contact law on published measurements: which law for which ball."""
    need("paper", "stackbounce validate")
    from stackbounce.fitting import validation

    _write(out, as_json, validation.write, _print_verdicts)


def _write(
    out: str, as_json: bool, write: Callable[..., Any], print_done: Callable[[Any], None]
) -> None:
    """Write a report into a folder, and print what came out."""
    if not out:  # Path("") is the current folder
        raise InvalidValue("--out must name a folder, got ''")
    done = write(Path(out), lambda line: typer.echo(line, err=True))
    if as_json:
        print_json(done.as_dict())
        return
    print_done(done)
    console().print(f"Open {Path(out) / 'index.html'}", soft_wrap=True)


def _print_audit(done: "Audit") -> None:
    """Print how many rows of the audit have which verdict."""
    from stackbounce.cli.tables import new_table

    table = new_table("Audit of the paper", ["verdict"], ["rows"])
    for verdict, count in (done.counts | {"all": len(done.rows)}).items():
        table.add_row(verdict, str(count))
    unexplained = sum(not row.explained for row in done.rows)
    console().print(table, f"\nRows that disagree without an explanation: {unexplained}", sep="\n")


def _print_verdicts(done: "Validation") -> None:
    from stackbounce.cli.tables import new_table

    table = new_table("Contact laws and published measurements", ["dataset", "laws"])
    for compared in done.comparisons:
        table.add_row(compared.series.name, compared.summary)
    console().print(table, f"\n{done.summary}\n", sep="\n")
