"""The command ``stackbounce balls``: the catalogue, each number with its source."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from stackbounce.cli.output import console, print_json

if TYPE_CHECKING:
    from rich.console import Console

    from stackbounce.model.catalogue import CatalogueBall


def run(as_json: bool) -> None:
    """List the catalogue: the paper's balls and a class's, each figure with its source."""
    if as_json:
        print_json(summary())
    else:
        print_catalogue(console())


def print_catalogue(console: "Console") -> None:
    """Print the catalogue: balls, pairs, and where each figure comes from."""
    from stackbounce.cli.tables import new_table, number
    from stackbounce.model.catalogue import BALLS, CLASS_BALLS, PAIRS

    _print_balls(console, "Balls of the paper, on springs without loss", BALLS)
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
    _print_balls(console, "Balls a class owns, with their losses", CLASS_BALLS)


def _print_balls(console: "Console", title: str, entries: "Sequence[CatalogueBall]") -> None:
    from stackbounce.cli.tables import new_table, number

    headings = ["mass\ng", "diameter\nmm", "restitution\non floor", "contact time\nms"]
    pressed = [entry.static_stiffness for entry in entries]
    pressed_too = any(value is not None for value in pressed)
    headings += ["stiffness\nN/m", *(["static\nN/m"] if pressed_too else [])]
    table = new_table(title, ["\nball"], tuple(headings))
    for entry, static in zip(entries, pressed, strict=True):
        table.add_row(
            str(entry.ball.name).replace(" ", "-"),
            number(entry.ball.mass * 1e3),
            number((entry.ball.diameter or math.nan) * 1e3),
            number(entry.restitution),
            number((entry.contact_time or math.nan) * 1e3),
            number(entry.stiffness),
            *([number(static or math.nan)] if pressed_too else []),
        )
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
    from stackbounce.model.catalogue import BALLS, CLASS_BALLS, PAIRS
    from stackbounce.version import __version__

    rows = [entry.to_mapping() for entry in (*BALLS, *CLASS_BALLS)]
    return {"stackbounce": __version__, "balls": rows, "pairs": PAIRS}
