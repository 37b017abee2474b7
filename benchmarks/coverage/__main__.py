"""Print how often error bars hold the truth: `python -m benchmarks.coverage [--seeds N]`."""

import argparse
import pkgutil
from importlib import import_module

from rich.console import Console
from rich.table import Table

import benchmarks.coverage as here
from benchmarks.coverage.shares import shares


def main() -> None:
    """Run all cases of all modules beside this one, and print their table."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.coverage", description=__doc__)
    parser.add_argument("--seeds", type=int, default=400, help="records of each case")
    parser.add_argument("--only", default="", help="cases whose name holds this")
    given = parser.parse_args()
    table = Table(title="Within 1 σ: 68 % if the errors are honest", title_justify="left", box=None)
    for head in ("kind", "case", "quantity"):
        table.add_column(head)
    for head in ("within 1 σ", "within 2 σ", "bias (σ)", "typical error"):
        table.add_column(head, justify="right")
    modules = [one.name for one in pkgutil.iter_modules(here.__path__)]
    console = Console(highlight=False, width=120)
    for kind in sorted(modules):
        cases = getattr(import_module(f"benchmarks.coverage.{kind}"), "CASES", {})
        for name, trial in cases.items():
            if given.only not in name:
                continue
            for quantity, share in shares(trial, range(given.seeds)).items():
                table.add_row(kind, name, quantity, *share.words())
                name = kind = ""
    console.print(table)


if __name__ == "__main__":
    main()
