"""The command ``stackbounce datasets``: published measurements, each with its source."""

from collections.abc import Sequence
from dataclasses import asdict
from typing import TYPE_CHECKING

from stackbounce.cli.output import console, print_json
from stackbounce.library_types import Console

if TYPE_CHECKING:
    from stackbounce.datasets import Column, Description

_FACTS = ("measured", "ball", "surface", "mass", "diameter", "source", "doi", "address", "seen")
_MORE = ("quoted_by", "licence", "remarks")


def run(name: str, as_json: bool) -> None:
    """List published measurements, or show one with its numbers and its source."""
    from stackbounce.datasets import describe, names
    from stackbounce.version import __version__

    found = [describe(known) for known in ([name] if name else names())]
    if as_json:
        print_json({"stackbounce": __version__, "datasets": [asdict(about) for about in found]})
    elif name:
        _print_dataset(console(), found[0])
    else:
        _print_list(console(), found)


def _print_list(console: Console, found: "Sequence[Description]") -> None:
    from stackbounce.cli.tables import new_table

    table = new_table("Published measurements", ["name", "title", "read"], ["rows"])
    for about in found:
        table.add_row(about.name, about.title, about.seen, str(len(about.columns[0].values)))
    console.print(table)
    console.print("\nNow: stackbounce datasets NAME")


def _print_dataset(console: Console, about: "Description") -> None:
    from stackbounce.cli.tables import new_table

    words = [column for column in about.columns if column.unit == "text"]
    numbers = [column for column in about.columns if column.unit != "text"]
    table = new_table(None, map(_heading, words), map(_heading, numbers))
    for i in range(len(about.columns[0].values)):
        table.add_row(*(_cell(column, i) for column in (*words, *numbers)))
    console.print(f"\n{about.title}", style="bold")
    console.print(table)
    console.print()
    for column in about.columns:
        assumed = column.assumed_error
        error = f"; error: none given, {assumed:g} {column.unit} assumed" if assumed else ""
        console.print(f"{column.name}: {column.meaning}{error}")
    for key in (*_FACTS, *_MORE):
        text = getattr(about, key)
        origin = getattr(about, f"{key}_from", "")
        if text:
            console.print(f"{key.replace('_', ' ')}: {text}{f' ({origin})' if origin else ''}")


def _heading(column: "Column") -> str:
    unit = "" if column.unit in ("1", "text") else column.unit
    return f"{column.name.replace('_', ' ')}\n{unit}"


def _cell(column: "Column", row: int) -> str:
    value = column.values[row]
    if isinstance(value, tuple):
        return f"{sum(value) / len(value):.4g} (mean of {len(value)})"
    if isinstance(value, str):
        return value
    error = f" ± {column.errors[row]:g}" if column.errors and column.errors[row] else ""
    return f"{value:g}{error}"
