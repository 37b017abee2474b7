"""Run all benchmarks: `PYTHONPATH=tests python -m benchmarks [--out DIR]`, as `make bench` does.

The solvers of `tests/reference`, of fifty digits, tell what is exact.
"""

import argparse
from pathlib import Path

from rich.console import Console
from rich.table import Table as Printed

from benchmarks.report import Table, write


def printed(table: Table) -> Printed:
    """Return a table for the screen."""
    grid = Printed(title=table.title, title_justify="left", box=None, pad_edge=False)
    for i, head in enumerate(table.heads):
        whole = max(map(len, head.split()))  # no word is broken
        grid.add_column(head, justify="left" if i < table.words else "right", min_width=whole)
    for row in table.rows:
        grid.add_row(*row)
    return grid


def main() -> None:
    """Measure, write the page, and print its tables."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument(
        "--out", type=Path, default=Path("build/bench"), help="folder for the page and its figures"
    )
    out = parser.parse_args().out
    console = Console(highlight=False)
    with console.status("starting") as status:
        tables = write(out, status.update)
    for table in tables:
        console.print(printed(table), "")


if __name__ == "__main__":
    main()
