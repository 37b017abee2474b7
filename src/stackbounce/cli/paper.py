"""The command ``stackbounce paper``."""

from pathlib import Path

import typer

from stackbounce.cli.output import console, print_json
from stackbounce.errors import InvalidValue


def run(out: str, as_json: bool) -> None:
    """Recompute the paper: its figures, its tables, and an audit of every number in it."""
    from stackbounce import cross2007

    if not out:  # Path("") is the current folder
        raise InvalidValue("--out must name a folder, got ''")
    done = cross2007.write(Path(out), lambda line: typer.echo(line, err=True))
    if as_json:
        print_json(done.as_dict())
        return
    unexplained = sum(not row.explained for row in done.rows)
    console().print(f"{done.counted}\nRows that disagree without an explanation: {unexplained}")
    console().print(f"Open {Path(out) / 'index.html'}", soft_wrap=True)
