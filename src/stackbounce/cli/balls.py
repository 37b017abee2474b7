"""The command ``stackbounce balls``: the catalogue, each number with its source."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from stackbounce.cli.output import console, print_json
from stackbounce.library_types import Console

if TYPE_CHECKING:
    from stackbounce.model.catalogue import CatalogueBall


def run(as_json: bool) -> None:
    """List the catalogue: the paper's balls and a class's, each figure with its source."""
    if as_json:
        print_json(summary())
    else:
        print_catalogue(console())


def print_catalogue(console: Console) -> None:
    """Print the catalogue: balls, pairs, and where each figure comes from."""
    from stackbounce.cli.tables import new_table, number
    from stackbounce.model.catalogue import BALLS, CLASS_BALLS, PAIRS

    _print_balls(console, "Balls of the paper, on springs without loss", BALLS)
    title = "Pairs: springs fitted to a drop of two balls"
    table = new_table(title, ["\nlower", "\nupper"], ("floor\nN/m", "between\nN/m", "gap\nmm"))
    table.add_column("\nsource")
    for pair in PAIRS:
        figures = (pair.floor_stiffness, pair.stiffness, 1e3 * pair.gap)
        table.add_row(pair.lower, pair.upper, *map(number, figures), pair.source)
    console.print(table)
    _print_balls(console, "Balls a class owns, with their losses", CLASS_BALLS)


def _print_balls(console: Console, title: str, entries: "Sequence[CatalogueBall]") -> None:
    from stackbounce.cli.tables import new_table, number

    figures = {
        "mass\ng": [1e3 * entry.ball.mass for entry in entries],
        "diameter\nmm": [1e3 * (entry.ball.diameter or math.nan) for entry in entries],
        "restitution\non floor": [entry.restitution for entry in entries],
        "contact time\nms": [1e3 * (entry.contact_time or math.nan) for entry in entries],
        "stiffness\nN/m": [entry.stiffness for entry in entries],
    }
    if any(entry.static_stiffness for entry in entries):
        figures["static\nN/m"] = [entry.static_stiffness or math.nan for entry in entries]
    table = new_table(title, ["\nball"], figures)
    for entry, *own in zip(entries, *figures.values(), strict=True):
        table.add_row(str(entry.ball.name).replace(" ", "-"), *map(number, own))
    console.print(table)
    for entry in entries:
        console.print(f"{entry.ball.name}: {_sources(entry)}")


def _sources(entry: "CatalogueBall") -> str:
    kinds = dict(entry.kinds)
    by_source: dict[str, list[str]] = {}
    for figure, source in entry.sources:
        kind = f" ({kinds[figure]})" if figure in kinds else ""
        by_source.setdefault(source, []).append(figure.replace("_", " ") + kind)
    return "; ".join(f"{', '.join(figures)}: {source}" for source, figures in by_source.items())


def summary() -> dict[str, object]:
    """Return what ``stackbounce balls --json`` prints."""
    from stackbounce.model.catalogue import ENTRIES, PAIRS
    from stackbounce.version import __version__

    rows = [entry.to_mapping() for entry in ENTRIES.values()]
    return {"stackbounce": __version__, "balls": rows, "pairs": PAIRS}
