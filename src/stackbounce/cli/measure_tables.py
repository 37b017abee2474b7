"""What ``stackbounce measure`` prints: tables for people, and JSON for machines."""

from collections.abc import Mapping, Sequence
from typing import Any

from rich.console import Console

from stackbounce.cli.tables import table_of_rows
from stackbounce.measure.constants import LawConstants
from stackbounce.measure.measurement import Measurement, row_mapping
from stackbounce.version import __version__


def summary(
    done: Sequence[Measurement], law: LawConstants | None, ball: Mapping[str, Any]
) -> dict[str, Any]:
    """Return what was found, for machines."""
    return {
        "stackbounce": __version__,
        "files": [source.to_mapping() for source in done],
        "law": None if law is None else [row_mapping(row) for row in law.all_rows()],
        "ball": dict(ball) or None,
    }


def print_measured(console: Console, done: Sequence[Measurement], law: LawConstants | None) -> None:
    """Print what was found, for people."""
    for source in done:
        console.print(f"{source.source}: {source.evidence['format']}", style="bold")
        if source.evidence["why"]:
            console.print(f"  {source.evidence['why']}")
        if source.evidence["doubt"]:
            console.print(f"  Unsure: {source.evidence['doubt']}")
        console.print(table_of_rows(source.rows))
        for note in source.notes:
            console.print(f"  {note}")
    if law is not None:
        console.print(f"The contact as {type(law.law).__name__}", style="bold")
        console.print(table_of_rows(law.all_rows()))
