"""The command ``stackbounce balls``: the catalogue, each number with its source."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from stackbounce.cli.options import AsJson
from stackbounce.cli.output import console, print_json

if TYPE_CHECKING:
    from rich.console import Console

__all__ = ["run"]


def run(as_json: AsJson = False) -> None:
    """List the catalogue: the paper's balls, each figure with its source."""
    if as_json:
        print_json(summary())
    else:
        print_catalogue(console())


def print_catalogue(console: "Console") -> None:
    """Print the catalogue: balls, pairs, and where each figure comes from."""
    from stackbounce.cli.tables import label, new_table, number
    from stackbounce.model.catalogue import BALLS, PAIRS

    headings = ("mass\ng", "diameter\nmm", "restitution\non floor", "contact time\nms")
    table = new_table("Balls", ["\nball"], (*headings, "stiffness\nN/m", "static\nN/m"))
    for entry in BALLS:
        table.add_row(
            label(entry.ball.name, 0),
            number(entry.ball.mass * 1e3),
            number((entry.ball.diameter or math.nan) * 1e3),
            number(entry.restitution),
            number((entry.contact_time or math.nan) * 1e3),
            number(entry.stiffness),
            number(entry.static_stiffness),
        )
    console.print(table)
    for entry in BALLS:
        console.print(f"{entry.ball.name}: {_sources(entry.sources)}")
    title = "Pairs: springs fitted to a drop of two balls"
    table = new_table(title, ["\nlower", "\nupper"], ("floor\nN/m", "between\nN/m", "gap\nmm"))
    table.add_column("\nsource")
    for pair in PAIRS:
        table.add_row(
            pair.lower,
            pair.upper,
            number(pair.floor_stiffness),
            number(pair.stiffness),
            number(pair.gap * 1e3),
            pair.source,
        )
    console.print(table)


def _sources(sources: Sequence[tuple[str, str]]) -> str:
    by_source: dict[str, list[str]] = {}
    for figure, source in sources:
        by_source.setdefault(source, []).append(figure.replace("_", " "))
    return "; ".join(f"{', '.join(figures)}: {source}" for source, figures in by_source.items())


def summary() -> dict[str, object]:
    """Return what ``stackbounce balls --json`` prints."""
    from stackbounce.model.catalogue import BALLS, PAIRS
    from stackbounce.version import __version__

    rows = [entry.to_mapping() for entry in BALLS]
    return {"stackbounce": __version__, "balls": rows, "pairs": PAIRS}
