"""What ``stackbounce measure`` makes of its results: tables, JSON, a law and a ball."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from rich.console import Console

from stackbounce.cli.tables import table_of_rows
from stackbounce.files import write_file
from stackbounce.measure.constants import LawConstants
from stackbounce.measure.measurement import Measurement, row_mapping
from stackbounce.measure.quantities import nominal
from stackbounce.version import __version__


def summary(
    done: Sequence[Measurement], law: LawConstants | None, ball: Mapping[str, Any]
) -> dict[str, Any]:
    """Return what was found, for machines."""
    return {
        "stackbounce": __version__,
        "files": [source.to_mapping() for source in done],
        "law": None if law is None else [row_mapping(row) for row in law.rows()],
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
        console.print(table_of_rows(law.rows()))


def law_of(known: Mapping[str, Any], done: Sequence[Measurement]) -> LawConstants:
    """Return the law of ``--law``, calibrated to the results and the known numbers."""
    from stackbounce.measure import one_law
    from stackbounce.measure.setup import Setup

    names = ("mass", "contact_time", "restitution", "exponent")
    given = {name: known[name] for name in names if name in known}
    of_fall = ("height", "speed", "gravity", "mass", "diameter", "drag_coefficient", "air_density")
    speed = Setup.of(of_fall, known).impact_speed
    found = [finding for measurement in done for finding in measurement.found]
    return one_law(known["law"], found, **given, impact_speed=speed)


def save_ball(
    done: Sequence[Measurement],
    law: LawConstants | None,
    path: Path,
    known: Mapping[str, Any],
    name: str | None,
    overwrite: bool,
) -> dict[str, Any]:
    """Write the ball that was measured as a scenario file, and return what is in it."""
    from stackbounce.measure import one_ball
    from stackbounce.measure.setup import Setup

    fall = Setup.of(("height", "measured_to", "diameter"), known).drop_height
    parts: list[dict[str, Any]] = [] if fall is None else [{"height": nominal(fall)}]
    parts += [found.parts() for measurement in done for found in measurement.found]
    if law is not None:
        parts = [{key: part[key] for key in part if key != "contact"} for part in parts]
        parts.append(law.parts())
    ball = {key: nominal(known[key]) for key in ("mass", "diameter") if key in known}
    drop = one_ball(parts, **ball, name=name)
    write_file(path, drop.to_toml().encode(), overwrite)
    return drop.to_mapping()
