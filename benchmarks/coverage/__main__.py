"""Print how often error bars hold the truth: `python -m benchmarks.coverage [--write FILE]`."""

import argparse
import csv
import pkgutil
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

from rich.console import Console
from rich.table import Table

import benchmarks.coverage as here
from benchmarks.coverage.shares import Share, shares

HEADS = ("analysis", "case", "quantity", "within 1 σ", "within 2 σ", "bias (σ)", "typical error")


def found(seeds: int, only: str) -> Iterator[tuple[str, str, str, Share]]:
    """Run the cases of all modules beside this one: analysis, case, quantity, its share."""
    for kind in sorted(one.name for one in pkgutil.iter_modules(here.__path__)):
        module = import_module(f"benchmarks.coverage.{kind}")
        cases = [*getattr(module, "CASES", {}).items(), *getattr(module, "LIMITS", {}).items()]
        for name, trial in cases:
            if only in name:
                for quantity, share in shares(trial, range(seeds)).items():
                    yield kind.replace("_", " "), name, quantity, share


def main() -> None:
    """Run all cases, print their table, and write it where asked."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.coverage", description=__doc__)
    parser.add_argument("--seeds", type=int, default=400, help="records of each case")
    parser.add_argument("--only", default="", help="cases whose name holds this")
    parser.add_argument("--write", type=Path, metavar="FILE", help="a CSV file for the table, too")
    given = parser.parse_args()
    table = Table(title="Within 1 σ: 68 % if the errors are honest", title_justify="left", box=None)
    for head in HEADS:
        table.add_column(head, justify="left" if head in HEADS[:3] else "right")
    rows = list(found(given.seeds, given.only))
    last = ("", "")
    for kind, name, quantity, share in rows:
        first = (kind * (kind != last[0]), name * (name != last[1]))
        table.add_row(*first, quantity, *share.words())
        last = (kind, name)
    Console(highlight=False, width=120).print(table)
    if given.write:
        with given.write.open("w", newline="", encoding="utf-8") as file:
            lines = csv.writer(file, lineterminator="\n")
            lines.writerow((*HEADS[:5], "records"))
            lines.writerows(
                (kind, name, quantity.replace("_", " "), *share.words()[:2], given.seeds)
                for kind, name, quantity, share in rows
            )


if __name__ == "__main__":
    main()
